//! The end of a window that sees the end of its path: the shortest motion that rests exactly there.

use super::budget::Budget;
use super::damping;
use super::optimiser::{JudgeQuestion, Optimiser, Solution};
use super::rounds::ENOUGH_VIOLATION;
use super::scaled_path::ScaledPath;
use super::shortcuts;
use super::spline::Grid;
use super::tube::Style;
use super::way::at_feed_until;
use super::window_start::WindowStart;

/// Lengths of the last window that are tried, and rounds for each. Steps that double over the 160
/// intervals of the longest window are seven, and as many halve again. Work may end it before.
const FINISHES: usize = 16;
const FINISH_ROUNDS: usize = 5;
/// No motion rests at the end after so few intervals: a problem has six at least, of whose points three
/// are given and three are the rest.
const LEAST_INTERVALS: usize = 5;
/// How near the end a motion is as good as there: in radii of the last piece, and in lengths of the path
/// for what rounding leaves. No measurement of it is kept.
const ARRIVED_R: f64 = 0.02;
const ROUNDING_R: f64 = 1e-9;
/// What is gained inside curves at the feed and not given back, in periods: to be on a grid asks for some of it.
const LEFT_R: f64 = 0.02;
/// Pull towards the path where nothing else is aimed at: with time fixed, it is all of the objective but
/// for the price of velocity across slow pieces.
const CENTRED_PULL: f64 = 1e-2;

/// A motion that rests at the end of the path.
struct Finish<const D: usize> {
    points: Vec<[f64; D]>,
    progress: Vec<f64>,
}

/// Which lengths are tried, in intervals: longer ones until a motion is found, then shorter by more and
/// more until one is missed, then half way between. What was missed from a motion far longer may be
/// found from the shortest one after all: that is tried at last.
struct Lengths {
    count: usize,
    hurry: Hurry,
    multiple: usize,
    shortest: Option<usize>,
    /// What is missed, or too short to be tried.
    too_few: usize,
    /// The shortest motion when something was missed last.
    missed_from: usize,
    step: usize,
}

impl Lengths {
    fn new(first: usize, multiple: usize) -> Self {
        Self {
            count: first,
            hurry: Hurry::AtTheEnd,
            multiple,
            shortest: None,
            too_few: least_of(multiple),
            missed_from: 0,
            step: multiple,
        }
    }

    /// There is a motion of the length at hand.
    fn found(&mut self) {
        self.shortest = Some(self.count);
        self.go_on_from(self.count);
    }

    /// There is none, or it was not found.
    fn missed(&mut self) {
        if let Some(shortest) = self.shortest {
            (self.too_few, self.missed_from) = (self.count, shortest);
            self.go_on_from(shortest);
        } else {
            self.count += self.multiple;
        }
    }

    fn go_on_from(&mut self, shortest: usize) {
        let least = least_of(self.multiple);
        // Nothing is left between what was missed and the shortest motion. What was missed was tried from a
        // longer one than that: all below is tried again from this one, hurried everywhere.
        if shortest - self.too_few <= self.multiple && shortest < self.missed_from {
            (self.too_few, self.missed_from) = (least, 0);
            (self.step, self.hurry) = (self.multiple, Hurry::Everywhere);
        }
        let half = (shortest - self.too_few) / 2 / self.multiple * self.multiple;
        // Half way once something was missed, or where a longer step would go beyond that; until then steps double.
        self.count = if self.too_few > least || self.step > half {
            self.too_few + half
        } else {
            shortest - self.step
        };
        self.step *= 2;
    }
}

/// The most intervals, of whole periods, after which no motion rests.
const fn least_of(multiple: usize) -> usize {
    LEAST_INTERVALS / multiple * multiple
}

/// Where a motion is made shorter.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Hurry {
    /// It does not wait where it has as good as arrived, and from where it is fastest on all of it is a
    /// little faster.
    AtTheEnd,
    /// All of it is a little faster.
    Everywhere,
}

