//! The report of `run`.

use super::motion::{MotionReport, Planning};
use super::status::{quantiles_object, realtime_object, timing_text};
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::play_time::PlayedTime;
use glidepath_audit::{AuditReport, ViolationKind};
use glidepath_link::Status;
use glidepath_link::servo::ServoCounts;
use serde::Serialize;
use serde_json::Value;

/// A motion that was played. The names are part of the command line's contract.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// The motion, as the servo received it.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// How long it took, and why longer than planned.
    #[serde(flatten)]
    pub played: PlayedTime,
    /// Ticks in which the motion slowed or stood for want of frames.
    pub starved_ticks: u64,
    /// Ticks of the interpolator.
    pub ticks: u64,
    /// Ticks it missed.
    pub missed_ticks: u64,
    /// Ticks that began late, within their period.
    pub late_ticks: u64,
    /// Setpoints the servo received.
    pub received_setpoints: u64,
    /// Setpoints that were published and did not reach the servo.
    pub lost_setpoints: u64,
    /// How often the servo stopped the joints by itself: from the first time on it played no setpoint.
    pub servo_own_stops: u64,
    /// Why it did so first.
    pub servo_stopped: Option<String>,
    /// How late ticks began: p50, p99, p999, max.
    pub lateness_us: Value,
    /// How long the work of a tick took, before and at its deadline: p50, p99, p999, max.
    pub work_us: Value,
    /// How long the host took to wake the thread before a tick: p50, p99, p999, max.
    pub latency_us: Value,
    /// From the deadline of a tick to its setpoint published, when whoever subscribes has it: p50, p99, p999, max.
    pub response_us: Value,
    /// What real time was granted.
    pub realtime: Value,
    /// What the bridge to emulated drives reports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drives: Option<Value>,
    #[serde(skip)]
    status: Status,
}

impl RunReport {
    /// The report of a run, without the names of files.
    #[must_use]
    pub fn new(
        planning: &Planning,
        (audit, played): (&AuditReport, PlayedTime),
        servo: &ServoCounts,
        status: &Status,
        config: &MachineConfig,
    ) -> Self {
        let mut motion = MotionReport::new(planning, audit, config);
        // A gap between received setpoints is loss on the way, which is reported as such.
        motion.violation_count = motion.violation_count.saturating_sub(servo.gaps);
        motion.violations = audit
            .violations
            .iter()
            .filter(|violation| !matches!(violation.kind, ViolationKind::Gap { .. }))
            .take(super::motion::SHOWN)
            .map(ToString::to_string)
            .collect();
        Self {
            motion,
            played,
            starved_ticks: status.starved_ticks,
            ticks: status.ticks,
            missed_ticks: status.missed_ticks,
            late_ticks: status.late_ticks,
            received_setpoints: servo.received,
            lost_setpoints: servo.lost,
            servo_own_stops: 0,
            servo_stopped: None,
            lateness_us: quantiles_object(&status.lateness),
            work_us: quantiles_object(&status.work),
            latency_us: quantiles_object(&status.latency),
            response_us: quantiles_object(&status.response),
            realtime: realtime_object(status.grants()),
            drives: None,
            status: *status,
        }
    }

    /// Done, or a fault if the auditor found any or the motion was not played to its end.
    #[must_use]
    pub const fn exit(&self) -> Exit {
        if self.servo_own_stops > 0 {
            Exit::Fault
        } else {
            self.motion.exit()
        }
    }

    /// The report for people.
    #[must_use]
    pub fn text(&self) -> String {
        let stopped = self.servo_stopped.as_ref().map_or_else(String::new, |why| {
            format!("  FAULT         the servo stopped by itself, and played nothing more: {why}\n")
        });
        format!(
            "{}{}{}  servo         {} setpoints received, {} lost\n{stopped}{}{}",
            self.motion.text(),
            self.played.text(),
            timing_text(&self.status),
            super::quantity::grouped(self.received_setpoints),
            super::quantity::grouped(self.lost_setpoints),
            self.drives.as_ref().map_or_else(String::new, drives_text),
            self.motion.files()
        )
    }
}

/// The emulated drives, in a line.
fn drives_text(report: &Value) -> String {
    format!(
        "  drives        emulated on EtherCAT: {} cycles, {} frames lost, {} bad working counters\n",
        report["cycles"], report["lost_frames"], report["bad_working_counters"]
    )
}
