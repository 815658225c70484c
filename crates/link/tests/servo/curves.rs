//! The curves between setpoints, and of the stop of its own.

use super::state;
use glidepath_link::servo::{JointState, Stop, StopLimits, quintic};
use proptest::prelude::*;

/// Value and first two derivatives of a polynomial, by Horner's rule on its coefficients.
fn polynomial(coefficients: &[f64; 6], t: f64) -> JointState {
    let derive = |c: &[f64]| -> Vec<f64> {
        c.iter()
            .enumerate()
            .skip(1)
            .map(|(n, c)| n as f64 * c)
            .collect()
    };
    let value = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * t + c);
    let first = derive(coefficients);
    let second = derive(&first);
    state(value(coefficients), value(&first), value(&second))
}

proptest! {
    #[test]
    fn the_quintic_through_two_points_of_a_quintic_is_that_quintic(
        coefficients in proptest::array::uniform6(-10.0..10.0),
        span_t in 0.1..2.0,
        fraction in 0.0..=1.0,
    ) {
        let (from, to) = (polynomial(&coefficients, 0.0), polynomial(&coefficients, span_t));
        let expected = polynomial(&coefficients, fraction * span_t);
        let found = quintic(&from, &to, span_t, fraction * span_t);
        // Conditioning: differences of values up to 10³, divided by h².
        prop_assert!((found.position - expected.position).abs() < 1e-11);
        prop_assert!((found.velocity - expected.velocity).abs() < 1e-9);
        prop_assert!((found.acceleration - expected.acceleration).abs() < 1e-8);
        prop_assert_eq!(quintic(&from, &to, span_t, 0.0), from);
        prop_assert_eq!(quintic(&from, &to, span_t, span_t), to);
    }

    #[test]
    fn a_stop_ends_at_rest_within_its_limits(
        velocity in -300.0..300.0,
        acceleration in -4000.0..4000.0,
        limit in 500.0..5000.0,
        jerk in 10_000.0..1e6,
    ) {
        let from = state(5.0, velocity, acceleration);
        let stop = Stop::new(from, StopLimits { acceleration: limit, jerk });
        let duration_t = stop.duration_t();
        prop_assert_eq!(stop.at(0.0), from);
        let end = stop.at(duration_t + 1.0);
        prop_assert_eq!((end.velocity, end.acceleration), (0.0, 0.0));
        prop_assert_eq!(stop.at(duration_t + 2.0), end);
        // Just before the end it is at rest by itself.
        let nearly = stop.at(duration_t * (1.0 - 1e-9));
        prop_assert!(nearly.velocity.abs() < 1e-4, "{}", nearly.velocity);
        prop_assert!(nearly.acceleration.abs() < 1e-2, "{}", nearly.acceleration);
        let limit = limit.max(acceleration.abs()) * (1.0 + 1e-9);
        let steps = 500;
        let dt = duration_t / f64::from(steps);
        let mut before = from;
        for step in 1..=steps {
            let now = stop.at(f64::from(step) * dt);
            prop_assert!(now.acceleration.abs() <= limit);
            let rounding = 1e-9 * limit;
            prop_assert!((now.acceleration - before.acceleration).abs() <= jerk * dt + rounding);
            // The velocity is the integral of the acceleration, the position that of the velocity:
            // by the trapezoidal rule, whose error is bounded by the jerk.
            let mean_a = 0.5 * (now.acceleration + before.acceleration);
            let dv = now.velocity - before.velocity;
            prop_assert!((dv - mean_a * dt).abs() <= jerk * dt * dt + 1e-9);
            let mean_v = 0.5 * (now.velocity + before.velocity);
            let dp = now.position - before.position;
            prop_assert!((dp - mean_v * dt).abs() <= limit * dt * dt + 1e-9);
            before = now;
        }
    }

    #[test]
    fn a_stop_is_the_shortest_within_its_limits(
        velocity in 0.0..300.0,
        limit in 500.0..5000.0,
        jerk in 10_000.0..1e6,
    ) {
        // From steady motion: the trapezoid of deceleration, or the triangle if the limit is not
        // met.
        let stop = Stop::new(state(0.0, velocity, 0.0), StopLimits { acceleration: limit, jerk });
        let shortest_t = if velocity * jerk <= limit * limit {
            2.0 * (velocity / jerk).sqrt()
        } else {
            velocity / limit + limit / jerk
        };
        prop_assert!((stop.duration_t() - shortest_t).abs() < 1e-9);
        let mirrored = Stop::new(state(0.0, -velocity, 0.0), StopLimits { acceleration: limit, jerk });
        prop_assert_eq!(mirrored.at(0.3 * shortest_t).position, -stop.at(0.3 * shortest_t).position);
    }
}
