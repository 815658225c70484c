//! The state of an interpolator, as text and as JSON.

use super::beside::Beside;
use super::machine::{AwaitedEvent, awaited_text, by_axis, machine_object, power_text};
use super::quantity::{decimals, grouped, microseconds};
use super::superposition;
use crate::machine_options::complete;
use core::fmt::Write as _;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{
    EndOfEpoch, FaultCause, Grants, JobStage, MachineState, MotionMode, Quantiles, Status,
};
use serde_json::{Map, Value, json};

/// How any fault is cleared, in the marks that commands stand in.
const HOW_TO_CLEAR: &str = "`glidepath reset`";

/// Names of the grants, for the keys of JSON and for people.
const GRANTS: [(Grants, &str, &str); 5] = [
    (Grants::FIFO, "fifo", "SCHED_FIFO"),
    (Grants::PINNED, "pinned", "pinned CPU"),
    (Grants::MEMORY_LOCKED, "memory_locked", "locked memory"),
    (Grants::PREFAULTED, "prefaulted", "prefaulted stack"),
    (Grants::DMA_LATENCY, "cpu_awake", "no deep CPU sleep"),
];

/// What real time was granted, as an object.
#[must_use]
pub fn realtime_object(grants: Grants) -> Value {
    let mut object = Map::new();
    for (grant, key, _) in GRANTS {
        object.insert(key.to_owned(), grants.contains(grant).into());
    }
    object.insert(
        "best_effort".to_owned(),
        grants.contains(Grants::BEST_EFFORT).into(),
    );
    Value::Object(object)
}

/// What real time was granted, and what not.
#[must_use]
pub fn realtime_text(grants: Grants) -> String {
    let list = |held: bool| {
        let names: Vec<&str> = GRANTS
            .iter()
            .filter(|(grant, ..)| grants.contains(*grant) == held)
            .map(|(.., name)| *name)
            .collect();
        names.join(", ")
    };
    match (list(true), list(false)) {
        (held, missing) if missing.is_empty() => held,
        (held, missing) if held.is_empty() => format!("none (best effort); missing: {missing}"),
        (held, missing) => format!("{held} (best effort); missing: {missing}"),
    }
}

/// Quantiles in µs, as an object.
#[must_use]
pub fn quantiles_object(quantiles: &Quantiles) -> Value {
    json!({
        "p50": microseconds(quantiles.p50_ns),
        "p99": microseconds(quantiles.p99_ns),
        "p999": microseconds(quantiles.p999_ns),
        "max": microseconds(quantiles.max_ns),
    })
}

/// Quantiles in µs, in one line.
#[must_use]
pub fn quantiles_text(quantiles: &Quantiles) -> String {
    format!(
        "p50 {:.1}, p99 {:.1}, p99.9 {:.1}, max {:.1} µs",
        microseconds(quantiles.p50_ns),
        microseconds(quantiles.p99_ns),
        microseconds(quantiles.p999_ns),
        microseconds(quantiles.max_ns)
    )
}

fn end_name(status: &Status) -> &'static str {
    status.end_of_epoch().map_or("unknown", EndOfEpoch::name)
}

/// What is to be done about the latched fault.
pub(super) fn remedy(status: &Status) -> Option<&'static str> {
    status.fault().ok().flatten().map(FaultCause::remedy)
}

