//! How failures come of the errors of other crates, and of commands.

use super::failure::Failure;
use crate::curve_file::CurveFileError;
use crate::program_text::UnknownEvent;
use glidepath_planner::Refusal;
use glidepath_recording::ReadError as RecordingError;
use std::path::Path;

impl From<CurveFileError> for Failure {
    fn from(error: CurveFileError) -> Self {
        match error {
            CurveFileError::Unreadable(error) => Self::File(error),
            CurveFileError::Rejected(diagnostic) => Self::Curve(diagnostic),
        }
    }
}

impl From<UnknownEvent> for Failure {
    fn from(event: UnknownEvent) -> Self {
        Self::UnknownEvent(event)
    }
}

impl Failure {
    /// A failure to read a recording.
    #[must_use]
    pub(super) fn recording(file: &Path, error: RecordingError) -> Self {
        let file = file.display().to_string();
        Self::Recording { file, error }
    }

    /// A refusal of a program, as the failure to run it.
    #[must_use]
    pub(super) fn refused(program: &str, refusal: Refusal, moved: bool) -> Self {
        match refusal {
            Refusal::Program {
                diagnostics,
                unlisted,
            } => Self::Rejected {
                program: program.to_owned(),
                diagnostics,
                more: unlisted,
                moved,
            },
            refusal => Self::Refused(refusal),
        }
    }

    /// A failure to deliver a command; of one that brings the machine to rest, with what is left.
    #[must_use]
    pub(super) fn of_command(self, command: &'static str) -> Self {
        let stops = matches!(command, "hold" | "abort" | "disable" | "stop-at-block-end");
        if stops && !matches!(self, Self::NoInterpolator { .. }) {
            let source = Box::new(self);
            Self::NotStopped { command, source }
        } else {
            self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whoever wants the machine to rest is told what is left where nobody answers.
    #[test]
    fn of_every_command_that_stops_the_last_resort_is_told() {
        let told = |command| {
            let silent = Failure::Silent {
                instance: "mill".to_owned(),
                process: 7,
                waited_s: 2,
            };
            silent.of_command(command).to_string()
        };
        for command in ["hold", "abort", "disable", "stop-at-block-end"] {
            assert!(
                told(command).contains("`glidepath abort --signal"),
                "{}",
                told(command)
            );
        }
        assert!(!told("enable").contains("abort"));
    }
}
