//! What is wrong with a curve file, and where.

use core::ops::Range;

/// What is wrong with a curve file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileDiagnostic {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: String,
    /// Where, in bytes of the text.
    pub at: Range<usize>,
}
