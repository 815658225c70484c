//! The parametrisation of least time along a track of knots.

use super::barrier::solve;
use super::between_knots::lessen;
use super::constraints::Problem;
use super::knot_times::RestPhase;
use super::knots::KnotPath;
use super::nominal::Nominal;
use super::parametrisation::{Builder, Parametrisation};
use super::solver_tolerances::SolverTolerances;
use crate::joints::MachineLimits;
use crate::on_path::speed::PieceSequence;
use crate::scurve::PathState;

/// Times a time parametrisation is made anew where it demands too much between its knots: a peak
/// between two knots gives way less than their limits do. No measurement of it is kept.
const ROUNDS: u32 = 8;

/// The parametrisation near the least time that starts and ends as the S-curves do, some times as
/// fast: the first of these rates that leaves room to start from. `None` if none is found that
/// keeps all limits, also between knots.
pub(crate) fn optimise(
    mut knot_path: KnotPath,
    sequence: &PieceSequence<'_>,
    limits: &MachineLimits,
    (rates, tolerances): (&[f64], &SolverTolerances),
) -> Option<Parametrisation> {
    let mut shares = vec![1.0; knot_path.intervals.len()];
    let first = usize::from(knot_path.rests[0].is_some());
    let mut rates = rates.iter().copied().peekable();
    // Rates only go down: what left no room to start from with larger shares leaves none with smaller.
    let mut firmness = 1.0;
    for _ in 0..ROUNDS {
        let problem = Problem::new(&knot_path, limits, &shares);
        let parametrisation = loop {
            match parametrisation_of(&knot_path, &problem, *rates.peek()?, tolerances) {
                Some(parametrisation) => break parametrisation,
                None => rates.next(),
            };
        };
        let remedy = lessen(
            &mut shares,
            (&parametrisation, first),
            firmness,
            &knot_path,
            sequence,
            (limits, tolerances),
        );
        if remedy.is_none {
            return Some(parametrisation);
        }
        // From the back, so that the numbers of those before stay.
        for &k in remedy.halved.iter().rev() {
            shares.insert(k, shares[k]);
        }
        knot_path.halve(&remedy.halved, sequence, limits);
        firmness *= tolerances.firmer_r;
    }
    None
}

fn parametrisation_of(
    knot_path: &KnotPath,
    problem: &Problem,
    rate_r: f64,
    tolerances: &SolverTolerances,
) -> Option<Parametrisation> {
    let x = solve(problem, knot_path.initial(rate_r), tolerances)?;
    let mut builder = Builder::new();
    let zero = PathState {
        position_s: 0.0,
        speed_v: 0.0,
        accel_a: 0.0,
    };
    // Ends at rest are as fast as the start.
    // Time scaled by 1/r scales jerk by r³.
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
        // Backward from the rest: v = ½·J·t², and a = −J·t.
        let state = PathState {
            position_s: knot_path.inner()[1],
            speed_v: 0.5 * jerk_j * duration_t * duration_t,
            accel_a: -jerk_j * duration_t,
        };
        builder.push_phase(state, jerk_j, duration_t);
    }
    let end = PathState {
        position_s: knot_path.length_s,
        speed_v: knot_path.ends_v[1] * knot_path.ends_at(rate_r)[1],
        accel_a: 0.0,
    };
    Some(builder.finish(end, knot_path.nominal.as_ref().map(Nominal::motion)))
}
