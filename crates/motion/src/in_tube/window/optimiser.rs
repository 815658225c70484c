//! The optimisation of one window: convex problems in turn with the giving out of samples.
//!
//! ```text
//!   guess ──► give out samples ──► solve ──► project ──┐     until progress gains nothing more, or
//!                  ▲                                   │     the iterations are used up; the best
//!                  └───────────────────────────────────┘     motion that passes the judge is taken
//! ```
//!
//! A window ends at rest, so each that is accepted carries its own stop. Stops do not trap the next
//! window: samples are bound to time, not to places, and move on.

use super::budget;
use super::cuts::Cuts;
use super::guess::Guess;
use super::rounds::{BestMotion, RoundState, hurried};
use super::samples::Samples;
use super::scaled_path::ScaledPath;
use super::solver::{Goal, Interior, Problem};
use super::tube;
use super::tube::{Extents, FEED_R, Layout, Style};
use super::window_start::WindowStart;

/// Rounds in which samples change pieces, and rounds in which they do not; what of the radius is
/// used in them, and how strong the pull to the middle is.
struct Phase {
    search: usize,
    polish: usize,
    keep_r: f64,
    ridge: f64,
}
/// The rounds of one attempt: what comes and goes at the edge of the tube is given more and more
/// room.
const PHASES: [Phase; 3] = [
    Phase {
        search: 3,
        polish: 3,
        keep_r: 0.995,
        ridge: 1e-5,
    },
    Phase {
        search: 2,
        polish: 3,
        keep_r: 0.97,
        ridge: 1e-4,
    },
    Phase {
        search: 2,
        polish: 3,
        keep_r: 0.92,
        ridge: 1e-3,
    },
];
/// Paces of the attempts, relative to what is expected; after them comes one that stops at every
/// vertex.
const PACES: [f64; 3] = [1.0, 0.9, 0.75];
/// Lengths of the last window that are tried, and rounds for each.
const FINISHES: usize = 16;
const FINISH_ROUNDS: usize = 5;
/// Pull towards the middle where the middle is all that is aimed at.
const CENTRED_RIDGE: f64 = 1e-2;
/// Rows violated by more than this, in radii, are so for good.
const ENOUGH_VIOLATION: f64 = 0.02;
/// Interior point iterations in one problem.
const SOLVER_ITERATIONS: usize = 40;
/// Lines may leave the path by this many radii while searching.
const SEARCH_STRAY_R: f64 = 12.0;

/// A motion that has passed.
#[derive(Debug, Clone)]
pub(crate) struct Solution<const D: usize> {
    pub(crate) points: Vec<[f64; D]>,
    /// It rests at the end of the path.
    pub(crate) is_end: bool,
}

/// What the judge is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Question {
    /// Does it keep everything?
    IsValid,
    /// And does it rest at the end of the path?
    IsEnd,
}

/// The optimisation, with its memory.
#[derive(Debug, Clone)]
pub(crate) struct Optimiser<const D: usize> {
    pub(crate) interior: Interior<D>,
    problem: Problem<D>,
    guess: Guess,
    samples: Samples,
    cuts: Cuts<D>,
    extents: [Extents; 2],
    /// How much faster than the guess the motion has turned out to be.
    pace: f64,
}

impl<const D: usize> Optimiser<D> {
    pub(crate) fn new() -> Self {
        Self {
            interior: Interior::new(),
            problem: Problem::new(),
            guess: Guess::default(),
            samples: Samples::default(),
            cuts: Cuts::new(),
            extents: [Extents::default(), Extents::default()],
            pace: 1.2,
        }
    }

