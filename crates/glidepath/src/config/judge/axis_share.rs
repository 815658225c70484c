//! The share of the axes' accelerations and jerks that the joints leave.

use super::values::Judge;
use crate::config::settings::AxisConfig;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{AxisRates, AxisShare, JointLimits, Mechanism};

/// The travel of every axis; a rotary one without soft limits is back where it was after a turn.
pub(super) fn travel_of(axes: &[AxisConfig]) -> Vec<(Axis, f64, f64)> {
    let of = |axis: &AxisConfig| {
        let (low, high) = axis.travel.unwrap_or((-180.0, 180.0));
        (axis.axis, low, high)
    };
    axes.iter().map(of).collect()
}

impl Judge {
    /// What joints leave of the axes' accelerations and jerks, anywhere in their travel.
    pub(super) fn axis_share(
        &self,
        mechanism: &Mechanism,
        limits: &JointLimits,
        axes: &[AxisConfig],
    ) -> AxisShare {
        // Looked for all over the travel, so only of a machine that can be.
        let is_vain = self.has_found(&["axis", "joint", "machine"]);
        if is_vain || matches!(mechanism, Mechanism::Trivial(_)) {
            return AxisShare::FULL;
        }
        let travel = travel_of(axes);
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
}
