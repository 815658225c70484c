//! The settings of the servo for a machine.

use crate::config::{AxisConfig, MachineConfig};
use glidepath_link::servo::{JumpLimits, ServoSettings, StopLimits};

/// Periods without a setpoint after which the servo stops its joints by itself.
const PATIENCE_PERIODS: u64 = 3;
/// The same on a host that promises no real time.
const BEST_EFFORT_PERIODS: u64 = 8;

/// How long setpoints may stay away on a host that promises no real time and stands still for some milliseconds now and
/// then, ns.
pub(in crate::command) fn best_effort_patience_ns(config: &MachineConfig) -> u64 {
    BEST_EFFORT_PERIODS * config.period_ns()
}

/// The limits of an axis for plans and for what is superposed together.
fn with_superposed(config: &MachineConfig, axis: &AxisConfig) -> (f64, f64, f64) {
    let superposed = config.superposition.filter(|of| of.axis == axis.axis);
    let [v, a, j] = superposed.map_or([0.0; 3], |of| [of.velocity, of.acceleration, of.jerk]);
    (
        axis.max_velocity + v,
        axis.max_acceleration + a,
        axis.max_jerk + j,
    )
}

/// Limits of the joints, as the configuration has them.
pub(in crate::command) fn settings(config: &MachineConfig) -> ServoSettings {
    let mut settings = ServoSettings {
        patience_ns: PATIENCE_PERIODS * config.period_ns(),
        ..ServoSettings::default()
    };
    // Where joints are not axes they have limits of their own.
    let limits = config.joint_limits.0.iter().take(config.joints());
    let joints = limits.map(|joint| (joint.velocity, joint.acceleration, joint.jerk));
    let of_joints = if config.joints() == 0 {
        config.axis_of_joints()
    } else {
        Vec::new()
    };
    let axes = of_joints
        .into_iter()
        .filter_map(|of| config.axes.iter().find(|axis| axis.axis == of))
        .zip(config.compensation.joints())
        .map(|(axis, compensation)| {
            // What is left of a compensated joint's limits is what plans keep to; its drive can do more.
            let cross = config.mechanism.cross();
            let drive = compensation
                .map(|made| made.drive())
                .or_else(|| cross.and_then(|cross| cross.joint(axis.axis)));
            drive.map_or_else(
                || with_superposed(config, axis),
                |drive| (drive.velocity, drive.acceleration, drive.jerk),
            )
        });
    let drives = settings.stop.iter_mut().zip(&mut settings.jump);
    for ((stop, jump), (velocity, acceleration, jerk)) in drives.zip(joints.chain(axes)) {
        *stop = StopLimits { acceleration, jerk };
        *jump = JumpLimits::above(velocity, acceleration);
    }
    settings
}
