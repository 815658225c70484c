//! How to go on with a program whose motion ended before it did.
//!
//! What is told is tried first: the program is read up to where it was left, as `--resume` reads it, and what that
//! comes to is told. So nobody is told of a resumption that is then refused.

use crate::command::failure::Failure;
use crate::command::run_supervisor::recalling;
use crate::config::MachineConfig;
use crate::machine_options::resume;
use glidepath_gcode::ReadingWatch;
use glidepath_link::{ActiveProgram, EndOfEpoch, LinkConfig, TOLD_TO_END};
use glidepath_planner::{
    FileSource, FramePublisher, Remainder, ResumeError, ResumePoint, RunError,
};
use std::path::Path;
use std::time::Duration;

/// How long a resumption is tried that nobody has asked for yet: whoever has ended the job waits for its end for .6 s,
/// and the service has other things to do.
const TRIAL: Duration = Duration::from_millis(200);

/// A watch that ends the reading of a trial in time, whoever attends to what meanwhile.
pub(super) fn trial_watch() -> ReadingWatch {
    let watch = ReadingWatch::default();
    let ends = watch.clone();
    std::thread::spawn(move || {
        std::thread::sleep(TRIAL);
        ends.end();
    });
    watch
}

/// Looks whether a file has another length than the program had when its motion began: `--resume` would refuse it.
///
/// # Errors
/// It has.
pub(super) fn must_be_the_text(
    file: &Path,
    link: &LinkConfig,
    fingerprint: u64,
) -> Result<(), Obstacle> {
    let note = ActiveProgram::read(link).ok().flatten();
    let begun = note.filter(|note| note.fingerprint == fingerprint);
    let now = file.metadata().map(|about| about.len()).ok();
    if begun.is_some_and(|begun| now != Some(begun.bytes)) {
        return Err(RunError::Resume(ResumeError::OtherProgram).into());
    }
    Ok(())
}

/// The rest of a program that was executed up to a point, as a resumption reads it.
///
/// # Errors
/// The file cannot be read, or cannot be resumed there.
pub(super) fn rest_of(
    file: &Path,
    fingerprint: u64,
    config: &MachineConfig,
    point: ResumePoint,
) -> Result<Remainder<FileSource>, RunError> {
    let settings = config.settings();
    let options = config.program_options(point.program_start);
    let source = FileSource::unchecked(file, options, &settings)?.known_as(fingerprint);
    let source = source.attended(recalling(config, fingerprint));
    Remainder::find(source, point, settings.tolerance_mm)
}

/// Whether the motion has not come to rest yet: a pass of a thread comes to its end first.
pub(super) fn is_under_way(publisher: &FramePublisher<'_>) -> bool {
    publisher.end_of_epoch() == Some(EndOfEpoch::Open)
}

/// The command that goes on with a program, and what may have moved the machine before it is typed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resumption<'r> {
    /// `planner` or `run-file`.
    pub(super) command: &'r str,
    /// The program.
    pub(super) file: &'r Path,
    /// An abort may raise the tool axis.
    pub(super) lifts: bool,
}

/// Why a program is not resumed where the machine stands.
#[derive(Debug)]
pub(super) enum Obstacle {
    /// The machine is away from where the program was left. The text says what leads back.
    Away(String),
    /// A reason that tells of the program by itself, and what to do instead.
    Told(String),
    /// Any other reason.
    Other(String),
    /// It could not be tried.
    Untried,
}

impl From<RunError> for Obstacle {
    fn from(error: RunError) -> Self {
        let told = error.to_string();
        match error {
            RunError::Resume(ResumeError::OffPath { away: Some(_), .. }) => Self::Away(told),
            RunError::Resume(_) => Self::Told(told),
            _ => Self::Other(told),
        }
    }
}

impl From<Failure> for Obstacle {
    fn from(failure: Failure) -> Self {
        Self::Other(failure.to_string())
    }
}

/// Whether the end of a motion leaves a program of which something was executed, and of which the interpolator knows
/// how far: whether a resumption is to be tried.
pub(super) fn may_go_on(error: &RunError, publisher: &FramePublisher<'_>) -> bool {
    let is_known = match error {
        RunError::Aborted | RunError::Fault(_) | RunError::Interrupted => true,
        RunError::Ended { why } => why != TOLD_TO_END,
        _ => false,
    };
    let point = publisher.resume_point().ok().filter(|_| is_known);
    point.is_some() && publisher.line() > 0
}

/// Where a program was left, and how to go on with it.
pub(super) fn told(
    error: &RunError,
    publisher: &FramePublisher<'_>,
    how: Resumption<'_>,
    tried: Result<(), Obstacle>,
) -> String {
    let line = publisher.line();
    let command = resume(how.command, &how.file.display().to_string());
    if is_under_way(publisher) {
        return format!(
            "it was left in line {line} and has not come to rest yet; then {command} goes on, or says why not"
        );
    }
    let is_lifted = how.lifts && matches!(error, RunError::Aborted);
    match tried {
        // The tool axis may still rise, so how far it is away now is not told.
        Ok(()) | Err(Obstacle::Away(_)) if is_lifted => format!(
            "it was left in line {line}, and {command} goes on from there; if the abort raised the tool axis (lift of \
             [jog]), bring it back first: --resume says how far"
        ),
        Ok(()) => format!("it was left in line {line}, and {command} goes on from there"),
        Err(Obstacle::Away(why)) => format!(
            "it was left in line {line}, and {command} goes on from there once the axes are back: {why}"
        ),
        Err(Obstacle::Told(why)) => why,
        Err(Obstacle::Other(why)) => {
            format!("it was left in line {line}, and cannot be resumed there: {why}")
        }
        Err(Obstacle::Untried) => {
            format!("it was left in line {line}; {command} goes on from there, or says why not")
        }
    }
}
