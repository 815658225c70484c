//! The knots of a time parametrisation: where they are, what the path is there, and its initial iterate, the
//! coefficients that the least time is sought from.

use super::interval::{Caps, Interval};
use super::knot_times::{Mark, RestPhase, knot_time, marks, position_at, rest_phase, times};
use super::parabola::Parabola;
use super::solver_tolerances::SolverTolerances;
use crate::joints::MachineLimits;
use crate::on_path::pieces::{Piece, Shape};
use crate::on_path::speed::{Leg, PieceSequence};
use glidepath_geometry::{AxisVector, Jet, Segment};

/// Most knots. A piece that is driven for longer than these last, at a feed of micrometres, has
/// them farther apart: its speed is the feed then, and memory does not grow with the time.
const MOST_KNOTS: f64 = 30_000.0;
/// The time T in which the initial iterate goes over from the speed v of the S-curves to its own: the larger
/// one of T² = RAMP_JERK·v/j and T = RAMP_ACCEL·v/a, so that it asks for a fifth of the jerk j and of the
/// acceleration a of an axis. From 1 to .85 of the speed ([`crate::on_path::refining::RATE_R`]) a quintic has
/// slopes of up to 1.875 · .15/T and second derivatives of up to 5.77 · .15/T²; five times as much is 1.4 and
/// 4.3. Of the fifth no measurement is kept: a quarter of both numbers, and three times both, changed none of
/// 50 programs.
const RAMP_JERK: f64 = 4.3;
const RAMP_ACCEL: f64 = 1.4;

/// Knots, path and S-curves.
#[derive(Debug)]
pub(crate) struct KnotPath {
    pub(crate) intervals: Vec<Interval>,
    /// What the initial iterate is made of, and places on it, densely.
    legs: Vec<Leg>,
    marks: Vec<Mark>,
    /// Time from knot to knot, s.
    knot_t: f64,
    /// Those of [`SolverTolerances`].
    nearest_r: f64,
    rest_growth: f64,
    /// At start and end; `None` where the motion does not rest.
    pub(crate) rests: [Option<RestPhase>; 2],
    /// The speed of the S-curves at start and end, mm/s.
    pub(crate) ends_v: [f64; 2],
    /// How fast the motion is at start and end, in speeds of the S-curves; `None` where it is as
    /// fast as the initial iterate.
    pub(crate) ends_r: [Option<f64>; 2],
    /// Lengths on which that goes from the one to the other, mm.
    ramps_s: [f64; 2],
    pub(crate) length_s: f64,
}

impl KnotPath {
    /// Knots along a window that S-curves drive.
    pub(crate) fn new(
        sequence: &PieceSequence<'_>,
        legs: &[Leg],
        limits: &MachineLimits,
        tolerances: &SolverTolerances,
        ends_r: [Option<f64>; 2],
    ) -> Option<Self> {
        let first = legs.first()?.profile;
        let last = legs.last()?.profile;
        let rests = [
            (first.entry_v() <= 0.0).then(|| rest_phase(first.phases())),
            (last.exit_v() <= 0.0).then(|| {
                let phases: Vec<_> = last.phases().collect();
                rest_phase(phases.into_iter().rev())
            }),
        ];
        let duration_t: f64 = legs.iter().map(|leg| leg.profile.duration_t()).sum();
        let knot_t = knot_time(limits, tolerances).max(duration_t / MOST_KNOTS);
        let mut knot_path = Self {
            intervals: Vec::new(),
            legs: legs.to_vec(),
            marks: marks(legs, knot_t),
            rests,
            ends_v: [first.entry_v(), last.exit_v()],
            ends_r,
            ramps_s: [first.entry_v(), last.exit_v()].map(|v| ramp_length(v, sequence, limits)),
            length_s: sequence.length_s(),
            knot_t,
            nearest_r: tolerances.nearest_r,
            rest_growth: tolerances.rest_growth,
        };
        let knots = knot_path.knots(sequence);
        knot_path.lay(sequence, &knots, limits);
        // Two coefficients are given at either end: of three intervals one is left. Why five are asked for is
        // not on record.
        (knot_path.intervals.len() > 4).then_some(knot_path)
    }

