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

use super::budget::Budget;
use super::cutting_planes::CuttingPlanes;
use super::damping;
use super::feed_rows;
use super::fixed_axes::FixedAxes;
use super::guess::Guess;
use super::joint_rows;
use super::rounds::{BestMotion, ENOUGH_VIOLATION, RoundState, gains};
use super::samples::Samples;
use super::scaled_path::{ScaledPath, ScaledSegment};
use super::shortcuts;
use super::solver::{Goal, Interior, Problem};
use super::travel_rows;
use super::tube;
use super::tube::{Extents, FEED_R, Layout, SEARCH_STEERING, STEERING, Style};
use super::window_start::WindowStart;
use glidepath_program::Corners;

/// Rounds in which samples change pieces, and rounds in which they do not; what of the radius is
/// used in them.
struct Phase {
    search: usize,
    polish: usize,
    keep_r: f64,
}
/// The rounds of one attempt: what comes and goes at the edge of the tube is given more and more
/// room. A phase ends with the first round of polishing that passes or exceeds rows for good; the attempt once
/// progress settles, or where from the second phase on rows are exceeded and nothing has passed. (If the first
/// phase ended it, too, five of 35 programs would be .1 to 2 % faster and one .1 % slower; if none did, three .3 to
/// .8 % slower.)
/// the fastest motion that has passed is kept, so the smaller radii of later phases cost no time of it.
/// Of the numbers no measurement is kept.
const PHASES: [Phase; 3] = [
    Phase {
        search: 3,
        polish: 3,
        keep_r: 0.995,
    },
    Phase {
        search: 2,
        polish: 3,
        keep_r: 0.97,
    },
    Phase {
        search: 2,
        polish: 3,
        keep_r: 0.92,
    },
];

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
/// Interior point iterations in one problem, of which it usually takes 6 to 20. One that takes more counts
/// as not solved ([`FAR_OFF_R`]).
const SOLVER_ITERATIONS: usize = 40;
/// Mean complementarity, in periods of progress, at which a problem is solved: in rounds in which lines
/// may leave the path, and in others. With 1e-7 the motion wanders less within the tube where the feed
/// binds, but has as much jerk: what is wanted there is said by prices ([`Style::jerk`]), not by μ.
const SEARCH_MU: f64 = 1e-4;
const EXACT_MU: f64 = 1e-5;
/// [`Goal::damping`] times the square of the way in a knot at the top speed. No measurement
/// of it is kept.
const DAMPING: f64 = 1e-7;
/// Share of every limit that is planned with: the residual of a solution may be half of the rest.
const LIMIT_R: f64 = 1.0 - 2e-6;
/// Lines may leave the path by this many radii while searching: large, so that a sample that is on a
/// piece too early or too late does not bind the motion before it is given out again. Careful attempts
/// and rounds of polishing have 1 in its place. No measurement of it is kept.
const SEARCH_STRAY_R: f64 = 12.0;
/// A motion of no solution whose samples are further off than this, in radii, is not gone on from. No
/// measurement of it is kept.
const FAR_OFF_R: f64 = 3.0;
/// Where samples come out further off than this while searching, in radii, they are given out half-way
/// back, from the third round on: else some problems go there and back between too early and too late.
const TOO_FAR_R: f64 = 1.02;
/// Rounds of a search that may go there and back ([`TOO_FAR_R`]).
const FREE_ROUNDS: usize = 2;

