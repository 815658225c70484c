//! The motor of a spindle: its speed follows what it is told as fast as its torque lets it, and it runs
//! out without power.

/// The modes: cyclic synchronous velocity, profile velocity, velocity of inverters.
const CYCLIC_VELOCITY: i8 = 9;
const PROFILE_VELOCITY: i8 = 3;
const VELOCITY: i8 = 2;
/// An inverter's ramp is enabled, not held, and takes the target for its input.
const RAMP_BITS: u16 = 0x70;

/// What turns a spindle, beside its drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleMotor {
    /// Counts of a revolution, by which 0x60FF and 0x606C are counts/s.
    pub counts_per_rev: f64,
    /// What its torque makes of its inertia, rev/min in a second.
    pub torque_rpm_per_s: f64,
    /// Time constant in which it runs out without power, s.
    pub coast_t: f64,
}

impl SpindleMotor {
    /// counts/s in which there is a rev/min.
    pub(crate) fn of_rpm(&self, rpm: f64) -> f64 {
        rpm / 60.0 * self.counts_per_rev
    }

    /// The velocity that the drive is told, counts/s; `None` if its mode is none of velocity.
    /// It has a target in counts/s, and one in rev/min.
    pub(crate) fn told(
        &self,
        (mode, control): (i8, u16),
        (velocity, speed_rpm): (i32, i16),
    ) -> Option<f64> {
        match mode {
            CYCLIC_VELOCITY | PROFILE_VELOCITY => Some(velocity.into()),
            VELOCITY if control & RAMP_BITS == RAMP_BITS => Some(self.of_rpm(speed_rpm.into())),
            VELOCITY => Some(0.0),
            _ => None,
        }
    }

    /// The velocity after a step, counts/s: towards what is told with power, to rest without.
    pub(crate) fn next(&self, velocity: f64, told: Option<f64>, step_t: f64) -> f64 {
        let most = self.of_rpm(self.torque_rpm_per_s) * step_t;
        told.map_or_else(
            || velocity * (-step_t / self.coast_t).exp(),
            |told| velocity + (told - velocity).clamp(-most, most),
        )
    }
}
