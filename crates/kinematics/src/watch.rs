//! The judge of a motion in the space of the joints, period by period: reach, singularities,
//! limits.

use crate::{
    JointLimits, JointMotion, JointVector, JointViolation, Kinematics, KinematicsError, Mechanism,
};
use glidepath_geometry::AxisVector;
use thiserror::Error;

/// A fault of a motion: what the mechanism cannot do.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum JointFault {
    /// The mechanism may not go there.
    #[error(transparent)]
    Position(#[from] KinematicsError),
    /// A joint cannot do it.
    #[error("{0}")]
    Limit(JointViolation),
}

/// Judges positions that follow each other by a period: reach, singularities, and the limits of
/// every joint by finite differences of its positions, which is what its drive makes of them.
///
/// Bounded work, no allocation.
#[derive(Debug, Clone, Copy)]
pub struct JointWatch {
    mechanism: Mechanism,
    limits: JointLimits,
    period_t: f64,
    last: Option<Last>,
}

#[derive(Debug, Clone, Copy)]
struct Last {
    position: JointVector,
    velocity: JointVector,
    acceleration: JointVector,
}

impl JointWatch {
    /// A judge of motions with a period in s.
    #[must_use]
    pub const fn new(mechanism: Mechanism, limits: JointLimits, period_t: f64) -> Self {
        Self {
            mechanism,
            limits,
            period_t,
            last: None,
        }
    }

    /// Whether the mechanism may stand at a position.
    ///
    /// # Errors
    /// What forbids it.
    pub fn stand(&self, axes: &AxisVector) -> Result<JointVector, JointFault> {
        let position = self.mechanism.admitted(axes)?;
        let motion = JointMotion {
            position,
            velocity: JointVector::zeros(),
            acceleration: JointVector::zeros(),
        };
        match self.limits.broken_by(&motion) {
            Some(violation) => Err(JointFault::Limit(violation)),
            None => Ok(position),
        }
    }

    /// Forgets the motion: the next position is one of rest.
    pub const fn rest(&mut self) {
        self.last = None;
    }

    /// Takes the next position of the motion; before the first one the machine was at rest there.
    ///
    /// # Errors
    /// The first thing that the mechanism cannot do.
    pub fn take(&mut self, axes: &AxisVector) -> Result<(), JointFault> {
        let position = self.mechanism.admitted(axes)?;
        let zero = JointVector::zeros();
        let mut last = self.last.unwrap_or(Last {
            position,
            velocity: zero,
            acceleration: zero,
        });
        self.follow(&mut last, position)?;
        self.last = Some(last);
        Ok(())
    }

    /// Judges the newest of four positions that follow each other by a period, the newest first;
    /// what was taken before does not count.
    ///
    /// # Errors
    /// The first thing that the mechanism cannot do.
    pub fn judge(&self, axes: &[AxisVector; 4]) -> Result<(), JointFault> {
        let position = self.stand(&axes[0])?;
        let mut before = [position; 3];
        for (joints, axes) in before.iter_mut().zip(&axes[1..]) {
            *joints = self.mechanism.inverse(axes)?;
        }
        let [a, b, c] = before;
        let (velocity, earlier) = ((a - b) / self.period_t, (b - c) / self.period_t);
        let mut last = Last {
            position: a,
            velocity,
            acceleration: (velocity - earlier) / self.period_t,
        };
        self.follow(&mut last, position)
    }

    /// Takes a position that follows another, in place: a jog asks at every place of every stop.
    #[inline]
    fn follow(&self, last: &mut Last, position: JointVector) -> Result<(), JointFault> {
        let velocity = (position - last.position) / self.period_t;
        let acceleration = (velocity - last.velocity) / self.period_t;
        let jerk = (acceleration - last.acceleration) / self.period_t;
        let motion = JointMotion {
            position,
            velocity,
            acceleration,
        };
        if !self.limits.plainly_keep(&motion, &jerk) {
            let broken = self.limits.broken_by(&motion);
            if let Some(violation) = broken.or_else(|| self.limits.jerk_broken_by(&jerk)) {
                return Err(JointFault::Limit(violation));
            }
        }
        *last = Last {
            position,
            velocity,
            acceleration,
        };
        Ok(())
    }
}
