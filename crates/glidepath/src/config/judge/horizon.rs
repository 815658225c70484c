//! The horizon: how far the planner has to publish ahead.
//!
//! The interpolator moves only while it holds enough frames to stop on. If the horizon were shorter
//! than that, it would stand in the middle of a program and wait for frames that never come. A stop
//! from full speed takes V/A + A/J on the slowest axis or joint; the horizon is to be three of them: one to
//! stop on, one for what comes in while it stops, one to go on with.

use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::settings::{AxisConfig, InterpolatorConfig};
use glidepath_kinematics::JointLimits;

/// Most frames published ahead of the machine: fewer than the interpolator can hold.
pub const MAX_FRAMES_AHEAD: u32 = 512;

/// The longest period there may be, µs.
pub(super) const LONGEST_PERIOD_US: i64 = 20_000;

/// Stops from full speed that the horizon covers at least.
pub(super) const STOPS: f64 = 3.0;

/// The horizon where the file gives none, s: longer only for a machine that needs more.
const USUAL_T: f64 = 0.6;

/// What an axis takes to stop from full speed, s.
pub(super) fn stop_t(axis: &AxisConfig) -> f64 {
    axis.max_velocity / axis.max_acceleration + axis.max_acceleration / axis.max_jerk
}

/// The shortest horizon a machine can do with, s. Joints without limits stop in no time.
pub(super) fn shortest_t(axes: &[AxisConfig], joints: &JointLimits) -> f64 {
    let by_joints = joints.0.iter().filter(|joint| joint.velocity.is_finite());
    let joints_t = by_joints
        .map(|joint| joint.velocity / joint.acceleration + joint.acceleration / joint.jerk);
    STOPS * axes.iter().map(stop_t).chain(joints_t).fold(0.0, f64::max)
}

/// The horizon where the file gives none, s.
pub(super) fn default_t(shortest_t: f64) -> f64 {
    USUAL_T.max(shortest_t)
}

/// What is wrong with a horizon, without a place in the file.
pub(super) fn diagnostic(
    interpolator: &InterpolatorConfig,
    shortest_t: f64,
) -> Option<ConfigDiagnostic> {
    let period_us = f64::from(interpolator.period_us);
    let reach_t = f64::from(MAX_FRAMES_AHEAD) * period_us / 1e6;
    if interpolator.horizon_t < shortest_t {
        return Some(ConfigDiagnostic {
            key: "interpolator.horizon_s".to_owned(),
            message: format!(
                "interpolator.horizon_s = {} s is too short for this machine",
                interpolator.horizon_t
            ),
            help: Some(format!(
                "give at least {shortest_t:.3} s, three stops from full speed of the slowest axis"
            )),
            span: None,
        });
    }
    (reach_t < shortest_t).then(|| ConfigDiagnostic {
        key: "interpolator.period_us".to_owned(),
        message: format!("interpolator.period_us = {period_us} is too short for this machine"),
        help: Some(format!(
            "give at least {:.0}: {MAX_FRAMES_AHEAD} frames can be ahead, and they have to cover \
             three stops from full speed of the slowest axis, {shortest_t:.3} s",
            (shortest_t * 1e6 / f64::from(MAX_FRAMES_AHEAD)).ceil()
        )),
        span: None,
    })
}
