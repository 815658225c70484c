//! Going on at the feed: one solve for smoothness where no time can be gained.
//!
//! Where the motion is at the feed, and the guess stays there until it has to brake for the end of
//! what is in view, a search has nothing to find. The problem of the second solve is solved at
//! once, with samples where the feed puts them. What comes out is taken if it passes and keeps the
//! feed as far; else the window is searched for like any other.
//!
//! Inside a curve the way is shorter, so the motion keeps inside it by what that progress is worth
//! against the pull to the path. Progress that is made early counts at every sample behind it: the
//! motion would come nearer to the path from the start of a window to its end, and jump back at the
//! next. So progress is counted only where the motion brakes, which is never handed out.

use super::budget;
use super::optimiser::{Optimiser, Question, Solution};
use super::rounds::RoundState;
use super::samples::Samples;
use super::scaled_path::ScaledPath;
use super::tube::Style;
use super::window_start::WindowStart;

/// Share of the feed that counts as all of it.
pub(crate) const AT_FEED_R: f64 = 0.999;

/// Weights of offset and jerk, relative to the usual ones: progress at the end has as much weight as
/// the mean progress of the window has elsewhere, which gains half as much from a way that is shorter.
pub(super) const WEIGHT: f64 = 2.0;

impl<const D: usize> Optimiser<D> {
    /// The motion that goes on at the feed, if that is all there is to do.
    pub(crate) fn go_on_at_feed(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Option<Solution<D>> {
        self.begin(path, window_start);
        let period_t = window_start.period_t;
        let at_feed =
            |samples: &Samples| at_feed_until(path, window_start.piece, samples, period_t);
        let slowing_at = at_feed(&self.samples);
        if slowing_at == 0 {
            return None;
        }
        let (_, stop_at) = window_start.tail_ends(path);
        let from = stop_at.min(slowing_at);
        let progress = &mut self.samples.progress;
        window_start.play_guess(path, &self.guess, progress, (from, 1.0));
        let wanted = at_feed(&self.samples);
        if wanted < 2 * window_start.commit {
            return None;
        }
        let braking_from = window_start.brake(path, &mut self.samples.progress);
        if wanted < braking_from {
            return None;
        }
        self.samples.forget();
        self.samples.give_out(path, window_start.piece);
        self.cuts.clear(self.samples.count(), path.segments.len());
        self.interior.allow(budget::at_feed(D));
        let style = Style {
            aims_beyond: braking_from,
            ..window_start.smooth_style(WEIGHT)
        };
        let along = window_start.points_along(path, &self.samples.progress);
        let round_state = RoundState::polishing(&along);
        let (_, points, samples) =
            self.smooth_with(path, window_start, &style, round_state, judge)?;
        let is_kept = at_feed(&samples) + window_start.commit >= wanted;
        let is_end = false;
        is_kept.then_some(Solution { points, is_end })
    }
}

/// Until which sample the motion is at the feed without a break.
pub(super) fn at_feed_until<const D: usize>(
    path: &ScaledPath<D>,
    first: usize,
    samples: &Samples,
    period_t: f64,
) -> usize {
    let mut piece = first;
    let steps = samples.progress.windows(2);
    let at_feed = steps.take_while(|step| {
        while path.segments[piece].s + path.segments[piece].length <= step[0]
            && piece + 1 < path.segments.len()
        {
            piece += 1;
        }
        step[1] - step[0] >= AT_FEED_R * path.segments[piece].top * period_t
    });
    at_feed.count()
}