/// A status as an object, with the tool that the machine waits for.
#[must_use]
pub fn status_object(instance: &str, status: &Status, asked: &AwaitedEvent) -> Value {
    let position = by_axis(&status.position);
    let mut object = json!({
        "instance": instance,
        "pid": status.pid,
        "state": status.state().map_or("unknown", MachineState::name),
        "state_text": status.state_text().map(complete).ok(),
        "fault": status.fault_text(),
        "fault_is_cleared_by": remedy(status).map(|_| complete(HOW_TO_CLEAR).replace('`', "")),
        "fault_remedy": remedy(status).map(complete),
        "epoch": status.epoch,
        "end_of_epoch": end_name(status),
        "line": status.line,
        "block": status.block,
        "single_block": status.single_block == 1,
        "frames_received": status.frames_received,
        "frames_executed": status.frames_executed,
        "queue_depth": status.queue_depth,
        "queue_capacity": status.queue_capacity,
        "position": position,
        "path_mm": status.path_s,
        "feed_mm_s": status.feed_v,
        "feed_override": status.feed_override,
        "rapid_override": status.rapid_override,
        "jog_override": status.jog_override,
        "effective_override": status.effective_override,
        "adaptive_feed": status.adaptive_feed,
        "period_us": microseconds(status.period_ns),
        "ticks": status.ticks,
        "missed_ticks": status.missed_ticks,
        "late_ticks": status.late_ticks,
        "setpoints_published": status.setpoints_published,
        "setpoints_lost": status.setpoints_lost,
        "reserve_stops": status.reserve_stops,
        "starved_ticks": status.starved_ticks,
        "frames_refused": status.frames_refused.iter().sum::<u64>(),
        "lateness_us": quantiles_object(&status.lateness),
        "work_us": quantiles_object(&status.work),
        "latency_us": quantiles_object(&status.latency),
        "response_us": quantiles_object(&status.response),
        "realtime": realtime_object(status.grants()),
        "last_error": status.last_error.as_str(),
        "last_event": status.last_event.as_str(),
        "message": status.message.as_str(),
    });
    if let Value::Object(object) = &mut object {
        object.extend(machine_object(status, asked));
        object.insert("job".to_owned(), job_object(status));
    }
    object
}

/// The job that is prepared or executed, with what is being done for it.
fn job_text(status: &Status) -> Option<String> {
    let held = if status.job_held == 1 {
        "; begins held"
    } else {
        ""
    };
    job_stage(status).map(|_| format!("{}{held}", status.job.as_str()))
}

fn job_object(status: &Status) -> Value {
    job_stage(status).map_or(Value::Null, |stage| {
        json!({
            "stage": stage,
            "text": status.job.as_str(),
            "begins_held": status.job_held == 1,
        })
    })
}

/// How the job stands, if there is one that is not over.
fn job_stage(status: &Status) -> Option<&'static str> {
    match status.job_stage() {
        Ok(JobStage::Waiting) => Some("waiting"),
        Ok(JobStage::Preparing) => Some("preparing"),
        Ok(JobStage::Begun) => Some("begun"),
        Ok(JobStage::None | JobStage::Aborted | JobStage::Refused | JobStage::Over) | Err(_) => {
            None
        }
    }
}

/// What an input makes of the overrides, if it does anything.
pub(super) fn adaptive_text(status: &Status) -> Option<String> {
    let part = status.adaptive_feed * 100.0;
    (part < 100.0).then(|| {
        if part < 0.0 {
            format!(
                "the adaptive feed turns the motion round, at {:.0} %",
                -part
            )
        } else {
            format!("the adaptive feed, or the spindle in G95, lets through {part:.0} %")
        }
    })
}

/// What is added to the motion of an axis, and whether that goes on; nothing on a machine without a superposition.
pub(super) fn superposition_text(status: &Status) -> Option<String> {
    let does = superposition::does(status)?;
    let offset = positions_text(&status.superposed, &[], |_, value| value != 0.0);
    Some(if offset.is_empty() {
        does
    } else {
        format!("{offset} beside the program; {does}")
    })
}

/// How a program is executed, where that is not the ordinary way.
pub(super) fn manner_text(status: &Status) -> String {
    let is_backwards = status.mode() == Ok(MotionMode::Backwards);
    let manners = [
        (is_backwards, ", backwards"),
        (status.single_block == 1, ", single block"),
    ];
    let in_force = manners.into_iter().filter(|(is_so, _)| *is_so);
    in_force.map(|(_, text)| text).collect()
}

/// The values of axes that are meant, with their names; those mean nothing that are not homed.
fn positions_text(
    values: &[f64; AXES],
    not_homed: &[Axis],
    is_meant: impl Fn(Axis, f64) -> bool,
) -> String {
    let axes = Axis::ALL.into_iter().zip(values);
    let meant = axes.filter(|(axis, value)| is_meant(*axis, **value));
    let meant: Vec<String> = meant
        .map(|(axis, value)| {
            let mark = if not_homed.contains(&axis) {
                " (not homed)"
            } else {
                ""
            };
            format!("{axis} {}{mark}", decimals(*value, 4))
        })
        .collect();
    meant.join("  ")
}

