//! The loops of a drive around a motor with inertia: position, velocity, torque.
//!
//! ```text
//!            0x60B1 ─┐          0x60B2 ─┐
//! 0x607A ─► P ───────┴─► PI ────────────┴─► limits of torque ─► motor: inertia, friction ─► 0x6064
//! ```
//!
//! Between two SYNC0 the target and its offsets go in a straight line to those of the second one, as in a drive
//! that interpolates. The loops run at 16 kHz. Coulomb friction is a torque against the motion that never turns
//! it around: it has no formula in common with what a master tells.

/// How long a step of the loops is at most, s.
const LOOP_T: f64 = 62.5e-6;

/// The loops of a drive, and its motor. Torques are thousandths of the rated one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionLoop {
    /// Velocity for an error of position, 1/s.
    pub position_gain: f64,
    /// Acceleration for an error of velocity, 1/s.
    pub velocity_gain: f64,
    /// The integral time of the loop of velocity, s.
    pub integral_t: f64,
    /// Torque for a count/s²: the inertia.
    pub inertia: f64,
    /// Torque for a count/s: viscous friction.
    pub viscous: f64,
    /// Torque against every motion: Coulomb friction.
    pub coulomb: f64,
}

/// What a drive has of the objects 0x60B1 and 0x60B2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OffsetAccess {
    /// It does not have them.
    #[default]
    None,
    /// It has them, and does not let them be mapped.
    Unmapped,
    /// They can be mapped.
    Mapped,
}

/// What the master tells at a SYNC0: counts, counts/s, thousandths of the rated torque.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Told {
    pub(crate) target: f64,
    pub(crate) velocity: f64,
    pub(crate) torque: f64,
}

/// The motor on its way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motor {
    loops: PositionLoop,
    /// counts/s.
    velocity: f64,
    /// What the loop of velocity has come to.
    integral: f64,
    told: Told,
}

impl Motor {
    /// One that stands.
    pub(crate) fn standing(loops: PositionLoop, place: f64) -> Self {
        Self {
            loops,
            velocity: 0.0,
            integral: 0.0,
            told: Told {
                target: place,
                ..Told::default()
            },
        }
    }

    /// Where it comes to from `place` in a step of `step_t` seconds. The torque is at most these, forwards and
    /// backwards.
    pub(crate) fn step(
        &mut self,
        place: f64,
        step_t: f64,
        told: Told,
        (forwards, backwards): (f64, f64),
    ) -> f64 {
        let before = core::mem::replace(&mut self.told, told);
        let loops = self.loops;
        let count = (step_t / LOOP_T).ceil().max(1.0);
        let part_t = step_t / count;
        let (mut place, mut nth) = (place, 0.0);
        while nth < count {
            let to = |from: f64, to: f64| from + (to - from) * nth / count;
            let behind = to(before.target, told.target) - place;
            let wanted = loops.position_gain * behind + to(before.velocity, told.velocity);
            let error = wanted - self.velocity;
            let torque = loops.inertia * loops.velocity_gain * error
                + self.integral
                + to(before.torque, told.torque);
            let limited = torque.clamp(-backwards, forwards);
            if loops.integral_t > 0.0 && (torque - limited).abs() <= 0.0 {
                self.integral +=
                    loops.inertia * loops.velocity_gain / loops.integral_t * error * part_t;
            }
            self.velocity = loops.driven(self.velocity, limited, part_t);
            place += self.velocity * part_t;
            nth += 1.0;
        }
        place
    }
}

impl PositionLoop {
    /// The velocity after a moment.
    fn driven(&self, velocity: f64, torque: f64, part_t: f64) -> f64 {
        let free = velocity + (torque - self.viscous * velocity) / self.inertia * part_t;
        let rubbed = (free.abs() - self.coulomb / self.inertia * part_t).max(0.0);
        rubbed.copysign(free)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOOPS: PositionLoop = PositionLoop {
        position_gain: 100.0,
        velocity_gain: 1000.0,
        integral_t: 0.01,
        inertia: 1e-4,
        viscous: 1e-4,
        coulomb: 20.0,
    };

    const MOST: (f64, f64) = (3000.0, 3000.0);

    /// How far it is behind its target at the end of two seconds at a velocity.
    fn behind(velocity: f64, told_velocity: f64) -> f64 {
        let (mut motor, mut place, mut target) = (Motor::standing(LOOPS, 0.0), 0.0, 0.0);
        for _ in 0..1000 {
            target += velocity * 0.002;
            let told = Told {
                target,
                velocity: told_velocity,
                torque: 0.0,
            };
            place = motor.step(place, 0.002, told, MOST);
        }
        target - place
    }

    #[test]
    fn it_is_behind_by_the_velocity_over_the_gain() {
        // The integral carries all friction.
        let error = behind(1e6, 0.0);
        assert!((error - 1e4).abs() < 1.0, "{error}");
        // A velocity that is told leaves nothing, or half of it a half.
        assert!(behind(1e6, 1e6).abs() < 1.0);
        assert!((behind(1e6, 5e5) - 5e3).abs() < 1.0);
    }

    #[test]
    fn torque_accelerates_by_the_inertia_and_is_limited() {
        let open = PositionLoop {
            position_gain: 0.0,
            velocity_gain: 0.0,
            viscous: 0.0,
            ..LOOPS
        };
        let mut motor = Motor::standing(open, 0.0);
        let told = Told {
            torque: 120.0,
            ..Told::default()
        };
        // The first step goes from no torque to all of it: begin behind it.
        let _ = motor.step(0.0, 0.001, told, MOST);
        let before = motor.velocity;
        let _ = motor.step(0.0, 0.01, told, MOST);
        let rate = (motor.velocity - before) / 0.01;
        assert!((rate - 1e6).abs() < 1.0, "{rate}");
        let before = motor.velocity;
        let _ = motor.step(0.0, 0.01, told, (70.0, 3000.0));
        let rate = (motor.velocity - before) / 0.01;
        assert!((rate - 5e5).abs() < 1.0, "{rate}");
    }

    #[test]
    fn friction_stops_a_motor_and_does_not_turn_it_around() {
        let mut velocity = 1e4;
        for _ in 0..10_000 {
            velocity = LOOPS.driven(velocity, 0.0, LOOP_T);
            assert!(velocity >= 0.0);
        }
        assert!(velocity <= 0.0);
        // Less torque than friction does not move it.
        assert!(LOOPS.driven(0.0, 19.0, LOOP_T) <= 0.0);
        assert!(LOOPS.driven(0.0, 21.0, LOOP_T) > 0.0);
    }
}
