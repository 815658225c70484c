//! The curve between two setpoints, for drives faster than the period.
//!
//! The quintic Hermite polynomial is the one of lowest degree with given position, velocity and
//! acceleration at both ends. With u = t / h from 0 to 1 and d = p₁ − p₀ it is
//!
//! ```text
//! p(u) = p₀ + h v₀ u + ½ h² a₀ u² + c₃ u³ + c₄ u⁴ + c₅ u⁵
//! c₃ =  10 d − h (6 v₀ + 4 v₁) − h² (3 a₀ −   a₁) / 2
//! c₄ = −15 d + h (8 v₀ + 7 v₁) + h² (3 a₀ − 2 a₁) / 2
//! c₅ =   6 d − h (3 v₀ + 3 v₁) − h² (  a₀ −   a₁) / 2
//! ```
//!
//! If the motion between the ends is of constant jerk, this is that motion, exactly.

/// Position, velocity and acceleration of one joint, units of the joint and seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointState {
    /// mm or degrees.
    pub position: f64,
    /// mm/s or °/s.
    pub velocity: f64,
    /// mm/s² or °/s².
    pub acceleration: f64,
}

impl JointState {
    /// The state after `time_t` seconds at constant acceleration.
    #[must_use]
    pub fn coast(self, time_t: f64) -> Self {
        let Self {
            position,
            velocity,
            acceleration,
        } = self;
        Self {
            position: position + time_t * (velocity + 0.5 * time_t * acceleration),
            velocity: velocity + time_t * acceleration,
            acceleration,
        }
    }
}

/// The state `time_t` seconds after `from` on the way to `to`, which is reached after `span_t` > 0
/// seconds; 0 ≤ `time_t` ≤ `span_t`.
///
/// Both ends are met bit for bit.
#[must_use]
pub fn quintic(from: &JointState, to: &JointState, span_t: f64, time_t: f64) -> JointState {
    if time_t <= 0.0 {
        return *from;
    }
    if time_t >= span_t {
        return *to;
    }
    let (h, u) = (span_t, time_t / span_t);
    let d = to.position - from.position;
    let (v0, v1) = (h * from.velocity, h * to.velocity);
    let (a0, a1) = (h * h * from.acceleration, h * h * to.acceleration);
    let c3 = 10.0 * d - (6.0 * v0 + 4.0 * v1) - 0.5 * (3.0 * a0 - a1);
    let c4 = -15.0 * d + (8.0 * v0 + 7.0 * v1) + 0.5 * (3.0 * a0 - 2.0 * a1);
    let c5 = 6.0 * d - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
    let offset = u * (v0 + u * (0.5 * a0 + u * (c3 + u * (c4 + u * c5))));
    let rate = v0 + u * (a0 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)));
    let bend = a0 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5));
    JointState {
        position: from.position + offset,
        velocity: rate / h,
        acceleration: bend / (h * h),
    }
}
