//! The joints of a mechanism, as the planner of motion asks for them.

use glidepath_geometry::AxisVector;
use glidepath_kinematics::{JOINTS, JointWatch, Kinematics as _, PathCaps};
use glidepath_motion::Joints;
use std::sync::Arc;

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
}
