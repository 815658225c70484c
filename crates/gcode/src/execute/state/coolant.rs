//! What the coolant was told.

/// What the coolant was told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Coolant {
    /// M7.
    pub(crate) mist: bool,
    /// M8.
    pub(crate) flood: bool,
}
