//! One window: how much of the path it sees, which axes move, and what becomes of it.

use super::one_sided::StartOffset;
use super::optimiser::{JudgeQuestion, Optimiser};
use super::scaled_path::{ScaledPath, moving_axes};
use super::search_bias::SearchBias;
use super::spline::Grid;
use super::tube::settling_periods;
use super::window_start::WindowStart;
use crate::in_tube::path::{ReferencePath, directional};
use crate::in_tube::period::State;
use crate::in_tube::verify::{Follower, History};
use crate::joints::SharedJoints;
use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::{Corners, Limits};

/// Parts of a period at which joints keep their limits, too: at a rate a little below 1 setpoints come to be
/// there. The mechanism bends between periods: a hexapod had 4 % more jerk there than at them.
const BETWEEN_R: [f64; 2] = [1.0 / 3.0, 2.0 / 3.0];

/// Most pieces a window looks at: a bound of memory and work where blocks are tiny. A window that sees no
/// further rests at the end of them.
const MOST_PIECES: usize = 4096;
/// Intervals of a window, at least and at most. Work and memory are linear in them; with fewer a window
/// sees its own stop too soon, with more each costs longer before anything of it is handed out. With 60, of
/// which 20 were handed out, motions of a first version were within .2 to 2.7 % of the optimum from rest to
/// rest; with 30 handed out they took up to 1.8 % longer. Of the most no measurement is kept.
pub(crate) const LEAST_INTERVALS: usize = 60;
const MOST_INTERVALS: usize = 160;
/// The same where the motion goes on at the feed: most of them are then handed out.
pub(crate) const FEED_INTERVALS: usize = MOST_INTERVALS;
/// Jerk from state to state counts as kept up to this factor. It is looked at beside the third differences of
/// positions ([`History`]), because these can keep the limit though third differences of control points do not,
/// which no row bounds where all of them are given. Why 1e-4 is not on record: with 1e-3, and with 1e-10, none of 35
/// programs changed.
const JERK_SLACK: f64 = 1.0 + 1e-4;
/// What rounding makes of a position, mm.
const ROUNDING_MM: f64 = 1e-11;
/// Length of a window in times to stop from the top speed: one is the stop itself, the rest is what is
/// optimised with it out of sight. No measurement of it is kept.
const STOPS: f64 = 2.4;

/// The pieces a window sees, and its length in knot intervals.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct View {
    pub(crate) pieces: core::ops::Range<usize>,
    pub(crate) intervals: usize,
    /// The motion is to rest at the end of the last piece, whatever follows.
    pub(crate) is_halt: bool,
}

impl View {
    /// What a window needs that starts on piece `index` at parameter `u`, with everything from
    /// piece `first` on in sight; `None` if that is not known yet.
    pub(crate) fn new(
        limits: &Limits,
        reference_path: &ReferencePath,
        grid: &Grid,
        first: usize,
        (index, u): (usize, f64),
        least_intervals: usize,
    ) -> Option<Self> {
        let mut needed = least_intervals;
        let mut known_t = 0.0;
        let mut end = index;
        while reference_path.is_settled(end) {
            let piece = reference_path.get(end)?;
            let along = (piece.end - piece.start) / piece.length_s;
            let bounds = piece.within_joints(directional(limits, &along), 1.0);
            let top_v = piece.top_v.min(bounds.speed_v);
            // Of an S-curve down to rest with a phase of constant acceleration.
            let stop_t = top_v / bounds.path.accel_a + bounds.path.accel_a / bounds.path.jerk_j;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "clamped"
            )]
            let wanted = (STOPS * stop_t / grid.knot_t)
                .ceil()
                .min(MOST_INTERVALS as f64) as usize;
            needed = needed.max(wanted);
            // The motion is nowhere faster, so in its time a window gets no further than at these speeds.
            let share = if end == index { 1.0 - u } else { 1.0 };
            known_t += share * piece.length_s / top_v;
            end += 1;
            let is_enough = known_t >= needed as f64 * grid.knot_t || end - first >= MOST_PIECES;
            if is_enough || reference_path.is_last(end - 1) {
                return Some(Self {
                    pieces: first..end,
                    intervals: grid.whole_periods(needed + grid.knots - 1),
                    is_halt: false,
                });
            }
        }
        None
    }
}

/// A motion as control points from the present knot on.
#[derive(Debug, Clone)]
pub(crate) struct WindowMotion {
    pub(crate) points: Vec<AxisVector>,
    /// Rests at the end of the last piece in view.
    pub(crate) is_rest: bool,
    /// True if that rest is at the end of the path.
    pub(crate) is_end: bool,
}

