//! The joints of a mechanism, as the planner of motion asks for them.

use glidepath_geometry::{AxisVector, Jet};
use glidepath_kinematics::{CurveRates, JointLimit, JointWatch, LimitedMechanism, PathRates};
use glidepath_motion::{Joints, JointsOnCurve};
use glidepath_program::Limits;
use std::sync::Arc;

/// Share of the joints' jerk that a plan along a path leaves to the interpolator: without any, its rate could
/// not leave 1 where the plan is at a limit. The time of a motion grows with its cube root, by .7 %.
const SPARE_JERK_R: f64 = 5e-4;
/// The same of acceleration.
const SPARE_ACCELERATION_R: f64 = 5e-4;

/// Axes that mechanisms move: X Y Z A B C.
const DERIVED_AXES: usize = 6;

/// Joints with limits of their own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointBounds(LimitedMechanism);

impl JointBounds {
    /// The joints of a machine, to be shared.
    pub(crate) fn shared(caps: LimitedMechanism) -> Arc<dyn Joints> {
        Arc::new(Self(caps))
    }
}

impl Joints for JointBounds {
    fn at(&self, curve: &[AxisVector; 4]) -> Option<JointsOnCurve> {
        let rates = CurveRates::<DERIVED_AXES>::at(&self.0.mechanism, curve).ok()?;
        let jacobian = rates.jacobian();
        Some(JointsOnCurve {
            derivatives: rates.derivatives,
            jacobian: core::array::from_fn(|order| {
                core::array::from_fn(|joint| {
                    let of_axis = |axis: usize, _| match axis {
                        0..DERIVED_AXES => jacobian[order][(joint, axis)],
                        _ => 0.0,
                    };
                    AxisVector::from_fn(of_axis)
                })
            }),
        })
    }

    fn allow(&self, positions: &[AxisVector; 4], period_t: f64) -> bool {
        let LimitedMechanism {
            mechanism,
            mut limits,
        } = self.0;
        for limit in &mut limits.0 {
            limit.acceleration *= 1.0 - SPARE_ACCELERATION_R;
            limit.jerk *= 1.0 - SPARE_JERK_R;
        }
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
