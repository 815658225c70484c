//! The interval between two things that are done now and then.

use std::time::{Duration, Instant};

/// An interval that others measure by the clock, as who waits for signs of life does. It is over once
/// as much was waited, and also once the clock says so: on a busy host a short wait takes many times
/// its length, and a thousand of them add up to more than who waits has patience.
#[derive(Debug)]
pub(crate) struct Interval {
    length: Duration,
    waited: Duration,
    begun: Instant,
}

impl Interval {
    pub(crate) fn new(length: Duration) -> Self {
        Self {
            length,
            waited: Duration::ZERO,
            begun: Instant::now(),
        }
    }

    /// Begins it anew.
    pub(crate) fn restart(&mut self) {
        *self = Self::new(self.length);
    }

    /// Ends it now.
    pub(crate) const fn end(&mut self) {
        self.waited = self.length;
    }

    /// Counts what was waited; true once the interval is over.
    pub(crate) fn is_over_after(&mut self, waited: Duration) -> bool {
        self.waited = self.waited.saturating_add(waited);
        self.waited >= self.length || self.begun.elapsed() >= self.length
    }
}