/// Everything a window starts from.
#[derive(Debug)]
pub(crate) struct WindowContext<'a> {
    pub(crate) limits: &'a Limits,
    pub(crate) period_t: f64,
    pub(crate) joints: &'a SharedJoints,
    pub(crate) corners: Corners,
    pub(crate) grid: &'a Grid,
    pub(crate) reference_path: &'a ReferencePath,
    pub(crate) history: &'a History,
    pub(crate) follower: &'a Follower,
    pub(crate) progress: (usize, f64),
    /// Pieces from here on are out of view.
    pub(crate) end: usize,
    /// Periods after which the next window will start.
    pub(crate) commit: usize,
    /// What goes on without a window keeps the rates, which may have changed.
    pub(crate) keeps_rates: bool,
    pub(crate) search: WindowSearch,
    pub(crate) bias: SearchBias,
}

/// What is looked for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum WindowSearch {
    /// The fastest motion, for so many multiplications of the solver at most.
    Whole(usize),
    /// One that goes on at the feed, if nothing else binds.
    AtFeed,
}

/// Optimisers by number of axes, made when first needed.
#[derive(Debug, Clone, Default)]
pub(crate) struct Optimisers {
    two: Option<Box<Optimiser<2>>>,
    three: Option<Box<Optimiser<3>>>,
    four: Option<Box<Optimiser<4>>>,
    five: Option<Box<Optimiser<5>>>,
    six: Option<Box<Optimiser<6>>>,
    nine: Option<Box<Optimiser<9>>>,
}

impl Optimisers {
    /// Multiplications of the solvers so far.
    pub(crate) fn work(&self) -> usize {
        fn of<const D: usize>(optimiser: Option<&Optimiser<D>>) -> usize {
            optimiser.map_or(0, |optimiser| optimiser.interior.work)
        }
        of(self.two.as_deref())
            + of(self.three.as_deref())
            + of(self.four.as_deref())
            + of(self.five.as_deref())
            + of(self.six.as_deref())
            + of(self.nine.as_deref())
    }

    /// A better motion than `tail`, which starts at the present state and ends at rest.
    pub(crate) fn attempt(
        &mut self,
        context: &WindowContext<'_>,
        view: &View,
        tail: &[AxisVector],
    ) -> Option<WindowMotion> {
        let origin = context.history.last();
        let corners = view
            .pieces
            .clone()
            .filter_map(|index| context.reference_path.get(index))
            .flat_map(|piece| [&piece.start, &piece.end]);
        let moves = moving_axes(&origin, corners.chain(tail));
        let way = (context, view, tail, moves);
        match moves.iter().filter(|&&is_moving| is_moving).count() {
            0..=2 => attempt(&mut self.two, way),
            3 => attempt(&mut self.three, way),
            4 => attempt(&mut self.four, way),
            5 => attempt(&mut self.five, way),
            6 => attempt(&mut self.six, way),
            _ => attempt(&mut self.nine, way),
        }
    }
}

/// What an optimiser is given: a context, a view, the motion to fall back on, which axes move.
type AttemptInput<'a> = (
    &'a WindowContext<'a>,
    &'a View,
    &'a [AxisVector],
    [bool; AXES],
);

fn attempt<const D: usize>(
    optimiser: &mut Option<Box<Optimiser<D>>>,
    (context, view, tail, moves): AttemptInput<'_>,
) -> Option<WindowMotion> {
    let optimiser = optimiser.get_or_insert_with(|| Box::new(Optimiser::new(context.corners)));
    let mut path: ScaledPath<D> = ScaledPath::new(
        context.limits,
        context.reference_path,
        view.pieces.clone(),
        (context.history.last(), moves),
        core::mem::take(&mut optimiser.segments),
    )
    .with_joints(context.joints);
    path.is_final |= view.is_halt;
    path = path.with_sides(context.reference_path, context.corners);
    let motion = attempt_along(optimiser, &path, (context, view, tail));
    optimiser.segments = path.segments;
    optimiser.segments.clear();
    motion
}

