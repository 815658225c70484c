//! Changes of speed from and to any acceleration.

use super::phase::{PathState, Phase};
use super::ramp::PathLimits;

/// A time-optimal change from one speed and acceleration to another, position free: three phases of
/// jerk +, 0, − or −, 0, +.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedChange {
    /// Durations of the three phases, s.
    pub durations_t: [f64; 3],
    /// Their jerks, mm/s³.
    pub jerks_j: [f64; 3],
    /// The path it takes, mm.
    pub length_s: f64,
}

impl SpeedChange {
    /// From `(from_v, from_a)` to `(to_v, to_a)`; both accelerations within ±A.
    #[must_use]
    pub fn new(from: (f64, f64), to: (f64, f64), limits: PathLimits) -> Self {
        let PathLimits { accel_a, jerk_j } = limits;
        let ((from_v, from_a), (to_v, to_a)) = (from, to);
        // The speed that is reached by going from one acceleration to the other at once: above it the
        // change has to hump upwards first, below it downwards.
        let direct_v =
            from_v + (to_a - from_a).signum() * (to_a * to_a - from_a * from_a) / (2.0 * jerk_j);
        let direction = if to_v >= direct_v { 1.0 } else { -1.0 };
        // Each jerk phase changes the speed by (a_end² − a_start²)/(2·±J), so both together give the peak:
        // a_p² = ½(a₀² + a₁²) ± J·(v₁ − v₀).
        let peak_a = (0.5 * (from_a * from_a + to_a * to_a) + direction * jerk_j * (to_v - from_v))
            .max(0.0)
            .sqrt();
        let (peak_a, hold_t) = if peak_a > accel_a {
            let hold_v = to_v
                - from_v
                - direction * (accel_a * accel_a - from_a * from_a) / (2.0 * jerk_j)
                - direction * (accel_a * accel_a - to_a * to_a) / (2.0 * jerk_j);
            (direction * accel_a, hold_v / (direction * accel_a))
        } else {
            (direction * peak_a, 0.0)
        };
        let durations_t = [
            direction * (peak_a - from_a) / jerk_j,
            hold_t,
            direction * (peak_a - to_a) / jerk_j,
        ];
        let jerks_j = [direction * jerk_j, 0.0, -direction * jerk_j];
        let mut state = PathState {
            position_s: 0.0,
            speed_v: from_v,
            accel_a: from_a,
        };
        for (duration_t, jerk_j) in durations_t.into_iter().zip(jerks_j) {
            let phase = Phase {
                jerk_j,
                accel_a: state.accel_a,
                speed_v: state.speed_v,
                position_s: state.position_s,
                ..Phase::default()
            };
            state = phase.at(duration_t);
        }
        Self {
            durations_t,
            jerks_j,
            length_s: state.position_s,
        }
    }
}
