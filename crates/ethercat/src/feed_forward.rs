//! The feed-forward of a drive: the velocity and the torque that a target takes, told with it.
//!
//! The loops of a drive see no more than positions, and act when there is an error. What the motion takes is
//! known before: with v and a of the target at the SYNC0 at which it takes effect,
//!
//! ```text
//! 0x60B1 = k v                                           in the drive's unit of velocity
//! 0x60B2 = m a + c v + f tanh(v / v₀)                    in thousandths of the rated torque
//! ```
//!
//! with the inertia m, the viscous friction c and the Coulomb friction f, which turns around between −v₀ and v₀
//! as a whole and not at once.

/// The feed-forward of a drive. What is `None` is not in its process data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedForward {
    /// What a mm/s or °/s is in the drive's unit of velocity, of 0x60B1.
    pub velocity_units: Option<f64>,
    /// What a motion takes of torque, for 0x60B2.
    pub torque: Option<TorqueModel>,
}

/// What a motion takes of torque, in thousandths of the rated one (0x6076).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueModel {
    /// For a mm/s² or °/s².
    pub per_acceleration: f64,
    /// For a mm/s or °/s: viscous friction.
    pub per_velocity: f64,
    /// For motion at all: Coulomb friction.
    pub coulomb: f64,
    /// At this speed three quarters of that are told, mm/s or °/s, > 0.
    pub coulomb_v: f64,
    /// The most that is told, either way.
    pub most: f64,
}

/// The offsets of a target, as a drive takes them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Offsets {
    /// 0x60B1.
    pub velocity: i32,
    /// 0x60B2.
    pub torque: i16,
}

impl Offsets {
    /// Those of what stands.
    pub(crate) const NONE: Self = Self {
        velocity: 0,
        torque: 0,
    };
}

impl TorqueModel {
    /// The torque of a motion at a velocity and an acceleration, before it is limited.
    #[must_use]
    pub fn torque(&self, velocity: f64, acceleration: f64) -> f64 {
        self.per_acceleration * acceleration
            + self.per_velocity * velocity
            + self.coulomb * (velocity / self.coulomb_v).tanh()
    }
}

impl FeedForward {
    /// What a target takes whose velocity and acceleration are these, counted in the direction of the drive.
    /// It saturates.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "it saturates")]
    pub fn offsets(&self, velocity: f64, acceleration: f64) -> Offsets {
        let told = self.velocity_units.unwrap_or(0.0) * velocity;
        let torque = self.torque.map_or(0.0, |model| {
            let most = model.most.min(f64::from(i16::MAX));
            model.torque(velocity, acceleration).clamp(-most, most)
        });
        Offsets {
            velocity: told.round() as i32,
            torque: torque.round() as i16,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORWARD: FeedForward = FeedForward {
        velocity_units: Some(1000.0),
        torque: Some(TorqueModel {
            per_acceleration: 0.25,
            per_velocity: 0.5,
            coulomb: 40.0,
            coulomb_v: 1.0,
            most: 500.0,
        }),
    };

    #[test]
    fn a_motion_takes_inertia_and_friction() {
        // By hand: 0.25 · 1000 + 0.5 · 100 + 40.
        let of = |velocity, acceleration| FORWARD.offsets(velocity, acceleration);
        let told = |velocity, torque| Offsets { velocity, torque };
        assert_eq!(of(100.0, 1000.0), told(100_000, 340));
        assert_eq!(of(-100.0, -1000.0), told(-100_000, -340));
        // It brakes: friction helps.
        assert_eq!(of(100.0, -1000.0), told(100_000, -160));
        // A part of the Coulomb friction: 40 tanh(0.5) = 18.48, and 0.25 of viscous.
        assert_eq!(of(0.5, 0.0), told(500, 19));
        assert_eq!(of(0.0, 0.0), Offsets::default());
    }

    #[test]
    fn torque_is_limited_and_velocity_saturates() {
        let told = FORWARD.offsets(1e9, 1e9);
        assert_eq!((told.velocity, told.torque), (i32::MAX, 500));
        let told = FORWARD.offsets(-1e9, -1e9);
        assert_eq!((told.velocity, told.torque), (i32::MIN, -500));
        assert_eq!(FORWARD.offsets(f64::NAN, f64::NAN).velocity, 0);
    }

    #[test]
    fn what_is_not_asked_for_is_zero() {
        let none = FeedForward {
            velocity_units: None,
            torque: None,
        };
        assert_eq!(none.offsets(100.0, 1000.0), Offsets::default());
    }
}
