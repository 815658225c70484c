//! The rule for the length of chords, the chord, and the errors of a curve that cannot be followed.

use nalgebra::Vector3;
use thiserror::Error;

/// The rule for the length of chords: as long as both limits allow. With the feed per tick as the
/// longest, L = v·T wherever the error allows it; where not, the curve is too sharp for that speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChordRule {
    /// Longest chord, mm, > 0.
    pub longest_mm: f64,
    /// Largest distance of the curve from a chord, mm, > 0.
    pub error_mm: f64,
}

impl ChordRule {
    /// Below this a chord is given up.
    pub(crate) fn shortest_mm(&self) -> f64 {
        1e-6 * self.longest_mm.min(1.0)
    }
}

/// A chord, from where the last one ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chord {
    /// Where it ends, mm.
    pub point: Vector3<f64>,
    /// Its length, mm; as long as wanted within the rounding of the coordinates, 2 pm and eight
    /// units in their last place (1e-7 mm where they are 6e7 mm), and of the formulas. One that
    /// is longer by more than a thousandth of the longest is refused.
    pub chord_mm: f64,
    /// Bound on the distance between the chord and the curve, both ways and in order, mm.
    pub error_mm: f64,
    /// Whether interval arithmetic proved the bound. Only where two surfaces nearly touch, but
    /// neither cross cleanly nor meet in a node within the rounding of their formulas, chords are
    /// not proven; they are at most 0.01 mm long, and bounded by their curvature.
    pub is_proven: bool,
}

/// The reason why a curve cannot be followed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CurveError {
    /// A formula has no value.
    #[error("the curve is not defined at t = {t}")]
    Undefined {
        /// Parameter.
        t: f64,
    },
    /// A value or derivative grows beyond all bounds, or jumps.
    #[error("the curve or its derivatives are not defined or have no bound near t = {t}")]
    Unbounded {
        /// Parameter.
        t: f64,
    },
    /// What a formula rounds away is more than a thousandth of the longest chord, or all of one.
    #[error(
        "the numbers are too coarse to follow the curve near t = {t}: they are rounded too much for a chord"
    )]
    TooCoarse {
        /// Parameter.
        t: f64,
    },
    /// The point does not move with the parameter.
    #[error("the curve stands still near t = {t}")]
    StandsStill {
        /// Parameter.
        t: f64,
    },
    /// The two surfaces touch or do not meet in one curve there.
    #[error(
        "the surfaces do not cross in one clean curve near ({:.6}, {:.6}, {:.6})", point.x, point.y, point.z
    )]
    Singular {
        /// Where, mm.
        point: Vector3<f64>,
    },
    /// No point of the curve was found where one was wanted.
    #[error(
        "no point of the curve was found near ({:.6}, {:.6}, {:.6})", point.x, point.y, point.z
    )]
    Lost {
        /// Where, mm.
        point: Vector3<f64>,
    },
    /// The direction given for the start is across the curve.
    #[error("the curve runs across the given direction at its start")]
    Sideways,
    /// The end did not come.
    #[error("the end of the curve was not reached within {length_mm:.0} mm")]
    Endless {
        /// Length followed, mm.
        length_mm: f64,
    },
}
