//! The remains of a run that ended before its end: files and figures of what was played, and where
//! the machine stood.

use super::setpoint_receiver::Received;
use crate::command::evidence::Evidence;
use crate::command::failure::Failure;
use crate::command::plan::title;
use crate::config::MachineConfig;
use crate::output;
use crate::program_file::ProgramFile;
use crate::report::{DiagnosisReport, Planning, RunReport};
use glidepath_link::{MachineState, Status};
use serde_json::Value;
use std::path::PathBuf;

/// What was received, and what was heard of the machine last.
pub(super) struct Left {
    pub(super) received: Received,
    pub(super) status: Option<Status>,
}

impl Left {
    /// Writes the files of what was played, marked as a part; the failure that ended it tells of them.
    pub(super) fn keep(
        self,
        program: &ProgramFile,
        config: &MachineConfig,
        (setpoints, plot): (Option<PathBuf>, Option<PathBuf>),
        failure: Failure,
    ) -> Failure {
        let Self { received, status } = self;
        let last = status.unwrap_or_else(bytemuck::Zeroable::zeroed);
        let audited = (&received.audit, received.played);
        let planning = Planning::default();
        let mut report = RunReport::new(&planning, audited, &received.counts, &last, config);
        report.servo_own_stops = received.farewell.own_stops;
        report
            .servo_stopped
            .clone_from(&received.farewell.first_stop);
        report.motion.program = program.name().display().to_string();
        report.motion.setpoints.clone_from(&setpoints);
        report.motion.plot.clone_from(&plot);
        report.motion.diagnosis = Some(DiagnosisReport::new(&received.summary, config));
        let mut recording = received.recording;
        recording.told(&report.motion, program.path());
        let title = format!("{}: ended before its end", title(program.name()));
        let is_cut_off = last.state().is_ok_and(MachineState::is_moving);
        let caption = if is_cut_off {
            "nothing more was heard of the machine while it moved".to_owned()
        } else {
            report.motion.caption()
        };
        let files = match recording.finish(&title, &caption) {
            Ok(()) => setpoints.into_iter().chain(plot).collect(),
            Err(error) => {
                output::note(&format!("what was played is not kept: {error}"));
                Vec::new()
            }
        };
        let of = |axis: glidepath_geometry::Axis| last.position.get(axis.index()).copied();
        let axes = config.axis_names().into_iter();
        let evidence = Evidence {
            figures: figures(&report, is_cut_off),
            played_s: report.played.played_s,
            line: last.line,
            position: axes
                .filter_map(|axis| Some((axis.to_string(), of(axis)?)))
                .collect(),
            files,
            fault: last.fault_text(),
        };
        Failure::EndedEarly {
            source: Box::new(failure),
            evidence: Box::new(evidence),
        }
    }
}

/// What is not known where the planner did not come to tell it.
const OF_THE_PLAN: [&str; 5] = [
    "lines",
    "segments",
    "plan_wall_s",
    "segments_per_s",
    "peak_rss_bytes",
];

/// What is judged as if the machine had stopped where it was heard of last.
const OF_THE_END: [&str; 6] = [
    "max_velocity_ratio",
    "max_acceleration_ratio",
    "max_jerk_ratio",
    "max_feed_ratio",
    "violation_count",
    "violations",
];

/// The figures of what was played, without those that would not be true.
fn figures(report: &RunReport, is_cut_off: bool) -> Value {
    let mut figures = serde_json::to_value(report).unwrap_or(Value::Null);
    if let Value::Object(figures) = &mut figures {
        let of_the_end = OF_THE_END.iter().filter(|_| is_cut_off);
        for unknown in OF_THE_PLAN.iter().chain(of_the_end) {
            figures.remove(*unknown);
        }
    }
    figures
}
