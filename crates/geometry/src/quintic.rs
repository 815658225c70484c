//! A polynomial of degree five by path position: what a smooth curve is cut into.
//!
//! Six conditions per axis determine it: place, direction and curvature at both ends. Pieces that
//! share these where they meet follow each other without a step in velocity or acceleration, and
//! none of them needs more than a few multiplications to be evaluated: no parameter is to be found
//! for a path position.
//!
//! ```text
//!   start, C′, C″ ●─────────────────● end, C′, C″        x = s / length
//!                  c0 + c1·x + … + c5·x⁵
//! ```
//!
//! The feed is measured in X, Y and Z; the other axes go along in proportion.

use crate::bernstein;
use crate::{AxisVector, DerivativeBounds, Jet, LINEAR_XYZ};
use nalgebra::Vector3;

/// A piece of a smooth curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quintic {
    /// Where it starts.
    pub start: AxisVector,
    /// Where it ends.
    pub end: AxisVector,
    /// First derivative of X, Y, Z by path position at both ends: about one long.
    pub tangents: [Vector3<f64>; 2],
    /// Second derivative at both ends, 1/mm.
    pub bends: [Vector3<f64>; 2],
    /// Path position at the end, mm, > 0.
    pub length: f64,
    /// How far it is from the curve it stands for, at most, mm.
    pub error_mm: f64,
}

/// Halvings before a hull is read.
const HULL_LEVELS: u32 = 2;

/// How far a smooth curve moves while its parameter goes from 0 to 1, from a start at zero: by
/// powers of the parameter. `d` and `e` are its first and second derivative at start and end.
fn powers(way: f64, d: [f64; 2], e: [f64; 2]) -> [f64; 5] {
    let [d0, d1] = d;
    let [e0, e1] = e;
    [
        d0,
        0.5 * e0,
        10.0 * way - 6.0 * d0 - 4.0 * d1 - 1.5 * e0 + 0.5 * e1,
        -15.0 * way + 8.0 * d0 + 7.0 * d1 + 1.5 * e0 - e1,
        6.0 * way - 3.0 * d0 - 3.0 * d1 - 0.5 * e0 + 0.5 * e1,
    ]
}

fn in_space(vector: &AxisVector) -> Vector3<f64> {
    vector.fixed_rows::<3>(0).into_owned()
}

impl Quintic {
    /// Position and derivatives at path position `s`, 0 to the length. Never allocates.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let l = self.length;
        let per_s = 1.0 / l;
        let displacement = self.end - self.start;
        // From the nearer end, so that both ends are met exactly.
        let is_back = s > 0.5 * l;
        let x = if is_back { (l - s) * per_s } else { s * per_s };
        let (origin, sign, near, far) = if is_back {
            (self.end, -1.0, 1, 0)
        } else {
            (self.start, 1.0, 0, 1)
        };
        let mut jet = Jet {
            position: origin + displacement * (sign * x),
            d1: displacement * per_s,
            d2: AxisVector::zeros(),
            d3: AxisVector::zeros(),
        };
        for i in LINEAR_XYZ {
            let [a, b, c, d, e] = powers(
                sign * displacement[i],
                [near, far].map(|end| sign * l * self.tangents[end][i]),
                [near, far].map(|end| l * l * self.bends[end][i]),
            );
            jet.position[i] = origin[i] + x * (a + x * (b + x * (c + x * (d + x * e))));
            let first = a + x * (2.0 * b + x * (3.0 * c + x * (4.0 * d + x * (5.0 * e))));
            let second = 2.0 * b + x * (6.0 * c + x * (12.0 * d + x * (20.0 * e)));
            let third = 6.0 * c + x * (24.0 * d + x * (60.0 * e));
            jet.d1[i] = sign * first * per_s;
            jet.d2[i] = second * per_s * per_s;
            jet.d3[i] = sign * third * per_s.powi(3);
        }
        jet
    }

    /// Bézier points, relative to the start.
    fn control(&self) -> [AxisVector; 6] {
        let way = self.end - self.start;
        let mut points: [AxisVector; 6] = core::array::from_fn(|k| way * (k as f64 / 5.0));
        let l = self.length;
        for i in LINEAR_XYZ {
            let [d0, d1] = [0, 1].map(|end| l * self.tangents[end][i] / 5.0);
            let [e0, e1] = [0, 1].map(|end| l * l * self.bends[end][i] / 20.0);
            let own = [
                0.0,
                d0,
                2.0 * d0 + e0,
                way[i] - 2.0 * d1 + e1,
                way[i] - d1,
                way[i],
            ];
            for (point, value) in points.iter_mut().zip(own) {
                point[i] = value;
            }
        }
        points
    }

    /// Largest derivatives per axis.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        let per_s = 1.0 / self.length;
        let first: [AxisVector; 5] = bernstein::differences(&self.control());
        let second: [AxisVector; 4] = bernstein::differences(&first);
        let third: [AxisVector; 3] = bernstein::differences(&second);
        DerivativeBounds {
            d1: bernstein::max_abs(&first, HULL_LEVELS) * (5.0 * per_s),
            d2: bernstein::max_abs(&second, HULL_LEVELS) * (20.0 * per_s * per_s),
            d3: bernstein::max_abs(&third, HULL_LEVELS) * (60.0 * per_s.powi(3)),
        }
    }

    /// Smallest and largest coordinate on every axis, or a little beyond.
    #[must_use]
    pub fn bounding_box(&self) -> (AxisVector, AxisVector) {
        let points = self.control().map(|point| self.start + point);
        points.iter().fold(
            (self.start.inf(&self.end), self.start.sup(&self.end)),
            |(low, high), point| (low.inf(point), high.sup(point)),
        )
    }

    /// The rest of the curve after path position `s`, from a place near its own there.
    #[must_use]
    pub fn after(&self, s: f64, start: AxisVector) -> Self {
        let jet = self.jet(s);
        Self {
            start,
            tangents: [in_space(&jet.d1), self.tangents[1]],
            bends: [in_space(&jet.d2), self.bends[1]],
            length: self.length - s,
            ..*self
        }
    }
}
