//! The report of `plan`, and the part of `run` that is the same.

use super::quantity::{grouped, seconds};
use core::fmt::Write as _;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

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
    /// From the first motion to the last, dwells included, s.
    pub cycle_time_s: f64,
    /// Length of the programmed path, mm.
    pub path_length_mm: f64,
    /// Configured tolerance, mm.
    pub tolerance_mm: f64,
    /// Largest distance between programmed path and motion, either way, mm.
    pub max_deviation_mm: f64,
    /// Largest velocity, as a share of the axis' limit.
    pub max_velocity_ratio: f64,
    /// Largest acceleration, as a share of the axis' limit.
    pub max_acceleration_ratio: f64,
    /// Largest jerk, as a share of the axis' limit.
    pub max_jerk_ratio: f64,
    /// Largest path speed, as a share of the programmed feedrate.
    pub max_feed_ratio: f64,
    /// Breaches of limits or tolerance the auditor found; more than none is a defect of Glidepath.
    pub violations: Vec<String>,
    /// Wall time of planning alone, s.
    pub plan_wall_s: f64,
    /// Segments planned in a second of wall time.
    pub segments_per_s: f64,
    /// Largest resident set of the planning process, bytes.
    pub peak_rss_bytes: u64,
    /// Where the motion ended, mm or degrees, by axis letter.
    pub final_position: BTreeMap<String, f64>,
    /// The CSV that was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub setpoints: Option<PathBuf>,
    /// The plot that was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plot: Option<PathBuf>,
}

impl MotionReport {
    /// The report for people. Lines end with a line feed.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a String does not fail.
        let _ = self.write_text(&mut text);
        text
    }

    fn write_text(&self, text: &mut String) -> core::fmt::Result {
        writeln!(
            text,
            "{}: {} lines, {} segments, {} setpoints every {} ms",
            self.program,
            grouped(self.lines),
            grouped(self.segments),
            grouped(self.samples),
            self.period_s * 1e3
        )?;
        writeln!(text, "  cycle time    {}", seconds(self.cycle_time_s))?;
        writeln!(text, "  path length   {:.3} mm", self.path_length_mm)?;
        writeln!(
            text,
            "  deviation     {:.4} mm of {} mm allowed",
            self.max_deviation_mm, self.tolerance_mm
        )?;
        writeln!(
            text,
            "  limits used   velocity {}, acceleration {}, jerk {}, feed {}",
            percent(self.max_velocity_ratio),
            percent(self.max_acceleration_ratio),
            percent(self.max_jerk_ratio),
            percent(self.max_feed_ratio)
        )?;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a rounded rate, for display; a cast saturates"
        )]
        let rate = self.segments_per_s.round() as u64;
        writeln!(
            text,
            "  planning      {} ({} segments/s), peak memory {:.1} MB",
            seconds(self.plan_wall_s),
            grouped(rate),
            self.peak_rss_megabytes()
        )?;
        let end: Vec<String> = self
            .final_position
            .iter()
            .map(|(axis, value)| format!("{axis} {value:.4}"))
            .collect();
        writeln!(text, "  end position  {}", end.join("  "))?;
        for violation in &self.violations {
            writeln!(text, "  VIOLATION     {violation}")?;
        }
        Ok(())
    }

    fn peak_rss_megabytes(&self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "for display")]
        let bytes = self.peak_rss_bytes as f64;
        bytes / 1e6
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
            "cycle time {} · path {:.1} mm · deviation {:.4} of {} mm · largest share of the \
             limits: velocity {}, acceleration {}, jerk {}",
            seconds(self.cycle_time_s),
            self.path_length_mm,
            self.max_deviation_mm,
            self.tolerance_mm,
            percent(self.max_velocity_ratio),
            percent(self.max_acceleration_ratio),
            percent(self.max_jerk_ratio)
        )
    }
}

fn percent(ratio: f64) -> String {
    format!("{:.2} %", ratio * 100.0)
}
