//! The demands of a time parametrisation on the axes between its knots, where the problem has no
//! constraints.
//!
//! The constraints hold at knots. Where the path bends within the time from one knot to the next,
//! as in the curve that replaces a corner, acceleration and jerk may be larger between them. So
//! what was optimised is looked at in between, and where it demands too much the constraints of the
//! intervals around are given a smaller share of the limits, and the parametrisation is made anew.

use super::interval::Interval;
use super::knots::KnotPath;
use super::parametrisation::{MotionPhase, Parametrisation};
use super::solver_tolerances::SolverTolerances;
use crate::joints::MachineLimits;
use crate::on_path::pieces::Shape;
use crate::on_path::speed::{Leg, PieceSequence};
use crate::scurve::PathState;
use glidepath_geometry::{Cubic, Jet};
use glidepath_program::Limits;

/// Places on an interval that are looked at, besides its start, and those on a transition, where
/// the third derivative of the path changes fast. What may be between them is what the shares below
/// leave: on an arc of .08 mm it was 7e-5 of the jerk.
const PLACES: u32 = 8;
const PLACES_OF_TRANSITION: u32 = 20;
/// Shares of limits up to which nothing is done, of jerk and of the others: between the places it
/// may be a little more. At knots the constraints leave twice as much. On that arc jerk
/// took a fourteenth of what is left to it; what else the numbers came from is not on record. With 1 in place of
/// both, none of 50 programs took another time.
const ENOUGH_R: f64 = 1.0 - 1e-4;
const ENOUGH_JERK_R: f64 = 1.0 - 1e-3;
/// Where a limit is exceeded by more than this factor, another knot is put in: the path changes too much
/// between two for less of its limits to be a remedy. No measurement of it is kept.
const MUCH_R: f64 = 1.05;
/// The least share of the limits. An initial iterate that is .85 times as fast as the S-curves asks for .85 of their
/// speed, .72 of their acceleration, .61 of their jerk. So where S-curves are at the top speed, shares below
/// .85 leave no such iterate, where they are at the limit of acceleration those below .72; from rest to rest a
/// slower one is tried then, elsewhere there is no parametrisation.
const LEAST_SHARE_R: f64 = 0.7;
/// Taken off more than was exceeded, for the places between these. No measurement of it is kept.
const MORE_R: f64 = 1e-3;

/// A speed above a cap by less than this is rounding.
const SPEED_ROUNDING_R: f64 = 1e-9;

/// The largest share of what is enough of a limit of an axis that a phase of a time parametrisation
/// uses.
fn worst(
    phase: &MotionPhase,
    duration_t: f64,
    (knot_path, interval): (&KnotPath, &Interval),
    sequence: &PieceSequence<'_>,
    limits: &MachineLimits,
) -> f64 {
    let places = match sequence.pieces[interval.piece].shape {
        Shape::Transition(_) => PLACES_OF_TRANSITION,
        Shape::Segment(_) | Shape::Spline(_) => PLACES,
    };
    let mut worst = 0.0_f64;
    for k in 0..=places {
        let state = phase.at(duration_t * f64::from(k) / f64::from(places));
        let jet = if k == 0 {
            interval.start
        } else if k == places {
            interval.end
        } else {
            knot_path.jet(sequence, (interval.piece, interval.phase), state.position_s)
        };
        worst = worst.max(used_by_all(&jet, &state, phase, limits));
    }
    worst
}

/// The same on a span of a spline that begins at a path position, at places of its own parameter:
/// none of them has to be sought.
fn worst_of_span(
    phase: &MotionPhase,
    interval: &Interval,
    (span, span_s, places): (&Cubic, f64, u32),
    limits: &MachineLimits,
) -> f64 {
    let ends_s = [interval.from_s, interval.from_s + interval.length_s];
    let [from_u, to_u] = ends_s.map(|s| span.parameter_at(s - span_s));
    let mut worst = 0.0_f64;
    for k in 1..places {
        let u = from_u + (to_u - from_u) * f64::from(k) / f64::from(places);
        let jet = span.jet_at_parameter(u);
        let state = phase.at_position(span_s + span.position_at(u));
        worst = worst.max(used_by_all(&jet, &state, phase, limits));
    }
    for (jet, s) in [&interval.start, &interval.end].into_iter().zip(ends_s) {
        worst = worst.max(used_by_all(jet, &phase.at_position(s), phase, limits));
    }
    worst
}

/// The largest share of what is enough of a limit of an axis or a joint that a state on a phase uses.
#[inline]
fn used_by_all(jet: &Jet, state: &PathState, phase: &MotionPhase, limits: &MachineLimits) -> f64 {
    let by_axes = used(jet, state, phase, &limits.axes);
    let rows = limits.joints.as_ref();
    let by_joints = rows.and_then(|rows| Some(used(&rows.along(jet)?, state, phase, &rows.limits)));
    by_axes.max(by_joints.unwrap_or(0.0))
}

