//! The refusals of programs: why one was not run, or not run to its end.

use std::io;

use glidepath_gcode::Diagnostic;
use glidepath_link::LinkError;
use glidepath_motion::PlanError;
use thiserror::Error;

/// A program that was refused, as a whole or from some point on.
#[derive(Debug, Error)]
pub enum Refusal {
    /// The text has errors: all of them if the whole file was checked before motion, else the
    /// first.
    #[error("the program has {} error(s), the first in {}", .diagnostics.len(), place(.diagnostics.first()))]
    Program {
        /// In the order of the text, at least one.
        diagnostics: Vec<Diagnostic>,
        /// Further diagnostics that are not listed.
        unlisted: u32,
    },
    /// The loops of the program go on for too long to be checked to their end.
    #[error(
        "the program is not checked beyond line {line}: its loops go on for too long; give \
         --allow-unchecked to run it all the same, each line judged only when it comes to it"
    )]
    Unchecked {
        /// Where the check was given up.
        line: u32,
    },
    /// The program asked an input or the probe what to do, and what that said is not known any more.
    #[error(
        "line {line} asked an input or the probe what to do (M66, G38), and what that said when this \
         part of the program ran is not known; run the program from a line behind it, and let the \
         machine keep answers: directory in [state] of its configuration"
    )]
    AnswerUnknown {
        /// The line that asked.
        line: u32,
    },
    /// What an input or the probe said cannot be kept.
    #[error(
        "what an input or the probe said cannot be kept: {0}; the program was not told, and does not \
         go on"
    )]
    NotKept(#[source] io::Error),
    /// An item cannot be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The text cannot be read.
    #[error("the program cannot be read: {0}")]
    Read(#[from] io::Error),
    /// The client of a listening planner died or fell silent.
    #[error(
        "the client fell silent after {accepted} accepted requests; the motion stopped at the end of \
         the last one"
    )]
    ClientLost {
        /// Requests accepted, the opening one included.
        accepted: u64,
    },
    /// The port a stream came by failed.
    #[error("the stream broke off: {0}")]
    StreamFailed(#[source] LinkError),
}

/// The line of a diagnostic, and its file if that is not the program.
fn place(diagnostic: Option<&Diagnostic>) -> String {
    let line = diagnostic.map_or(0, |diagnostic| diagnostic.line);
    match diagnostic.and_then(|diagnostic| diagnostic.file.as_deref()) {
        Some(file) => format!("line {line} of {file}"),
        None => format!("line {line}"),
    }
}

impl Refusal {
    /// True if the frames given out before do not end at rest: whoever plays them has to stop the
    /// motion.
    #[must_use]
    pub const fn leaves_motion_open(&self) -> bool {
        matches!(
            self,
            Self::Plan(PlanError::NoMotion { .. } | PlanError::BeyondTravel { .. })
        )
    }
}
