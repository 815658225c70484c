//! The errors of files that cannot be opened, read or written.

use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// An error with a file of the command line.
#[derive(Debug, Error)]
pub enum FileError {
    /// The file cannot be opened.
    #[error("cannot open {path}: {source}", path = path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file cannot be read further or written.
    #[error("cannot {action} {path}: {source}{}", remedy(.source), path = path.display())]
    Use {
        /// What was tried: "read", "write".
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file may not be overwritten.
    #[error("{path} is not written: {reason}", path = path.display())]
    Guarded {
        /// The file.
        path: PathBuf,
        /// Why, and what to do.
        reason: String,
    },
}

/// What can be done about it, where the system does not say so itself.
fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::FileTooLarge => "; raise the limit of the size of files (ulimit -f)",
        io::ErrorKind::StorageFull => "; free some room on its file system (df -h)",
        io::ErrorKind::QuotaExceeded => {
            "; delete files, or have the quota of this user raised (quota)"
        }
        _ => "",
    }
}

impl FileError {
    /// A file that may not be overwritten.
    #[must_use]
    pub fn guarded(path: &Path, reason: String) -> Self {
        Self::Guarded {
            path: path.to_owned(),
            reason,
        }
    }

    /// For `map_err` of opening a file.
    pub fn open(path: &Path) -> impl FnOnce(io::Error) -> Self {
        |source| Self::Open {
            path: path.to_owned(),
            source,
        }
    }

    /// For `map_err` of reading or writing a file.
    pub fn file(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Use {
            action,
            path: path.to_owned(),
            source,
        }
    }
}
