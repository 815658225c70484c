//! The parametrisation of least time along a track of knots.

use super::barrier::solve;
use super::between_knots::lessen;
use super::constraints::Problem;
use super::knots::{KnotPath, RestPhase};
use super::parametrisation::{Builder, Parametrisation};
use crate::on_path::speed::Course;
use crate::scurve::PathState;
use glidepath_program::Limits;

/// Times a time parametrisation is made anew where it demands too much between its knots.
const ROUNDS: u32 = 6;

/// The parametrisation near the least time that starts and ends as the S-curves do, `rate_r` times
/// as fast; `None` if none is found that keeps all limits, also between knots.
pub(crate) fn optimise(
    knot_path: &KnotPath,
    course: &Course<'_>,
    limits: &Limits,
    rate_r: f64,
) -> Option<Parametrisation> {
    let mut shares = vec![1.0; knot_path.intervals.len()];
    let first = usize::from(knot_path.rests[0].is_some());
    for _ in 0..ROUNDS {
        let parametrisation =
            parametrisation_of(knot_path, &Problem::new(knot_path, limits, &shares), rate_r)?;
        if lessen(
            &mut shares,
            &parametrisation,
            first,
            &knot_path.intervals,
            course,
            limits,
        ) {
            return Some(parametrisation);
        }
    }
    None
}

fn parametrisation_of(
    knot_path: &KnotPath,
    problem: &Problem,
    rate_r: f64,
) -> Option<Parametrisation> {
    let x = solve(problem, knot_path.start(rate_r))?;
    let mut builder = Builder::new();
    let zero = PathState {
        position_s: 0.0,
        speed_v: 0.0,
        accel_a: 0.0,
    };
    let slowed = |rest: RestPhase| (rest.jerk_j * rate_r.powi(3), rest.duration_t / rate_r);
    if let Some((jerk_j, duration_t)) = knot_path.rests[0].map(slowed) {
        builder.push_phase(zero, jerk_j, duration_t);
    }
    for (k, interval) in knot_path.intervals.iter().enumerate() {
        let [b, slope, second] = knot_path.parabola(k).at_start(&x[k..k + 3]);
        let state = PathState {
            position_s: interval.from_s,
            speed_v: b.max(0.0).sqrt(),
            accel_a: 0.5 * slope,
        };
        builder.push_parabola(state, interval.length_s, second)?;
    }
    if let Some((jerk_j, duration_t)) = knot_path.rests[1].map(slowed) {
        let state = PathState {
            position_s: knot_path.inner()[1],
            speed_v: 0.5 * jerk_j * duration_t * duration_t,
            accel_a: -jerk_j * duration_t,
        };
        builder.push_phase(state, jerk_j, duration_t);
    }
    Some(builder.finish(PathState {
        position_s: knot_path.length_s,
        speed_v: knot_path.ends_v[1] * rate_r,
        accel_a: 0.0,
    }))
}