    /// A better motion than the tail, if one is found.
    pub(crate) fn optimise(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Option<Solution<D>> {
        self.guess.make(path);
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
            (&window_start.grid, window_start.period_t),
            false,
        );
        if !window_start.keeps_rates {
            self.samples.progress.fill(window_start.progress);
        }
        let tail_progress = self.samples.progress.clone();
        let tail_mean = self.samples.mean();
        let (rest_at, stop_at) = window_start.tail_ends(path);
        let work = self.interior.work;
        let allowance = budget::search(D, path.is_final, window_start.most_work);
        self.interior.allow(allowance);
        let mut found = BestMotion { best: None };
        for attempt in 0..=PACES.len() {
            self.samples.progress.clone_from(&tail_progress);
            self.samples.forget();
            self.cuts.clear(self.samples.count(), path.segments.len());
            let progress = &mut self.samples.progress;
            match PACES.get(attempt) {
                Some(share) => {
                    let from = (stop_at, share * self.pace);
                    window_start.play_guess(path, &self.guess, progress, from);
                }
                None => window_start.play_stops(path, progress, rest_at),
            }
            self.iterate(path, window_start, attempt > 0, judge, &mut found);
            if found.best.is_some() || self.interior.is_spent() {
                break;
            }
        }
        let left_work = window_start.most_work - (self.interior.work - work);
        self.interior.allow(budget::finish(D, left_work));
        let passed = found
            .best
            .filter(|(mean, ..)| rest_at == 0 || *mean >= tail_mean);
        let Some((_, points, samples)) = passed else {
            self.pace = (0.85 * self.pace).max(0.5);
            return self.finish(path, window_start, window_start.tail, &tail_progress, judge);
        };
        let pace = window_start.pace(path, &self.guess, &samples.progress);
        self.pace = 0.5 * (self.pace + (1.05 * pace).clamp(0.8, 2.5));
        let finished = self.finish(path, window_start, &points, &samples.progress, judge);
        if finished.is_some() {
            return finished;
        }
        Some(Solution {
            points,
            is_end: false,
        })
    }

    /// One attempt: rounds of giving out, solving and projecting, in which `found` gets the best
    /// motion that passes. In the later rounds of a phase the samples stay where they are.
    fn iterate(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        is_careful: bool,
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
        found: &mut BestMotion<D>,
    ) {
        let mut round_state = RoundState {
            points: window_start.tail.to_vec(),
            has_motion: false,
            is_exceeding: false,
            mean: f64::NEG_INFINITY,
            speed_r: 0.0,
            feed_r: FEED_R,
        };
        for (number, phase) in PHASES.iter().enumerate() {
            for round in 0..phase.search + phase.polish {
                if self.interior.is_spent() {
                    return;
                }
                if round <= phase.search {
                    self.samples.give_out(path, window_start.piece);
                }
                let is_polish = round >= phase.search;
                let is_wide = !is_polish && !is_careful;
                let style = Style {
                    stray_r: if is_wide { SEARCH_STRAY_R } else { 1.0 },
                    is_feed_firm: is_polish || round_state.is_exceeding,
                    keep_r: phase.keep_r,
                    ridge: if is_polish && number > 0 {
                        round_state.firm_ridge(phase.ridge)
                    } else {
                        phase.ridge
                    },
                    feed_r: if is_polish {
                        round_state.feed_r
                    } else {
                        FEED_R
                    },
                    ..window_start.style(round_state.has_motion)
                };
                let given = self.samples.progress.clone();
                let may_lead = round + 1 < phase.search;
                let is_solved =
                    self.take_round(path, window_start, &style, may_lead, &mut round_state);
                if is_polish && is_solved {
                    round_state.learn_feed(style.feed_r);
                }
                let passes = is_solved && judge(&round_state.points, Question::IsValid);
                if passes {
                    found.add(self.samples.mean(), &round_state.points, &self.samples);
                }
                if passes && round_state.has_settled(self.samples.mean(), window_start.progress) {
                    return;
                }
                round_state.mean = self.samples.mean();
                if is_polish && round_state.is_exceeding && number > 0 && found.best.is_none() {
                    // Samples are on pieces that the motion cannot reach in time.
                    return;
                }
                if is_polish && (passes || round_state.is_exceeding) {
                    break;
                }
                if !is_polish && self.samples.worst_r > 1.02 && round >= 2 {
                    self.samples.go_half_way(&given);
                }
            }
        }
    }

    /// Solves and projects. True if there is a solution.
    fn take_round(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        style: &Style,
        may_lead: bool,
        round_state: &mut RoundState<D>,
    ) -> bool {
        let mut next = round_state.points.clone();
        let is_exact = style.stray_r <= 1.0;
        let is_solved = self.solve(path, style, &mut next, false, is_exact);
        if is_solved {
            round_state.speed_r = self
                .cuts
                .learn(path, &self.samples, &next, &window_start.grid);
        }
        round_state.is_exceeding = self.interior.violation() > ENOUGH_VIOLATION;
        let grid = (&window_start.grid, window_start.period_t);
        self.samples
            .project(path, &next, window_start.piece, grid, may_lead);
        if is_solved || self.samples.worst_r < 3.0 {
            round_state.points = next;
            round_state.has_motion = true;
        }
        is_solved
    }

