//! The drives and joints of a status, as text and as JSON.

use super::quantity::microseconds;
use super::superposition;
use crate::machine_options::complete;
use core::fmt::{self, Write as _};
use glidepath_geometry::{AXES, Axis};
use glidepath_interpolator::AnswerSource;
use glidepath_link::{MotionMode, Power, SpindleFlags, Status};
use glidepath_program::{CodeWord, Event};
use serde_json::{Map, Value, json};

/// One value by axis.
pub(super) fn by_axis(values: &[f64; AXES]) -> Map<String, Value> {
    let pairs = Axis::ALL.into_iter().zip(values);
    pairs
        .map(|(axis, value)| (axis.to_string(), (*value).into()))
        .collect()
}

/// The names of axes.
#[must_use]
pub fn names(axes: &[Axis]) -> Value {
    axes.iter().map(ToString::to_string).collect()
}

/// The names of the joints of a mask.
fn joints_of(mask: u32) -> Vec<String> {
    (0..AXES)
        .filter(|joint| mask & (1 << joint) != 0)
        .map(|joint| format!("J{joint}"))
        .collect()
}

/// Values of the joints that the machine has.
fn by_joint(status: &Status, values: &[f64; AXES]) -> Map<String, Value> {
    let pairs = (0..AXES).zip(values);
    pairs
        .filter(|(joint, _)| status.joints & (1 << joint) != 0)
        .map(|(joint, value)| (format!("J{joint}"), (*value).into()))
        .collect()
}

/// How old feedback is, ms; nothing before the first.
fn age_ms(age_ns: u64) -> Option<f64> {
    (age_ns != u64::MAX).then(|| microseconds(age_ns).round() / 1e3)
}

/// A tool that the machine waits for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AskedTool {
    /// Its number; 0 if the spindle is to be empty.
    pub number: u32,
    /// What the tool table says of it.
    pub name: Option<String>,
}

/// What is known, beside the status, of an event that is awaited.
#[derive(Debug, Clone, Default)]
pub struct AwaitedEvent {
    /// The tool that is asked for.
    pub tool: Option<AskedTool>,
    /// Who answers; `None` for a person.
    pub answer: Option<AnswerSource>,
}

impl AwaitedEvent {
    /// Whether a person says that it is done.
    const fn by_hand(&self) -> bool {
        matches!(
            self.answer,
            None | Some(AnswerSource::Nobody | AnswerSource::Acknowledgement)
        )
    }

    /// How it is known that it is done.
    fn done_by(&self) -> String {
        match self.answer {
            None | Some(AnswerSource::Nobody | AnswerSource::Acknowledgement) => {
                complete("`glidepath acknowledge`")
            }
            Some(AnswerSource::Input { number, .. }) => {
                format!("input {number} says when it is done")
            }
            Some(AnswerSource::Planner) => "the input says when it is done".to_owned(),
            Some(_) => "the spindle says when it is done".to_owned(),
        }
    }
}

impl fmt::Display for AskedTool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.number == 0 {
            return f.write_str("no tool");
        }
        write!(f, "tool T{}", self.number)?;
        match &self.name {
            Some(name) => write!(f, " ({name})"),
            None => Ok(()),
        }
    }
}

/// The event that is awaited, and for how long.
fn awaited(status: &Status, asked: &AwaitedEvent) -> Option<Value> {
    (status.awaited_since_ns != 0).then(|| {
        let waited_ns = status.updated_ns.saturating_sub(status.awaited_since_ns);
        json!({
            "event": awaited_name(status),
            "p": status.awaited_words.get(CodeWord::P),
            "q": status.awaited_words.get(CodeWord::Q),
            "tool": asked.tool.as_ref().map(|tool| json!({ "number": tool.number, "name": tool.name })),
            "line": status.awaited_line,
            "epoch": status.epoch,
            "sequence": status.awaited_sequence,
            "waited_s": microseconds(waited_ns) / 1e6,
            "done_by": asked.done_by(),
            "failed_by": asked.by_hand().then(|| complete("`glidepath acknowledge --fail \"the reason\"`")),
        })
    })
}

/// The name of the event that is awaited.
fn awaited_name(status: &Status) -> String {
    match status.awaited_event() {
        Ok(Some(Event::Synchronise { .. } | Event::Tap { .. })) => "the spindle's angle".to_owned(),
        Ok(Some(Event::MCode(code) | Event::Await(code))) => format!("M{code}"),
        _ => "an event".to_owned(),
    }
}

/// Its words, each behind a space.
fn awaited_words(status: &Status) -> String {
    let words = [(CodeWord::P, 'P'), (CodeWord::Q, 'Q')];
    let given = words.map(|(word, letter)| {
        let value = status.awaited_words.get(word);
        value.map_or_else(String::new, |value| format!(" {letter}{value}"))
    });
    given.concat()
}