    /// Length of the interval before one, 0 if there is none.
    pub(crate) fn before_s(&self, k: usize) -> f64 {
        let before = k.checked_sub(1).and_then(|k| self.intervals.get(k));
        before.map_or(0.0, |interval| interval.length_s)
    }

    /// The parabola of an interval, over its coefficients.
    pub(crate) fn parabola(&self, k: usize) -> Parabola {
        let length = |k: usize| self.intervals.get(k).map_or(0.0, |i| i.length_s);
        Parabola::new([self.before_s(k), length(k), length(k + 1)])
    }

    /// Path position at which the phase next to the start ends, and that where the one next to the
    /// end begins.
    pub(crate) fn inner(&self) -> [f64; 2] {
        // A constant jerk from rest covers J·t³/6.
        let [start_s, end_s] = self
            .rests
            .map(|rest| rest.map_or(0.0, |r| r.jerk_j * r.duration_t.powi(3) / 6.0));
        [start_s, self.length_s - end_s]
    }

    /// Path positions of the knots.
    fn knots(&self, sequence: &PieceSequence<'_>) -> Vec<f64> {
        let [from_s, to_s] = self.inner();
        let duration_t = self.marks.last().map_or(0.0, |mark| mark.t);
        // From both ends to the middle.
        let [mut times, mut back] = self
            .rests
            .map(|rest| times(rest, 0.5 * duration_t, (self.knot_t, self.rest_growth)));
        back.reverse();
        // Those from the start end before the middle, those from the end half a knot's time after it: the two
        // about it are no nearer to each other than that.
        let left = back.into_iter().map(|t| duration_t - t);
        times.extend(left.filter(|t| *t > 0.5 * (duration_t + self.knot_t)));
        let mut own = vec![from_s];
        own.extend(
            times
                .into_iter()
                .map(|t| position_at(&self.marks, t, self.length_s)),
        );
        own.push(to_s);
        // Where pieces meet there is a knot in any case, for derivatives of the path jump there; those of
        // the time that are too near to one are left out, or intervals of very different lengths meet.
        let junctions: Vec<f64> = sequence.starts_s.clone();
        let junctions = &junctions[junctions.partition_point(|s| *s <= from_s)..];
        let junctions = &junctions[..junctions.partition_point(|s| *s < to_s)];
        let mut knots = vec![from_s];
        let mut next = junctions.iter().copied().peekable();
        for window in own.windows(3) {
            let [before_s, here_s, after_s] = [window[0], window[1], window[2]];
            let near_s = self.nearest_r * (here_s - before_s).min(after_s - here_s);
            while let Some(junction_s) = next.next_if(|s| *s <= here_s) {
                knots.push(junction_s);
            }
            let passed_s = knots.last().copied().unwrap_or(from_s);
            let is_near = next.peek().is_some_and(|s| s - here_s < near_s);
            if here_s - passed_s > near_s && !is_near {
                knots.push(here_s);
            }
        }
        knots.extend(next);
        knots.push(to_s);
        knots
    }

    /// The coefficient of b on an interval, as the S-curves have it: where the tangents of b at the
    /// ends have the middle, on average. Exact for a parabola.
    fn coefficient(&self, interval: &Interval) -> f64 {
        let half_s = 0.5 * interval.length_s;
        let after = |s: f64| self.legs.partition_point(|leg| leg.from_s <= s);
        let tangent = |s: f64, step_s: f64| {
            let leg = self.legs.get(after(s).saturating_sub(1));
            leg.map_or(0.0, |leg| {
                let state = leg.profile.at_position(s - leg.from_s);
                state.speed_v * state.speed_v + 2.0 * state.accel_a * step_s
            })
        };
        let [from_s, to_s] = [interval.from_s, interval.from_s + interval.length_s];
        0.5 * (tangent(from_s, half_s) + tangent(to_s, -half_s))
    }

