//! The holding back of samples: one stays on a piece before a slower one until the motion is as slow.
//!
//! ```text
//!     rapid ───────▶───●────●──●┐      Near a corner a sample is in the tubes of both pieces. Given
//!                              ●│      to the slower one it brings that one's feed with it, for the
//!                          plunge ●    velocities before it, too. If the motion is not yet so slow,
//!                               │●     whatever costs less than the feed is given up: it cuts the
//!                               ▼      corners before, its samples come out further on, and the
//!                                      next round asks for more still.
//! ```
//!
//! On the faster piece the sample asks for nothing that the motion cannot do, and moves on as soon
//! as the motion has slowed down.

use super::sample_place::SamplePlace;
use super::scaled_path::ScaledPath;
use super::speed::{differences_of, velocity_over_feed};
use super::spline::Grid;

/// Speed over the feed from which a motion is too fast: solutions may be a little above it. At 1 samples
/// would wait for what planes of the feed leave, some parts in ten thousand, and come and go by it.
const TOO_FAST_R: f64 = 1.05;
/// How far from the faster piece a sample may be, in radii, to stay on it: one that is further away
/// has gone on, if too fast.
const MOST_R: f64 = 2.0;

/// True if the feed falls after piece `i`, and the motion at sample `k` is too fast for what
/// follows.
pub(crate) fn is_too_fast<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    (i, k): (usize, usize),
    grid: &Grid,
) -> bool {
    path.feed_falls_after(i)
        && differences_of(grid, k)
            .filter(|m| m + 1 < points.len())
            .any(|m| {
                let feed_axes = &path.segments[i + 1].feed_axes;
                velocity_over_feed(points, feed_axes, m, grid).0 > TOO_FAST_R
            })
}

/// Where sample `k`, at `y`, is taken to be, which was at most at `from` and is nearest to `to`.
pub(crate) fn hold_back<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    (k, y): (usize, &[f64; D]),
    (from, to): (SamplePlace, SamplePlace),
    grid: &Grid,
) -> SamplePlace {
    let held = (from.piece..to.piece)
        .find(|&i| is_too_fast(path, points, (i, k), grid))
        .map(|i| SamplePlace::on(path, i, from.s, y));
    held.filter(|held| held.distance < MOST_R * path.segments[held.piece].radius)
        .unwrap_or(to)
}