/// The M code that is awaited, with its words.
#[must_use]
pub fn awaited_code(status: &Status) -> String {
    awaited_name(status) + &awaited_words(status)
}

/// What is awaited, and for how long, in words; nothing if nothing is.
pub(super) fn awaited_text(status: &Status, asked: &AwaitedEvent) -> Option<String> {
    (status.awaited_since_ns != 0).then(|| {
        let waited_ns = status.updated_ns.saturating_sub(status.awaited_since_ns);
        let (line, waited_s) = (status.awaited_line, microseconds(waited_ns) / 1e6);
        if matches!(
            status.awaited_event(),
            Ok(Some(Event::Synchronise { .. } | Event::Tap { .. }))
        ) {
            return format!(
                "the spindle, for the thread of line {line}: its speed and its angle, for \
                 {waited_s:.1} s"
            );
        }
        let tool = asked.tool.as_ref();
        let tool = tool.map_or_else(String::new, |tool| format!(", {tool}"));
        format!(
            "the answer to {}{tool}, of line {line}, for {waited_s:.1} s ({})",
            awaited_code(status),
            asked.done_by(),
        )
    })
}

/// Whether it is known of the spindle: what drives said that are silent now is not.
fn is_known(status: &Status, flag: SpindleFlags) -> bool {
    status.spindle().contains(flag) && !status.drives_are_silent()
}

/// Speed of the spindle, rev/min; nothing where nobody measures it.
fn spindle_rpm(status: &Status) -> Option<f64> {
    let is_measured = is_known(status, SpindleFlags::SPEED);
    // Not -0.
    is_measured.then_some(60.0 * status.spindle_v + 0.0)
}

/// Load of the spindle as a part of its rated torque; nothing where nobody measures it.
fn spindle_load(status: &Status) -> Option<f64> {
    let is_measured = is_known(status, SpindleFlags::LOAD);
    is_measured.then_some(status.spindle_load)
}

/// What a status says about drives and joints.
pub(super) fn machine_object(status: &Status, asked: &AwaitedEvent) -> Map<String, Value> {
    let object = json!({
        "away": by_axis(&status.away),
        "superposition": superposition::name(status),
        "superposition_text": superposition::does(status),
        "superposed": by_axis(&status.superposed),
        "power": status.power().map_or("unknown", Power::name),
        "mode": status.mode().map_or("unknown", MotionMode::name),
        "homed": joints_of(status.homed),
        "not_homed": joints_of(status.joints & !status.homed),
        "enabled": joints_of(status.enabled),
        "drive_faults": joints_of(status.drive_faults),
        "reference": status.reference,
        "feedback_age_ms": age_ms(status.feedback_age_ns),
        "joint_actual": by_joint(status, &status.joint_actual),
        "following_error": by_joint(status, &status.following_error),
        "following_peak": by_joint(status, &status.following_peak),
        "spindle_rpm": spindle_rpm(status),
        "spindle_load": spindle_load(status),
        "spindle_override": status.spindle_override,
        "spindle_at_speed": is_known(status, SpindleFlags::AT_SPEED),
        "awaited": awaited(status, asked),
    });
    match object {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}

/// Power, homes and following errors in one line.
pub(super) fn power_text(status: &Status) -> String {
    let power = status.power().unwrap_or(Power::Simulated);
    if power == Power::Simulated {
        return "simulated: no feedback is configured".to_owned();
    }
    let mut text = power.name().to_owned();
    let not_homed = joints_of(status.joints & !status.homed);
    if not_homed.is_empty() {
        text.push_str(", homed");
    } else {
        let _ = write!(text, ", not homed: {}", not_homed.join(" "));
    }
    if status.drive_faults != 0 {
        let _ = write!(
            text,
            ", drives with faults: {}",
            joints_of(status.drive_faults).join(" ")
        );
    }
    let peak = status.following_peak.iter().copied().fold(0.0, f64::max);
    let _ = write!(text, ", following error at most {peak:.4}");
    match age_ms(status.feedback_age_ns) {
        Some(age_ms) => {
            let _ = write!(text, ", feedback {age_ms:.1} ms old");
        }
        None => text.push_str(", no feedback yet"),
    }
    if let Some(rpm) = spindle_rpm(status) {
        let _ = write!(text, ", spindle at {:.0} rev/min", rpm.round() + 0.0);
    }
    if let Some(load) = spindle_load(status) {
        let _ = write!(text, ", its load {:.0} %", 100.0 * load);
    }
    text
}
