//! The report of `plan`, and the part of `run` that is the same.

use super::diagnosis::DiagnosisReport;
use super::quantity::{counted, decimals, grouped, seconds};
use crate::config::{AxisConfig, MachineConfig};
use crate::exit::Exit;
use core::fmt::Write as _;
use glidepath_audit::{AuditReport, Violation};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Violations listed at most.
pub(super) const SHOWN: usize = 20;
/// Smoothness findings in the text; the object has [`SHOWN`].
const FINDINGS_IN_TEXT: usize = 3;

/// What planning a program took.
#[derive(Debug, Clone, Copy, Default)]
pub struct Planning {
    /// Source lines read.
    pub lines: u64,
    /// Segments planned.
    pub segments: u64,
    /// Wall time for which it was waited for, s.
    pub plan_wall_s: f64,
    /// Largest resident set of the process, bytes.
    pub peak_rss_bytes: Option<u64>,
}

/// A motion and how it was made. The names are part of the command line's contract.
#[derive(Debug, Clone, Default, Serialize)]
pub struct MotionReport {
    /// The program as it was named on the command line.
    pub program: String,
    /// Source lines read.
    pub lines: u64,
    /// Segments planned.
    pub segments: u64,
    /// Setpoints.
    pub samples: u64,
    /// Interpolation period, s.
    pub period_s: f64,
    /// How long the program takes, s: from the first motion to the last, with all dwells, those
    /// before and behind included.
    pub cycle_time_s: f64,
    /// Length of the programmed path, without moves of rotary axes alone, mm.
    pub path_length_mm: f64,
    /// Path of the moves of rotary axes alone, degrees.
    pub turn_length_deg: f64,
    /// The largest tolerance in force for a move, mm: that of G64 P, else the configured one.
    pub tolerance_mm: f64,
    /// The smallest one likewise, mm.
    pub least_tolerance_mm: f64,
    /// Largest distance between programmed path and motion, either way, mm.
    pub max_deviation_mm: f64,
    /// Largest angle between the direction of the tool and the programmed one, degrees, where rotary axes turn it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_direction_deg: Option<f64>,
    /// The largest tolerance of that in force for a move, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_tolerance_deg: Option<f64>,
    /// How far an axis was beyond an end of its travel at most, mm or degrees; 0 if none was.
    pub max_beyond_travel_mm: f64,
    /// Largest velocity, as a share of the axis' limit.
    pub max_velocity_ratio: f64,
    /// Largest acceleration, as a share of the axis' limit.
    pub max_acceleration_ratio: f64,
    /// Largest jerk, as a share of the axis' limit.
    pub max_jerk_ratio: f64,
    /// Largest velocity of a joint, as a share of its limit, where joints are not axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_joint_velocity_ratio: Option<f64>,
    /// Largest acceleration likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_joint_acceleration_ratio: Option<f64>,
    /// Largest jerk likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_joint_jerk_ratio: Option<f64>,
    /// Largest path speed, as a share of the programmed feedrate.
    pub max_feed_ratio: f64,
    /// How far joints that go straight between setpoints are off half-way, at most, mm or degrees;
    /// of a plan, where joints are not axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_joint_line_error: Option<f64>,
    /// Events that do not stop the motion; absent if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub events: Option<u64>,
    /// How far from its place the motion was when one of them happened, at most, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_event_off_mm: Option<f64>,
    /// The same in the mean, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_event_off_mm: Option<f64>,
    /// Breaches of limits, tolerance or order the auditor found. More than none is a defect of
    /// ours.
    pub violation_count: u64,
    /// The first of them.
    pub violations: Vec<String>,
    /// Motion that the program does not ask for, inside all limits: samples of an axis that moves
    /// though the program leaves it alone, or has jerk at constant feed that the path does not ask
    /// for.
    pub smoothness_finding_count: u64,
    /// The first of them.
    pub smoothness_findings: Vec<String>,
    /// Wall time for which planning was waited for, s.
    pub plan_wall_s: f64,
    /// Segments planned in a second of wall time.
    pub segments_per_s: f64,
    /// Largest resident set of the planning process, bytes; absent if the system does not tell.
    pub peak_rss_bytes: Option<u64>,
    /// Where the motion ended, mm or degrees, by axis letter.
    pub final_position: BTreeMap<String, f64>,
    /// Which limits bind, where time is lost, and how smooth the motion is.
    #[serde(flatten)]
    pub diagnosis: Option<DiagnosisReport>,
    /// The CSV that was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub setpoints: Option<PathBuf>,
    /// The plot that was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plot: Option<PathBuf>,
}

