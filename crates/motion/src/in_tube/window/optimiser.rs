//! The optimisation of one window: convex problems in turn with the giving out of samples.
//!
//! ```text
//!   guess ──► assign samples ──► solve ──► project ──┐     until progress gains nothing more, or
//!                  ▲                                   │     the iterations are used up; the best
//!                  └───────────────────────────────────┘     motion that passes the judge is taken
//! ```
//!
//! A window ends at rest, so each that is accepted carries its own stop. Stops do not trap the next
//! window: samples are bound to time, not to places, and move on.
//!
//! Motion is optimised in time, not along a path: geometry and time law come out together, and limits are
//! linear in the control points. It is alternating minimisation. With every sample on a piece the problem
//! is a convex quadratic program ([`super::solver`]); with the motion given, samples go to pieces by a
//! projection ([`super::samples`]). There is no trust region: nothing is linearised but balls
//! ([`super::cutting_planes`]) and joints ([`super::joint_rows`]), and where a corner is passed and
//! what chords cut off is taken from the last motion. Where there are joints, rounds of polishing go no further than
//! the motion before, so that what is linear about it settles. What comes out is a local optimum
//! ([`super::search_bias`]), and nothing is believed of it that the judge has not seen.

mod convex_problem;
mod phases;

use super::budget::Budget;
use super::cutting_planes::CuttingPlanes;
use super::fixed_axes::FixedAxes;
use super::guess::Guess;
use super::rounds::BestMotion;
use super::samples::Samples;
use super::scaled_path::{ScaledPath, ScaledSegment};
use super::solver::{Interior, Problem};
use super::tube::Extents;
use super::window_start::WindowStart;
use glidepath_program::Corners;

/// Where samples are first thought to be in an attempt.
#[derive(Debug, Clone, Copy)]
enum Seed {
    /// Where the guess is at a pace, relative to what is expected.
    Guess(f64),
    /// At every vertex for a while.
    Stops,
}

/// The attempts, in turn, until one has found a motion. Fast first: a sample that is on a piece too
/// early comes back in one round, one that is late moves on by a tube length a round. Of the
/// paces no measurement is kept.
const ATTEMPTS: [Seed; 4] = [
    Seed::Guess(1.0),
    Seed::Guess(0.9),
    Seed::Guess(0.75),
    Seed::Stops,
];
/// What a motion must gain of what the tail does: the search weighs smoothness too, and keeps a little
/// below the feed, so that it may end a little before a tail that sees as far.
const NO_LESS_R: f64 = 0.995;
/// From so many axes on, the work of a window is spent after a few rounds if it has to keep to the inner
/// side: then the motion is first thought to be no faster than the guess, so that the first round finds one.
const MANY_AXES: usize = 7;
/// How much faster than the guess the first window is thought to be. Of this and the paces below no
/// measurement is kept, but of what a new one counts beside those before, half: with all seven of 35 programs were
/// up to .9 % faster or .3 % slower, with a quarter seven up to 1 % faster or .3 % slower.
const START_PACE: f64 = 1.2;
/// After a window without a motion the next one is slower by this, down to a least pace.
const SLOWER_R: f64 = 0.85;
const LEAST_PACE: f64 = 0.5;
/// How much faster than the last window has turned out to be the next one is thought to be (fast is
/// corrected sooner than slow), and between which paces.
const HOPEFUL_R: f64 = 1.05;
const PACES: [f64; 2] = [0.8, 2.5];

/// A motion that has passed.
#[derive(Debug, Clone)]
pub(crate) struct Solution<const D: usize> {
    pub(crate) points: Vec<[f64; D]>,
    /// It rests at the end of the path.
    pub(crate) is_end: bool,
}

/// What the judge is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum JudgeQuestion {
    /// Does it keep everything?
    IsValid,
    /// And does it rest at the end of the path?
    IsEnd,
}

