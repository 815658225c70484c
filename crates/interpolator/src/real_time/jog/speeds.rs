//! The speeds of a jog: what the settings, the demand and the joints leave.

use super::Jog;
use super::jog_motion::{Goal, JogLimits};
use glidepath_geometry::AxisVector;
use glidepath_link::JogMode;

/// By how much the speed that the joints can do has to rise before the axes go faster: so that they
/// do not set out anew in every tick.
const FASTER_R: f64 = 1.05;

impl Jog {
    pub(super) fn jog_limits(&self) -> JogLimits {
        let mut jog = self.limits;
        let slow = self.settings.unhomed_velocity.iter();
        for ((most, slow), is_homed) in jog.velocity.iter_mut().zip(slow).zip(&self.is_homed) {
            *most = if *is_homed { *most } else { most.min(*slow) };
        }
        let demanded_v = if self.is_returning() {
            self.settings.return_v
        } else {
            match &self.demand {
                Some(demand) if demand.mode != JogMode::Continuous => demand.most_v,
                _ => f64::INFINITY,
            }
        };
        JogLimits {
            jog,
            most_v: demanded_v.min(self.joint_v),
            override_ratio: self.override_ratio,
        }
    }

    /// The joints' speed along the present direction, here and where a stop would end.
    pub(super) fn look_up_joint_speed(&mut self, position: &AxisVector) {
        if self.clearance.is_of_travel_alone() {
            return;
        }
        let direction = match (self.jog_motion.direction(), &self.goal) {
            (Some(direction), _) => *direction,
            (None, Goal::Speeds(speeds)) => speeds.normalize(),
            (None, Goal::Place(place)) => (place - position).normalize(),
            (None, Goal::Stop) => return,
        };
        let end = self.jog_motion.stop().end();
        let here = self.clearance.speed(position, &direction);
        let v = here.min(self.clearance.speed(&end, &direction));
        if v < self.joint_v || v > self.joint_v * FASTER_R {
            self.joint_v = v;
        }
    }
}
