//! The clearance of a jog's step: it is done only if the stop from its end may be, too.
//!
//! The stop is played through before the step is published. So at every tick there is a stop known
//! that stays in travel and within reach, and keeps every joint inside its limits, and it is the
//! very stop that is made if the next step is not allowed.

use super::jog_motion::{JogMotion, Stop};
use super::travel::Travel;
use crate::shared::config::Config;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{
    JointLimits, JointMotion, JointVector, JointWatch, Kinematics as _, Mechanism,
};

/// Most places of a stop that are looked at: the mechanism is asked for each.
const PLACES: u32 = 48;
/// Ticks after the end of a stop in which differences still change.
const SETTLING: u32 = 3;
/// Part of a joint's velocity that a jog may take along a line: the direction of the joints changes
/// on the way.
const JOINT_SPEED_R: f64 = 0.95;

/// The judge of a jog where joints are not axes.
#[derive(Debug, Clone, Copy)]
struct JointClearance {
    mechanism: Mechanism,
    limits: JointLimits,
    /// The motion of the joints so far.
    watch: JointWatch,
}

/// The judge of a jog.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clearance {
    joints: Option<JointClearance>,
    period_t: f64,
}

impl Clearance {
    pub(crate) fn new(config: &Config) -> Self {
        let joints = config.joint_watch().map(|watch| JointClearance {
            mechanism: config.mechanism,
            limits: config.joint_limits,
            watch,
        });
        Self {
            joints,
            period_t: config.period_t(),
        }
    }

    /// The motion begins, from rest.
    pub(crate) const fn begin(&mut self) {
        if let Some(joints) = &mut self.joints {
            joints.watch.rest();
        }
    }

    /// A position was published.
    pub(crate) fn follow(&mut self, position: &AxisVector) {
        if let Some(joints) = &mut self.joints {
            // It was judged before; and if it was not, the joints are watched elsewhere, too.
            joints.watch.take(position).ok();
        }
    }

    /// Whether a course may be followed to where it is now.
    pub(crate) fn admits(&self, jog_motion: &JogMotion, travel: &Travel) -> bool {
        let stop = jog_motion.stop();
        let (low, high) = stop.extent();
        if !travel.holds(&(low, high)) {
            return false;
        }
        self.joints
            .as_ref()
            .is_none_or(|joints| joints.admits(&jog_motion.motion().position, &stop, self.period_t))
    }

    /// Whether joints are axes, so that only travel is judged.
    pub(crate) const fn is_of_travel_alone(&self) -> bool {
        self.joints.is_none()
    }

    /// The speed along a direction that the joints can do at a place; infinite where joints are
    /// axes.
    pub(crate) fn speed(&self, place: &AxisVector, direction: &AxisVector) -> f64 {
        let Some(joints) = &self.joints else {
            return f64::INFINITY;
        };
        let zero = AxisVector::zeros();
        let Ok(motion) = joints.mechanism.motion(place, direction, &zero) else {
            return 0.0;
        };
        let rates = motion.velocity;
        rates
            .iter()
            .zip(&joints.limits.0)
            .filter(|(rate, _)| **rate != 0.0)
            .map(|(rate, limit)| JOINT_SPEED_R * limit.velocity / rate.abs())
            .fold(f64::INFINITY, f64::min)
    }
}

impl JointClearance {
    fn admits(&self, position: &AxisVector, stop: &Stop, period_t: f64) -> bool {
        let mut watch = self.watch;
        if watch.take(position).is_err() {
            return false;
        }
        let ticks = stop.duration_t() / period_t;
        if ticks <= f64::from(PLACES - SETTLING) {
            // To past its end, where the last differences are.
            let count =
                (1..=PLACES).take_while(|k| f64::from(*k) < ticks + f64::from(SETTLING) + 1.0);
            return count
                .map(|k| stop.at(f64::from(k) * period_t))
                .all(|place| watch.take(&place).is_ok());
        }
        self.admits_coarsely(&watch, position, stop)
    }

    /// A stop of more ticks than can be looked at: where the joints are and how fast, at as many
    /// places as can. Their accelerations are limited by those of the axes.
    fn admits_coarsely(&self, watch: &JointWatch, position: &AxisVector, stop: &Stop) -> bool {
        let step_t = stop.duration_t() / f64::from(PLACES);
        let Ok(mut before) = watch.stand(position) else {
            return false;
        };
        (1..=PLACES).all(|k| {
            let Ok(position) = watch.stand(&stop.at(f64::from(k) * step_t)) else {
                return false;
            };
            let motion = JointMotion {
                position,
                velocity: (position - before) / step_t,
                acceleration: JointVector::zeros(),
            };
            before = position;
            self.limits.broken_by(&motion).is_none()
        })
    }
}