/// The optimisation, with its memory.
#[derive(Debug, Clone)]
pub(crate) struct Optimiser<const D: usize> {
    pub(crate) interior: Interior<D>,
    /// Memory for the pieces of the next window, empty.
    pub(super) segments: Vec<ScaledSegment<D>>,
    problem: Problem<D>,
    pub(super) guess: Guess,
    pub(super) samples: Samples,
    pub(super) cutting_planes: CuttingPlanes<D>,
    fixed_axes: FixedAxes<D>,
    /// For rounds in which lines keep to the path, and for those in which they stray ([`phases`]).
    extents: [Extents; 2],
    /// How much faster than the guess the motion has turned out to be.
    pace: f64,
}

impl<const D: usize> Optimiser<D> {
    pub(crate) fn new(corners: Corners) -> Self {
        let is_dear = D >= MANY_AXES && corners == Corners::Inner;
        Self {
            interior: Interior::new(),
            segments: Vec::new(),
            problem: Problem::new(),
            guess: Guess::default(),
            samples: Samples::default(),
            cutting_planes: CuttingPlanes::new(),
            fixed_axes: FixedAxes::default(),
            extents: [Extents::default(), Extents::default()],
            pace: if is_dear { 1.0 } else { START_PACE },
        }
    }

    /// A better motion than the tail, if one is found.
    pub(crate) fn optimise(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        most_work: usize,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Option<Solution<D>> {
        let budget = Budget::new(D, path.joints().is_some());
        self.begin(path, window_start);
        let tail_progress = self.samples.progress.clone();
        let tail_mean = self.samples.mean_t(path);
        let (rest_at, stop_at) = window_start.tail_ends(path);
        let work = self.interior.work;
        self.interior.allow(budget.search(path.is_final, most_work));
        let mut found = BestMotion { best: None };
        for (attempt, seed) in ATTEMPTS.into_iter().enumerate() {
            self.samples.progress.clone_from(&tail_progress);
            self.samples.forget();
            self.cutting_planes
                .clear(self.samples.count(), path.segments.len());
            let progress = &mut self.samples.progress;
            match seed {
                Seed::Guess(share) => {
                    let from = (stop_at, share * self.pace * window_start.bias.hurry);
                    window_start.play_guess(path, &self.guess, progress, from);
                }
                Seed::Stops => window_start.play_stops(path, progress, rest_at),
            }
            self.iterate(path, window_start, attempt > 0, judge, &mut found);
            if found.best.is_some() || self.interior.is_spent() {
                break;
            }
        }
        let left_work = most_work.saturating_sub(self.interior.work - work);
        self.interior.allow(budget.finish(left_work));
        // A tail that is not to be driven on, because rates have changed, is no measure.
        let passed = found
            .best
            .filter(|(mean_t, ..)| !window_start.keeps_rates || *mean_t >= NO_LESS_R * tail_mean);
        let Some(best) = passed else {
            self.pace = (SLOWER_R * self.pace).max(LEAST_PACE);
            return self.finish(path, window_start, window_start.tail, &tail_progress, judge);
        };
        let (_, points, samples) = &best;
        let pace = window_start.pace(path, &self.guess, &samples.progress);
        let [least, most] = PACES;
        // Half and half with the one before, so that one window does not set it; what is clamped is the new one.
        self.pace = 0.5 * (self.pace + (HOPEFUL_R * pace).clamp(least, most));
        let finished = self.finish(path, window_start, points, &samples.progress, judge);
        if finished.is_some() {
            return finished;
        }
        let left_work = most_work.saturating_sub(self.interior.work - work);
        self.interior.allow(budget.smoothing(left_work));
        Some(Solution {
            points: self.smooth(path, window_start, best, judge),
            is_end: false,
        })
    }

    /// A new window, with samples where the tail is.
    pub(super) fn begin(&mut self, path: &ScaledPath<D>, window_start: &WindowStart<'_, D>) {
        self.guess.make(path, window_start.period_t);
        for extents in &mut self.extents {
            extents.clear(path.segments.len());
        }
        let intervals = window_start.tail.len() - 3;
        self.samples.reset(window_start.grid.periods_in(intervals));
        self.samples.progress[0] = window_start.progress;
        self.samples.project(
            path,
            window_start.tail,
            window_start.piece,
            &window_start.grid,
            false,
        );
        if !window_start.keeps_rates {
            self.samples.progress.fill(window_start.progress);
        }
    }
}
