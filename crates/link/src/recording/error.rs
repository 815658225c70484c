//! Why a recording cannot be written or read.

use super::format::VERSION;
use std::io;

/// Why a recording cannot be written or read.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The file cannot be written or read.
    #[error("recording: {0}")]
    File(#[from] io::Error),
    /// It does not begin as a recording does.
    #[error("this file is no recording of glidepath")]
    NotARecording,
    /// It is of a later version of the format.
    #[error("the recording has format version {found}; this program reads version {VERSION}")]
    Version {
        /// Its version.
        found: u32,
    },
    /// It is of other records.
    #[error("the recording is of {found}, not of {expected}")]
    OtherRecord {
        /// What it is of.
        found: String,
        /// What was wanted.
        expected: &'static str,
    },
    /// It ends within a record.
    #[error("the recording was cut short: it ends within a record, after {whole} whole ones")]
    CutShort {
        /// Records before that.
        whole: u64,
    },
}
