//! The operator's overrides of feed and rapids.

/// The operator's overrides: how much faster or slower than programmed the motion is to be.
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
