//! The guard against jumps: it refuses a setpoint whose curve asks for more than a joint may do.
//!
//! Setpoints come from another process, and after a gap the joints are elsewhere than the next one
//! takes them to be. Either way the curve to the next setpoint could ask for more than any drive
//! can do, and a drive that follows it stalls, trips or breaks something. So the curve is looked at
//! before it is begun: velocity and acceleration of the quintic at its quarters and at its end. A
//! step by d within a time h shows there as 1.875 d/h and 5.6 d/h².
//!
//! Where setpoints are missing, between the two or while the joints coasted, velocity alone is
//! judged. After a tick that the interpolator missed the motion goes on where it was, a period later
//! than the joints did: to make that good within a period takes more acceleration than the joints
//! have, for so short a time that drives do follow, and a stop off the path would be worse.

use super::{JointState, quintic};
use core::fmt;
use glidepath_geometry::AXES;

/// The limits of the guard: what a joint may be asked for at most. To be set above the limits that
/// the motion is planned with, or else every motion at its limit is a jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JumpLimits {
    /// mm/s or °/s, > 0; infinite for no guard.
    pub velocity: f64,
    /// mm/s² or °/s², > 0; infinite for no guard.
    pub acceleration: f64,
}

impl Default for JumpLimits {
    /// No guard: what a machine can do is not known here.
    fn default() -> Self {
        Self {
            velocity: f64::INFINITY,
            acceleration: f64::INFINITY,
        }
    }
}

impl JumpLimits {
    /// The guard's limits above those of a joint: a fifth above the velocity and twice the
    /// acceleration.
    ///
    /// The curve between two setpoints that keep the limits by finite differences goes past them
    /// by a little.
    #[must_use]
    pub fn above(velocity: f64, acceleration: f64) -> Self {
        Self {
            velocity: 1.2 * velocity,
            acceleration: 2.0 * acceleration,
        }
    }
}

/// The quantity that a setpoint asked too much of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JumpOf {
    /// mm/s or °/s.
    Velocity,
    /// mm/s² or °/s².
    Acceleration,
}

/// A setpoint that is not played, because the way to it is beyond the limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// The joint, from 0.
    pub joint: usize,
    /// Where it would have come from, mm or degrees.
    pub from: f64,
    /// Where it was to go, mm or degrees.
    pub to: f64,
    /// In what time, s.
    pub span_t: f64,
    /// What of the way is too much.
    pub of: JumpOf,
    /// How much it would have been.
    pub asked: f64,
    /// How much is allowed.
    pub limit: f64,
}

impl fmt::Display for Jump {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            joint,
            from,
            to,
            span_t,
            asked,
            limit,
            ..
        } = self;
        let (what, unit) = match self.of {
            JumpOf::Velocity => ("a velocity", "1/s"),
            JumpOf::Acceleration => ("an acceleration", "1/s²"),
        };
        write!(
            f,
            "joint {joint}: from {from} to {to} within {:.3} ms asks for {what} of {asked:.1}, \
             allowed are {limit:.1} (mm or degrees, {unit})",
            span_t * 1e3
        )
    }
}

/// What is wrong with the way from one state of the joints to another, if anything is; `is_whole` if
/// no setpoint is missing on it. The joints in `led` are not looked at, one bit each: their drives
/// lead, and setpoints repeat what they report.
pub(super) fn find_jump(
    from: &[JointState; AXES],
    to: &[JointState; AXES],
    span_t: f64,
    limits: &[JumpLimits; AXES],
    (is_whole, led): (bool, u32),
) -> Option<Jump> {
    let ways = from.iter().zip(to).zip(limits).enumerate();
    ways.filter(|(joint, _)| led & 1 << joint == 0)
        .filter(|(_, (_, limits))| limits.velocity.min(limits.acceleration).is_finite())
        .find_map(|(joint, ((from, to), limits))| {
            let quarters = [0.25, 0.5, 0.75, 1.0];
            let peaks = quarters.map(|part| quintic(from, to, span_t, part * span_t));
            let peak = |of: fn(&JointState) -> f64| peaks.iter().map(of).fold(0.0, f64::max);
            let (v, a) = (
                peak(|joint| joint.velocity.abs()),
                peak(|joint| joint.acceleration.abs()),
            );
            let (of, asked, limit) = if v > limits.velocity {
                (JumpOf::Velocity, v, limits.velocity)
            } else if is_whole && a > limits.acceleration {
                (JumpOf::Acceleration, a, limits.acceleration)
            } else {
                return None;
            };
            Some(Jump {
                joint,
                from: from.position,
                to: to.position,
                span_t,
                of,
                asked,
                limit,
            })
        })
}
