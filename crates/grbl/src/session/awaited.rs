//! What the oldest line, and a reset, wait for.

use std::time::Duration;

/// What the oldest line waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Waiting {
    Nothing,
    /// That it was judged.
    Judgement,
    /// That the machine has power.
    Unlocking {
        since: Duration,
    },
    /// That the search for home is over.
    Home {
        since: Duration,
        has_begun: bool,
        /// The sender has ended it.
        is_ended: bool,
    },
}

/// A reset that is not over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Reset {
    pub(super) since: Duration,
    pub(super) has_welcome: bool,
    /// Modes and offsets were asked to be reset.
    pub(super) resets_modes: bool,
}
