//! The law of least time along a track of knots.

use super::barrier::solve;
use super::between_knots::lessen;
use super::constraints::Problem;
use super::knots::{RestPhase, Track};
use super::parametrisation::{Builder, Law};
use crate::on_path::speed::Course;
use crate::scurve::PathState;
use glidepath_program::Limits;

/// Times a law is made anew where it demands too much between its knots.
const ROUNDS: u32 = 6;

/// The law near the least time that starts and ends as the S-curves do, `rate_r` times as fast;
/// `None` if none is found that keeps all limits, also between knots.
pub(crate) fn optimise(
    track: &Track,
    course: &Course<'_>,
    limits: &Limits,
    rate_r: f64,
) -> Option<Law> {
    let mut shares = vec![1.0; track.intervals.len()];
    let first = usize::from(track.rests[0].is_some());
    for _ in 0..ROUNDS {
        let law = law_of(track, &Problem::new(track, limits, &shares), rate_r)?;
        if lessen(&mut shares, &law, first, &track.intervals, course, limits) {
            return Some(law);
        }
    }
    None
}

fn law_of(track: &Track, problem: &Problem, rate_r: f64) -> Option<Law> {
    let x = solve(problem, track.start(rate_r))?;
    let mut builder = Builder::new();
    let zero = PathState {
        position_s: 0.0,
        speed_v: 0.0,
        accel_a: 0.0,
    };
    let slowed = |rest: RestPhase| (rest.jerk_j * rate_r.powi(3), rest.duration_t / rate_r);
    if let Some((jerk_j, duration_t)) = track.rests[0].map(slowed) {
        builder.push_phase(zero, jerk_j, duration_t);
    }
    for (k, interval) in track.intervals.iter().enumerate() {
        let [b, slope, second] = track.parabola(k).at_start(&x[k..k + 3]);
        let state = PathState {
            position_s: interval.from_s,
            speed_v: b.max(0.0).sqrt(),
            accel_a: 0.5 * slope,
        };
        builder.push_span(state, interval.length_s, second)?;
    }
    if let Some((jerk_j, duration_t)) = track.rests[1].map(slowed) {
        let state = PathState {
            position_s: track.inner()[1],
            speed_v: 0.5 * jerk_j * duration_t * duration_t,
            accel_a: -jerk_j * duration_t,
        };
        builder.push_phase(state, jerk_j, duration_t);
    }
    Some(builder.finish(PathState {
        position_s: track.length_s,
        speed_v: track.ends_v[1] * rate_r,
        accel_a: 0.0,
    }))
}
