//! The limits of the axes (velocity, acceleration, jerk, travel), and the limits along the path.

use crate::Travel;
use glidepath_geometry::AxisVector;

/// Largest speed, acceleration and jerk of every axis, each > 0, in any direction of motion, and its
/// travel.
///
/// An axis the machine does not have keeps the values of [`Limits::UNLIMITED`]; no program moves
/// it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// mm/s or °/s.
    pub velocity: AxisVector,
    /// mm/s² or °/s².
    pub acceleration: AxisVector,
    /// mm/s³ or °/s³.
    pub jerk: AxisVector,
    /// The limits of the motion along the path, beside those of the axes.
    pub path: PathBounds,
    /// How far each axis can go.
    pub travel: Travel,
}

impl Limits {
    /// The value that stands for "no limit": large, but finite, so that formulas stay finite.
    pub const UNLIMITED: f64 = 1e12;

    /// The same three limits on every axis, and no end of travel.
    #[must_use]
    pub fn uniform(velocity: f64, acceleration: f64, jerk: f64) -> Self {
        Self {
            velocity: AxisVector::repeat(velocity),
            acceleration: AxisVector::repeat(acceleration),
            jerk: AxisVector::repeat(jerk),
            path: PathBounds::NONE,
            travel: Travel::unlimited(),
        }
    }
}

/// Limits of the motion along the path, beside those of the axes, each > 0. With κ the curvature,
/// and speed, acceleration and jerk those of path position:
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathBounds {
    /// Largest acceleration along the path, mm/s².
    pub tangential_a: f64,
    /// Largest acceleration across it, v²·κ, mm/s².
    pub normal_a: f64,
    /// Largest jerk along the path, and of going round a curve, v³·κ², mm/s³.
    pub jerk_j: f64,
}

impl PathBounds {
    /// No limits.
    pub const NONE: Self = Self {
        tangential_a: Limits::UNLIMITED,
        normal_a: Limits::UNLIMITED,
        jerk_j: Limits::UNLIMITED,
    };

    /// True if there are no such limits.
    #[must_use]
    #[inline]
    pub fn is_none(&self) -> bool {
        let limits = [self.tangential_a, self.normal_a, self.jerk_j];
        limits.iter().all(|limit| *limit >= Limits::UNLIMITED)
    }

    /// The highest speed on a curve, mm/s.
    #[inline]
    #[must_use]
    pub fn speed_v(&self, curvature_k: f64) -> f64 {
        let by_acceleration = (self.normal_a / curvature_k).sqrt();
        by_acceleration.min((self.jerk_j / (curvature_k * curvature_k)).cbrt())
    }
}
