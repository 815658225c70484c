//! The limits of the joints (position, velocity, acceleration, jerk), and the check of a motion
//! against them.

use crate::{JOINTS, JointMotion};
use core::fmt;

/// Limits of one joint, mm or degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLimit {
    /// Lowest position.
    pub min_position: f64,
    /// Highest position.
    pub max_position: f64,
    /// Largest speed, per s, > 0.
    pub velocity: f64,
    /// Largest acceleration, per s², > 0.
    pub acceleration: f64,
    /// Largest jerk, per s³, > 0.
    pub jerk: f64,
}

impl JointLimit {
    /// A joint that can do everything.
    pub const NONE: Self = Self {
        min_position: f64::NEG_INFINITY,
        max_position: f64::INFINITY,
        velocity: f64::INFINITY,
        acceleration: f64::INFINITY,
        jerk: f64::INFINITY,
    };
}

/// Limits of every joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLimits(pub [JointLimit; JOINTS]);

/// The quantity that a limit is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Position against the lower end of the joint's range.
    Lowest,
    /// Position against the upper end.
    Highest,
    /// Speed.
    Velocity,
    /// Acceleration.
    Acceleration,
    /// Jerk.
    Jerk,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lowest => "lowest position",
            Self::Highest => "highest position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Jerk => "jerk",
        })
    }
}

/// A limit that was not kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointViolation {
    /// The joint.
    pub joint: usize,
    /// Which of its limits.
    pub quantity: Quantity,
    /// What came, in the limit's unit.
    pub value: f64,
    /// The limit.
    pub limit: f64,
}

impl fmt::Display for JointViolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            joint,
            quantity,
            value,
            limit,
        } = self;
        write!(
            f,
            "joint J{joint}: {quantity} {limit:.3} is exceeded: {value:.3}"
        )
    }
}

impl JointLimits {
    /// No limits.
    pub const NONE: Self = Self([JointLimit::NONE; JOINTS]);

    /// Relative excess that rounding may cause.
    const ROUNDING: f64 = 1e-6;

    /// Whether a motion and its jerk are inside of all limits: without a branch, where nobody asks which one
    /// it is not. Not where something is not a number.
    pub(crate) fn plainly_keep(&self, motion: &JointMotion, jerk: &crate::JointVector) -> bool {
        let allowed = |limit: f64| limit * (1.0 + Self::ROUNDING);
        self.0
            .iter()
            .enumerate()
            .fold(true, |kept, (joint, limit)| {
                let position = motion.position[joint];
                kept & (position >= limit.min_position)
                    & (position <= limit.max_position)
                    & (motion.velocity[joint].abs() <= allowed(limit.velocity))
                    & (motion.acceleration[joint].abs() <= allowed(limit.acceleration))
                    & (jerk[joint].abs() <= allowed(limit.jerk))
            })
    }

    /// The first limit a motion does not keep.
    #[must_use]
    pub fn broken_by(&self, motion: &JointMotion) -> Option<JointViolation> {
        (0..JOINTS).find_map(|joint| {
            let limit = &self.0[joint];
            let position = motion.position[joint];
            let allowed = |limit: f64| limit * (1.0 + Self::ROUNDING);
            let (velocity, acceleration) = (
                motion.velocity[joint].abs(),
                motion.acceleration[joint].abs(),
            );
            let (quantity, value, limit) = if position < limit.min_position {
                (Quantity::Lowest, position, limit.min_position)
            } else if position > limit.max_position {
                (Quantity::Highest, position, limit.max_position)
            } else if velocity > allowed(limit.velocity) {
                (Quantity::Velocity, velocity, limit.velocity)
            } else if acceleration > allowed(limit.acceleration) {
                (Quantity::Acceleration, acceleration, limit.acceleration)
            } else {
                return None;
            };
            Some(JointViolation {
                joint,
                quantity,
                value,
                limit,
            })
        })
    }

    /// The first joint whose jerk exceeds its limit.
    #[must_use]
    pub fn jerk_broken_by(&self, jerk: &crate::JointVector) -> Option<JointViolation> {
        (0..JOINTS).find_map(|joint| {
            let (value, limit) = (jerk[joint].abs(), self.0[joint].jerk);
            (value > limit * (1.0 + Self::ROUNDING)).then_some(JointViolation {
                joint,
                quantity: Quantity::Jerk,
                value,
                limit,
            })
        })
    }
}
