//! The check of the time that axes take to stop. One that takes too long most often has a velocity
//! that was meant in mm/min, as grbl has it.
//!
//! Frames are published ahead for three stops from full speed. Where no period that may be chosen
//! has them, it is not the period that is to be mended.

use super::horizon::{LONGEST_PERIOD_US, MAX_FRAMES_AHEAD, STOPS, stop_t};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::settings::{AxisConfig, InterpolatorConfig};

/// From here on a velocity is likely to be meant per minute, mm/s: 60 m/min.
const FAST_V: f64 = 1000.0;

/// What is wrong with the limits of an axis, without a place in the file; none if the horizon can
/// be chosen so that it covers its stops.
pub(super) fn diagnostic(
    axis: &AxisConfig,
    interpolator: &InterpolatorConfig,
) -> Option<ConfigDiagnostic> {
    let needed_t = STOPS * stop_t(axis);
    let frames = f64::from(MAX_FRAMES_AHEAD);
    #[allow(clippy::cast_precision_loss, reason = "a small number")]
    let longest_t = frames * LONGEST_PERIOD_US as f64 / 1e6;
    let reach_t = frames * f64::from(interpolator.period_us) / 1e6;
    let is_short = reach_t.min(interpolator.horizon_t) < needed_t;
    let is_suspect = is_short && axis.max_velocity >= FAST_V;
    (needed_t > longest_t || is_suspect).then(|| told(axis))
}

fn told(axis: &AxisConfig) -> ConfigDiagnostic {
    let AxisConfig {
        axis,
        max_velocity: v,
        max_acceleration: a,
        max_jerk: j,
        ..
    } = axis;
    let unit = if axis.is_rotary() { "°" } else { "mm" };
    let (key, message, help) = if v / a >= a / j {
        let fast = if axis.is_rotary() {
            format!("{} rpm", v / 6.0)
        } else {
            format!("{} m/min", v * 0.06)
        };
        let message = format!(
            "axis.{axis}.max_velocity = {v} {unit}/s is {fast}, and {:.1} s to stop: {unit}/min?",
            v / a
        );
        let help = format!(
            "velocities are {unit}/s: {v} {unit}/min is max_velocity = {:.1}; if it is meant, \
             max_acceleration = {a} {unit}/s² is too low for it",
            v / 60.0
        );
        ("max_velocity", message, help)
    } else {
        let message = format!(
            "axis.{axis}.max_jerk = {j} {unit}/s³ takes {:.1} s to build up max_acceleration = {a} \
             {unit}/s²",
            a / j
        );
        let help = "give a higher jerk, ten to a hundred times the acceleration, or a lower \
                    acceleration";
        ("max_jerk", message, help.to_owned())
    };
    ConfigDiagnostic {
        key: format!("axis.{axis}.{key}"),
        message,
        help: Some(help),
        span: None,
    }
}
