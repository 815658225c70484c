//! The jerk between the setpoints of a plan, at the period of the bus.
//!
//! A plan keeps its limits at its own period. Between two setpoints the demand is the quintic through
//! both, which is the motion that was planned as long as its jerk is one: where an S-curve changes it
//! inside a period, the curve bends more sharply for a moment. Third differences see that the more,
//! the shorter they are.

use glidepath_link::servo::{JointState, quintic};
use glidepath_tests::settings;

use super::judge::JOINTS;

/// Places of SYNC0 in its period that are tried.
const PHASES: u32 = 50;

/// The largest third difference of the demand, of the limit of the jerk, wherever in a period of the
/// setpoints the SYNC0 are.
pub(super) fn jerk_ratio(states: &[[JointState; JOINTS]], period_t: f64) -> f64 {
    let jerk_j = settings().limits.jerk[0];
    let mut largest = 0.0_f64;
    for joint in 0..JOINTS {
        let states: Vec<_> = states.iter().map(|states| states[joint]).collect();
        for phase in 0..PHASES {
            let phase_t = period_t * f64::from(phase) / f64::from(PHASES);
            largest = largest.max(third_difference(&states, phase_t, period_t));
        }
    }
    largest / period_t.powi(3) / jerk_j
}

/// The largest of the demand for one joint, mm.
fn third_difference(states: &[JointState], phase_t: f64, period_t: f64) -> f64 {
    let span_t = settings().period_t;
    let demand = |nth: u32| {
        let time_t = phase_t + f64::from(nth) * period_t;
        let place = (time_t / span_t) as usize;
        let (from, to) = (states.get(place)?, states.get(place + 1)?);
        Some(quintic(from, to, span_t, time_t - place as f64 * span_t).position)
    };
    let demands: Vec<f64> = (0..).map_while(demand).collect();
    let differences = demands
        .windows(4)
        .map(|p| (p[3] - 3.0 * p[2] + 3.0 * p[1] - p[0]).abs());
    differences.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten setpoints of a motion at the limit of the jerk, which turns over at a time, periods.
    fn turned_over_at(periods: f64) -> Vec<[JointState; JOINTS]> {
        let (span_t, jerk_j) = (settings().period_t, settings().limits.jerk[0]);
        let state = |nth: u32| {
            let (time_t, turned_t) = (f64::from(nth) * span_t, periods * span_t);
            let after_t = (time_t - turned_t).max(0.0);
            JointState {
                position: jerk_j * (time_t.powi(3) - 2.0 * after_t.powi(3)) / 6.0,
                velocity: jerk_j * (time_t.powi(2) - 2.0 * after_t.powi(2)) / 2.0,
                acceleration: jerk_j * (time_t - 2.0 * after_t),
            }
        };
        (0..10).map(|nth| [state(nth); JOINTS]).collect()
    }

    #[test]
    fn a_jerk_that_stays_is_seen_as_it_is() {
        for period_t in [0.001, 0.002, 0.004] {
            let ratio = jerk_ratio(&turned_over_at(20.0), period_t);
            assert!((ratio - 1.0).abs() < 1e-6, "{period_t}: {ratio}");
            // At a setpoint.
            let ratio = jerk_ratio(&turned_over_at(5.0), period_t);
            assert!((ratio - 1.0).abs() < 1e-6, "{period_t}: {ratio}");
        }
    }

    #[test]
    fn a_jerk_that_turns_over_inside_a_period_is_seen_as_more() {
        // By integrals of how the third difference of a quintic answers to jerk.
        for (period_t, wanted) in [(0.001, 1.1724), (0.002, 1.0392), (0.004, 1.0026)] {
            let places = (0..100).map(|nth| 5.0 + 0.01 * f64::from(nth));
            let ratios = places.map(|place| jerk_ratio(&turned_over_at(place), period_t));
            let largest = ratios.fold(0.0, f64::max);
            assert!((largest - wanted).abs() < 3e-4, "{period_t}: {largest}");
        }
    }
}
