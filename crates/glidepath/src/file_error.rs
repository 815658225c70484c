//! Files that cannot be opened, read or written.

use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What went wrong with a file of the command line.
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
    #[error("cannot {action} {path}: {source}", path = path.display())]
    Use {
        /// What was tried: "read", "write".
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

impl FileError {
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
