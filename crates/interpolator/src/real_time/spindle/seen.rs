//! The spindle as a tick sees it, measured or simulated.

use crate::shared::message::observation::Turn;

/// A sample older than so many periods says nothing any more.
const STALE_PERIODS: u64 = 6;

/// The spindle, measured or simulated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpindleSeen {
    /// Its angle.
    pub(crate) turn: Turn,
    /// It turns as fast as it was told to.
    pub(crate) at_speed: bool,
}

impl SpindleSeen {
    /// Whether its angle is known at a moment, ns, by a sample that is new enough.
    pub(crate) const fn is_known(&self, at_ns: u64, period_ns: u64) -> bool {
        let age_ns = at_ns.saturating_sub(self.turn.sample_ns);
        age_ns <= STALE_PERIODS * period_ns && self.turn.is_settled
    }

    /// Whether it is at speed, and its angle known.
    pub(crate) const fn is_ready(&self, at_ns: u64, period_ns: u64) -> bool {
        self.at_speed && self.is_known(at_ns, period_ns)
    }
}
