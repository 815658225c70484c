//! How to go on with a program whose motion ended before it did.
//!
//! What is told is tried first: the program is read up to where it was left, as `--resume` reads it, and what that
//! comes to is told. So nobody is told of a resumption that is then refused.

use crate::command::failure::Failure;
use crate::machine_options::resume;
use glidepath_link::{EndOfEpoch, TOLD_TO_END};
use glidepath_planner::{FramePublisher, ResumeError, RunError};
use std::path::Path;
use std::time::Duration;

/// How long a resumption is tried that nobody has asked for yet: within a second a command has to end that is told to,
/// and the service has other things to do.
pub(super) const TRIAL: Duration = Duration::from_millis(800);

/// The command that goes on with a program, and what may have moved the machine before it is typed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resumption<'r> {
    /// `planner` or `run-file`.
    pub(super) command: &'r str,
    /// The program.
    pub(super) file: &'r Path,
    /// `glidepath abort` raises the tool axis.
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
    if publisher.end_of_epoch() == Some(EndOfEpoch::Open) {
        // A pass of a thread comes to its end first.
        return format!(
            "it was left in line {line} and has not come to rest yet; then {command} goes on, or says why not"
        );
    }
    let is_lifted = how.lifts && matches!(error, RunError::Aborted);
    match tried {
        Ok(()) if is_lifted => format!(
            "it was left in line {line}, and {command} goes on from there, once the tool axis, which `glidepath abort` \
             raises (lift of [jog]), is back"
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
