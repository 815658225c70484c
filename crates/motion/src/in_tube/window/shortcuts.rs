//! Progress that is owed to a shorter way, inside a curve.
//!
//! ```text
//!   ╭───────────╮   programmed: progress is counted along it
//!  ╱ ╭─────────╮ ╲
//! │ ╱           ╲ │  inside: less way for the same progress
//! ```
//!
//! At the feed every motion covers the same way in the same time. One that keeps a whole tolerance
//! inside an arc makes more progress by it, and the arc is too small by all of that. So where a motion
//! is made smooth, way is what counts on curves that are driven at the feed, in what is aimed at as in
//! what may be lost. Of corners it is progress: what time is gained by rounding them is what the
//! tolerance is for.
//!
//! The way up to sample m is Σ τ_j·(y_j − y_{j−1}) up to it, where τ_j is the heading of the program in
//! the period before sample j. The sum of it over all samples, with weights a_m of which A_j are left
//! from sample j on, is Σ A_j τ_j·(y_j − y_{j−1}). What y_k has a part in is
//!
//! ```text
//!     (A_k τ_k − A_{k+1} τ_{k+1})·y_k  =  (a_k τ_k  +  A_{k+1} (τ_k − τ_{k+1}))·y_k
//!                                          progress     outwards, by how the program turns
//! ```

use super::damping::{is_near_corner, margin};
use super::samples::Samples;
use super::scaled_path::ScaledPath;
use super::solver::Problem;
use super::spline::Grid;
use super::tube::Layout;
use super::way::{at_feed_r, turn_before, way_before, way_t};

/// Share of what counts as the feed from which on it is what binds: rounds may plan with as little as
/// 0.995 of it.
const NEAR_FEED_R: f64 = 0.99;

/// Adds to the objective what makes way of progress.
pub(super) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>) {
    let (path, samples, style) = (layout.path, layout.samples, layout.style);
    let corner_margin = margin(path, style);
    let mut left = 0.0;
    // The gradient by y_k, from the end on: `left` is A_{k+1}. The first part, a_k·τ_k, is the aim of the
    // tube's rows already; only what the program turns by is added.
    for k in (1..samples.count()).rev() {
        left += layout.aim(k + 1);
        let grid = (&style.grid, style.period_t, corner_margin);
        if way_on_curve_t(path, layout.points, samples, k, grid).is_none() {
            continue;
        }
        let [before, after] = [k, k + 1].map(|k| heading_before(path, samples, k));
        let outwards = core::array::from_fn(|a| before[a] - after[a]);
        problem.add_aim(style.grid.site(k), left, &outwards);
    }
}

/// The heading of the program in the middle of the period before sample `k`.
fn heading_before<const D: usize>(path: &ScaledPath<D>, samples: &Samples, k: usize) -> [f64; D] {
    let middle = 0.5 * (samples.progress[k - 1] + samples.progress[k]);
    let pieces = samples.piece[k - 1]..samples.piece[k];
    let mut passed = pieces.skip_while(|i| path.segments[i + 1].s <= middle);
    path.heading(passed.next().unwrap_or(samples.piece[k]), middle)
}

/// What the way in the period before sample `k` takes at the feed, if that is driven there, on a curve.
fn way_on_curve_t<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    samples: &Samples,
    k: usize,
    (grid, period_t, margin): (&Grid, f64, usize),
) -> Option<f64> {
    let segment = &path.segments[samples.piece[k - 1]];
    let way_t = if segment.is_all_counted() {
        way_t(path, points, samples, (k, grid))
    } else if segment.is_feed_bound() {
        segment.feed_t(&way_before(points, (k, grid)))
    } else {
        return None;
    };
    let near_r = NEAR_FEED_R * at_feed_r(turn_before(points, (k, grid)));
    let is_at_feed = way_t >= near_r * period_t;
    (is_at_feed && !is_near_corner(path, samples, k, margin)).then_some(way_t)
}

/// By how much progress along curves at the feed has been more than way, at each sample, in the time
/// that it takes at the top speeds. The grid comes with the periods about a corner in which nothing is
/// taken for a curve.
pub(super) fn gained_t<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    samples: &Samples,
    grid: (&Grid, f64, usize),
) -> Vec<f64> {
    let reached_t = samples.times(path);
    let mut gained_t = 0.0;
    let mut all = vec![0.0];
    for k in 1..=samples.count() {
        if let Some(way_t) = way_on_curve_t(path, points, samples, k, grid) {
            gained_t += reached_t[k] - reached_t[k - 1] - way_t;
        }
        all.push(gained_t);
    }
    all
}

/// Takes back from the progress of samples what was gained, and gives those that are before their
/// pieces then to the pieces before.
pub(super) fn take_back<const D: usize>(
    path: &ScaledPath<D>,
    samples: &mut Samples,
    gained_t: &[f64],
) {
    for k in 1..=samples.count() {
        let mut piece = samples.piece[k];
        let back = gained_t[k] * path.segments[piece].top;
        let progress = (samples.progress[k] - back).max(samples.progress[k - 1]);
        while back > 0.0 && piece > samples.piece[k - 1] && progress < path.segments[piece].s {
            piece -= 1;
        }
        samples.piece[k] = piece;
        samples.progress[k] = progress;
    }
}
