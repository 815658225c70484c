//! The shape invariants of a pair: what its weights decide of curvature and deviation.

use crate::Turn;

/// Shape invariants of a half: s1 = w0·w2/w1², s2 = w1·w3/w2², both > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairShape {
    /// At the line.
    pub s1: f64,
    /// At the junction.
    pub s2: f64,
}

impl PairShape {
    /// Unit weights: one polynomial cubic.
    pub const CUBIC: Self = Self { s1: 1.0, s2: 1.0 };
    /// A sensible fixed choice among the pairs whose curvature is smooth at the junction: 12 % less
    /// peak curvature than the cubic.
    pub const SMOOTH: Self = Self {
        s1: 0.6,
        s2: 15.0 / 17.0,
    };

    /// True if the derivative of curvature is continuous at the junction, to a relative 1e-12.
    #[must_use]
    pub fn is_smooth_at_junction(self) -> bool {
        (self.s2 * (4.0 - self.s1) - 3.0).abs() <= 3e-12
    }

    /// Largest distance of the corner from the curve, mm; `sb` as for [`crate::Blend::deviation`].
    #[must_use]
    pub fn deviation(d: f64, sb: f64) -> f64 {
        0.25 * d * sb
    }

    /// The length `d` that gives a deviation; infinite for `sb` = 0.
    #[must_use]
    pub fn distance_for(deviation_mm: f64, sb: f64) -> f64 {
        4.0 * deviation_mm / sb
    }

    /// Curvature at the junction, 1/mm. It is the largest if [`PairShape::peaks_at_junction`].
    #[must_use]
    pub fn junction_curvature(self, d: f64, turn: Turn) -> f64 {
        self.s2 * 8.0 * turn.sb / (3.0 * d * turn.cb * turn.cb)
    }

    /// Whether the curvature peaks at the junction, for a shape that is smooth there. Where it does
    /// not, the peak was at most 0.3 % higher for 0.02 ≤ s1.
    #[must_use]
    pub fn peaks_at_junction(self, turn: Turn) -> bool {
        let tan = turn.sb / turn.cb;
        3.0 * tan * tan + 3.0 * self.s1 * self.s1 - self.s1 >= 0.0
    }

    /// Derivative of curvature by arc length where the curve leaves the line, 1/mm²: never zero.
    #[must_use]
    pub fn end_curvature_rate(self, d: f64, turn: Turn) -> f64 {
        2.0 * self.s1 * self.s1 * self.s2 * turn.sin_theta() / (9.0 * d * d)
    }

    /// Derivative of curvature by arc length arriving at the junction, 1/mm²; it leaves with the
    /// opposite sign.
    #[must_use]
    pub fn junction_curvature_rate(self, d: f64, turn: Turn) -> f64 {
        let Self { s1, s2 } = self;
        32.0 / 3.0 * s2 * (4.0 * s2 - s1 * s2 - 3.0) * turn.sb / (d * d * turn.cb.powi(3))
    }
}