    /// Puts knots into the middle of some intervals, in rising order.
    pub(crate) fn halve(
        &mut self,
        halved: &[usize],
        sequence: &PieceSequence<'_>,
        limits: &MachineLimits,
    ) {
        let mut knots = Vec::with_capacity(self.intervals.len() + halved.len() + 1);
        let mut next = halved.iter().peekable();
        for (k, interval) in self.intervals.drain(..).enumerate() {
            knots.push(interval.from_s);
            if next.next_if(|next| **next == k).is_some() {
                knots.push(interval.from_s + 0.5 * interval.length_s);
            }
        }
        knots.push(self.inner()[1]);
        self.lay(sequence, &knots, limits);
    }

    /// The path between the knots.
    fn lay(&mut self, sequence: &PieceSequence<'_>, knots: &[f64], limits: &MachineLimits) {
        for window in knots.windows(2) {
            let (from_s, to_s) = (window[0], window[1]);
            let middle_s = 0.5 * (from_s + to_s);
            let index = sequence.touched(middle_s, middle_s).start;
            let piece = &sequence.pieces[index];
            let caps = caps(piece);
            let jet = |s: f64| piece.jet((s - sequence.starts_s[index]).clamp(0.0, piece.length_s));
            let start = match self.intervals.last() {
                Some(before) if before.piece == index => before.end,
                _ => jet(from_s),
            };
            let [middle, end] = [middle_s, to_s].map(jet);
            let own_v = |jet: &Jet| Interval::cap_v(jet, &caps, &limits.axes);
            let joints = JointEnds::new(
                self.intervals.last(),
                index,
                [&start, &middle, &end],
                limits,
            );
            let by_joints_v = joints
                .as_ref()
                .map_or([f64::INFINITY; 3], |joints| joints.caps_v);
            let top_v = |jet: &Jet, place: usize| own_v(jet).min(by_joints_v[place]);
            self.intervals.push(Interval {
                piece: index,
                from_s,
                length_s: to_s - from_s,
                start_v: top_v(&start, 0),
                middle_v: top_v(&middle, 1),
                end_v: top_v(&end, 2),
                start,
                end,
                joints: joints.map(|joints| Box::new(joints.ends)),
            });
        }
    }

    /// How fast the initial iterate is at a path position, in speeds of the S-curves; `rate_r` away from the
    /// ends.
    fn rate_at(&self, s: f64, rate_r: f64) -> f64 {
        let sides_s = [s, self.length_s - s];
        let mut at_r = rate_r;
        for ((end_r, ramp_s), side_s) in self.ends_r.iter().zip(self.ramps_s).zip(sides_s) {
            if let Some(end_r) = end_r {
                let u = (side_s / ramp_s).clamp(0.0, 1.0);
                // The quintic with no slope and no second derivative at its ends: neither acceleration
                // nor jerk jumps there.
                let passed_r = u * u * u * (10.0 + u * (6.0 * u - 15.0));
                at_r += (end_r - rate_r) * (1.0 - passed_r);
            }
        }
        at_r
    }

    /// How fast the motion is at start and end, in speeds of the S-curves.
    pub(crate) fn ends_at(&self, rate_r: f64) -> [f64; 2] {
        self.ends_r.map(|end_r| end_r.unwrap_or(rate_r))
    }

