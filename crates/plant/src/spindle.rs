//! A spindle that takes its time.

use glidepath_link::SpindleFlags;
use glidepath_program::Event;

/// How fast its speed changes, rev/s².
const RATE: f64 = 40.0;
/// How near to its speed it is at speed, rev/s.
const NEAR: f64 = 0.05;

#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Spindle {
    /// rev/s, without direction.
    asked: f64,
    /// 1 for M3, −1 for M4, 0 for M5.
    direction: f64,
    pub(crate) speed: f64,
    /// Revolutions.
    pub(crate) angle: f64,
}

impl Spindle {
    pub(crate) fn take(&mut self, event: Event) {
        match event {
            Event::SpindleSpeed(per_min) => self.asked = per_min / 60.0,
            Event::MCode(3) => self.direction = 1.0,
            Event::MCode(4) => self.direction = -1.0,
            Event::MCode(5) => self.direction = 0.0,
            _ => {}
        }
    }

    pub(crate) fn step(&mut self, step_t: f64) {
        let away = self.asked * self.direction - self.speed;
        self.speed += away.clamp(-RATE * step_t, RATE * step_t);
        self.angle += self.speed * step_t;
    }

    /// Index pulses so far, counted at whole revolutions.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "far below the bound"
    )]
    pub(crate) fn index_count(&self) -> u64 {
        self.angle.abs() as u64
    }

    pub(crate) fn flags(&self) -> SpindleFlags {
        let asked = self.asked * self.direction;
        let is_near = (self.speed - asked).abs() < NEAR;
        let at_speed = if is_near { SpindleFlags::AT_SPEED.0 } else { 0 };
        let stopped = if self.speed.abs() < NEAR {
            SpindleFlags::STOPPED.0
        } else {
            0
        };
        SpindleFlags(at_speed | stopped)
    }
}
