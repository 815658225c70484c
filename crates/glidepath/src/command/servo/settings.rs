//! The settings of the servo for a machine.

use crate::config::MachineConfig;
use glidepath_link::servo::{JumpLimits, ServoSettings, StopLimits};

/// Periods without a setpoint after which the servo stops its joints by itself.
const PATIENCE_PERIODS: u64 = 3;

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
            compensation.map_or(
                (axis.max_velocity, axis.max_acceleration, axis.max_jerk),
                |made| {
                    let drive = made.drive();
                    (drive.velocity, drive.acceleration, drive.jerk)
                },
            )
        });
    let drives = settings.stop.iter_mut().zip(&mut settings.jump);
    for ((stop, jump), (velocity, acceleration, jerk)) in drives.zip(joints.chain(axes)) {
        *stop = StopLimits { acceleration, jerk };
        *jump = JumpLimits::above(velocity, acceleration);
    }
    settings
}