    /// The initial iterate of the optimisation: coefficients of the S-curves, `rate_r` times as fast, but for
    /// the ends.
    pub(crate) fn initial(&self, rate_r: f64) -> Vec<f64> {
        let square_r = rate_r * rate_r;
        let count = self.intervals.len();
        let mut x = Vec::with_capacity(count + 2);
        let speed = |rest: Option<RestPhase>, end_v: f64| match rest {
            Some(r) => {
                let speed_v = 0.5 * r.jerk_j * r.duration_t * r.duration_t;
                (speed_v * speed_v, r.jerk_j * r.duration_t)
            }
            None => (end_v * end_v, 0.0),
        };
        let (start_b, start_a) = speed(self.rests[0], self.ends_v[0]);
        let (end_b, end_a) = speed(self.rests[1], self.ends_v[1]);
        // The coefficient next to an end is where the tangent of b there leads to in the middle of the interval,
        // b ± b′·h/2, and b′ is twice the acceleration. `end_a` is without its sign: there the motion slows down.
        x.push(start_b);
        for interval in &self.intervals {
            x.push(self.coefficient(interval));
        }
        x.push(end_b);
        if let (Some(first), Some(last)) = (self.intervals.first(), self.intervals.last()) {
            x[1] = start_b + start_a * first.length_s;
            x[count] = end_b + end_a * last.length_s;
        }
        if self.ends_r == [None; 2] {
            for b in &mut x {
                *b *= square_r;
            }
            return x;
        }
        let middle = |interval: &Interval| interval.from_s + 0.5 * interval.length_s;
        for (b, interval) in x[1..=count].iter_mut().zip(&self.intervals) {
            *b *= self.rate_at(middle(interval), rate_r).powi(2);
        }
        let [start_r, end_r] = self.ends_at(rate_r);
        x[0] = start_b * start_r * start_r;
        x[count + 1] = end_b * end_r * end_r;
        // Nothing but the speed is given there.
        if self.ends_r[0].is_some() {
            x[1] = x[0];
        }
        if self.ends_r[1].is_some() {
            x[count] = x[count + 1];
        }
        x
    }
}

/// The joints on an interval, where they are not the axes.
struct JointEnds {
    /// At its start and its end.
    ends: [Jet; 2],
    /// How fast they can follow at its start, in its middle and at its end, mm/s.
    caps_v: [f64; 3],
}

impl JointEnds {
    /// From the path at the three places; what the interval before on the same piece has is not computed
    /// again.
    fn new(
        before: Option<&Interval>,
        piece: usize,
        [start, middle, end]: [&Jet; 3],
        limits: &MachineLimits,
    ) -> Option<Self> {
        let rows = limits.joints.as_ref()?;
        let known = before
            .filter(|before| before.piece == piece)
            .and_then(|before| before.joints.as_ref().map(|joints| joints[1]));
        let start = match known {
            Some(start) => start,
            None => rows.along(start)?,
        };
        let [middle, end] = [rows.along(middle)?, rows.along(end)?];
        let caps_v = [&start, &middle, &end].map(|joints| Interval::joints_v(joints, &rows.limits));
        Some(Self {
            ends: [start, end],
            caps_v,
        })
    }
}

/// What bounds the speed on a piece whatever the axes can do. Where the curvature changes within a
/// period, as on all curves but those of the program, which are long, its largest counts.
fn caps(piece: &Piece) -> Caps {
    let (rate_v, chord_a, chord_v) = piece.rule.caps(piece.planned);
    match piece.shape {
        Shape::Segment(Segment::Curve(_)) => Caps { rate_v, chord_a },
        _ => Caps {
            rate_v: rate_v.min(chord_v),
            chord_a: f64::INFINITY,
        },
    }
}

/// The length on which a motion can easily go from the speed of the S-curves to that of an initial iterate.
fn ramp_length(speed_v: f64, sequence: &PieceSequence<'_>, limits: &MachineLimits) -> f64 {
    let least = |of: &AxisVector| of.iter().copied().fold(f64::INFINITY, f64::min);
    let (mut jerk_j, mut accel_a) = (least(&limits.axes.jerk), least(&limits.axes.acceleration));
    if limits.joints.is_some() {
        let along = sequence.pieces.iter().map(|piece| piece.limit.change);
        for change in along {
            (jerk_j, accel_a) = (jerk_j.min(change.jerk_j), accel_a.min(change.accel_a));
        }
    }
    speed_v
        * (RAMP_JERK * speed_v / jerk_j)
            .sqrt()
            .max(RAMP_ACCEL * speed_v / accel_a)
}
