//! The rows of a window that keep the feed, and what keeps a slow motion on its way.
//!
//! The feed bounds a ball of velocities. Planes touch it along the path, and where earlier solutions
//! were beyond it. That does where the feed is large: in the time that jerk takes to get across the
//! tube, the motion goes far along it, and velocities point along the path with little between.
//! Where the feed is slow the whole ball is in reach within the tube, a solution finds its way out
//! between the planes in another direction each time, and no motion passes. There velocity across
//! the path has a price:
//!
//! ```text
//!                     feed large                          feed slow
//!     tube    ───────────────────────────        ─────────────────────────
//!               ●─────────▶ ●─────────▶             ●▶ ▲
//!             ───────────────────────────            ──┴●▶────────────────
//! ```

use super::cutting_planes::{
    WORTH_OF_FEED, piece_at, pieces_at, progress_at, sample_at, slowest_feed,
};
use super::sense_rows;
use super::solver::{FAR, Problem};
use super::speed::velocity_over_feed;
use super::tube::Layout;
use crate::in_tube::path::SHARP;

/// How many radii the feed goes along the path while jerk strays by one, where it is no longer slow. From
/// there down the price of velocity across the path rises from 0; a larger number gives it to motions
/// that planes alone hold, and takes time from them at corners.
const NOT_SLOW: f64 = 3.0;

/// Share of the feed from which on the last motion gets a plane in its own direction: far inside the ball
/// no plane binds, and the direction of what hardly moves says nothing of the next motion's.
const TOLD_R: f64 = 0.2;

/// Feed, and no running back, for every first difference that is not given.
pub(crate) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>) {
    let Layout {
        path,
        samples,
        points,
        style,
        cutting_planes,
    } = layout;
    let (grid, h) = (&style.grid, style.grid.knot_t);
    let stray_t = style.stray_t(path);
    for k in 2..problem.intervals {
        let middle = piece_at(samples, grid, 2 * k - 1);
        // Where velocity turns within an interval to either side, nearer than the difference has a part in
        // (`pieces_at`). Why nearer is not on record.
        let bends_here = (piece_at(samples, grid, 2 * k - 3)
            ..piece_at(samples, grid, 2 * k + 1 + grid.knots))
            .any(|i| path.turn(i, i + 1) > SHARP);
        let scale = path.segments[middle].feed_axes;
        let slowest = slowest_feed(path, pieces_at(samples, grid, k));
        // A difference has a part in periods of several pieces: it is bound by the slowest of them.
        let factor = (0..D)
            .filter(|&a| scale[a] > 0.0)
            .fold(1.0_f64, |most, a| most.max(slowest[a] / scale[a]));
        problem.add_site(k, [-1.0, 1.0, 0.0, 0.0]);
        steer(problem, layout, (k, middle), stray_t);
        let normal = path.segments[middle].feed.map(|f| f * factor / h);
        // Without the lower side a motion that is to be late would back off first, to pass its corner
        // faster. At a corner it may: there going back is part of the turn.
        let low = if bends_here { -FAR } else { 0.0 };
        problem.add_feed_row(normal, [low, style.feed_r], style.is_feed_firm);
        // The feed bounds a ball of velocities: a plane touches it where the last motion was, and
        // more where earlier ones were beyond it.
        let (size, direction) = velocity_over_feed(points, &slowest, k, grid);
        let last = Some(direction).filter(|_| size > TOLD_R && size <= WORTH_OF_FEED);
        for direction in last.iter().chain(cutting_planes.of_feed(k)) {
            let normal = core::array::from_fn(|a| direction[a] * slowest[a] / h);
            problem.add_feed_row(normal, [-FAR, style.feed_r], style.is_feed_firm);
        }
        sense_rows::add(problem, layout, k);
    }
}

/// The price of velocity across the path for first difference `k`, the last site, where the feed is
/// slow. Samples are given to a piece a little before its start: the path there is the one before. Of a chord it is the
/// curve that it stands for: along the chords themselves a slow circle became a polygon, with a jerk of twenty
/// times its own.
fn steer<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    (k, middle): (usize, usize),
    stray_t: f64,
) {
    let Layout {
        path,
        samples,
        style,
        ..
    } = layout;
    let grid = &style.grid;
    let pieces = path.segments[pieces_at(samples, grid, k)].iter();
    let top = pieces.map(|piece| piece.top).fold(f64::INFINITY, f64::min);
    let slowness = 1.0 - (top * stray_t / (NOT_SLOW * path.segments[middle].radius)).powi(2);
    if slowness <= 0.0 {
        return;
    }
    let progress = samples.progress[sample_at(samples, grid, 2 * k - 1)];
    let here = path.segments[..=middle]
        .iter()
        .rposition(|piece| piece.s <= progress);
    if let (Some(site), Some(here)) = (problem.sites.last_mut(), here) {
        // An attraction on Δx, whose center is 0: ½·attraction·|velocity across|², of the way at the feed.
        site.attraction = style.steering * slowness / (top * grid.knot_t).powi(2);
        site.tangent = path.unit_heading(here, progress_at(samples, grid, 2 * k - 1));
    }
}
