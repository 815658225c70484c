//! Is a motion inside the travel of every axis, between periods, too?
//!
//! Positions at the periods are judged as the interpolator judges them. Between two of them the motion
//! is the quintic through both states ([`super::between_periods`]), which is in the hull of its Bézier
//! points; where they are not inside, it is halved.

use super::between_periods::BetweenPeriods;
use glidepath_geometry::AXES;
use glidepath_program::{Limits, Travel};

/// What the motion may swing beyond an end between two periods, as a share of what jerk does in one: less than
/// the [`Travel::SWING_R`] that a motion inside may be seen beyond. One that comes to rest there within a
/// period, with all of the jerk, makes J·T³/768, and no motion on the grid of periods avoids it.
const SWING_R: f64 = 1.0 / 400.0;
/// Halvings of a period at most.
const HALVINGS: u32 = 6;

/// True if the motion of a period is inside the travel.
pub(super) fn is_inside(limits: &Limits, period: &BetweenPeriods<'_>) -> bool {
    let Travel { lowest, highest } = &limits.travel;
    let t = period.period_t;
    (0..AXES).all(|i| {
        let (low, high) = (lowest[i], highest[i]);
        if !low.is_finite() && !high.is_finite() {
            return true;
        }
        let at = period.to.position[i];
        if at < low - Travel::ROUNDING || at > high + Travel::ROUNDING {
            return false;
        }
        let swing = SWING_R * limits.jerk[i] * t * t * t + Travel::ROUNDING;
        holds(&period.bezier(i), (low - swing, high + swing), HALVINGS)
    })
}

/// True if no part of a curve is found beyond.
fn holds(points: &[f64; 6], (low, high): (f64, f64), halvings: u32) -> bool {
    let is_inside = |point: &f64| *point >= low && *point <= high;
    if points.iter().all(is_inside) {
        return true;
    }
    let [first, .., last] = points;
    if halvings == 0 || !is_inside(first) || !is_inside(last) {
        return is_inside(first) && is_inside(last);
    }
    let (mut left, mut right) = (*points, *points);
    for (level, point) in left.iter_mut().enumerate() {
        *point = right[0];
        for k in 0..points.len() - 1 - level {
            right[k] = 0.5 * (right[k] + right[k + 1]);
        }
    }
    holds(&left, (low, high), halvings - 1) && holds(&right, (low, high), halvings - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::in_tube::period::State;
    use glidepath_geometry::AxisVector;

    /// Whether a motion from x to y with these velocities, mm/s, is inside −1 … 0 on the first axis.
    fn inside(x: [f64; 2], v: [f64; 2], jerk: f64) -> bool {
        let mut limits = Limits::uniform(100.0, 500.0, jerk);
        (limits.travel.lowest[0], limits.travel.highest[0]) = (-1.0, 0.0);
        let state = |k: usize| {
            let mut state = State::rest(AxisVector::zeros());
            (state.position[0], state.velocity[0]) = (x[k], v[k]);
            state
        };
        let period = BetweenPeriods {
            from: &state(0),
            to: &state(1),
            period_t: 0.004,
        };
        is_inside(&limits, &period)
    }

    #[test]
    fn what_is_beyond_at_a_period_or_between_is_found() {
        assert!(inside([0.0, 0.0], [0.0; 2], 1e4));
        assert!(inside([-1.0, -0.9], [10.0, 30.0], 1e4));
        assert!(!inside([0.0, 2e-9], [0.0; 2], 1e4));
        assert!(inside([0.0, 5e-10], [0.0; 2], 1e4));
        assert!(!inside([-1.0, -1.0 - 2e-9], [0.0; 2], 1e4));
        // There and back within the period: 3 µm over.
        assert!(!inside([0.0, 0.0], [2.5, -2.5], 1e4));
        assert!(!inside([-1.0, -1.0], [-2.5, 2.5], 1e4));
        assert!(inside([-0.004, -0.004], [2.5, -2.5], 1e4));
    }

    #[test]
    fn a_rest_within_a_period_is_inside() {
        let (t, jerk) = (0.004, 1e4);
        let mut limits = Limits::uniform(100.0, 500.0, jerk);
        limits.travel.highest[0] = 0.0;
        for k in 1..40 {
            let rest_t = t * f64::from(k) / 40.0;
            let mut from = State::rest(AxisVector::zeros());
            from.position[0] = -jerk * rest_t.powi(3) / 6.0;
            from.velocity[0] = jerk * rest_t.powi(2) / 2.0;
            from.acceleration[0] = -jerk * rest_t;
            let to = State::rest(AxisVector::zeros());
            let period = BetweenPeriods {
                from: &from,
                to: &to,
                period_t: t,
            };
            assert!(is_inside(&limits, &period), "{k}");
        }
    }
}