impl MotionReport {
    /// The report of a motion, without the names of files.
    #[must_use]
    pub fn new(planning: &Planning, audit: &AuditReport, config: &MachineConfig) -> Self {
        #[allow(clippy::cast_precision_loss, reason = "a rate, for display")]
        let segments = planning.segments as f64;
        let position = |axis: &AxisConfig| {
            (
                axis.axis.to_string(),
                audit.final_position[axis.axis.index()],
            )
        };
        let joints = audit
            .max_joint_ratios
            .map(|worst| worst.map(|worst| worst.ratio));
        Self {
            lines: planning.lines,
            segments: planning.segments,
            samples: audit.samples,
            period_s: config.period_t(),
            cycle_time_s: audit.cycle_time_s,
            path_length_mm: audit.path_length_mm,
            turn_length_deg: audit.turn_length_deg,
            tolerance_mm: audit.tolerance_mm,
            least_tolerance_mm: audit.least_tolerance_mm,
            max_deviation_mm: audit.max_deviation_mm,
            max_direction_deg: audit.max_direction_deg,
            direction_tolerance_deg: audit.max_direction_deg.map(|_| {
                let direction = config.settings().direction;
                direction.in_force_deg(audit.tolerance_mm)
            }),
            max_beyond_travel_mm: audit.max_beyond_travel_mm,
            max_velocity_ratio: audit.max_velocity_ratio.ratio,
            max_acceleration_ratio: audit.max_acceleration_ratio.ratio,
            max_jerk_ratio: audit.max_jerk_ratio.ratio,
            max_joint_velocity_ratio: joints.map(|[velocity, ..]| velocity),
            max_joint_acceleration_ratio: joints.map(|[_, acceleration, _]| acceleration),
            max_joint_jerk_ratio: joints.map(|[.., jerk]| jerk),
            max_feed_ratio: audit.max_feed_ratio.ratio,
            events: (audit.events > 0).then_some(audit.events),
            max_event_off_mm: (audit.events > 0).then_some(audit.max_event_off_mm),
            mean_event_off_mm: (audit.events > 0).then_some(audit.mean_event_off_mm),
            violation_count: audit.violation_count,
            violations: shown(&audit.violations),
            smoothness_finding_count: audit.tremor_count,
            smoothness_findings: shown(&audit.tremors),
            plan_wall_s: planning.plan_wall_s,
            segments_per_s: segments / planning.plan_wall_s.max(1e-9),
            peak_rss_bytes: planning.peak_rss_bytes,
            final_position: config.axes.iter().map(position).collect(),
            ..Self::default()
        }
    }

    /// Done, or a fault if the auditor found any.
    #[must_use]
    pub const fn exit(&self) -> Exit {
        if self.violation_count == 0 {
            Exit::Done
        } else {
            Exit::Fault
        }
    }

