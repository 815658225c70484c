//! Where a motion is to end.

/// Where a motion is to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// Where the program does.
    OfProgram,
    /// Anywhere on the program: it was ended.
    Anywhere,
}
