//! The times of knots: the time along the S-curves that a parametrisation starts from, where they are at a
//! time, and the phases next to rests, which knots lie closer to.

use super::solver_tolerances::SolverTolerances;
use crate::joints::MachineLimits;
use crate::on_path::speed::Leg;
use crate::scurve::PathState;
use glidepath_program::Limits;

/// Time from knot to knot on the S-curves, at least, s. No share of a machine's ramp makes it less: the
/// work is linear in the knots. It is not in periods, for a parametrisation is sampled afterwards, nor in a/j,
/// which [`SolverTolerances::knot_r`] is in. With half of it, and with twice it, none of 50 programs took another
/// time.
const LEAST_KNOT_T: f64 = 0.002;
/// Time of the phase of constant jerk next to a rest, and its largest share of the S-curve's. At a rest
/// b ~ s^(4/3) has a second derivative beyond all bounds, which no spline follows; the shorter the
/// phase, the more knots next to it ([`SolverTolerances::rest_growth`]). Why a time, and not a
/// share of a/j, is not on record. With twice as much 17 of 50 programs took .2 to 1.2 % longer, with half as much 13
/// took up to .6 % less and 3 up to .8 % more. Of the share no measurement is kept.
const REST_T: f64 = 0.001;
const REST_R: f64 = 0.25;

/// Places on the S-curves are so much of the time from knot to knot apart, and each S-curve has so many at
/// least: between two of them path position is taken to be linear in time, which tells where a knot goes, and
/// nothing else.
const MARK_R: f64 = 0.25;
const LEAST_MARKS: f64 = 8.0;

/// A place on the S-curves: time and path position.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mark {
    pub(super) t: f64,
    s: f64,
}

/// The phase of constant jerk next to a rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RestPhase {
    pub(crate) jerk_j: f64,
    pub(crate) duration_t: f64,
}

/// Time from knot to knot.
pub(super) fn knot_time(limits: &MachineLimits, tolerances: &SolverTolerances) -> f64 {
    let limits = limits
        .joints
        .as_ref()
        .map_or(&limits.axes, |joints| &joints.limits);
    let axes = limits.acceleration.iter().zip(&limits.jerk);
    let limited = axes.filter(|(_, jerk_j)| **jerk_j < Limits::UNLIMITED);
    let rises_t = limited.map(|(accel_a, jerk_j)| accel_a / jerk_j);
    let least_t = rises_t.fold(f64::INFINITY, f64::min);
    (tolerances.knot_r * least_t)
        .max(LEAST_KNOT_T)
        .min(tolerances.knot_t)
}

/// Times of knots from an end of the motion up to some time, without the end, s.
pub(super) fn times(rest: Option<RestPhase>, to_t: f64, (knot_t, growth): (f64, f64)) -> Vec<f64> {
    let mut times = Vec::new();
    let mut t = rest.map_or(0.0, |rest| rest.duration_t);
    loop {
        t += match rest {
            Some(_) => ((growth - 1.0) * t).min(knot_t),
            None => knot_t,
        };
        let is_before = t > 0.0 && t < to_t;
        if !is_before {
            return times;
        }
        times.push(t);
    }
}

/// The phase next to a rest, from the phases of an S-curve in the order away from it.
pub(super) fn rest_phase(mut phases: impl Iterator<Item = (f64, PathState, f64)>) -> RestPhase {
    let first = phases.find(|(duration_t, ..)| *duration_t > 0.0);
    let (duration_t, jerk_j) = first.map_or((0.0, 0.0), |(t, _, jerk_j)| (t, jerk_j));
    RestPhase {
        jerk_j: jerk_j.abs(),
        duration_t: (REST_R * duration_t).min(REST_T),
    }
}

/// Places on some S-curves, four between two knots.
pub(super) fn marks(legs: &[Leg], knot_t: f64) -> Vec<Mark> {
    let mut marks = Vec::new();
    let mut from_t = 0.0;
    for leg in legs {
        let duration_t = leg.profile.duration_t();
        let steps = (duration_t / (MARK_R * knot_t)).ceil().max(LEAST_MARKS);
        let mut k = 0.0;
        while k < steps {
            let t = duration_t * k / steps;
            let state = leg.profile.at(t);
            marks.push(Mark {
                t: from_t + t,
                s: leg.from_s + state.position_s,
            });
            k += 1.0;
        }
        from_t += duration_t;
    }
    if let Some(last) = legs.last() {
        marks.push(Mark {
            t: from_t,
            s: last.from_s + last.profile.length_s(),
        });
    }
    marks
}

/// Path position at a time; `length_s` after the last place.
pub(super) fn position_at(marks: &[Mark], t: f64, length_s: f64) -> f64 {
    let after = marks.partition_point(|mark| mark.t <= t);
    let before = after.saturating_sub(1);
    match (marks.get(before), marks.get(after)) {
        (Some(a), Some(b)) => a.s + (b.s - a.s) * (t - a.t) / (b.t - a.t),
        _ => length_s,
    }
}
