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

use super::cuts::Cuts;
use super::guess::Guess;
use super::opening::Opening;
use super::samples::Samples;
use super::scene::Scene;
use super::solver::{Goal, Interior, Problem};
use super::tube::{self, Extents, Layout, Style};

/// Rounds in which samples change pieces, and rounds in which they do not.
struct Phase {
    search: usize,
    polish: usize,
}
/// The rounds of one attempt.
const PHASES: [Phase; 3] = [
    Phase {
        search: 3,
        polish: 4,
    },
    Phase {
        search: 2,
        polish: 4,
    },
    Phase {
        search: 2,
        polish: 4,
    },
];
/// Lengths of the last window that are tried, and rounds for each.
const FINISHES: usize = 6;
const FINISH_ROUNDS: usize = 5;
/// Rows violated by more than this, in radii, are so for good.
const ENOUGH_VIOLATION: f64 = 0.02;
/// Interior point iterations in one problem.
const SOLVER_ITERATIONS: usize = 40;
/// Gain of progress, relative to that of the window, below which nothing more is tried.
const LITTLE_GAIN: f64 = 1e-4;
/// Lines may leave the path by this many radii while searching.
const SEARCH_STRAY_R: f64 = 12.0;
/// Interior point iterations after which a window is given up.
const MOST_WORK: usize = 600;

/// A motion that has passed.
#[derive(Debug, Clone)]
pub(super) struct Solution<const D: usize> {
    pub(super) points: Vec<[f64; D]>,
    /// It rests at the end of the path.
    pub(super) is_end: bool,
}

/// What the judge is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Question {
    /// Does it keep everything?
    IsValid,
    /// And does it rest at the end of the path?
    IsEnd,
}

/// The best motion so far.
#[derive(Debug)]
struct Found<const D: usize> {
    best: Option<(f64, Vec<[f64; D]>, Samples)>,
    /// Iterations of the solver up to which there is something left to spend.
    most_iterations: usize,
}

impl<const D: usize> Found<D> {
    fn add(&mut self, mean: f64, points: &[[f64; D]], samples: &Samples) {
        if self.best.as_ref().is_none_or(|(most, ..)| mean > *most) {
            self.best = Some((mean, points.to_vec(), samples.clone()));
        }
    }
}

/// The optimisation, with its memory.
#[derive(Debug)]
pub(super) struct Optimiser<const D: usize> {
    pub(super) interior: Interior<D>,
    problem: Problem<D>,
    guess: Guess,
    samples: Samples,
    cuts: Cuts<D>,
    extents: [Extents; 2],
    /// How much faster than the guess the motion has turned out to be.
    pace: f64,
}