impl<const D: usize> Finish<D> {
    /// A guess of the motion with fewer intervals.
    fn shortened(
        &self,
        path: &ScaledPath<D>,
        count: usize,
        grid: &Grid,
        hurry: Hurry,
    ) -> (Vec<[f64; D]>, Vec<f64>) {
        let intervals = self.points.len() - 3;
        let total = path.length();
        let radius = path.segments.last().map_or(0.0, |last| last.radius);
        let is_there = |s: &f64| *s >= total - radius;
        let arrival = self.progress.iter().position(is_there);
        let arrival = arrival.map_or(intervals, |period| period * grid.knots / grid.periods);
        let left = match hurry {
            Hurry::AtTheEnd => grid.whole_periods(arrival.max(count).min(intervals)),
            Hurry::Everywhere => intervals,
        };
        // Of the motion the part from `from` to `left` is made shorter; what comes after that only waits.
        let step = |k: &usize| self.progress[k + 1] - self.progress[*k];
        let periods = grid.periods_in(left);
        let fastest =
            (periods / 2..periods.saturating_sub(1)).max_by(|a, b| step(a).total_cmp(&step(b)));
        let from = match hurry {
            Hurry::AtTheEnd => fastest.unwrap_or(0).min(grid.periods_in(count) / 2),
            Hurry::Everywhere => 0,
        };
        let fewer = left - count;
        let between = |a: &[f64; D], b: &[f64; D], share| {
            core::array::from_fn(|k| a[k] + share * (b[k] - a[k]))
        };
        let from_point = from * grid.knots / grid.periods;
        let (start, end) = self.points[..left + 3].split_at(from_point);
        let mut points = start.to_vec();
        points.extend(hurried(end, fewer, between));
        let (start, end) = self.progress[..=periods].split_at(from);
        let mut progress = start.to_vec();
        progress.extend(hurried(end, grid.periods_in(fewer), |a, b, share| {
            a + share * (b - a)
        }));
        (points, progress)
    }
}

