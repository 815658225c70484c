//! A stop in reserve, as it is kept: see [`super::reserve_search`] for what it is good for.

use super::kept_stop::KeptStop;

/// A stop that was played through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reserve {
    pub(super) stop: KeptStop,
    /// The frame at which it rests, if that is why it is wanted: the end of a block.
    pub(super) arrives_at: Option<u64>,
}

impl Reserve {
    /// A reserve without a stop so far.
    pub(super) const fn empty() -> Self {
        Self {
            stop: KeptStop::new(),
            arrives_at: None,
        }
    }

    /// Ticks until it begins.
    pub(super) fn in_ticks(&self) -> u32 {
        self.stop.in_ticks().unwrap_or(0)
    }
}
