//! The second solve: of all motions about as fast, the smoothest, and of those the truest.
//!
//! Where the feed binds, many motions take the same time, and the search stops at any of them. So
//! the best one is solved for again, with what jerk costs and what being off the path costs made
//! dear enough to be felt, and cheap enough that time comes first:
//!
//! ```text
//!   maximise  mean progress  −  ½·pull·Σ |offset across / radius|²  −  ½·jerk·Σ |jerk / limit|²
//! ```
//!
//! Progress stays in the objective: to hold it fast would forbid an arc to be driven at its radius,
//! because the inner one is shorter. What that gains is taken out of it ([`super::shortcuts`]). What is
//! accepted has passed the judge and has lost hardly any progress beside; else the weights are made
//! smaller, and in the end the motion of the search stays.
//!
//! Where a window begins at the feed, progress counts from where it slows down on, as it does in windows
//! that go on at the feed ([`super::at_feed`]), and jerk is dear up to there ([`super::tube::JERK_AT_FEED`]).
//!
//! Samples stay with the pieces that the search gave them to, but for those that were reached by a
//! shorter way. A motion may have been found in a round in which it had no need to reach its pieces;
//! then samples are given to those that it is on, and whatever rows it stands out of there, what comes
//! out is the judge's to refuse.

use super::at_feed::WEIGHT;
use super::damping;
use super::optimiser::{JudgeQuestion, Optimiser};
use super::rounds::RoundState;
use super::samples::{Samples, mean};
use super::scaled_path::ScaledPath;
use super::search_bias::SearchBias;
use super::shortcuts;
use super::tube::{STEERING, Style};
use super::way::at_feed_until;
use super::window_start::WindowStart;

/// Twice what an offset of the whole radius costs at one sample, and what jerk at its limit does, in periods
/// of mean progress ([`Style::attraction`]): about three times what a usual search has ([`SearchBias::USUAL`]). At the feed an arc of
/// 8 mm was 1.7 µm too small with the latter, 1 µm with these, before way counted there
/// ([`super::shortcuts`]).
const PULL: f64 = 0.1;
const JERK: f64 = 0.03;
/// The weights that are tried, relative to these, until no more progress is lost than may be. No measurement
/// of the steps is kept.
const WEIGHTS: [f64; 3] = [1.0, 0.1, 0.01];
/// Rounds for each: on curves the planes that bound the feed are learnt in them.
const ROUNDS: usize = 3;
/// Share of its progress that a window may lose: a period in 1.3 s at 4 ms. What is smooth is gained where
/// the feed binds, and there nothing is lost; where limits bind, more smoothness costs more time.
const MOST_LOSS: f64 = 0.003;
/// The same for another look at a short stretch, which is for time alone.
const MOST_LOSS_AGAIN: f64 = 0.001;
/// What a shorter way inside a curve gains about a corner at its end, where nothing is taken for a curve, as
/// a share of what it gains before. A corner is entered a little sooner from the inside, too.
const GAINED_AT_CORNERS_R: f64 = 0.25;
/// Change of progress, relative to that of the window, below which rounds change nothing.
const SETTLED: f64 = 1e-5;
/// Share of the progress that later rounds may bring back at most: one that has lost more than may be
/// lost by that much is the last with its weights.
const BROUGHT_BACK: f64 = 5e-4;
/// What of the radius is used: less than in the first phase of a search, for a motion that is smooth is
/// worth nothing if the judge refuses it for the edge of the tube.
const KEEP_R: f64 = 0.99;

/// A motion with its mean progress, and where its samples are.
pub(super) type Found<const D: usize> = (f64, Vec<[f64; D]>, Samples);

impl<const D: usize> WindowStart<'_, D> {
    /// False for another look at a short stretch, which is for time alone.
    fn is_first_look(&self) -> bool {
        self.bias == SearchBias::USUAL
    }

    /// How rows are made for a second solve, with so much of the weights. Where the pull to the path is
    /// weak, a dear way across would keep the motion off it.
    pub(super) fn smooth_style(&self, weight: f64) -> Style {
        Style {
            keep_r: KEEP_R,
            attraction: weight * PULL,
            jerk: weight * JERK,
            steering: weight.min(1.0) * STEERING,
            counts_way: true,
            is_damped: self.is_first_look(),
            ..self.style(true)
        }
    }
}

