//! The window that goes on at the feed: one solve for smoothness where no time can be gained.
//!
//! Where the motion is at the feed, and the guess stays there until it has to brake for the end of
//! what is in view, a search has nothing to find. The problem of the second solve is solved at
//! once, with samples where the feed puts them. What comes out is taken if it passes and keeps the
//! feed as far; else the window is searched for like any other.
//!
//! Progress is counted at one sample alone, the last before the motion brakes. If it counted at samples
//! before, the start of a window would be shaped otherwise than its end, and the next one begins with
//! that. Later samples are held by their pieces, where the guess brakes: progress that gains nothing
//! more does not ask for the feed. What a shorter way inside a curve gains is not counted at all
//! ([`super::shortcuts`]).

use super::budget::Budget;
use super::optimiser::{JudgeQuestion, Optimiser, Solution};
use super::rounds::RoundState;
use super::scaled_path::ScaledPath;
use super::tube::Style;
use super::way::{at_feed_r, at_feed_until};
use super::window_start::WindowStart;

/// Weights of offset and jerk, relative to the usual ones: progress at the end has as much weight as
/// the mean progress of the window has elsewhere, to which the way in it adds half as much.
pub(super) const WEIGHT: f64 = 2.0;

impl<const D: usize> Optimiser<D> {
    /// The motion that goes on at the feed, if that is all there is to do.
    pub(crate) fn go_on_at_feed(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Option<Solution<D>> {
        self.begin(path, window_start);
        let period_t = window_start.period_t;
        let grid = (&window_start.grid, period_t);
        let tail = window_start.tail;
        self.samples.assign(path, window_start.piece);
        let slowing_at = at_feed_until(path, tail, &self.samples, grid);
        if slowing_at == 0 {
            return None;
        }
        let (_, stop_at) = window_start.tail_ends(path);
        let from = stop_at.min(slowing_at);
        let progress = &mut self.samples.progress;
        window_start.play_guess(path, &self.guess, progress, (from, 1.0));
        let from = (window_start.piece, from);
        let wanted = progress_at_feed_until(path, from, progress, period_t);
        // The guess leaves the feed soon, so there is time to be gained: a search is for that.
        if wanted < 2 * window_start.commit {
            return None;
        }
        let braking_from = window_start.brake(path, &mut self.samples.progress);
        if wanted < braking_from {
            return None;
        }
        self.samples.forget();
        self.samples.assign(path, window_start.piece);
        self.cutting_planes
            .clear(self.samples.count(), path.segments.len());
        let budget = Budget::new(D, path.joints().is_some());
        self.interior.allow(budget.at_feed());
        let style = Style {
            aims_beyond: braking_from.saturating_sub(1),
            aims_until: braking_from,
            at_feed: braking_from,
            ..window_start.smooth_style(WEIGHT)
        };
        let along = window_start.points_along(path, &self.samples.progress);
        let round_state = RoundState::polishing(&along);
        let (_, points, samples) =
            self.smooth_with(path, window_start, &style, round_state, judge)?;
        let kept = at_feed_until(path, &points, &samples, grid);
        let is_kept = kept + window_start.commit >= wanted;
        let is_end = false;
        is_kept.then_some(Solution { points, is_end })
    }
}

/// Until which sample progress from some sample on is that of the feed without a break.
fn progress_at_feed_until<const D: usize>(
    path: &ScaledPath<D>,
    (mut piece, from): (usize, usize),
    progress: &[f64],
    period_t: f64,
) -> usize {
    let steps = progress[from..].windows(2);
    let at_feed = steps.take_while(|step| {
        while path.segments[piece].s + path.segments[piece].length <= step[0]
            && piece + 1 < path.segments.len()
        {
            piece += 1;
        }
        step[1] - step[0] >= at_feed_r(0.0) * path.segments[piece].top * period_t
    });
    from + at_feed.count()
}