    /// The report for people. Lines end with a line feed.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a String does not fail.
        let _ = self.write_text(&mut text);
        text
    }

    /// How far from their places the events happen that do not stop the motion.
    fn write_events(&self, text: &mut String) -> core::fmt::Result {
        let (Some(events), Some(mean_mm), Some(most_mm)) =
            (self.events, self.mean_event_off_mm, self.max_event_off_mm)
        else {
            return Ok(());
        };
        writeln!(
            text,
            "  events        {}, off their places by {mean_mm:.4} mm in the mean, {most_mm:.4} mm at most",
            grouped(events)
        )
    }

    fn write_text(&self, text: &mut String) -> core::fmt::Result {
        writeln!(
            text,
            "{}: {}, {}, {} every {} ms",
            self.program,
            counted(self.lines, "line"),
            counted(self.segments, "segment"),
            counted(self.samples, "setpoint"),
            (self.period_s * 1e6).round() / 1e3
        )?;
        writeln!(text, "  cycle time    {}", seconds(self.cycle_time_s))?;
        writeln!(text, "  path length   {}", self.path_length(3))?;
        writeln!(
            text,
            "  deviation     {:.4} mm of {} mm allowed",
            self.max_deviation_mm,
            self.tolerances()
        )?;
        if let (Some(off_deg), Some(allowed_deg)) =
            (self.max_direction_deg, self.direction_tolerance_deg)
        {
            writeln!(
                text,
                "  direction     {off_deg:.4}° of {allowed_deg}° allowed"
            )?;
        }
        writeln!(
            text,
            "  limits used   velocity {}, acceleration {}, jerk {}, feed {}",
            percent(self.max_velocity_ratio),
            percent(self.max_acceleration_ratio),
            percent(self.max_jerk_ratio),
            percent(self.max_feed_ratio)
        )?;
        if let (Some(velocity), Some(acceleration), Some(jerk)) = (
            self.max_joint_velocity_ratio,
            self.max_joint_acceleration_ratio,
            self.max_joint_jerk_ratio,
        ) {
            writeln!(
                text,
                "  joints used   velocity {}, acceleration {}, jerk {}",
                percent(velocity),
                percent(acceleration),
                percent(jerk)
            )?;
        }
        self.write_events(text)?;
        self.write_planning(text)?;
        let end: Vec<String> = self
            .final_position
            .iter()
            .map(|(axis, value)| format!("{axis} {}", decimals(*value, 4)))
            .collect();
        writeln!(text, "  end position  {}", end.join("  "))?;
        if let Some(diagnosis) = &self.diagnosis {
            text.push_str(&diagnosis.text());
        }
        if self.smoothness_finding_count > 0 {
            writeln!(
                text,
                "  not smooth    {} findings, the first:",
                grouped(self.smoothness_finding_count)
            )?;
        }
        for finding in self.smoothness_findings.iter().take(FINDINGS_IN_TEXT) {
            writeln!(text, "    {finding}")?;
        }
        if self.violation_count > 0 {
            writeln!(
                text,
                "  violations    {}, the first:",
                grouped(self.violation_count)
            )?;
        }
        for violation in &self.violations {
            writeln!(text, "    {violation}")?;
        }
        Ok(())
    }

    fn write_planning(&self, text: &mut String) -> core::fmt::Result {
        if let Some(error) = self.max_joint_line_error {
            writeln!(
                text,
                "  joints        straight between setpoints: off by {error:.2e}"
            )?;
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a rounded rate, for display; a cast saturates"
        )]
        let rate = self.segments_per_s.round() as u64;
        writeln!(
            text,
            "  planning      {} ({} segments/s){}",
            seconds(self.plan_wall_s),
            grouped(rate),
            self.peak_memory()
        )?;
        Ok(())
    }

    /// The length of the path, and how far rotary axes turn where nothing else moves.
    fn path_length(&self, decimals: usize) -> String {
        let mut text = format!("{:.decimals$} mm", self.path_length_mm);
        if self.turn_length_deg > 0.0 {
            let _ = write!(text, " and {:.decimals$}°", self.turn_length_deg);
        }
        text
    }

    /// The tolerance in force, or from which to which it goes.
    fn tolerances(&self) -> String {
        if self.least_tolerance_mm < self.tolerance_mm {
            format!("{} to {}", self.least_tolerance_mm, self.tolerance_mm)
        } else {
            self.tolerance_mm.to_string()
        }
    }

    fn peak_memory(&self) -> String {
        #[allow(clippy::cast_precision_loss, reason = "for display")]
        let megabytes = |bytes: u64| bytes as f64 / 1e6;
        self.peak_rss_bytes
            .map(|bytes| format!(", peak memory {:.1} MB", megabytes(bytes)))
            .unwrap_or_default()
    }

    /// Lines that say where the files are.
    #[must_use]
    pub fn files(&self) -> String {
        let mut text = String::new();
        for (what, path) in [("setpoints", &self.setpoints), ("plot", &self.plot)] {
            if let Some(path) = path {
                let _ = writeln!(text, "  {what:<13} {}", path.display());
            }
        }
        text
    }

    /// One line under the title of a plot.
    #[must_use]
    pub fn caption(&self) -> String {
        format!(
            "cycle time {} · path {} · deviation {:.4} of {} mm · largest share of the \
             limits: velocity {}, acceleration {}, jerk {}",
            seconds(self.cycle_time_s),
            self.path_length(1),
            self.max_deviation_mm,
            self.tolerances(),
            percent(self.max_velocity_ratio),
            percent(self.max_acceleration_ratio),
            percent(self.max_jerk_ratio)
        )
    }
}

fn shown(violations: &[Violation]) -> Vec<String> {
    let shown = violations.iter().take(SHOWN);
    shown.map(ToString::to_string).collect()
}

fn percent(ratio: f64) -> String {
    format!("{:.2} %", ratio * 100.0)
}
