//! The end that a motion is judged by: that of the program, or anywhere on it.

/// Where a motion is to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// Where the program does.
    OfProgram,
    /// Anywhere on the program: it was ended.
    Anywhere,
}
