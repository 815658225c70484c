//! Transitions: curves that replace a corner, so that the machine need not stop there.
//!
//! ```text
//!             corner P
//!    ──────────┬ ─ ─ ·         T1, T2: directions, unit feed length
//!    P − d·T1  │ ╲   ·         d: what the transition takes from each side
//!                 ╲  │         δ: its largest distance from P
//!                  ╲ │ P + d·T2
//!                    │
//! ```
//!
//! Every family lies in the span of T1 and T2, `P + a·T1 + b·T2` with scalar functions a and b, so
//! any number of axes goes along and the formulas are those of a planar corner.
//!
//! | family | at the lines | parametrised by | meant for |
//! |---|---|---|---|
//! | [`Blend`] | velocity, acceleration, jerk continuous | path position | corners of two lines (default) |
//! | [`BezierPair`] | curvature continuous | arc length | constant corner speed, the published pair |
//! | [`Hermite`] | position and three derivatives | path position | junctions where an arc takes part |
//!
//! Source: Chen, Zhang, Li, *Local Interpolation Method for Continuous Small Line Segments*, 2017,
//! for the pair, with its misprints put right; the other families were derived for Glidepath.

mod bezier_pair;
mod blend;
mod bounds;
mod constant_speed;
mod error;
mod hermite;

pub use bezier_pair::{BezierPair, PairShape};
pub use blend::Blend;
pub use bounds::DerivativeBounds;
pub use error::TransitionError;
pub use hermite::Hermite;

use crate::{AxisVector, Jet};

/// A curve that replaces a corner. Path position runs from 0 to [`Transition::length`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a box would allocate, and the largest is usual"
)]
pub enum Transition {
    /// Polynomial blend of the two directions.
    Blend(Blend),
    /// Two rational cubics.
    BezierPair(BezierPair),
    /// Septic polynomial through two jets.
    Hermite(Hermite),
}

impl Transition {
    /// The default for a corner of two lines: the uniform sextic blend that takes `d` > 0 from each
    /// side. `t1` and `t2` are the directions, of unit feed length.
    #[must_use]
    pub fn sextic(corner: AxisVector, t1: AxisVector, t2: AxisVector, d: f64) -> Self {
        Self::Blend(Blend::new(corner, t1, t2, d))
    }

    /// The published pair of rational cubics, by arc length.
    ///
    /// # Errors
    /// For a reversal, and for directions that are not both unit in the same axes.
    pub fn bezier_pair(
        corner: AxisVector,
        t1: AxisVector,
        t2: AxisVector,
        d: f64,
        shape: PairShape,
    ) -> Result<Self, TransitionError> {
        BezierPair::new(corner, t1, t2, d, shape).map(Self::BezierPair)
    }

    /// The septic polynomial that leaves `from` and arrives at `to` with all their derivatives,
    /// its path position running over `length` > 0. Between two lines, with length 2d, it is the
    /// sextic.
    #[must_use]
    pub fn hermite(from: &Jet, to: &Jet, length: f64) -> Self {
        Self::Hermite(Hermite::new(from, to, length))
    }

    /// Path position at the end, mm.
    #[must_use]
    pub const fn length(&self) -> f64 {
        match self {
            Self::Blend(curve) => curve.length(),
            Self::BezierPair(curve) => curve.length(),
            Self::Hermite(curve) => curve.length(),
        }
    }

    /// Position and derivatives at path position `s`, which is clamped to the curve. Never
    /// allocates.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let s = s.max(0.0).min(self.length());
        match self {
            Self::Blend(curve) => curve.jet(s),
            Self::BezierPair(curve) => curve.jet(s),
            Self::Hermite(curve) => curve.jet(s),
        }
    }

    /// Whether all of the curve is proven to lie between two positions, axis by axis, or beyond by
    /// `slack` at most.
    ///
    /// Blends and pairs lie in the triangle of the corner, and so where their ends and the corner do:
    /// it is taken for granted that these are inside.
    #[must_use]
    pub fn is_within(&self, lowest: &AxisVector, highest: &AxisVector, slack: f64) -> bool {
        match self {
            Self::Blend(_) | Self::BezierPair(_) => true,
            Self::Hermite(curve) => curve.is_within(lowest, highest, slack),
        }
    }

    /// Largest derivatives per axis.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        match self {
            Self::Blend(curve) => curve.bounds(),
            Self::BezierPair(curve) => curve.bounds(),
            Self::Hermite(curve) => curve.bounds(),
        }
    }
}
