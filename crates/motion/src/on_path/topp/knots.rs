//! The knots of a time parametrisation: where they are, what the path is there, and its initial iterate, the
//! coefficients that the least time is sought from.

use super::interval::{Caps, Interval};
use super::knot_times::{Mark, RestPhase, knot_time, marks, position_at, rest_phase, times};
use super::nominal::Nominal;
use super::parabola::Parabola;
use super::solver_tolerances::SolverTolerances;
use crate::joints::MachineLimits;
use crate::on_path::pieces::{Piece, Shape};
use crate::on_path::speed::{Leg, PieceSequence};
use glidepath_geometry::{AxisVector, Jet, Segment};

/// Most knots. A piece that is driven for longer than these last, at a feed of micrometres, has
/// them farther apart: its speed is the feed then, and memory does not grow with the time.
const MOST_KNOTS: f64 = 30_000.0;
/// Knots of a window that passes corners are closer by this, where they are at times: what binds at a corner does so for
/// a few ms. On a passage by the pole of two tables, with four corners, the two that are passed take 1.3 % less
/// time with half, and .4 % less again with a quarter.
const CORNER_R: f64 = 0.5;
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
    /// The time of the S-curves, where knots are at times on it and not at path positions.
    pub(super) nominal: Option<Nominal>,
    /// What the initial iterate is made of, and places on it, densely.
    pub(super) legs: Vec<Leg>,
    marks: Vec<Mark>,
    /// Time from knot to knot, s.
    knot_t: f64,
    /// Those of [`SolverTolerances`].
    nearest_r: f64,
    rest_growth: f64,
    /// At start and end; `None` where the motion does not rest, or knots are at times.
    pub(crate) rests: [Option<RestPhase>; 2],
    /// Whether there is a rest at start and end, in nominal time. The rate at which the motion leaves it is
    /// sought, too; it has no slope there. With one, jerk would keep its limits at both ends of the interval and
    /// be far beyond them between.
    pub(crate) rests_in_time: [bool; 2],
    /// The speed of the S-curves at start and end, mm/s, by path position.
    pub(crate) ends_v: [f64; 2],
    /// How fast the motion is at start and end, in speeds of the S-curves; `None` where it is as
    /// fast as the initial iterate.
    pub(crate) ends_r: [Option<f64>; 2],
    /// Lengths on which that goes from the one to the other, mm; times, s, if knots are at these.
    pub(super) ramps_s: [f64; 2],
    pub(crate) length_s: f64,
    /// Where the last knot is, mm or s.
    pub(super) extent: f64,
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
        let duration_t: f64 = legs.iter().map(|leg| leg.profile.duration_t()).sum();
        let knot_t = knot_time(limits, tolerances).max(duration_t / MOST_KNOTS);
        // On dense blocks there are about as many phases as knots.
        let by_time = limits.joints.is_some() && tolerances.places_of_span.is_none();
        let is_corner = |piece: &Piece| !matches!(piece.shape, Shape::Segment(_));
        let knot_t = if by_time && sequence.pieces.iter().any(is_corner) {
            CORNER_R * knot_t
        } else {
            knot_t
        };
        let nominal = if by_time {
            Some(Nominal::new(legs)?)
        } else {
            None
        };
        let length_s = sequence.length_s();
        let ends_v = [first.entry_v(), last.exit_v()];
        let are_rests = ends_v.map(|v| v <= 0.0);
        let rests = [
            (!by_time && are_rests[0]).then(|| rest_phase(first.phases())),
            (!by_time && are_rests[1]).then(|| {
                let phases: Vec<_> = last.phases().collect();
                rest_phase(phases.into_iter().rev())
            }),
        ];
        let mut knot_path = Self {
            intervals: Vec::new(),
            legs: legs.to_vec(),
            marks: marks(legs, knot_t),
            rests,
            rests_in_time: are_rests.map(|is_rest| by_time && is_rest),
            ends_v,
            ends_r,
            ramps_s: ends_v.map(|v| {
                let unit_v = if by_time { v } else { 1.0 };
                ramp_length(v, sequence, limits) / unit_v
            }),
            length_s,
            extent: nominal.as_ref().map_or(length_s, Nominal::duration_t),
            nominal,
            knot_t,
            nearest_r: tolerances.nearest_r,
            rest_growth: tolerances.rest_growth,
        };
        let knots = match &knot_path.nominal {
            Some(nominal) => {
                // The ends have their time. Next to a rest that of a position is known to some µs only.
                let junctions_s = &sequence.starts_s[1..sequence.pieces.len()];
                nominal.knots(legs, junctions_s, knot_t)
            }
            None => knot_path.knots(sequence),
        };
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
        let own = Parabola::new([self.before_s(k), length(k), length(k + 1)]);
        if self.nominal.is_none() {
            return own;
        }
        let [starts, ends] = self.rests_in_time;
        let at_rest = [starts && k == 0, ends && k + 1 == self.intervals.len()];
        own.level_at(length(k), at_rest)
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
        knots.push(match self.nominal {
            Some(_) => self.extent,
            None => self.inner()[1],
        });
        self.lay(sequence, &knots, limits);
    }

    /// The axes and their derivatives at a place of a piece and a phase.
    pub(crate) fn jet(
        &self,
        sequence: &PieceSequence<'_>,
        (piece, phase): (usize, usize),
        at: f64,
    ) -> Jet {
        match &self.nominal {
            Some(of) => {
                let place = of.place(phase, at);
                place.jet(&path_jet(sequence, piece, place.state.position_s))
            }
            None => path_jet(sequence, piece, at),
        }
    }

    /// The path between the knots.
    fn lay(&mut self, sequence: &PieceSequence<'_>, knots: &[f64], limits: &MachineLimits) {
        for window in knots.windows(2) {
            let (from_s, to_s) = (window[0], window[1]);
            let middle_s = 0.5 * (from_s + to_s);
            let nominal = self.nominal.as_ref().map(|of| {
                let phase = of.phase_at(middle_s);
                let places = [from_s, middle_s, to_s].map(|at| of.place(phase, at));
                (phase, places)
            });
            let (phase, on_path_s) = nominal.as_ref().map_or((0, middle_s), |(phase, places)| {
                (*phase, places[1].state.position_s)
            });
            let index = sequence.touched(on_path_s, on_path_s).start;
            let before = self.intervals.last();
            let before = before.filter(|before| (before.piece, before.phase) == (index, phase));
            let jet = |s: f64| path_jet(sequence, index, s);
            let caps = caps(&sequence.pieces[index]);
            let cap_v = |jet: &Jet| Interval::cap_v(jet, &caps, &limits.axes);
            let (jets, top_v) = match &nominal {
                None => {
                    let start = before.map_or_else(|| jet(from_s), |before| before.end);
                    let jets = [start, jet(middle_s), jet(to_s)];
                    (jets, [0, 1, 2].map(|k| cap_v(&jets[k])))
                }
                Some((_, places)) => {
                    let on_path = [0, 1, 2].map(|k| jet(places[k].state.position_s));
                    (
                        [0, 1, 2].map(|k| places[k].jet(&on_path[k])),
                        [0, 1, 2].map(|k| places[k].rate(cap_v(&on_path[k]))),
                    )
                }
            };
            let joints = JointEnds::new(before, [&jets[0], &jets[1], &jets[2]], limits);
            let [start, _, end] = jets;
            let by_joints_v = joints
                .as_ref()
                .map_or([f64::INFINITY; 3], |joints| joints.caps_v);
            let [start_v, middle_v, end_v] = [0, 1, 2].map(|k| top_v[k].min(by_joints_v[k]));
            self.intervals.push(Interval {
                piece: index,
                phase,
                from_s,
                length_s: to_s - from_s,
                start_v,
                middle_v,
                end_v,
                start,
                end,
                along: nominal
                    .map(|(_, [start, _, end])| Box::new([start.derivatives(), end.derivatives()])),
                joints: joints.map(|joints| Box::new(joints.ends)),
            });
        }
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
    /// From the path at the three places; what the interval before has, on the same piece and phase, is not
    /// computed again.
    fn new(
        before: Option<&Interval>,
        [start, middle, end]: [&Jet; 3],
        limits: &MachineLimits,
    ) -> Option<Self> {
        let rows = limits.joints.as_ref()?;
        let known = before.and_then(|before| before.joints.as_ref().map(|joints| joints[1]));
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

/// The axes and their derivatives by path position, at one on a piece.
fn path_jet(sequence: &PieceSequence<'_>, piece: usize, s: f64) -> Jet {
    let own = &sequence.pieces[piece];
    own.jet((s - sequence.starts_s[piece]).clamp(0.0, own.length_s))
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
