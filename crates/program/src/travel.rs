//! The travel of every axis: its soft limits.

use glidepath_geometry::AxisVector;

/// The travel of every axis: its soft limits, in machine coordinates, mm or degrees.
///
/// Both ends belong to it: a program may go to an end of travel, and rest there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Travel {
    /// Lowest position; −∞ for an axis without a soft limit.
    pub lowest: AxisVector,
    /// Highest position; ∞ for an axis without a soft limit.
    pub highest: AxisVector,
}

impl Travel {
    /// What rounding may put a position beyond an end of travel, mm or degrees. All who judge a
    /// position allow as much: the reader of programs, the planner, the interpolator, the auditor.
    pub const ROUNDING: f64 = 1e-9;

    /// No soft limits.
    #[must_use]
    pub fn unlimited() -> Self {
        Self {
            lowest: AxisVector::repeat(f64::NEG_INFINITY),
            highest: AxisVector::repeat(f64::INFINITY),
        }
    }
}
