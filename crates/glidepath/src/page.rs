//! The data that the page of `live` and `plan --plot` is given of a machine and its motion.

use crate::chords::chords;
use crate::config::{AxisConfig, MachineConfig};
use crate::report::DiagnosisReport;
use crate::sample::TickSample;
use glidepath_audit::diagnosis::Binding;
use glidepath_live::{AxisScale, LimitKind, Motion, MotionSample};
use glidepath_program::Item;
use serde_json::{Value, json};

/// How many times as far as joints let an axis go alone, anywhere in its travel, what it does is shown where it has no
/// limit of its own: elsewhere they let it do more.
const BY_JOINTS: f64 = 8.0;

/// Velocity, acceleration and jerk of an axis up to which its motion is shown: its limits, as far as it has such.
fn shown(axis: &AxisConfig) -> [f64; 3] {
    let limits = [axis.max_velocity, axis.max_acceleration, axis.max_jerk];
    core::array::from_fn(|k| {
        if axis.has_own[k] {
            limits[k]
        } else {
            BY_JOINTS * limits[k]
        }
    })
}

/// A motion of a machine with nothing in it.
#[must_use]
pub fn motion(config: &MachineConfig) -> Motion {
    let axes = config.axes.iter().map(|axis| AxisScale {
        index: axis.axis.index(),
        limits: shown(axis),
    });
    Motion::new(&axes.collect::<Vec<_>>(), config.period_t())
}

/// Takes the next sample of a motion.
pub fn push(motion: &mut Motion, sample: &TickSample) {
    let (limit, limit_axis) = limit_of(sample.binding);
    let deviation = sample.deviation.unwrap_or_default();
    motion.push(&MotionSample {
        position: sample.position.into(),
        line: sample.line,
        feed_v: sample.feed_v,
        programmed_v: sample.programmed_v,
        deviation_mm: deviation.distance_mm,
        tolerance_mm: deviation.tolerance_mm,
        path_mm: sample.path_s,
        limit,
        limit_axis,
        is_rapid: sample.rapid,
    });
}

/// Takes the next item of the program; the first one with its start.
pub fn push_item(motion: &mut Motion, item: &Item, is_first: bool) {
    chords(item, is_first, |position, rapid| {
        let at = [position[0], position[1], position[2]];
        motion.push_programmed(at, item.line, rapid);
    });
}

const fn limit_of(binding: Option<Binding>) -> (LimitKind, usize) {
    match binding {
        Some(Binding::Rest) => (LimitKind::Rest, 0),
        Some(Binding::Feed) => (LimitKind::Feed, 0),
        Some(Binding::Velocity(axis)) => (LimitKind::Velocity, axis.index()),
        Some(Binding::Acceleration(axis)) => (LimitKind::Acceleration, axis.index()),
        Some(Binding::Jerk(axis)) => (LimitKind::Jerk, axis.index()),
        Some(Binding::JointVelocity(joint)) => (LimitKind::Velocity, MotionSample::joint(joint)),
        Some(Binding::JointAcceleration(joint)) => {
            (LimitKind::Acceleration, MotionSample::joint(joint))
        }
        Some(Binding::JointJerk(joint)) => (LimitKind::Jerk, MotionSample::joint(joint)),
        Some(Binding::Tolerance) => (LimitKind::Tolerance, 0),
        Some(Binding::ChordError) => (LimitKind::ChordError, 0),
        Some(Binding::None) | None => (LimitKind::None, 0),
    }
}

/// The machine as the page knows it, as an object.
#[must_use]
pub fn machine_object(config: &MachineConfig, instance: &str) -> Value {
    let axes: Vec<Value> = config
        .axes
        .iter()
        .map(|axis| {
            json!({
                "name": axis.axis.to_string(),
                "unit": if axis.axis.is_rotary() { "°" } else { "mm" },
                "limits": shown(axis),
                // Without, what is above is a scale alone: joints limit the axis.
                "has_limit": axis.has_own,
                "travel": axis.travel.map(|(low, high)| [low, high]),
            })
        })
        .collect();
    json!({
        "instance": instance,
        "axes": axes,
        "period_s": config.period_t(),
        "tolerance_mm": config.path.tolerance_mm,
        "following_error_mm": config.feedback.following_error,
        "horizon_s": config.interpolator.horizon_t,
        "max_missed_ticks": config.interpolator.max_missed_ticks,
        "spindle_override": config.spindle_override,
    })
}

/// The report of a plan as the page knows it, as an object.
#[must_use]
pub fn report_object(
    diagnosis: &DiagnosisReport,
    path_mm: f64,
    [max_deviation_mm, tolerance_mm]: [f64; 2],
) -> Value {
    json!({
        "path_mm": path_mm,
        "max_deviation_mm": max_deviation_mm,
        "tolerance_mm": tolerance_mm,
        "binding": diagnosis.binding,
        "slowest": diagnosis.slowest,
        "smoothness": diagnosis.smoothness,
        "shape": diagnosis.shape,
    })
}
