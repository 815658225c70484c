//! Why a command did not do what was asked.

use crate::config::ConfigError;
use crate::exit::Exit;
use glidepath_gcode::Report;
use glidepath_planner::Refusal;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A command's failure, with its exit code.
#[derive(Debug, Error)]
pub enum Failure {
    /// The configuration was refused.
    #[error(transparent)]
    Configuration(#[from] ConfigError),
    /// A file of the command line cannot be opened.
    #[error("cannot open {path}: {source}", path = path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file cannot be read further or written.
    #[error("cannot {action} {path}: {source}", path = path.display())]
    File {
        /// What was tried: "read", "write".
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A program has findings; nothing moved.
    #[error("{program} is rejected; nothing moved")]
    Rejected {
        /// The program.
        program: String,
        /// What was found.
        report: Box<Report>,
    },
    /// A program that passed the check was refused later.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The system refuses to have Ctrl-C handled.
    #[error("cannot handle signals: {0}")]
    Signals(std::io::Error),
    /// The command is not connected to the stages below yet.
    #[error("this command is not built yet")]
    NotBuilt,
    /// The command was interrupted.
    #[error("interrupted")]
    Interrupted,
}

impl Failure {
    /// For `map_err` of opening a file.
    pub fn open(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        |source| Self::Open {
            path: path.to_owned(),
            source,
        }
    }

    /// For `map_err` of reading or writing a file.
    pub fn file(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| Self::File {
            action,
            path: path.to_owned(),
            source,
        }
    }

    /// The exit code.
    #[must_use]
    pub const fn exit(&self) -> Exit {
        match self {
            Self::Configuration(_) => Exit::Configuration,
            Self::Open { .. } => Exit::Usage,
            Self::Rejected { .. } | Self::Refused(_) => Exit::Rejected,
            Self::File { .. } | Self::Signals(_) | Self::NotBuilt => Exit::Fault,
            Self::Interrupted => Exit::Interrupted,
        }
    }
}