impl<const D: usize> Optimiser<D> {
    /// If the motion comes to rest at the end of the path: the shortest one that rests exactly
    /// there.
    pub(super) fn finish(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        points: &[[f64; D]],
        progress: &[f64],
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Option<Solution<D>> {
        let last = path.segments.last().filter(|_| path.is_final)?;
        let total = path.length();
        let near = ARRIVED_R * last.radius + ROUNDING_R * total;
        let arrival = progress.iter().position(|&s| s >= total - near)?;
        let intervals = points.len() - 3;
        let end = path.vertex(path.segments.len() - 1);
        let multiple = window_start.grid.knots;
        let arrival = arrival * window_start.grid.knots / window_start.grid.periods;
        let first = arrival.max(LEAST_INTERVALS + 1).div_ceil(multiple) * multiple;
        let style = Style {
            is_centred: true,
            attraction: CENTRED_PULL,
            jerk: 0.0,
            ..window_start.style(true)
        };
        let grid = &window_start.grid;
        let mut shortest: Option<Finish<D>> = None;
        let mut lengths = Lengths::new(first, multiple);
        for _ in 0..FINISHES {
            let count = lengths.count;
            if count <= lengths.too_few || count > intervals || self.interior.is_spent() {
                break;
            }
            let (mut next, progress) = match &shortest {
                Some(longer) => longer.shortened(path, count, grid, lengths.hurry),
                None => (points[..count + 3].to_vec(), progress.to_vec()),
            };
            self.samples.progress = progress;
            self.samples.cut(grid.periods_in(count));
            self.samples.assign(path, window_start.piece);
            // The state it starts from, and rest exactly at the end: neither is sought.
            next[..3].copy_from_slice(&points[..3]);
            next[count..].fill(end);
            if self.finish_in(path, window_start, &style, &mut next, judge) {
                self.samples
                    .project(path, &next, window_start.piece, grid, false);
                shortest = Some(Finish {
                    points: next,
                    progress: self.samples.progress.clone(),
                });
                lengths.found();
            } else {
                lengths.missed();
            }
        }
        let points = shortest?.points;
        let points = self.smooth_finish(path, window_start, points, judge);
        let points = self.give_back(path, window_start, points, intervals, judge);
        Some(Solution {
            points,
            is_end: true,
        })
    }

    /// The same in the same time, but as smooth as it can be, if that passes.
    fn smooth_finish(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        points: Vec<[f64; D]>,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Vec<[f64; D]> {
        if self.interior.is_spent() {
            return points;
        }
        let count = window_start.grid.periods_in(points.len() - 3);
        self.samples.cut(count);
        self.samples
            .project(path, &points, window_start.piece, &window_start.grid, false);
        self.samples.assign(path, window_start.piece);
        let by_period = (&window_start.grid, window_start.period_t);
        let smooth = Style {
            is_centred: true,
            at_feed: at_feed_until(path, &points, &self.samples, by_period),
            ..window_start.smooth_style(1.0)
        };
        let usual = Style {
            is_centred: true,
            ..window_start.style(true)
        };
        for style in [smooth, usual] {
            let mut next = points.clone();
            if self.finish_in(path, window_start, &style, &mut next, judge) {
                return next;
            }
        }
        points
    }

    /// The same in as much more time as it has gained inside curves that are driven at the feed, if that passes: the
    /// shortest motion of all cuts them, to rest a period sooner.
    fn give_back(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        points: Vec<[f64; D]>,
        most_intervals: usize,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> Vec<[f64; D]> {
        let grid = &window_start.grid;
        let intervals = points.len() - 3;
        self.samples.cut(grid.periods_in(intervals));
        self.samples
            .project(path, &points, window_start.piece, grid, false);
        self.samples.assign(path, window_start.piece);
        let by_period = (grid, window_start.period_t);
        let style = Style {
            is_centred: true,
            at_feed: at_feed_until(path, &points, &self.samples, by_period),
            ..window_start.smooth_style(1.0)
        };
        let margin = damping::margin(path, &style);
        let by_grid = (grid, window_start.period_t, margin);
        let gained_t = shortcuts::gained_t(path, &points, &self.samples, by_grid);
        let gained_t = gained_t.last().copied().unwrap_or(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a time within the window"
        )]
        let owed = (gained_t / window_start.period_t - LEFT_R).ceil().max(0.0) as usize;
        let more = owed.div_ceil(grid.periods) * grid.knots;
        // The search for the shortest may have had all that was wanted for the end.
        let budget = Budget::new(D, path.joints().is_some());
        self.interior.want(budget.smoothing(0).wanted);
        if more == 0 || intervals + more > most_intervals || self.interior.is_spent() {
            return points;
        }
        let count = intervals + more;
        let between = |a: &[f64; D], b: &[f64; D], share| {
            core::array::from_fn(|k| a[k] + share * (b[k] - a[k]))
        };
        let mut next = in_steps(&points, count + 2, between);
        let progress = in_steps(
            &self.samples.progress,
            grid.periods_in(count),
            |a, b, share| a + share * (b - a),
        );
        self.samples.progress = progress;
        self.samples.cut(grid.periods_in(count));
        self.samples.assign(path, window_start.piece);
        next[..3].copy_from_slice(&points[..3]);
        next[count..].fill(points[intervals]);
        if self.finish_in(path, window_start, &style, &mut next, judge) {
            next
        } else {
            points
        }
    }

    /// Makes a motion pass that rests at the end of the path after so many control points.
    fn finish_in(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        style: &Style,
        points: &mut [[f64; D]],
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
    ) -> bool {
        for _ in 0..FINISH_ROUNDS {
            // With the end given, a row that stays violated says that the time is too short.
            let is_solved = self.solve(path, style, points, true, true);
            if !is_solved || self.interior.violation() > ENOUGH_VIOLATION {
                return false;
            }
            if judge(points, JudgeQuestion::IsEnd) {
                return true;
            }
            self.cutting_planes
                .learn(path, &self.samples, points, &window_start.grid);
        }
        false
    }
}

/// The same way in fewer steps.
fn hurried<T>(values: &[T], fewer: usize, between: impl Fn(&T, &T, f64) -> T) -> Vec<T> {
    let less = (values.len() - 1).saturating_sub(fewer).max(1);
    in_steps(values, less, between)
}

/// The same way in so many steps.
fn in_steps<T>(values: &[T], steps: usize, between: impl Fn(&T, &T, f64) -> T) -> Vec<T> {
    let count = values.len() - 1;
    (0..=steps)
        .map(|k| {
            let at = k * count;
            let (before, rest) = (at / steps, at % steps);
            let after = (before + 1).min(count);
            #[expect(clippy::cast_precision_loss, reason = "hundreds")]
            let share = rest as f64 / steps as f64;
            between(&values[before], &values[after], share)
        })
        .collect()
}
