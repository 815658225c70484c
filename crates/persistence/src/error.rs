//! The errors of reading or writing what is kept.

use std::io;
use thiserror::Error;

/// The reason why what is kept cannot be read or written.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The system refuses to read or write a file.
    #[error("cannot {action} {file}: {source}")]
    Io {
        /// What was tried.
        action: &'static str,
        /// The file, or the folder.
        file: String,
        /// What the system said.
        source: io::Error,
    },
    /// A file is not what was written.
    #[error("{file} is damaged: {reason}")]
    Damaged {
        /// The file.
        file: String,
        /// How that is known.
        reason: String,
    },
    /// A file was written by a later version of this program.
    #[error("{file} is of version {found}; this program reads up to version {known}")]
    Newer {
        /// The file.
        file: String,
        /// Its version.
        found: u32,
        /// The one that is known here.
        known: u32,
    },
    /// Another process writes here.
    #[error(
        "{} keeps its state in {folder}, which one process may write at a time",
        Holder(*.process)
    )]
    Taken {
        /// The folder.
        folder: String,
        /// Which process it is; `None` if it did not say.
        process: Option<u32>,
    },
    /// What is to be kept is no state of a machine.
    #[error("this cannot be kept: {reason}")]
    NotKeepable {
        /// Why.
        reason: String,
    },
}

impl StoreError {
    /// For `map_err` of a use of a file.
    pub(crate) fn io(action: &'static str, file: &str) -> impl FnOnce(io::Error) -> Self {
        let file = file.to_owned();
        move |source| Self::Io {
            action,
            file,
            source,
        }
    }
}

/// Who has the right to write.
struct Holder(Option<u32>);

impl std::fmt::Display for Holder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(process) => write!(f, "process {process}"),
            None => f.write_str("another process"),
        }
    }
}
