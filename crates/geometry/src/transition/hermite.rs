//! Septic Hermite transition: through position and three derivatives at both ends.
//!
//! For corners and tangent joints where an arc takes part. Eight conditions per axis determine a
//! polynomial of degree seven in s; its Bézier points follow from the Taylor expansions at the
//! ends, and the hull of the Bézier points of a derivative bounds that derivative.

use super::bounds::DerivativeBounds;
use crate::bernstein;
use crate::{AxisVector, Jet};

/// A polynomial of degree seven per axis, by path position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hermite {
    /// Where it starts; the Bézier points are relative to it, so that a small curve far from the
    /// origin keeps its digits.
    origin: AxisVector,
    control: [AxisVector; 8],
    length: f64,
}

impl Hermite {
    /// The curve from one jet to another over a path length > 0.
    #[must_use]
    pub fn new(from: &Jet, to: &Jet, length: f64) -> Self {
        let start = ends(from, length);
        let end = ends(to, -length);
        let span = to.position - from.position;
        let control = [
            start[0],
            start[1],
            start[2],
            start[3],
            span + end[3],
            span + end[2],
            span + end[1],
            span + end[0],
        ];
        Self {
            origin: from.position,
            control,
            length,
        }
    }

    /// Path position at the end, mm.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// Position and derivatives at path position `s`.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let per_s = 1.0 / self.length;
        let u = s * per_s;
        // De Casteljau to a cubic; its four points hold the value and three derivatives.
        let mut points = self.control;
        for degree in (4..8).rev() {
            for i in 0..degree {
                points[i] = points[i] * (1.0 - u) + points[i + 1] * u;
            }
        }
        let [p0, p1, p2, p3, ..] = points;
        let v = 1.0 - u;
        let (e0, e1, e2) = (p1 - p0, p2 - p1, p3 - p2);
        let value =
            p0 * (v * v * v) + p1 * (3.0 * v * v * u) + p2 * (3.0 * v * u * u) + p3 * (u * u * u);
        let first = e0 * (v * v) + e1 * (2.0 * v * u) + e2 * (u * u);
        let second = (e1 - e0) * v + (e2 - e1) * u;
        let third = e2 - e1 * 2.0 + e0;
        Jet {
            position: self.origin + value,
            d1: first * (7.0 * per_s),
            d2: second * (42.0 * per_s * per_s),
            d3: third * (210.0 * per_s * per_s * per_s),
        }
    }

    /// Whether all of the curve is proven to lie between two positions, or beyond by `slack` at most:
    /// by hulls, on up to 2⁶ pieces where they are not inside.
    #[must_use]
    pub fn is_within(&self, lowest: &AxisVector, highest: &AxisVector, slack: f64) -> bool {
        let slack = AxisVector::repeat(slack);
        let ends = [lowest - self.origin - slack, highest - self.origin + slack];
        bernstein::is_within(&self.control, &ends, TRAVEL_LEVELS)
    }

    /// Largest derivatives per axis, from hulls on eight pieces.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        let per_s = 1.0 / self.length;
        let first: [AxisVector; 7] = bernstein::differences(&self.control);
        let second: [AxisVector; 6] = bernstein::differences(&first);
        let third: [AxisVector; 5] = bernstein::differences(&second);
        DerivativeBounds {
            d1: bernstein::max_abs(&first, HULL_LEVELS) * (7.0 * per_s),
            d2: bernstein::max_abs(&second, HULL_LEVELS) * (42.0 * per_s * per_s),
            d3: bernstein::max_abs(&third, HULL_LEVELS) * (210.0 * per_s * per_s * per_s),
        }
    }
}

/// Halvings before the hull is read: 2³ pieces.
const HULL_LEVELS: u32 = 3;
/// Halvings at most to prove that the curve is inside a box.
const TRAVEL_LEVELS: u32 = 6;

/// The four Bézier points next to an end, relative to it; `length` negative at the far end.
fn ends(jet: &Jet, length: f64) -> [AxisVector; 4] {
    let first = jet.d1 * (length / 7.0);
    let second = jet.d2 * (length * length / 42.0);
    let third = jet.d3 * (length * length * length / 210.0);
    [
        AxisVector::zeros(),
        first,
        first * 2.0 + second,
        (first + second) * 3.0 + third,
    ]
}
