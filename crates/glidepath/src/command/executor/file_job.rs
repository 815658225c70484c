//! A file to be executed, and how it is to begin.

use std::path::Path;

use glidepath_planner::StartLine;

/// A file, and how it is to begin.
pub(super) struct FileJob<'j> {
    pub(super) path: &'j Path,
    /// The fingerprint of the program that is meant; `None`: whatever is in the file.
    pub(super) looked_at: Option<u64>,
    /// How many times its tolerance it may use. One that goes on keeps what it began with.
    pub(super) tolerance_ratio: f64,
    pub(super) from: Option<StartLine>,
    pub(super) confirmed: bool,
    pub(super) resumes: bool,
}
