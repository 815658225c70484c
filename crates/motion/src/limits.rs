//! What each axis can do.

use glidepath_geometry::AxisVector;

/// Largest speed, acceleration and jerk of every axis, each > 0, in any direction of motion.
///
/// An axis the machine does not have keeps the values of [`Limits::UNLIMITED`]; no program moves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// mm/s or °/s.
    pub velocity: AxisVector,
    /// mm/s² or °/s².
    pub acceleration: AxisVector,
    /// mm/s³ or °/s³.
    pub jerk: AxisVector,
}

impl Limits {
    /// The value that stands for "no limit": large, but finite, so that formulas stay finite.
    pub const UNLIMITED: f64 = 1e12;

    /// The same three limits on every axis.
    #[must_use]
    pub fn uniform(velocity: f64, acceleration: f64, jerk: f64) -> Self {
        Self {
            velocity: AxisVector::repeat(velocity),
            acceleration: AxisVector::repeat(acceleration),
            jerk: AxisVector::repeat(jerk),
        }
    }
}
