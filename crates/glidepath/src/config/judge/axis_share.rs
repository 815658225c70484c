//! The share of the axes' accelerations and jerks that the joints leave.

use crate::config::machine::AxisConfig;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{AxisRates, AxisShare, JointLimits, Mechanism};

/// What joints leave of the axes' accelerations and jerks, anywhere in their travel; a rotary axis
/// without soft limits is back where it was after a turn.
pub(super) fn axis_share(
    mechanism: &Mechanism,
    limits: &JointLimits,
    axes: &[AxisConfig],
) -> AxisShare {
    if matches!(mechanism, Mechanism::Trivial(_)) {
        return AxisShare::FULL;
    }
    let travel: Vec<_> = axes
        .iter()
        .map(|axis| {
            let (low, high) = axis.travel.unwrap_or((-180.0, 180.0));
            (axis.axis, low, high)
        })
        .collect();
    let mut rates = AxisRates {
        acceleration: AxisVector::zeros(),
        jerk: AxisVector::zeros(),
    };
    for axis in axes {
        let i = axis.axis.index();
        (rates.acceleration[i], rates.jerk[i]) = (axis.max_acceleration, axis.max_jerk);
    }
    AxisShare::over(mechanism, limits, &travel, &rates)
}
