//! The state of the rounds: what is carried from one to the next in the optimisation of a window.

use super::samples::Samples;
use super::tube::FEED_R;
use crate::in_tube::verify::FEED_SLACK;

/// Gain of progress, relative to that of the window, below which nothing more is tried: another round
/// would cost a whole problem. Of a hundred periods at the feed it is half a hundredth of one.
const LITTLE_GAIN: f64 = 1e-4;

/// The largest violation of a soft row that is none, in the unit of the row (the radius, the feed, a limit of a
/// joint, four radii beyond an end of a line): rows with more are violated for good, because samples are on
/// pieces that cannot be reached. One number does for all, because nothing is accepted by it: a row that is kept
/// is violated by about μ over its price, some millionths, and the judge has limits of its own. With a tenth of
/// it two of 35 programs took up to .6 % longer, with five times as much two up to .3 %.
pub(super) const ENOUGH_VIOLATION: f64 = 0.02;
/// Speed over the feed that is aimed at where motions stand out of the planes: the judge allows a
/// little more ([`FEED_SLACK`]), so that what turns a little further in the next round still passes.
const ALLOWED_R: f64 = 1.0 + 4e-4;
/// How many times stronger the pull to the path is where the feed was not kept. With less, velocities
/// turn as before; with more, corners are cut less than the tolerance allows. No measurement is kept.
const FIRM: f64 = 10.0;
/// Least share of the feed to plan with. The excess that planes leave is some parts in ten thousand; one
/// far beyond that is no reason to drive the window slower.
const LEAST_FEED_R: f64 = 0.995;

/// True if a mean progress is a gain over another one that is worth a round.
pub(super) fn gains(before_t: f64, mean_t: f64) -> bool {
    mean_t - before_t >= LITTLE_GAIN * before_t
}

/// The best motion so far.
#[derive(Debug)]
pub(crate) struct BestMotion<const D: usize> {
    pub(crate) best: Option<(f64, Vec<[f64; D]>, Samples)>,
}

impl<const D: usize> BestMotion<D> {
    pub(crate) fn add(&mut self, mean: f64, points: &[[f64; D]], samples: &Samples) {
        if self.best.as_ref().is_none_or(|(most, ..)| mean > *most) {
            self.best = Some((mean, points.to_vec(), samples.clone()));
        }
    }
}

/// Where an attempt is.
#[derive(Debug)]
pub(crate) struct RoundState<const D: usize> {
    pub(crate) points: Vec<[f64; D]>,
    /// The points are a motion, and not only the tail to start from.
    pub(crate) has_motion: bool,
    /// Rows were violated in the last round: samples are on pieces too early.
    pub(crate) is_exceeding: bool,
    /// Mean progress in the last round ([`Samples::mean_t`]), s.
    pub(crate) mean_t: f64,
    /// With less of it a motion that passes is of no use, and none of the next will be.
    pub(crate) least_t: f64,
    /// Largest speed over the feed in the last solution.
    pub(crate) speed_r: f64,
    /// Share of the feed to plan with in rounds in which samples stay where they are.
    pub(crate) feed_r: f64,
    /// A solution that violates rows by more is not looked at when a motion is made smooth.
    pub(crate) most_violation: f64,
}

impl<const D: usize> RoundState<D> {
    /// To begin with a tail, which need not be a motion.
    pub(crate) fn starting(tail: &[[f64; D]]) -> Self {
        Self {
            has_motion: false,
            ..Self::polishing(tail)
        }
    }

    /// To go on from a motion.
    pub(crate) fn polishing(points: &[[f64; D]]) -> Self {
        Self {
            points: points.to_vec(),
            has_motion: true,
            is_exceeding: false,
            mean_t: f64::NEG_INFINITY,
            least_t: f64::NEG_INFINITY,
            speed_r: 0.0,
            feed_r: FEED_R,
            most_violation: ENOUGH_VIOLATION,
        }
    }

    /// Takes note of how far the last solution stands out of the planes that bound the feed, which
    /// it was planned with a share of: the next one is expected to stand out as far.
    ///
    /// On curves velocities turn from round to round, and planes that touch the feed where the last
    /// ones were come a little late for the next.
    pub(crate) fn learn_feed(&mut self, planned_r: f64) {
        // Planned at p it came to speed_r: at p·ALLOWED_R/speed_r it would come to what is allowed.
        let excess_r = self.speed_r / planned_r;
        self.feed_r = (ALLOWED_R / excess_r).clamp(LEAST_FEED_R, FEED_R);
    }

    /// The pull to the path where the feed was not kept: in a wide tube velocities may turn far
    /// from round to round, and planes of the last ones do not hold the next; near the middle they
    /// all point along the path.
    pub(crate) fn firm_pull(&self, pull: f64) -> f64 {
        if self.speed_r > FEED_SLACK {
            FIRM * pull
        } else {
            pull
        }
    }

    /// True if progress hardly changes any more.
    pub(crate) fn has_settled(&self, mean_t: f64) -> bool {
        (mean_t - self.mean_t).abs() < LITTLE_GAIN * mean_t
    }
}