impl<const D: usize> Optimiser<D> {
    pub(super) fn new() -> Self {
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
    pub(super) fn optimise(
        &mut self,
        scene: &Scene<D>,
        opening: &Opening<'_, D>,
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Option<Solution<D>> {
        self.guess.make(scene);
        for extents in &mut self.extents {
            extents.clear(scene.chords.len());
        }
        let intervals = opening.tail.len() - 3;
        self.samples.reset(opening.grid.periods_in(intervals));
        self.samples.progress[0] = opening.progress;
        self.samples.project(
            scene,
            opening.tail,
            opening.piece,
            (&opening.grid, opening.period_t),
            false,
        );
        let tail_progress = self.samples.progress.clone();
        let tail_mean = self.samples.mean();
        let (rest_at, stop_at) = opening.tail_ends(scene);
        let mut found = Found {
            best: None,
            most_iterations: self.interior.iterations + MOST_WORK,
        };
        for attempt in 0..3 {
            self.samples.progress.clone_from(&tail_progress);
            self.samples.forget();
            self.cuts.clear(self.samples.count(), scene.chords.len());
            let progress = &mut self.samples.progress;
            let pace = self.pace * if attempt == 0 { 1.0 } else { 0.8 };
            match attempt {
                0 | 1 => opening.play_guess(scene, &self.guess, progress, (stop_at, pace)),
                _ => opening.play_stops(scene, progress, rest_at),
            }
            self.iterate(scene, opening, attempt > 0, judge, &mut found);
            if found.best.is_some() || self.interior.iterations > found.most_iterations {
                break;
            }
        }
        let passed = found
            .best
            .filter(|(mean, ..)| rest_at == 0 || *mean >= tail_mean);
        let Some((_, points, samples)) = passed else {
            self.pace = (0.85 * self.pace).max(0.5);
            return self.finish(scene, opening, opening.tail, &tail_progress, judge);
        };
        let pace = opening.pace(scene, &self.guess, &samples.progress);
        self.pace = 0.5 * (self.pace + (1.05 * pace).clamp(0.8, 2.5));
        let finished = self.finish(scene, opening, &points, &samples.progress, judge);
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
        scene: &Scene<D>,
        opening: &Opening<'_, D>,
        is_careful: bool,
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
        found: &mut Found<D>,
    ) {
        let mut points = opening.tail.to_vec();
        let mut has_motion = false;
        let mut last_mean = f64::NEG_INFINITY;
        let rounds = PHASES
            .iter()
            .flat_map(|phase| (0..phase.search + phase.polish).map(move |round| (phase, round)));
        let mut is_polished = false;
        for (phase, round) in rounds {
            if self.interior.iterations > found.most_iterations {
                return;
            }
            let is_polish = round >= phase.search;
            if is_polish && is_polished {
                continue;
            }
            let is_wide = !is_polish && !is_careful;
            let style = Style {
                stray_r: if is_wide { SEARCH_STRAY_R } else { 1.0 },
                ..opening.style(has_motion)
            };
            if round <= phase.search {
                self.samples.give_out(scene, opening.piece);
            }
            let mut next = points.clone();
            let is_solved = self.solve(scene, &style, &mut next, false, is_polish);
            if is_solved {
                self.cuts.learn(scene, &self.samples, &next, &opening.grid);
            }
            let given = self.samples.progress.clone();
            let grid = (&opening.grid, opening.period_t);
            let may_lead = round + 1 < phase.search;
            self.samples
                .project(scene, &next, opening.piece, grid, may_lead);
            let mean = self.samples.mean();
            let passes = is_solved && judge(&next, Question::IsValid);
            if passes {
                found.add(mean, &next, &self.samples);
            }
            if is_solved || self.samples.worst_r < 3.0 {
                points = next;
                has_motion = true;
            }
            let gain = (mean - last_mean) / (mean - opening.progress).max(f64::MIN_POSITIVE);
            if passes && gain.abs() < LITTLE_GAIN {
                return;
            }
            last_mean = mean;
            is_polished = is_polish && passes;
            if !is_polish && self.samples.worst_r > 1.02 && round >= 2 {
                self.samples.go_half_way(&given);
            }
        }
    }

    fn solve(
        &mut self,
        scene: &Scene<D>,
        style: &Style,
        points: &mut [[f64; D]],
        is_end_fixed: bool,
        is_exact: bool,
    ) -> bool {
        let h = style.grid.knot_t;
        self.problem.clear(points.len() - 3, is_end_fixed);
        let keep = 1.0 - 2e-6;
        self.problem.bounds = [
            scene.velocity_bounds().map(|v| v * h * keep),
            scene.acceleration.map(|a| a * h * h * keep),
            scene.jerk.map(|j| j * h * h * h * keep),
        ];
        let extents = &mut self.extents[usize::from(style.stray_r > 1.0)];
        let layout = Layout {
            scene,
            samples: &self.samples,
            cuts: &self.cuts,
            points,
            style,
        };
        tube::build(&mut self.problem, &layout, extents);
        let top = scene
            .chords
            .iter()
            .map(|chord| chord.top)
            .fold(0.0, f64::max);
        let goal = Goal {
            mu: if is_exact { 1e-5 } else { 1e-4 },
            iterations: SOLVER_ITERATIONS,
            damping: 1e-7 / (top * h).powi(2),
        };
        self.interior.solve(&self.problem, points, goal)
    }

    /// If the motion comes to rest at the end of the path: the shortest one that rests exactly there.
    fn finish(
        &mut self,
        scene: &Scene<D>,
        opening: &Opening<'_, D>,
        points: &[[f64; D]],
        progress: &[f64],
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Option<Solution<D>> {
        let last = scene.chords.last().filter(|_| scene.is_final)?;
        let total = scene.length();
        let near = 0.02 * last.radius + 1e-9 * total;
        let arrival = progress.iter().position(|&s| s >= total - near)?;
        let intervals = points.len() - 3;
        let end = scene.vertex(scene.chords.len() - 1);
        let multiple = opening.grid.knots;
        let arrival = arrival * opening.grid.knots / opening.grid.periods;
        let first = arrival.max(6).div_ceil(multiple) * multiple;
        let style = opening.style(true);
        for count in (first..=intervals).step_by(multiple).take(FINISHES) {
            let mut next = points[..count + 3].to_vec();
            next[count..].fill(end);
            self.samples.progress.clear();
            self.samples.progress.extend_from_slice(progress);
            self.samples.cut(opening.grid.periods_in(count));
            self.samples.give_out(scene, opening.piece);
            for _ in 0..FINISH_ROUNDS {
                let is_solved = self.solve(scene, &style, &mut next, true, true);
                if !is_solved || self.interior.violation() > ENOUGH_VIOLATION {
                    break;
                }
                if judge(&next, Question::IsEnd) {
                    return Some(Solution {
                        points: next,
                        is_end: true,
                    });
                }
                self.cuts.learn(scene, &self.samples, &next, &opening.grid);
            }
        }
        None
    }
}
