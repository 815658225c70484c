//! How closely the least time is sought.

/// How closely the least time is sought, and how much work that is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fineness {
    /// The longest time from knot to knot on the S-curves, s.
    pub(crate) knot_t: f64,
    /// What is left to gain in the end, as a share of the time.
    pub(crate) gap_r: f64,
    /// How much more firmly limits are lessened each time that they were exceeded between knots.
    pub(crate) firmer_r: f64,
}

impl Fineness {
    /// For curves of the program.
    pub(crate) const CLOSE: Self = Self {
        knot_t: 0.002,
        gap_r: 2e-5,
        firmer_r: 1.0,
    };
    /// For everything else, of which there may be much: within half a percent of the above, for a
    /// tenth of the work.
    pub(crate) const QUICK: Self = Self {
        knot_t: 0.005,
        gap_r: 2e-3,
        firmer_r: 2.0,
    };
}