fn attempt_along<const D: usize>(
    optimiser: &mut Optimiser<D>,
    path: &ScaledPath<D>,
    (context, view, tail): (&WindowContext<'_>, &View, &[AxisVector]),
) -> Option<WindowMotion> {
    let is_path_end = context.reference_path.is_last(context.end - 1);
    let tail: Vec<_> = (0..view.intervals.max(tail.len() - 3) + 3)
        .filter_map(|k| tail.get(k).or(tail.last()))
        .map(|point| path.inside(point))
        .collect();
    let piece = context.progress.0 - path.first;
    let segment = path.segments.get(piece)?;
    let window_start = WindowStart {
        tail: &tail,
        keeps_rates: context.keeps_rates,
        piece,
        progress: segment.s + segment.length * context.progress.1,
        passed: context.follower.reachable.last() - path.first,
        grid: *context.grid,
        period_t: context.period_t,
        commit: context.commit,
        bias: context.bias,
    };
    let start = StartOffset::new(
        path,
        (piece, window_start.progress),
        &path.inside(&context.history.last()),
        settling_periods(path, context.period_t),
    );
    // The judge sees positions as they are handed out, not control points in the window's space: what
    // rounding makes of them is judged, too.
    let mut judge = |points: &[[f64; D]], question| {
        let points: Vec<_> = points.iter().map(|point| path.outside(point)).collect();
        passes((context, path, &start), &points, question)
    };
    let solution = match context.search {
        WindowSearch::Whole(most_work) => {
            optimiser.optimise(path, &window_start, most_work, &mut judge)?
        }
        WindowSearch::AtFeed => optimiser.go_on_at_feed(path, &window_start, &mut judge)?,
    };
    let points = solution.points.iter();
    let mut points: Vec<_> = points.map(|point| path.outside(point)).collect();
    if solution.is_end {
        end_exactly(context, &mut points);
    }
    Some(WindowMotion {
        points,
        is_rest: solution.is_end,
        is_end: solution.is_end && is_path_end,
    })
}

/// The last control points are the end of what is in view, to the bit.
fn end_exactly(context: &WindowContext<'_>, points: &mut [AxisVector]) {
    if let Some(last) = context.reference_path.get(context.end - 1) {
        let count = points.len();
        points[count - 3..].fill(last.end);
    }
}

/// Follows a motion to its rest.
fn passes<const D: usize>(
    (context, path, start): (&WindowContext<'_>, &ScaledPath<D>, &StartOffset<D>),
    points: &[AxisVector],
    question: JudgeQuestion,
) -> bool {
    let mut points = points.to_vec();
    if question == JudgeQuestion::IsEnd {
        end_exactly(context, &mut points);
    }
    let mut history = context.history.clone();
    let mut follower = context.follower.to(context.end);
    let mut place = context.progress;
    let periods = context.grid.periods_in(points.len() - 3);
    // Into the rest, too, as far as third differences look back.
    for period in 1..=periods + 3 {
        let next = context.grid.state(&points, period);
        let way = (context.reference_path, &mut follower);
        if let Some(joints) = context.joints {
            let period_t = context.period_t;
            let [last, before, first] = *history.recent();
            let are_kept = joints.allow(&[next.position, last, before, first], period_t)
                && BETWEEN_R
                    .iter()
                    .all(|u| joints.allow(&history.between(&next, period_t, *u), period_t));
            if !are_kept {
                return false;
            }
        }
        let before = history.last();
        if !keeps_jerk(
            &context.limits.jerk,
            context.period_t,
            [history.state(), &next],
        ) {
            return false;
        }
        let followed = history.follow(context.limits, context.period_t, way, &next);
        if !followed.is_kept() {
            return false;
        }
        if context.corners == Corners::Inner {
            let reachable = &follower.reachable;
            place = reachable.nearest(context.reference_path, &next.position, place);
            if !path.is_on_its_sides(place, [&before, &next.position], (period - 1, start)) {
                return false;
            }
        }
    }
    // Whoever follows (chords, chords that begin within periods, the curve) has to have come as far at the rest:
    // one that is still before a vertex could not pass it from there.
    let may_set_out = follower.least_reach() >= follower.reachable.last();
    may_set_out
        && (question == JudgeQuestion::IsValid || follower.reachable.is_at_end_of(context.end - 1))
}

/// False if no motion with no more jerk than that of each axis can lead from one state to the next: a jerk of
/// J all along adds J·t, J·t²/2 and J·t³/6 to what acceleration, velocity and position would come to without,
/// and none adds more.
fn keeps_jerk(jerk: &AxisVector, t: f64, [from, to]: [&State; 2]) -> bool {
    let step_a = to.acceleration - from.acceleration;
    let step_v = to.velocity - from.velocity - from.acceleration * t;
    let gone = from.velocity * t + from.acceleration * (0.5 * t * t);
    let step = to.position - from.position - gone;
    (0..AXES).all(|i| {
        let most = JERK_SLACK * jerk[i] * t * t * t;
        step[i].abs() <= most / 6.0 + ROUNDING_MM
            && step_v[i].abs() * t <= most / 2.0 + ROUNDING_MM
            && step_a[i].abs() * t * t <= most + ROUNDING_MM
    })
}
