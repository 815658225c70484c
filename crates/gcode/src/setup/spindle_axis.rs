//! A spindle that is an axis of the machine when it does not turn.

use glidepath_geometry::{Axis, AxisVector, limit_along};
use glidepath_program::Limits;

/// A spindle whose drive follows a rotary axis of the machine while M3 and M4 do not turn it. Rising
/// angles are the way that M3 turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleAxis {
    /// The axis.
    pub axis: Axis,
    /// What the axes of the machine can do.
    pub limits: Limits,
    /// G84 and G74 tap rigidly; else they are for a tap in a holder that gives way.
    pub rigid_tapping: bool,
}

impl SpindleAxis {
    /// The highest speed along a direction of length 1, mm/s.
    pub(crate) fn most_v(&self, direction: &AxisVector) -> f64 {
        limit_along(direction, &self.limits.velocity)
    }
}
