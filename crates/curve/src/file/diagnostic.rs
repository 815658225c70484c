//! The diagnostic of a curve file: what is wrong, and where.

use core::ops::Range;

/// A diagnostic of a curve file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileDiagnostic {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: String,
    /// Where, in bytes of the text.
    pub at: Range<usize>,
}
