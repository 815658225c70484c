//! Heading curve: the heading is a polynomial of arc length.
//!
//! With x = s/L and m = 2/5, over the turn θ = 2β,
//!
//! ```text
//! ψ(x) = θ·[(1+m)·h5 − m·h7]    h5 = 10x³ − 15x⁴ + 6x⁵    h7 = 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷
//! k    = θ/L·[(1+m)·30y² − 140m·y³]                         y = x(1−x)
//! ```
//!
//! so curvature is exact, zero with its derivative at both ends, and largest in the middle. Length and
//! deviation follow from C = ∫₀¹ cos(ψ−β)dx and S = ∫₀^½ sin(β−ψ)dx: L = 2d·cos β / C,
//! δ = d·sin β − L·S. Both are smooth, and a twelve-point rule on the half gives them to rounding.

use super::constant_speed::{Enclosure, Frame, Half, PlanarJet, Point};
use super::{DerivativeBounds, TransitionError};
use crate::quadrature::gauss_12;
use crate::{AxisVector, Jet, Turn};

/// Weight of h7: gives the lowest peak of dk/ds near which the peak of k is still flat.
const M: f64 = 0.4;

/// A heading curve at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadingCurve {
    frame: Frame,
    beta_rad: f64,
    d: f64,
    length: f64,
}

impl HeadingCurve {
    /// The curve that takes `d` > 0 from each side of the corner. `t1`, `t2`: unit feed length.
    ///
    /// # Errors
    /// For a reversal, and for directions that are not both unit in the same axes.
    pub fn new(
        corner: AxisVector,
        t1: AxisVector,
        t2: AxisVector,
        d: f64,
    ) -> Result<Self, TransitionError> {
        let frame = Frame::new(corner, &t1, &t2)?;
        let length = Self::length_for(d, frame.turn);
        Ok(Self {
            frame,
            beta_rad: 0.5 * frame.turn.theta_rad(),
            d,
            length,
        })
    }

    /// Arc length of the curve, mm.
    #[must_use]
    pub fn length_for(d: f64, turn: Turn) -> f64 {
        let beta = 0.5 * turn.theta_rad();
        let cosine = 2.0 * gauss_12(0.0, 0.5, |x| (beta * offset(x)).cos());
        2.0 * d * turn.cb / cosine
    }

    /// Largest distance of the corner from the curve, mm.
    #[must_use]
    pub fn deviation(d: f64, turn: Turn) -> f64 {
        let beta = 0.5 * turn.theta_rad();
        let sine = gauss_12(0.0, 0.5, |x| -(beta * offset(x)).sin());
        d * turn.sb - Self::length_for(d, turn) * sine
    }

    /// The length `d` that gives a deviation (which is proportional to it), mm; infinite for a turn
    /// of zero.
    #[must_use]
    pub fn distance_for(deviation_mm: f64, turn: Turn) -> f64 {
        deviation_mm / Self::deviation(1.0, turn)
    }

    /// Largest curvature, 1/mm, in the middle.
    #[must_use]
    pub fn max_curvature(d: f64, turn: Turn) -> f64 {
        turn.theta_rad() / Self::length_for(d, turn) * (15.0 / 8.0 - 5.0 / 16.0 * M)
    }

    /// Largest derivative of curvature by arc length, 1/mm².
    #[must_use]
    pub fn max_curvature_rate(d: f64, turn: Turn) -> f64 {
        turn.theta_rad() / Self::length_for(d, turn).powi(2) * max_rate()
    }

    /// Arc length of the whole curve, mm.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// Position and derivatives at arc length `s`.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let second_half = s > 0.5 * self.length;
        let s = if second_half { self.length - s } else { s };
        self.frame.jet(&self.planar(s / self.length), second_half)
    }

    /// Largest derivatives per axis.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        self.frame.bounds(self)
    }

    fn planar(&self, x: f64) -> PlanarJet {
        let Turn { sb, cb } = self.frame.turn;
        let beta = self.beta_rad;
        // sin φ / sin β without a quotient of zeros.
        let across = |phi: f64| {
            if sb > 0.0 {
                phi.sin() / sb
            } else {
                phi / beta.max(f64::MIN_POSITIVE)
            }
        };
        let (dx, dy) = (
            self.length * gauss_12(0.0, x, |x| (beta * offset(x)).cos()) / cb,
            self.length * gauss_12(0.0, x, |x| across(beta * offset(x))),
        );
        let phi = beta * offset(x);
        let tangent = [phi.cos() / cb, across(phi)];
        // The normal is (−sin φ, cos φ) in (m, n); times k, which has a factor sin β to spare.
        let normal = |k: f64| {
            [
                -k * phi.sin() / cb,
                if sb > 0.0 { k * phi.cos() / sb } else { 0.0 },
            ]
        };
        let [k, k1] = self.curvature(x);
        let (bend, turning) = (normal(k), normal(k1));
        [
            [-self.d + dx, self.d + dy],
            tangent,
            bend,
            [
                turning[0] - k * k * tangent[0],
                turning[1] - k * k * tangent[1],
            ],
        ]
    }

    /// Curvature and its derivative by arc length.
    fn curvature(&self, x: f64) -> [f64; 2] {
        let y = x * (1.0 - x);
        let theta = 2.0 * self.beta_rad;
        [
            theta / self.length * y * y * (30.0 * (1.0 + M) - 140.0 * M * y),
            theta / self.length.powi(2) * rate(x),
        ]
    }

    fn point(&self, x: f64) -> Point {
        let [k, k1] = self.curvature(x);
        let (sin, cos) = (self.beta_rad * offset(x)).sin_cos();
        Point {
            k,
            k1,
            heading: [cos, sin],
        }
    }
}

impl Half for HeadingCurve {
    type Piece = [f64; 2];

    fn root(&self) -> [f64; 2] {
        [0.0, 0.5]
    }

    fn halve(&self, &[from, to]: &[f64; 2]) -> [[f64; 2]; 2] {
        let middle = 0.5 * (from + to);
        [[from, middle], [middle, to]]
    }

    fn enclose(&self, &[from, to]: &[f64; 2]) -> Enclosure {
        let ends = [self.point(from), self.point(to)];
        // k rises up to the middle; dk/ds rises to its peak at (1 − 5^(−1/4))/2, then falls.
        let peak_x = 0.5 * (1.0 - peak_w());
        let peak = if (from..=to).contains(&peak_x) {
            self.curvature(peak_x)[1]
        } else {
            0.0
        };
        Enclosure {
            k: [ends[0].k, ends[1].k],
            k1: [
                ends[0].k1.min(ends[1].k1),
                ends[0].k1.max(ends[1].k1).max(peak),
            ],
            ends,
        }
    }
}

/// (ψ − β)/β: −1 at the start, 0 in the middle, 1 at the end.
fn offset(x: f64) -> f64 {
    let h5 = x * x * x * (10.0 + x * (6.0 * x - 15.0));
    let h7 = x * x * x * x * (35.0 + x * (x * (70.0 - 20.0 * x) - 84.0));
    2.0 * ((1.0 + M) * h5 - M * h7) - 1.0
}

/// dk/ds · L²/θ. With w = 1 − 2x it is 10.5·w·(1 − w⁴) for m = 2/5.
fn rate(x: f64) -> f64 {
    let y = x * (1.0 - x);
    y * (60.0 * (1.0 + M) - 420.0 * M * y) * (1.0 - 2.0 * x)
}

/// Where [`rate`] peaks, as w.
fn peak_w() -> f64 {
    5.0_f64.powf(-0.25)
}

fn max_rate() -> f64 {
    8.4 * peak_w()
}
