//! Why a job was not executed to its end.

use glidepath_planner::Refusal;

use crate::command::failure::Failure;
use crate::command::program_diagnostics::refusal_text;

/// Why a job was not executed to its end.
pub(super) enum Stop {
    Refused(String),
    Failed(String),
    ToConfirm(String),
    /// The file is not the program that was looked at.
    Changed(String),
}

impl Stop {
    /// The reason, for people.
    pub(super) fn text(self) -> String {
        match self {
            Self::Refused(text)
            | Self::Failed(text)
            | Self::ToConfirm(text)
            | Self::Changed(text) => text,
        }
    }
}

pub(super) type End = Result<String, Stop>;

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        Self::Refused(failure.to_string())
    }
}

/// A refusal in a few lines.
pub(super) fn refusal(refusal: &Refusal) -> Stop {
    Stop::Refused(refusal_text(refusal))
}
