//! The state of an interpolator, as text and as JSON.

use super::machine::{awaited_text, by_axis, machine_object, power_text};
use super::quantity::{grouped, microseconds};
use core::fmt::Write as _;
use glidepath_geometry::Axis;
use glidepath_link::{EndOfEpoch, FaultCause, Grants, MachineState, MotionMode, Quantiles, Status};
use serde_json::{Map, Value, json};

/// What a machine does, in one word.
#[must_use]
pub const fn state_name(state: MachineState) -> &'static str {
    match state {
        MachineState::Idle => "idle",
        MachineState::Running => "running",
        MachineState::Holding => "holding",
        MachineState::Held => "held",
        MachineState::Starving => "starving",
        MachineState::Starved => "starved",
        MachineState::ProgramStop => "program-stop",
        MachineState::Stopping => "stopping",
        MachineState::Faulted => "faulted",
        MachineState::Waiting => "waiting",
        MachineState::Awaiting => "awaiting",
        MachineState::Jogging => "jogging",
        MachineState::Homing => "homing",
        MachineState::Off => "off",
        MachineState::NotHomed => "not-homed",
    }
}

/// How any fault is cleared.
const HOW_TO_CLEAR: &str = "glidepath reset";

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

/// The latched fault in words, `None` if there is none.
#[must_use]
pub fn fault_text(status: &Status) -> Option<String> {
    let cause = status.fault().ok().flatten()?;
    let mut text = match cause {
        FaultCause::Frame(refusal) => format!("a frame was refused ({refusal:?})"),
        FaultCause::PlannerLost => "no more frames came: the planner died or hangs".to_owned(),
        FaultCause::MissedTicks => "too many ticks were missed".to_owned(),
        FaultCause::Output => "a computed setpoint broke a limit".to_owned(),
        FaultCause::Ports => "the thread that serves the ports died or hangs".to_owned(),
        FaultCause::RealTime => "the real-time thread died".to_owned(),
        FaultCause::FeedbackLost => "the drives no longer say where they are".to_owned(),
        FaultCause::FollowingError => "a joint is too far from where it is to be".to_owned(),
        FaultCause::Drive => "a drive reports a fault".to_owned(),
        FaultCause::EnableLost => "a drive lost its power".to_owned(),
        FaultCause::AuxTimeout => "an event was not acknowledged in time".to_owned(),
        FaultCause::ProbeContact => "the probe touched outside of a probing move".to_owned(),
        FaultCause::AuxFailed => "what an event asked for has failed".to_owned(),
        FaultCause::SpindleSpeed => {
            "in a thread the spindle left 50 to 109 % of its speed: the thread is not finished"
                .to_owned()
        }
        FaultCause::SpindleAngle => {
            "in a thread the spindle's angle was not told, or made no sense: look at its encoder"
                .to_owned()
        }
        FaultCause::ThreadLost => {
            "in a thread the axes could not follow the spindle, or frames ran out".to_owned()
        }
        FaultCause::TapOvertravel => {
            "a tap went on into its hole for spindle.overtravel revolutions, and the spindle did not \
             turn back: it was told to stop, and the tap stands in the hole"
                .to_owned()
        }
        FaultCause::LimitSwitch => "a joint stands at its limit switch".to_owned(),
        FaultCause::Homing => "a joint did not find its home".to_owned(),
    };
    if let Some(joint) = status.fault_joint() {
        let _ = write!(text, ", joint J{joint}");
    }
    if status.drive_fault != 0 {
        let _ = write!(text, ", the drive's number {}", status.drive_fault);
    }
    if let Some(axis) = status.fault_axis() {
        let _ = write!(text, ", axis {axis}");
    }
    if status.fault_line > 0 {
        let _ = write!(text, ", line {}", status.fault_line);
    }
    if status.fault_limit != 0.0 {
        let _ = write!(
            text,
            ", {} where {} is allowed",
            status.fault_value, status.fault_limit
        );
    }
    Some(text)
}

fn end_name(status: &Status) -> &'static str {
    match status.end_of_epoch() {
        Ok(EndOfEpoch::None) => "none",
        Ok(EndOfEpoch::Open) => "open",
        Ok(EndOfEpoch::Completed) => "completed",
        Ok(EndOfEpoch::Aborted) => "aborted",
        Ok(EndOfEpoch::Faulted) => "faulted",
        Ok(EndOfEpoch::Tripped) => "tripped",
        Err(_) => "unknown",
    }
}

/// A status as an object.
#[must_use]
pub fn status_object(instance: &str, status: &Status) -> Value {
    let position = by_axis(&status.position);
    let mut object = json!({
        "instance": instance,
        "pid": status.pid,
        "state": status.state().map_or("unknown", state_name),
        "fault": fault_text(status),
        "fault_is_cleared_by": fault_text(status).map(|_| HOW_TO_CLEAR),
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
        object.extend(machine_object(status));
    }
    object
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

/// A status for people.
#[must_use]
pub fn status_text(instance: &str, status: &Status) -> String {
    let mut text = String::new();
    let state = status.state().map_or("unknown", state_name);
    let position: Vec<String> = Axis::ALL
        .into_iter()
        .map(|axis| (axis, status.position[axis.index()]))
        .filter(|(axis, value)| axis.index() < 3 || *value != 0.0)
        .map(|(axis, value)| format!("{axis} {value:.4}"))
        .collect();
    // Writing to a String does not fail.
    let _ = writeln!(text, "{instance}: {state}, process {}", status.pid);
    if let Some(fault) = fault_text(status) {
        let _ = writeln!(text, "  fault         {fault}");
        let _ = writeln!(text, "  to clear it   {HOW_TO_CLEAR}");
    }
    if let Some(awaited) = awaited_text(status) {
        let _ = writeln!(text, "  awaits        {awaited}");
    }
    let _ = writeln!(text, "  position      {}", position.join("  "));
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
        "  override      feed {:.0} %, rapid {:.0} %, jog {:.0} % (executed {:.0} %)",
        status.feed_override * 100.0,
        status.rapid_override * 100.0,
        status.jog_override * 100.0,
        status.effective_override * 100.0
    );
    if let Some(adaptive) = adaptive_text(status) {
        let _ = writeln!(text, "  input         {adaptive}");
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
        "  ticks         {}, {} missed, {} late, {} starved\n  waking        {}\n  lateness      {}\n  handed over   {}\n  work          {}\n  real time     {}\n",
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