/// How far the axes are from the path, if they are away from it.
fn away_text(status: &Status) -> Option<String> {
    let away = positions_text(&status.away, &[], |_, value| value != 0.0);
    (!away.is_empty()).then(|| format!("{away}, from the path"))
}

/// A status for people, with what is known beside it.
#[must_use]
pub fn status_text(instance: &str, status: &Status, beside: &Beside) -> String {
    let mut text = String::new();
    let state = status.state().map_or("unknown", MachineState::name);
    let is_told = |axis: Axis, value: f64| axis.index() < 3 || value != 0.0;
    let position = positions_text(&status.position, &beside.not_homed, is_told);
    // Writing to a String does not fail.
    let doing = status.state_text().unwrap_or_default();
    let _ = writeln!(text, "{instance}: {state}, process {}", status.pid);
    let _ = writeln!(text, "  this is       {}", complete(doing));
    if let Some(fault) = status.fault_text() {
        let _ = writeln!(text, "  fault         {fault}");
        let remedy = complete(remedy(status).unwrap_or(HOW_TO_CLEAR));
        let _ = writeln!(text, "  to clear it   {remedy}");
    }
    if let Some(awaited) = awaited_text(status, &beside.asked) {
        let _ = writeln!(text, "  awaits        {awaited}");
    }
    if let Some(job) = job_text(status) {
        let _ = writeln!(text, "  job           {job}");
    }
    let _ = writeln!(text, "  position      {}", position);
    if let Some(offset) = &beside.offset {
        let part = offset.work(&status.position);
        let part = positions_text(&part, &beside.not_homed, is_told);
        let _ = writeln!(text, "  part          {part}  ({})", offset.said());
    }
    if let Some(away) = away_text(status) {
        let _ = writeln!(text, "  away          {away}");
    }
    let _ = writeln!(text, "  power         {}", power_text(status));
    let _ = writeln!(
        text,
        "  motion        line {}, {:.3} mm of path, {:.2} mm/s{}",
        status.line,
        status.path_s,
        status.feed_v,
        manner_text(status)
    );
    let _ = writeln!(
        text,
        "  override      feed {:.0} %, rapid {:.0} %, jog {:.0} %, spindle {:.0} % (executed {:.0} %)",
        status.feed_override * 100.0,
        status.rapid_override * 100.0,
        status.jog_override * 100.0,
        status.spindle_override * 100.0,
        status.effective_override * 100.0
    );
    if let Some(adaptive) = adaptive_text(status) {
        let _ = writeln!(text, "  input         {adaptive}");
    }
    if let Some(superposed) = superposition_text(status) {
        let _ = writeln!(text, "  superposed    {superposed}");
    }
    let _ = writeln!(
        text,
        "  frames        epoch {} ({}), {} executed, {} queued",
        status.epoch,
        end_name(status),
        grouped(status.frames_executed),
        status.queue_depth
    );
    let _ = writeln!(text, "  last event    {}", status.last_event.as_str());
    let message = status.message.as_str();
    if !message.is_empty() {
        let _ = writeln!(text, "  says          {message}");
    }
    text + &timing_text(status)
}

/// Ticks, lateness, work and grants.
#[must_use]
pub fn timing_text(status: &Status) -> String {
    format!(
        "  ticks         {}, {} missed, {} late, {} starved\n  waking        {}\n  lateness      {}\n  published     {}\n  work          {}\n  real time     {}\n",
        grouped(status.ticks),
        grouped(status.missed_ticks),
        grouped(status.late_ticks),
        grouped(status.starved_ticks),
        quantiles_text(&status.latency),
        quantiles_text(&status.lateness),
        quantiles_text(&status.response),
        quantiles_text(&status.work),
        realtime_text(status.grants())
    )
}
