//! The problem: a quadratic spline on a track of knots, and the limits at places on it.

use super::interval::{BETWEEN_R, Interval};
use super::knots::KnotPath;
use super::parabola::{Parabola, Taylor};
use crate::joints::MachineLimits;
use glidepath_geometry::{AXES, Jet};
use glidepath_program::Limits;

/// The limits of an axis, a joint, or of the path, at a place: |½·d1·b′ + d2·b| ≤ A and
/// |½·d1·b″ + 3/2·d2·b′ + d3·b|·√b ≤ J. One that cannot bind there is infinite.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row {
    half_d1: f64,
    d2: f64,
    d3: f64,
    pub(crate) most_a: f64,
    pub(crate) most_j: f64,
}

impl Row {
    /// The acceleration as factors of b and b′.
    pub(crate) const fn accel(&self) -> [f64; 2] {
        [self.d2, self.half_d1]
    }

    /// The jerk over √b as factors of b, b′ and b″.
    pub(crate) const fn jerk(&self) -> [f64; 3] {
        [self.d3, 1.5 * self.d2, self.half_d1]
    }
}

/// What of an interval a place is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Part {
    /// Its start, where b and b′ depend on the first two of its three coefficients.
    Start,
    /// Between its ends, where only speed is limited.
    Inside,
    /// Its end, where b and b′ depend on the last two.
    End,
}

/// A place where limits are kept.
#[derive(Debug)]
pub(crate) struct ConstraintPoint {
    /// The first of the three coefficients that matter here.
    pub(crate) first: usize,
    /// b, b′ and b″ over these.
    pub(crate) taylor: Taylor,
    pub(crate) part: Part,
    /// The square of the top speed, mm²/s²; infinite where speed is given or kept elsewhere.
    pub(crate) cap_b: f64,
    /// The length that is driven as fast as this place, mm.
    pub(crate) share_s: f64,
    /// Where its rows end, among all.
    pub(crate) rows_end: usize,
}

impl ConstraintPoint {
    /// b, b′ and b″ for some coefficients.
    pub(crate) fn values(&self, x: &[f64]) -> [f64; 3] {
        let near = &x[self.first..self.first + 3];
        let Taylor {
            value,
            slope,
            second,
        } = &self.taylor;
        [value, slope, second].map(|of| of[0] * near[0] + of[1] * near[1] + of[2] * near[2])
    }
}

/// All limits.
#[derive(Debug)]
pub(crate) struct Problem {
    pub(crate) places: Vec<ConstraintPoint>,
    pub(crate) rows: Vec<Row>,
    /// How many limits there are, those that hold both ways counted twice.
    pub(crate) count: usize,
    pub(crate) knots: usize,
    /// How many coefficients are given at start and end.
    pub(crate) given: [usize; 2],
    /// Every limit may bind.
    may_all_bind: bool,
}

/// Share of the jerk of an axis that may be asked for at a place: it changes faster between them than
/// speed and acceleration do, ten times as fast by this. What comes out is looked at between the places
/// whatever these shares are ([`super::between_knots`]); with less room that has more to mend.
const JERK_BETWEEN_R: f64 = 1.0 - 2e-3;
/// A limit this many times what can be asked for is none: a row less. What can be asked for is reckoned with s̈
/// and s⃛ within the path's limits, and these hold at knots only; what is above 1 is for the places between. Where
/// the path has no limits of its own, every axis that moves along it may bind. With 1, and with 100, none of 50
/// programs took another time: the number saves rows and no more.
const IDLE_R: f64 = 1.5;

impl Problem {
    /// `shares`: of its limits that each interval may use.
    pub(crate) fn new(knot_path: &KnotPath, limits: &MachineLimits, shares: &[f64]) -> Self {
        let MachineLimits { axes, joints } = limits;
        let count = knot_path.intervals.len();
        let mut problem = Self {
            places: Vec::with_capacity(3 * count),
            rows: Vec::with_capacity(4 * count),
            count: 0,
            knots: count + 1,
            given: knot_path
                .rests_in_time
                .map(|rests| if rests { 1 } else { 2 }),
            may_all_bind: knot_path.nominal.is_some(),
        };
        for (k, (interval, share_r)) in knot_path.intervals.iter().zip(shares).enumerate() {
            let parabola = knot_path.parabola(k);
            let half_s = 0.5 * interval.length_s;
            let (start, end) = (&interval.start, &interval.end);
            let of_joints = joints
                .as_ref()
                .map(|rows| &rows.limits)
                .zip(interval.joints.as_deref());
            problem.axes((start, interval.start_v), axes, *share_r, true);
            if let Some((limits, [start, _])) = of_joints {
                problem.axes((start, interval.start_v), limits, *share_r, true);
            }
            problem.path(axes, interval.along.as_deref().map(|[start, _]| *start));
            // The speed of S-curves is within the top speed, or at it: there is no room to ask for.
            let is_given = |is_end: bool, end: usize| is_end && knot_path.ends_r[end].is_some();
            let (from_given, to_given) = (is_given(k == 0, 0), is_given(k + 1 == count, 1));
            let start_v = if from_given {
                f64::INFINITY
            } else {
                share_r * interval.start_v
            };
            // Σ h/√b by trapezia: a knot stands for half of the interval to either side.
            let share_s = half_s + 0.5 * knot_path.before_s(k);
            problem.place((k, Part::Start), parabola.start, start_v, share_s);

            // b and b′ are continuous and b″ jumps: within a piece the start of the next interval has these
            // constraints again, but for that of the jerk.
            let next = knot_path.intervals.get(k + 1);
            let is_inside = next.is_some_and(|next| next.piece == interval.piece);
            problem.axes((end, interval.end_v), axes, *share_r, !is_inside);
            if let Some((limits, [_, end])) = of_joints {
                problem.axes((end, interval.end_v), limits, *share_r, !is_inside);
            }
            problem.path(axes, interval.along.as_deref().map(|[_, end]| *end));
            let end_v = if is_inside || to_given {
                f64::INFINITY
            } else {
                share_r * interval.end_v
            };
            let share_s = if next.is_none() { half_s } else { 0.0 };
            problem.place((k, Part::End), parabola.end, end_v, share_s);
            problem.inside(k, &parabola, interval, *share_r, from_given || to_given);
        }
        problem
    }