/// Rounds of polishing more where joints are not the axes.
const MORE_POLISH: usize = 3;

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
    /// For rounds in which lines keep to the path, and for those in which they stray ([`SEARCH_STRAY_R`]).
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

    /// One attempt: rounds of giving out, solving and projecting, in which `found` gets the best
    /// motion that passes. In the later rounds of a phase the samples stay where they are.
    fn iterate(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        is_careful: bool,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
        found: &mut BestMotion<D>,
    ) {
        let mut round_state = RoundState::starting(window_start.tail);
        let has_joints = path.joints().is_some();
        let more = if has_joints { MORE_POLISH } else { 0 };
        for (number, phase) in PHASES.iter().enumerate() {
            let best_before = found.best.as_ref().map(|best| best.0);
            for round in 0..phase.search + phase.polish + more {
                if self.interior.is_spent() {
                    return;
                }
                // The first round of polishing still takes what the last search has shown.
                if round <= phase.search {
                    self.samples.assign(path, window_start.piece);
                }
                let is_polish = round >= phase.search;
                let is_wide = !is_polish && !is_careful;
                let usual = window_start.style(round_state.has_motion);
                let style = Style {
                    stray_r: if is_wide { SEARCH_STRAY_R } else { 1.0 },
                    steering: if is_wide { SEARCH_STEERING } else { STEERING },
                    is_feed_firm: is_polish || round_state.is_exceeding,
                    keep_r: phase.keep_r,
                    feed_r: if is_polish {
                        round_state.feed_r
                    } else {
                        FEED_R
                    },
                    attraction: if is_polish && number > 0 {
                        round_state.firm_pull(usual.attraction)
                    } else {
                        usual.attraction
                    },
                    keeps_progress: is_polish && has_joints,
                    ..usual
                };
                let given = self.samples.progress.clone();
                let may_lead = round + 1 < phase.search;
                let is_solved =
                    self.take_round(path, window_start, &style, may_lead, &mut round_state);
                if is_polish && is_solved {
                    round_state.learn_feed(style.feed_r);
                }
                let mean_t = self.samples.mean_t(path);
                let passes = is_solved && judge(&round_state.points, JudgeQuestion::IsValid);
                if passes {
                    found.add(mean_t, &round_state.points, &self.samples);
                }
                let has_settled = if style.keeps_progress {
                    // Against the phase before: within this one it does not go on.
                    best_before.is_some_and(|best_t| !gains(best_t, mean_t))
                } else {
                    round_state.has_settled(mean_t)
                };
                if passes && has_settled {
                    return;
                }
                round_state.mean_t = mean_t;
                if is_polish && round_state.is_exceeding && number > 0 && found.best.is_none() {
                    // Samples are on pieces that the motion cannot reach in time.
                    return;
                }
                if is_polish && (passes || round_state.is_exceeding) {
                    break;
                }
                if !is_polish && self.samples.worst_r > TOO_FAR_R && round >= FREE_ROUNDS {
                    self.samples.go_half_way(&given);
                }
            }
        }
    }

    /// Solves and projects. True if there is a solution.
    pub(super) fn take_round(
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
            round_state.speed_r =
                self.cutting_planes
                    .learn(path, &self.samples, &next, &window_start.grid);
        }
        round_state.is_exceeding = self.interior.violation() > ENOUGH_VIOLATION;
        let grid = &window_start.grid;
        self.samples
            .project(path, &next, window_start.piece, grid, may_lead);
        // What is not solved may still be a better start than the last one, if it is near the path.
        if is_solved || self.samples.worst_r < FAR_OFF_R {
            round_state.points = next;
            round_state.has_motion = true;
        }
        is_solved
    }

    /// Solves the convex problem of a style. True if there is a solution.
    pub(super) fn solve(
        &mut self,
        path: &ScaledPath<D>,
        style: &Style,
        points: &mut [[f64; D]],
        is_end_fixed: bool,
        is_exact: bool,
    ) -> bool {
        let h = style.grid.knot_t;
        self.problem.clear(points.len() - 3, is_end_fixed);
        // Limits of differences of control points, in tolerances: a knot is the unit of time.
        self.problem.bounds = [
            path.velocity_bounds().map(|v| v * h * LIMIT_R),
            path.acceleration.map(|a| a * h * h * LIMIT_R),
            path.jerk.map(|j| j * h * h * h * LIMIT_R),
        ];
        // |Δ³x / unit|² is one at the jerk that is priced.
        let unit = style.priced_jerk(path).map(|j| j * h * h * h);
        self.problem.jerk = unit.map(|unit| style.jerk / (unit * unit));
        let margin = style.settling_periods(path);
        self.fixed_axes
            .set(path, &self.samples, points, &style.grid, margin);
        self.problem
            .fixed_axes
            .clone_from(&self.fixed_axes.of_points);
        let extents = &mut self.extents[usize::from(style.stray_r > 1.0)];
        let layout = Layout {
            path,
            samples: &self.samples,
            cutting_planes: &self.cutting_planes,
            points,
            style,
        };
        tube::build(&mut self.problem, &layout, extents);
        feed_rows::add(&mut self.problem, &layout);
        travel_rows::add(&mut self.problem, &layout);
        if path.joints().is_some() {
            joint_rows::add(&mut self.problem, &layout);
        }
        if style.is_damped {
            damping::add(&mut self.problem, &layout);
        }
        if style.counts_way {
            shortcuts::add(&mut self.problem, &layout);
        }
        let top = path
            .segments
            .iter()
            .map(|segment| segment.top)
            .fold(0.0, f64::max);
        let goal = Goal {
            mu: if is_exact { EXACT_MU } else { SEARCH_MU },
            iterations: SOLVER_ITERATIONS,
            damping: DAMPING / (top * h).powi(2),
        };
        self.interior.solve(&self.problem, points, goal)
    }
}
