//! The table of the benchmark programs.

use super::anchors::{Anchors, OtherControl};
use crate::exit::Exit;
use crate::report::MotionReport;
use core::fmt::Write as _;
use serde::Serialize;
use serde_json::{Value, json};

/// A program, planned, beside what is known of it.
#[derive(Debug)]
pub struct BenchRow {
    /// The program's name.
    pub program: String,
    /// The machine it was planned for.
    pub profile: String,
    /// The plan. Its planning time is processor time.
    pub motion: MotionReport,
    /// What is known.
    pub anchors: Anchors,
}

/// All rows.
#[derive(Debug, Default)]
pub struct BenchReport {
    /// In the order of the catalogue.
    pub rows: Vec<BenchRow>,
}

const HEAD: &str = "\
program               cycle s  T/tube  T/copp  T/curve  T/stop  T/LinuxCNC  deviation mm  \
v     a     j       CPU %  segments/s
";

const NOTES: &str = "
tube: best time of any geometry inside the tolerance, a local optimum; * of another tolerance
copp: jerk-limited along corner by corner transitions   curve: along the curve the chords are of
stop: with a stop at every corner   LinuxCNC: its fastest run with jerk limit, at the nearest jerk
v a j: largest share of each limit   CPU: processor time of planning, as a share of the cycle time
";

impl BenchRow {
    fn over(&self, time_s: Option<f64>) -> Option<f64> {
        time_s.map(|time_s| self.motion.cycle_time_s / time_s)
    }

    fn tube_s(&self) -> Option<f64> {
        self.anchors.tube.map(|(time_s, _)| time_s)
    }

    fn cpu_percent(&self) -> f64 {
        100.0 * self.motion.plan_wall_s / self.motion.cycle_time_s.max(f64::MIN_POSITIVE)
    }

    /// True if the bound is for another tolerance than the machine's.
    fn is_of_other_tolerance(&self) -> bool {
        let own_mm = self.motion.tolerance_mm;
        self.anchors
            .tube
            .is_some_and(|(_, tolerance_mm)| (tolerance_mm - own_mm).abs() > 1e-9)
    }

    fn line(&self) -> String {
        let ratio = |time_s: Option<f64>| {
            self.over(time_s)
                .map_or_else(|| "–".to_owned(), |ratio| format!("{ratio:.3}"))
        };
        let Anchors {
            copp,
            exact_curve,
            exact_stop,
            linuxcnc,
            ..
        } = &self.anchors;
        let mut tube = ratio(self.tube_s());
        if self.is_of_other_tolerance() {
            tube.push('*');
        }
        let motion = &self.motion;
        format!(
            "{:<20} {:>8.3} {:>7} {:>7} {:>8} {:>7} {:>11} {:>13.4} {:>5.3} {:>5.3} {:>9.7} {:>6.1} {:>11.0}\n",
            self.program,
            motion.cycle_time_s,
            tube,
            ratio(*copp),
            ratio(*exact_curve),
            ratio(*exact_stop),
            ratio(linuxcnc.as_ref().map(|run| run.time_s)),
            motion.max_deviation_mm,
            motion.max_velocity_ratio,
            motion.max_acceleration_ratio,
            motion.max_jerk_ratio,
            self.cpu_percent(),
            motion.segments_per_s,
        )
    }

    fn object(&self) -> Value {
        let motion = &self.motion;
        let Anchors {
            tube,
            copp,
            exact_curve,
            exact_stop,
            linuxcnc,
        } = &self.anchors;
        let linuxcnc_s = linuxcnc.as_ref().map(|run| run.time_s);
        json!({
            "program": self.program,
            "profile": self.profile,
            "cycle_time_s": motion.cycle_time_s,
            "tube_s": self.tube_s(),
            "tube_tolerance_mm": tube.map(|(_, tolerance_mm)| tolerance_mm),
            "over_tube": self.over(self.tube_s()),
            "copp_s": copp,
            "over_copp": self.over(*copp),
            "exact_curve_s": exact_curve,
            "over_exact_curve": self.over(*exact_curve),
            "exact_stop_s": exact_stop,
            "over_exact_stop": self.over(*exact_stop),
            "linuxcnc": linuxcnc.as_ref().map(OtherControlObject::from),
            "over_linuxcnc": self.over(linuxcnc_s),
            "tolerance_mm": motion.tolerance_mm,
            "max_deviation_mm": motion.max_deviation_mm,
            "max_velocity_ratio": motion.max_velocity_ratio,
            "max_acceleration_ratio": motion.max_acceleration_ratio,
            "max_jerk_ratio": motion.max_jerk_ratio,
            "violation_count": motion.violation_count,
            "plan_cpu_s": motion.plan_wall_s,
            "cpu_percent": self.cpu_percent(),
            "segments": motion.segments,
            "segments_per_s": motion.segments_per_s,
        })
    }
}

#[derive(Serialize)]
struct OtherControlObject {
    time_s: f64,
    jerk_mm_s3: f64,
    path_mode: String,
    deviation_mm: Option<f64>,
}

impl From<&OtherControl> for OtherControlObject {
    fn from(run: &OtherControl) -> Self {
        Self {
            time_s: run.time_s,
            jerk_mm_s3: run.jerk_j,
            path_mode: run.path_mode.clone(),
            deviation_mm: run.deviation_mm,
        }
    }
}

impl BenchReport {
    /// The table for people.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = HEAD.to_owned();
        for row in &self.rows {
            text.push_str(&row.line());
        }
        text.push_str(NOTES);
        for row in self
            .rows
            .iter()
            .filter(|row| row.motion.violation_count > 0)
        {
            // Writing to a String does not fail.
            let _ = writeln!(
                text,
                "{}: {} violations",
                row.program, row.motion.violation_count
            );
        }
        text
    }

    /// The table as an object.
    #[must_use]
    pub fn object(&self) -> Value {
        let rows: Vec<_> = self.rows.iter().map(BenchRow::object).collect();
        json!({ "programs": rows })
    }

    /// Done, or a fault if the auditor found any.
    #[must_use]
    pub fn exit(&self) -> Exit {
        if self.rows.iter().all(|row| row.motion.violation_count == 0) {
            Exit::Done
        } else {
            Exit::Fault
        }
    }
}
