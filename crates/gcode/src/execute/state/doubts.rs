//! What blocks did as their control does, and whoever wrote them may not have meant.

/// What there was of it so far in a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Doubts {
    /// A cycle of a FANUC went across to its hole below its R plane.
    pub(crate) crosses_below_r: bool,
    /// Klipper read over S of G4, and did not wait.
    pub(crate) did_not_wait: bool,
}
