//! Operator's overrides of speed.

use crate::Rate;

/// How much faster or slower than programmed the operator wants the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Override {
    /// Factor on feedrates, > 0. The limits of the machine stay what they are: a corner that they
    /// bind is not slowed by a factor below 1.
    pub feed_r: f64,
    /// Factor on the speed of rapids, 0 < r ≤ 1.
    pub rapid_r: f64,
}

impl Override {
    /// As programmed.
    pub const NONE: Self = Self {
        feed_r: 1.0,
        rapid_r: 1.0,
    };
}

/// The rate of a segment before any override.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ProgrammedRate {
    pub rate: Rate,
    /// The speed at which some axis reaches its velocity limit, mm/s: what a rapid is driven at.
    pub axes_v: f64,
}

impl ProgrammedRate {
    /// The rate under an override, mm/s.
    pub(crate) fn under(&self, wanted: Override) -> f64 {
        let programmed_v = match self.rate.feed_v() {
            Some(feed_v) => feed_v * wanted.feed_r,
            None => self.axes_v * wanted.rapid_r,
        };
        programmed_v.min(self.rate.most_v())
    }
}
