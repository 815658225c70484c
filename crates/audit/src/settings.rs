//! The settings of an audit: limits, period and tolerance that a motion is judged by.

use glidepath_geometry::AxisVector;
use glidepath_program::{Corners, DirectionTolerance, Limits, Settings};

/// The settings of an audit: what a motion is judged by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AuditSettings {
    /// What each axis can do.
    pub limits: Limits,
    /// Interpolation period in seconds, > 0.
    pub period_t: f64,
    /// Tolerance in mm where the program gives none (G64 P), > 0: for XYZ together, and for UVW
    /// together.
    pub tolerance_mm: f64,
    /// That of the direction of the tool, where it is told how the rotary axes turn it ([`crate::Audit::with_tool`]);
    /// else that of the rotary axes together.
    pub direction: DirectionTolerance,
    /// On which side of the program's corners the motion is to be.
    pub corners: Corners,
}

impl AuditSettings {
    /// The same for a motion that begins at a place: an axis that stands beyond its travel there may stay or come
    /// inwards.
    #[must_use]
    pub fn beginning_at(mut self, start: &AxisVector) -> Self {
        self.limits.travel = self.limits.travel.beginning_at(start);
        self
    }
}

/// What a motion that was planned with these settings is judged by.
impl From<&Settings> for AuditSettings {
    fn from(planned: &Settings) -> Self {
        Self {
            limits: planned.limits,
            period_t: planned.period_t,
            tolerance_mm: planned.tolerance_mm,
            direction: planned.direction,
            corners: planned.corners,
        }
    }
}
