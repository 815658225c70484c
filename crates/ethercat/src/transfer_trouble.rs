//! What is wrong with an object that came, or was taken, in segments.

use core::fmt;

/// What is wrong with a transfer. Lengths are bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferTrouble {
    /// A segment came twice, or one is missing: its toggle bit did not change.
    Toggle,
    /// More or less came than was told.
    Length {
        /// By the first answer.
        told: usize,
        /// What came.
        given: usize,
    },
    /// It is longer than anything that is read of it.
    TooLong {
        /// By the first answer.
        told: usize,
        /// What is read.
        most: usize,
    },
    /// A segment was empty, and not the last one.
    Empty,
}

impl fmt::Display for TransferTrouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Toggle => write!(
                f,
                "a segment came twice or is missing (its toggle bit did not change)"
            ),
            Self::Length { told, given } => {
                write!(f, "{told} bytes were told, and {given} came")
            }
            Self::TooLong { told, most } => {
                write!(f, "it has {told} bytes, and {most} are read at most")
            }
            Self::Empty => write!(f, "a segment was empty, and not the last one"),
        }
    }
}
