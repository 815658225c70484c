//! A phase of constant jerk.

/// Motion along the path at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathState {
    /// Position from the start of the profile, mm.
    pub position_s: f64,
    /// Speed, mm/s.
    pub speed_v: f64,
    /// Acceleration, mm/s².
    pub accel_a: f64,
}

/// Steps for the time at a position: bisection alone comes to rounding in as many.
const STEPS: u32 = 60;
/// Change of that time, in durations of the phase, at which it is taken for found.
const EXACT_R: f64 = 1e-12;

/// One phase of constant jerk, with the state at its start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Phase {
    pub(super) start_t: f64,
    pub(super) duration_t: f64,
    pub(super) jerk_j: f64,
    pub(super) accel_a: f64,
    pub(super) speed_v: f64,
    pub(super) position_s: f64,
}

impl Phase {
    pub(super) fn at(&self, t: f64) -> PathState {
        PathState {
            position_s: self.position_s
                + t * (self.speed_v + t * (self.accel_a / 2.0 + t * (self.jerk_j / 6.0))),
            speed_v: self.speed_v + t * (self.accel_a + t * (self.jerk_j / 2.0)),
            accel_a: self.accel_a + t * self.jerk_j,
        }
    }

    /// When the position is `s`, within the phase: cubic in time, solved by Newton steps in a
    /// bracket. The closed form of a cubic loses digits where jerk is small beside speed; and next to a
    /// rest, where the speed is nearly 0, Newton's step alone leads far away.
    pub(super) fn time_at(&self, s: f64) -> f64 {
        let (mut low_t, mut high_t) = (0.0, self.duration_t);
        let mut t = ((s - self.position_s) / self.speed_v)
            .max(0.0)
            .min(0.5 * high_t);
        for _ in 0..STEPS {
            let state = self.at(t);
            let error_s = state.position_s - s;
            if error_s > 0.0 {
                high_t = t;
            } else {
                low_t = t;
            }
            let newton_t = t - error_s / state.speed_v;
            let next_t = if newton_t >= low_t && newton_t <= high_t {
                newton_t
            } else {
                0.5 * (low_t + high_t)
            };
            if (next_t - t).abs() <= EXACT_R * self.duration_t {
                return next_t;
            }
            t = next_t;
        }
        t
    }
}