/// True if an S-curve keeps the limits of axes and joints, at places of each of its phases and of each
/// piece.
pub(crate) fn keeps_limits(
    leg: &Leg,
    sequence: &PieceSequence<'_>,
    limits: &MachineLimits,
) -> bool {
    let phases = leg
        .profile
        .phases()
        .filter(|(duration_t, ..)| *duration_t > 0.0);
    let phases: Vec<_> = phases
        .map(|(duration_t, start, jerk_j)| {
            let phase = MotionPhase {
                from_t: 0.0,
                start,
                jerk_j,
                growth: 0.0,
            };
            (duration_t, phase)
        })
        .collect();
    let is_kept = |state: &PathState, phase: &MotionPhase, piece: usize| {
        let at_s = leg.from_s + state.position_s;
        let own = &sequence.pieces[piece];
        let jet = own.jet((at_s - sequence.starts_s[piece]).clamp(0.0, own.length_s));
        // The rate of the program is among what bounds the speed on a piece.
        state.speed_v <= own.limit.peak_v * (1.0 + SPEED_ROUNDING_R)
            && used_by_all(&jet, state, phase, limits) <= 1.0
    };
    let along_phases = phases.iter().all(|(duration_t, phase)| {
        (0..=PLACES).all(|k| {
            let state = phase.at(duration_t * f64::from(k) / f64::from(PLACES));
            let at_s = leg.from_s + state.position_s;
            is_kept(&state, phase, sequence.touched(at_s, at_s).start)
        })
    });
    let to_s = leg.from_s + leg.profile.length_s();
    along_phases
        && sequence.touched(leg.from_s, to_s).all(|piece| {
            let places = match sequence.pieces[piece].shape {
                Shape::Transition(_) => PLACES_OF_TRANSITION,
                Shape::Segment(_) | Shape::Spline(_) => PLACES,
            };
            let ends_s = [sequence.starts_s[piece], sequence.starts_s[piece + 1]];
            (0..=places).all(|k| {
                let share_r = f64::from(k) / f64::from(places);
                let at_s = ends_s[0] + share_r * (ends_s[1] - ends_s[0]) - leg.from_s;
                let at_s = at_s.clamp(0.0, leg.profile.length_s());
                let passed = phases.partition_point(|(_, phase)| phase.start.position_s <= at_s);
                let phase = phases.get(passed.saturating_sub(1));
                phase.is_none_or(|(_, phase)| is_kept(&leg.profile.at_position(at_s), phase, piece))
            })
        })
}

/// The same of axes, or of joints in their place.
#[inline]
fn used(jet: &Jet, state: &PathState, phase: &MotionPhase, limits: &Limits) -> f64 {
    let (v, a) = (state.speed_v, state.accel_a);
    let j = phase.jerk_j + phase.growth * v;
    // q̇ = q′·v,  q̈ = q″·v² + q′·a,  q⃛ = q‴·v³ + 3·q″·v·a + q′·j; along the phase j = γ·v.
    let speed = jet.d1 * v;
    let accel = jet.d2 * (v * v) + jet.d1 * a;
    let jerk = jet.d3 * (v * v * v) + jet.d2 * (3.0 * v * a) + jet.d1 * j;
    let mut used = 0.0_f64;
    for (asked, limit, enough_r) in [
        (speed, &limits.velocity, ENOUGH_R),
        (accel, &limits.acceleration, ENOUGH_R),
        (jerk, &limits.jerk, ENOUGH_JERK_R),
    ] {
        used = used.max(asked.abs().component_div(limit).max() / enough_r);
    }
    used
}

/// What is to be done where a time parametrisation exceeds limits between its knots.
#[derive(Debug)]
pub(crate) struct Remedy {
    /// Intervals that need another knot in their middle.
    pub(crate) halved: Vec<usize>,
    /// Nothing is exceeded.
    pub(crate) is_none: bool,
}

/// Takes from the shares of the intervals that constraints have of the limits where a time
/// parametrisation exceeds them, `firmness` times what is exceeded; where that is much, the knots
/// are too far apart. `first`: the phase of the first interval; those next to rests are no intervals, for they are
/// phases of the S-curves, slowed, and keep the limits as these do.
///
/// Axes and joints are looked at, not the path's own limits nor the caps of speed: s̈ is linear between knots, b keeps
/// the caps at both ends and in the middle of an interval, and for the rest both are planned a little lower
/// ([`super::interval`]).
pub(crate) fn lessen(
    shares: &mut [f64],
    (parametrisation, first): (&Parametrisation, usize),
    firmness: f64,
    knot_path: &KnotPath,
    sequence: &PieceSequence<'_>,
    (limits, tolerances): (&MachineLimits, &SolverTolerances),
) -> Remedy {
    let given = shares.to_vec();
    let mut remedy = Remedy {
        halved: Vec::new(),
        is_none: true,
    };
    for (k, interval) in knot_path.intervals.iter().enumerate() {
        let Some(phase) = parametrisation.phases.get(first + k) else {
            break;
        };
        let next_t = parametrisation
            .phases
            .get(first + k + 1)
            .map(|next| next.from_t);
        let duration_t = next_t.unwrap_or(parametrisation.duration_t) - phase.from_t;
        let piece = &sequence.pieces[interval.piece];
        let from_s = sequence.starts_s[interval.piece] - piece.from_s;
        let ratio = match (&piece.shape, tolerances.places_of_span) {
            (Shape::Spline(span), Some(places)) => {
                worst_of_span(phase, interval, (span, from_s, places), limits)
            }
            _ => worst(phase, duration_t, (knot_path, interval), sequence, limits),
        };
        if ratio <= 1.0 {
            continue;
        }
        remedy.is_none = false;
        if ratio > MUCH_R {
            remedy.halved.push(k);
            continue;
        }
        // The neighbours, too: a coefficient acts on three intervals. Less by what it was over, and a bit.
        let over_r = firmness * (ratio - 1.0);
        let around = k.saturating_sub(1)..(k + 2).min(shares.len());
        for (share, given) in shares[around.clone()].iter_mut().zip(&given[around]) {
            *share = share.min((given / (1.0 + over_r) - MORE_R).max(LEAST_SHARE_R.min(*given)));
        }
    }
    remedy
}