impl<const D: usize> Optimiser<D> {
    /// The motion that is to be used instead of the best one of the search, or that one itself.
    pub(super) fn smooth(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        (mean_t, points, samples): Found<D>,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Vec<[f64; D]> {
        let corner_margin = damping::margin(path, &window_start.smooth_style(1.0));
        let gained_t = |points: &[[f64; D]], samples: &Samples| {
            let grid = (&window_start.grid, window_start.period_t, corner_margin);
            shortcuts::gained_t(path, points, samples, grid)
        };
        let (aims_beyond, scale) = aim(path, window_start, &points, &samples);
        let gained_by_best_t = gained_t(&points, &samples);
        let mut samples = samples;
        let most_loss = if window_start.is_first_look() {
            MOST_LOSS
        } else {
            MOST_LOSS_AGAIN
        };
        let gained_mean_t = mean(gained_by_best_t.iter().copied());
        let at_corners_t = GAINED_AT_CORNERS_R * gained_mean_t.max(0.0);
        let least = (1.0 - most_loss) * mean_t - gained_mean_t - at_corners_t;
        // Pieces that are reached by a shorter way would hold the motion there.
        shortcuts::take_back(path, &mut samples, &gained_by_best_t);
        let mut is_assigned = false;
        let mut weights = WEIGHTS.into_iter().peekable();
        while let Some(weight) = weights.peek() {
            self.samples.clone_from(&samples);
            let style = Style {
                aims_beyond,
                at_feed: aims_beyond,
                ..window_start.smooth_style(scale * *weight)
            };
            let mut round_state = RoundState::polishing(&points);
            round_state.least_t = (1.0 - BROUGHT_BACK) * least;
            if is_assigned {
                round_state.most_violation = f64::INFINITY;
            }
            match self.smooth_with(path, window_start, &style, round_state, judge) {
                Some((mean_t, points, samples))
                    if mean_t - mean(gained_t(&points, &samples).into_iter()) >= least =>
                {
                    return points;
                }
                None if !is_assigned => {
                    samples.assign(path, window_start.piece);
                    is_assigned = true;
                }
                _ => {
                    weights.next();
                }
            }
            if self.interior.is_spent() {
                break;
            }
        }
        points
    }

    /// The last motion that passes of some rounds with a style; one that passes and is too slow ends
    /// them.
    pub(super) fn smooth_with(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        style: &Style,
        mut round_state: RoundState<D>,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Option<Found<D>> {
        let mut passed: Option<Found<D>> = None;
        for _ in 0..ROUNDS {
            if self.interior.is_spent() {
                break;
            }
            let style = Style {
                feed_r: round_state.feed_r,
                has_motion: round_state.has_motion,
                ..*style
            };
            let is_solved = self.take_round(path, window_start, &style, false, &mut round_state);
            if !is_solved || self.interior.violation() > round_state.most_violation {
                break;
            }
            round_state.learn_feed(style.feed_r);
            let mean_t = self.samples.mean_t(path);
            let change = mean_t - round_state.mean_t;
            round_state.mean_t = mean_t;
            if judge(&round_state.points, JudgeQuestion::IsValid) {
                passed = Some((mean_t, round_state.points.clone(), self.samples.clone()));
                if change.abs() < SETTLED * mean_t || mean_t < round_state.least_t {
                    break;
                }
            }
        }
        passed
    }
}

/// From which sample on progress counts, and how much stronger the weights are for that.
fn aim<const D: usize>(
    path: &ScaledPath<D>,
    window_start: &WindowStart<'_, D>,
    points: &[[f64; D]],
    samples: &Samples,
) -> (usize, f64) {
    let grid = (&window_start.grid, window_start.period_t);
    let slowing_at = at_feed_until(path, points, samples, grid);
    if slowing_at >= window_start.commit {
        (slowing_at, WEIGHT)
    } else {
        (0, 1.0)
    }
}
