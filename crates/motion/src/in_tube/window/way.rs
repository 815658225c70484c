//! The way of a motion, which is what the feed bounds, and whether it is at the feed.

use super::samples::{Samples, sample};
use super::scaled_path::ScaledPath;
use super::solver::{combine, dot};
use super::spline::Grid;

/// Share of the feed that counts as all of it.
const AT_FEED_R: f64 = 0.999;
/// What of the square of a turn within a period is missing of it. The speed between control points
/// is bounded; that of the spline is less by ⅛ of the square, and between samples by another 1/24.
const OF_TURN: f64 = 1.0 / 6.0;
/// Largest turn in which that counts, rad: the series ends with the square, whose share is 4 % there.
const MOST_TURN: f64 = 0.5;

/// Until which sample a motion is at the feed without a break.
pub(super) fn at_feed_until<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    samples: &Samples,
    (grid, period_t): (&Grid, f64),
) -> usize {
    let is_at_feed = |k: &usize| {
        let turn = turn_before(points, (*k, grid));
        way_t(path, points, samples, (*k, grid)) >= at_feed_r(turn) * period_t
    };
    (1..=samples.count()).take_while(is_at_feed).count()
}

/// Share of the feed that counts as all of it where the motion turns so much in a period, rad.
pub(crate) fn at_feed_r(turn: f64) -> f64 {
    let turn = turn.min(MOST_TURN);
    AT_FEED_R - OF_TURN * turn * turn
}

/// What the way in the period before sample `k` takes at the top speed, s. Progress says less: it
/// gains inside a curve, loses on the way back from there, and on chords comes by fits and starts.
pub(super) fn way_t<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    samples: &Samples,
    (k, grid): (usize, &Grid),
) -> f64 {
    let segment = &path.segments[samples.piece[k - 1]];
    let way = way_before(points, (k, grid));
    // Where it is not the feed that sets the top speed, but an axis, as in rapid moves.
    let along_t = dot(&way, &segment.tangent) / segment.top;
    segment.feed_t(&way).max(along_t)
}

/// The way in the period before sample `k`.
pub(super) fn way_before<const D: usize>(
    points: &[[f64; D]],
    (k, grid): (usize, &Grid),
) -> [f64; D] {
    let [before, y] = [k - 1, k].map(|k| sample(points, grid, k));
    core::array::from_fn(|a| y[a] - before[a])
}

/// How much a motion turns in the period before sample `k`, rad, from 0 to π.
pub(super) fn turn_before<const D: usize>(points: &[[f64; D]], (k, grid): (usize, &Grid)) -> f64 {
    let [before, after] = [k - 1, k].map(|k| {
        let (first, weights) = grid.velocity_site(k);
        combine(points, first, &weights)
    });
    let both = dot(&before, &before) * dot(&after, &after);
    // |a|·|b|·sin, which `atan2` takes with |a|·|b|·cos.
    let sin = (both - dot(&before, &after).powi(2)).max(0.0).sqrt();
    sin.atan2(dot(&before, &after))
}
