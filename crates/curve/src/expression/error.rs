//! The error of a formula: what is wrong with it.

use core::ops::Range;
use thiserror::Error;

/// An error in a formula.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: String,
    /// Where, in bytes of the text.
    pub at: Range<usize>,
}
