//! The tolerances of the solver: how closely the least time is sought.

/// How closely the least time is sought, and how much work that is. Of single numbers no measurement is
/// kept, but of what they do together.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SolverTolerances {
    /// The longest time from knot to knot on the S-curves, s, and that as a share of the time in
    /// which the jerk of an axis makes up its acceleration.
    pub(crate) knot_t: f64,
    pub(crate) knot_r: f64,
    /// Knots nearer than this share of their distance to a place where pieces meet are left out.
    pub(crate) nearest_r: f64,
    /// Next to a rest, the time to a knot grows by this factor from the one before: b ~ t⁴ then grows by its
    /// fourth power on each interval, and the jerk, which is at its limit at one end of it, by its square.
    pub(crate) rest_growth: f64,
    /// What is left to gain in the end, as a share of the time, if three limits bind at each knot.
    pub(crate) gap_r: f64,
    /// The square of a step for each knot, in the measure of the barrier, that counts as small: half of it a knot
    /// is still to be gained of the weighted time, beside the three a knot that the last weight leaves. With 0 the
    /// step of the whole window has to be small ([`super::barrier`]). With 0 for dense blocks as well one of 50
    /// programs was .5 % faster (a period), and the others took the same time.
    pub(crate) small_r: f64,
    /// How much more firmly limits are lessened each time that they were exceeded between knots.
    pub(crate) firmer_r: f64,
    /// Spans of a spline are looked at between knots at so many places by their own parameter,
    /// which is less work; not by time.
    pub(crate) places_of_span: Option<u32>,
}

impl SolverTolerances {
    /// For curves of the program. Knots are as close as they may be, so `knot_r` makes them no closer.
    pub(crate) const CLOSE: Self = Self {
        knot_t: 0.002,
        knot_r: 0.1,
        nearest_r: 0.35,
        rest_growth: 1.2,
        gap_r: 2e-5,
        small_r: 0.0,
        firmer_r: 1.0,
        places_of_span: None,
    };
    /// For other curves, of which there may be much: within half a percent of the above, for a
    /// tenth of the work.
    pub(crate) const QUICK: Self = Self {
        knot_t: 0.005,
        knot_r: 0.1,
        nearest_r: 0.35,
        rest_growth: 1.2,
        gap_r: 2e-3,
        small_r: 0.0,
        firmer_r: 2.0,
        places_of_span: None,
    };
    /// Where joints are not the axes, also for lines, in nominal time ([`super::nominal`]). Round a square of 20 mm
    /// with a delta, stops take .6459 s at least; with these .6470 s, and with knots by path position, which grew by
    /// 1.06 next to rests, .660 s.
    pub(crate) const OF_JOINTS: Self = Self {
        knot_t: 0.003,
        knot_r: 0.04,
        nearest_r: 0.35,
        rest_growth: 1.2,
        gap_r: 2e-4,
        small_r: 0.0,
        firmer_r: 2.0,
        places_of_span: None,
    };
    /// For dense blocks, where how many of them are planned in a second counts: within half a
    /// percent of the above, for half of the work.
    pub(crate) const COARSE: Self = Self {
        knot_t: 0.008,
        knot_r: 0.16,
        nearest_r: 0.5,
        rest_growth: 1.2,
        gap_r: 5e-3,
        small_r: 0.05,
        firmer_r: 2.0,
        places_of_span: Some(6),
    };
}