    /// Time, about, s: Σ h/√b.
    pub(crate) fn time(&self, x: &[f64]) -> f64 {
        let driven = self.places.iter().filter(|place| place.share_s > 0.0);
        let times = driven.map(|place| place.share_s / place.values(x)[0].sqrt());
        times.sum()
    }

    /// A place with the rows put in since the one before.
    fn place(&mut self, (first, part): (usize, Part), taylor: Taylor, top_v: f64, share_s: f64) {
        let cap_b = top_v * top_v;
        self.count += usize::from(cap_b.is_finite());
        self.places.push(ConstraintPoint {
            first,
            taylor,
            part,
            cap_b,
            share_s,
            rows_end: self.rows.len(),
        });
    }

    /// The top speed between the ends of an interval. Its coefficient is the middle Bézier point of
    /// b there, so b is nowhere above the largest of it and the values at both ends; where the top
    /// speed changes, b is kept below it in the middle, too. At an end where the speed is given, the
    /// coefficient is.
    fn inside(
        &mut self,
        first: usize,
        parabola: &Parabola,
        interval: &Interval,
        share_r: f64,
        is_given: bool,
    ) {
        let alone = |value: [f64; 3]| Taylor {
            value,
            slope: [0.0; 3],
            second: [0.0; 3],
        };
        let Interval {
            start_v,
            middle_v,
            end_v,
            ..
        } = *interval;
        // One row on the coefficient bounds all of the parabola; without it b could rise above the top
        // speed between two knots that keep it.
        let top_v = start_v.max(middle_v).max(end_v);
        let place = (first, Part::Inside);
        if !is_given {
            self.place(place, alone([0.0, 1.0, 0.0]), share_r * top_v, 0.0);
        }
        if middle_v < top_v {
            self.place(place, alone(parabola.middle()), share_r * middle_v, 0.0);
        }
    }

    fn row(&mut self, row: Row) {
        let limits = [row.most_a, row.most_j];
        let finite = limits.iter().filter(|limit| limit.is_finite()).count();
        if finite > 0 {
            self.count += 2 * finite;
            self.rows.push(row);
        }
    }

    /// The limits along the path, of which `along` has the derivatives by nominal time. s̈ is linear between two knots, so nothing of the acceleration is kept
    /// back for what is between them; s⃛ has √b in it, which is not.
    fn path(&mut self, limits: &Limits, along: Option<[f64; 3]>) {
        let bounds = &limits.path;
        let [d1, d2, d3] = along.unwrap_or([1.0, 0.0, 0.0]);
        self.row(Row {
            half_d1: 0.5 * d1,
            d2,
            d3,
            most_a: finite(bounds.tangential_a),
            most_j: BETWEEN_R * finite(bounds.jerk_j),
        });
    }

    /// The limits of the axes at a place, but for those that cannot bind there whatever the others
    /// leave, and without acceleration where it is limited elsewhere.
    fn axes(&mut self, (jet, top_v): (&Jet, f64), limits: &Limits, share_r: f64, has_accel: bool) {
        let bounds = &limits.path;
        for axis in 0..AXES {
            let (d1, d2, d3) = (jet.d1[axis], jet.d2[axis], jet.d3[axis]);
            if d1.to_bits() << 1 == 0 && d2.to_bits() << 1 == 0 && d3.to_bits() << 1 == 0 {
                continue;
            }
            let (most_a, most_j) = (limits.acceleration[axis], limits.jerk[axis]);
            // The most that the rows can come to, each term by itself, with s̈ and s⃛ at the path's limits.
            let along_a = d1.abs() * bounds.tangential_a;
            let needed_a = along_a + d2.abs() * top_v * top_v;
            let cross_j = 3.0 * d2.abs() * top_v * bounds.tangential_a;
            let needed_j = d1.abs() * bounds.jerk_j + cross_j + d3.abs() * top_v.powi(3);
            let may_bind = self.may_all_bind;
            let binding = |limit: f64, needed: f64| {
                if may_bind || limit < IDLE_R * needed {
                    finite(limit)
                } else {
                    f64::INFINITY
                }
            };
            self.row(Row {
                half_d1: 0.5 * d1,
                d2,
                d3,
                most_a: if has_accel {
                    share_r * BETWEEN_R * binding(most_a, needed_a)
                } else {
                    f64::INFINITY
                },
                most_j: share_r * JERK_BETWEEN_R * binding(most_j, needed_j),
            });
        }
    }
}

/// A limit, infinite where there is none.
fn finite(limit: f64) -> f64 {
    if limit < Limits::UNLIMITED {
        limit
    } else {
        f64::INFINITY
    }
}
