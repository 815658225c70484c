//! The stop of a joint whose setpoints stay away: to rest as fast as its own limits allow.
//!
//! ```text
//!   a  ____                     from (v, a): jerk −J to the peak −A, hold it, jerk +J to zero,
//!   0 -----\------------/----   all for a velocity that is too large; mirrored for one too small.
//!           \__________/
//!         t₁      t₂    t₃
//! ```
//!
//! With the acceleration brought to zero at once the velocity would become v + a|a| / 2J; its sign
//! says which way to brake. Taking that sign as positive, the velocity lost on the way is
//!
//! ```text
//! v + a² / 2J = A² / J + A t₂
//! ```
//!
//! so without a hold the peak is A = √(J v + a² / 2); where that is above the limit, it is the
//! limit and t₂ follows. The stop leaves the path: nobody knows the path any more.

use super::JointState;

/// The limits of a joint's own stop, both > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopLimits {
    /// mm/s² or °/s². A joint that accelerates harder already may keep that value.
    pub acceleration: f64,
    /// mm/s³ or °/s³.
    pub jerk: f64,
}

/// A joint's way to rest; by default that of one which is at rest at zero.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stop {
    from: JointState,
    /// Jerk of the first phase; the last has the opposite.
    jerk_j: f64,
    /// Durations of the three phases.
    phases_t: [f64; 3],
}

impl Stop {
    /// The way to rest from a state.
    #[must_use]
    pub fn new(from: JointState, limits: StopLimits) -> Self {
        let JointState {
            velocity,
            acceleration,
            ..
        } = from;
        let jerk = limits.jerk;
        let coasting_v = velocity + acceleration * acceleration.abs() / (2.0 * jerk);
        let sign = if coasting_v < 0.0 { -1.0 } else { 1.0 };
        let (v, a) = (sign * velocity, sign * acceleration);
        let limit_a = limits.acceleration.max(a.abs());
        let to_lose_v = v + a * a / (2.0 * jerk);
        let peak_a = (jerk * v + 0.5 * a * a)
            .max(0.0)
            .sqrt()
            .min(limit_a)
            .max(-a);
        let hold_t = if peak_a > 0.0 {
            ((to_lose_v - peak_a * peak_a / jerk) / peak_a).max(0.0)
        } else {
            0.0
        };
        let phases_t = [(a + peak_a) / jerk, hold_t, peak_a / jerk];
        Self {
            from,
            jerk_j: -sign * jerk,
            phases_t,
        }
    }

    /// Time until rest, s.
    #[must_use]
    pub fn duration_t(&self) -> f64 {
        self.phases_t.iter().sum()
    }

    /// The state `time_t` ≥ 0 seconds after the start; at rest from [`Stop::duration_t`] on.
    #[must_use]
    pub fn at(&self, time_t: f64) -> JointState {
        let [first_t, hold_t, last_t] = self.phases_t;
        let mut state = self.from;
        let mut left_t = time_t.max(0.0);
        for (phase_t, jerk) in [
            (first_t, self.jerk_j),
            (hold_t, 0.0),
            (last_t, -self.jerk_j),
        ] {
            state = under_jerk(state, jerk, left_t.min(phase_t));
            left_t -= phase_t;
        }
        if left_t >= 0.0 {
            // Exactly at rest, not but for rounding.
            state.velocity = 0.0;
            state.acceleration = 0.0;
        }
        state
    }
}

/// The state after a time at constant jerk; the same state for a time ≤ 0.
fn under_jerk(from: JointState, jerk_j: f64, time_t: f64) -> JointState {
    if time_t <= 0.0 {
        return from;
    }
    let t = time_t;
    JointState {
        position: from.position
            + t * (from.velocity + t * (0.5 * from.acceleration + t * jerk_j / 6.0)),
        velocity: from.velocity + t * (from.acceleration + 0.5 * t * jerk_j),
        acceleration: from.acceleration + t * jerk_j,
    }
}