    fn solve(
        &mut self,
        path: &ScaledPath<D>,
        style: &Style,
        points: &mut [[f64; D]],
        is_end_fixed: bool,
        is_exact: bool,
    ) -> bool {
        let h = style.grid.knot_t;
        self.problem.clear(points.len() - 3, is_end_fixed);
        let keep = 1.0 - 2e-6;
        self.problem.bounds = [
            path.velocity_bounds().map(|v| v * h * keep),
            path.acceleration.map(|a| a * h * h * keep),
            path.jerk.map(|j| j * h * h * h * keep),
        ];
        let extents = &mut self.extents[usize::from(style.stray_r > 1.0)];
        let layout = Layout {
            path,
            samples: &self.samples,
            cuts: &self.cuts,
            points,
            style,
        };
        tube::build(&mut self.problem, &layout, extents);
        let top = path
            .segments
            .iter()
            .map(|segment| segment.top)
            .fold(0.0, f64::max);
        let goal = Goal {
            mu: if is_exact { 1e-5 } else { 1e-4 },
            iterations: SOLVER_ITERATIONS,
            damping: 1e-7 / (top * h).powi(2),
        };
        self.interior.solve(&self.problem, points, goal)
    }

    /// If the motion comes to rest at the end of the path: the shortest one that rests exactly
    /// there.
    fn finish(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        points: &[[f64; D]],
        progress: &[f64],
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Option<Solution<D>> {
        let last = path.segments.last().filter(|_| path.is_final)?;
        let total = path.length();
        let near = 0.02 * last.radius + 1e-9 * total;
        let arrival = progress.iter().position(|&s| s >= total - near)?;
        let intervals = points.len() - 3;
        let end = path.vertex(path.segments.len() - 1);
        let multiple = window_start.grid.knots;
        let arrival = arrival * window_start.grid.knots / window_start.grid.periods;
        let first = arrival.max(6).div_ceil(multiple) * multiple;
        let style = Style {
            is_centred: true,
            ridge: CENTRED_RIDGE,
            ..window_start.style(true)
        };
        let mut shortest: Option<Vec<[f64; D]>> = None;
        let mut progress = progress.to_vec();
        let mut count = first;
        for _ in 0..FINISHES {
            if count < 6 || count > intervals || self.interior.is_spent() {
                break;
            }
            self.samples.progress.clone_from(&progress);
            self.samples.cut(window_start.grid.periods_in(count));
            self.samples.give_out(path, window_start.piece);
            let mut next = match &shortest {
                Some(longer) => hurried(longer, multiple, |a: &[f64; D], b, share| {
                    core::array::from_fn(|k| a[k] + share * (b[k] - a[k]))
                }),
                None => points[..count + 3].to_vec(),
            };
            next[..3].copy_from_slice(&points[..3]);
            next[count..].fill(end);
            let passes = self.finish_in(path, window_start, &style, &mut next, judge);
            if passes {
                // Then all of it a little faster.
                let grid = (&window_start.grid, window_start.period_t);
                self.samples
                    .project(path, &next, window_start.piece, grid, false);
                let fewer = window_start.grid.periods_in(multiple);
                progress = hurried(&self.samples.progress, fewer, |a, b, share| {
                    a + share * (b - a)
                });
                shortest = Some(next);
                count -= multiple;
            } else if shortest.is_some() {
                break;
            } else {
                count += multiple;
            }
        }
        shortest.map(|points| Solution {
            points,
            is_end: true,
        })
    }

    /// Makes a motion pass that rests at the end of the path after so many control points.
    fn finish_in(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        style: &Style,
        points: &mut [[f64; D]],
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> bool {
        for _ in 0..FINISH_ROUNDS {
            let is_solved = self.solve(path, style, points, true, true);
            if !is_solved || self.interior.violation() > ENOUGH_VIOLATION {
                return false;
            }
            if judge(points, Question::IsEnd) {
                return true;
            }
            self.cuts
                .learn(path, &self.samples, points, &window_start.grid);
        }
        false
    }
}
