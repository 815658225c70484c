//! The joints of a mechanism, as the planner of motion asks for them.

use crate::joint_speed::JointSpeed;
use glidepath_geometry::{AxisVector, Jet};
use glidepath_kinematics::{
    AxisRates, JOINTS, JointLimit, JointWatch, Kinematics as _, PathCaps, PathRates,
};
use glidepath_motion::{ItemPacer, Joints};
use glidepath_program::{Limits, Settings};
use std::sync::Arc;

/// Share of the joints' jerk that a plan along a path leaves to the interpolator: without any, its rate could
/// not leave 1 where the plan is at a limit. The time of a motion grows with its cube root, by .7 %.
const SPARE_JERK_R: f64 = 5e-4;
/// The same of acceleration.
const SPARE_ACCELERATION_R: f64 = 5e-4;

/// Joints with limits of their own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointBounds(PathCaps);

impl JointBounds {
    /// The joints of a machine, to be shared.
    pub(crate) fn shared(caps: PathCaps) -> Arc<dyn Joints> {
        Arc::new(Self(caps))
    }
}

impl Joints for JointBounds {
    fn velocity_rows(&self, position: &AxisVector) -> Vec<AxisVector> {
        let PathCaps {
            mechanism, limits, ..
        } = &self.0;
        let Ok(jacobian) = mechanism.jacobian(position) else {
            return Vec::new();
        };
        let is_limited = |joint: &usize| limits.0[*joint].velocity.is_finite();
        (0..JOINTS.min(mechanism.joints()))
            .filter(is_limited)
            .map(|joint| jacobian.row(joint).transpose() / limits.0[joint].velocity)
            .collect()
    }

    fn allow(&self, positions: &[AxisVector; 4], period_t: f64) -> bool {
        let PathCaps {
            mechanism, limits, ..
        } = self.0;
        let watch = JointWatch::new(mechanism, limits, period_t);
        watch.judge(positions).is_ok()
    }

    fn along(&self, path: &Jet) -> Option<Jet> {
        let PathRates {
            position,
            d1,
            d2,
            d3,
        } = PathRates::at(&self.0.mechanism, path).ok()?;
        Some(Jet {
            position,
            d1,
            d2,
            d3,
        })
    }

    fn anywhere(&self, limits: &Limits) -> Limits {
        let AxisRates { acceleration, jerk } = &self.0.rates;
        Limits {
            acceleration: limits.acceleration.inf(acceleration),
            jerk: limits.jerk.inf(jerk),
            ..*limits
        }
    }

    fn pacer(&self, settings: &Settings) -> Box<dyn ItemPacer> {
        Box::new(JointSpeed::new(self.0, *settings))
    }

    fn limits(&self) -> [AxisVector; 3] {
        let of = |limit: &dyn Fn(&JointLimit) -> f64| {
            AxisVector::from_fn(|joint, _| limit(&self.0.limits.0[joint]).min(Limits::UNLIMITED))
        };
        [
            of(&|limit| limit.velocity),
            of(&|limit| (1.0 - SPARE_ACCELERATION_R) * limit.acceleration),
            of(&|limit| (1.0 - SPARE_JERK_R) * limit.jerk),
        ]
    }
}
