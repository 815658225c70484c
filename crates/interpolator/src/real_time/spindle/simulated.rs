//! The simulated spindle of a machine whose drives are simulated: it turns as it is told to.
//!
//! It turns by ticks, and only while somebody looks: a tick that is missed on a desk does no harm.

use super::seen::SpindleSeen;
use crate::shared::message::observation::Turn;
use glidepath_program::Event;

/// How fast its speed changes, rev/s².
const ACCELERATION: f64 = 40.0;

/// A simulated spindle: what it was told, and what it does.
#[derive(Debug, Default)]
pub(crate) struct SimulatedSpindle {
    /// rev/s, without direction.
    told: f64,
    /// 1 for M3, −1 for M4, 0 for M5, M6 and M19.
    direction: f64,
    speed: f64,
    /// Revolutions.
    angle: f64,
}

impl SimulatedSpindle {
    /// Obeys an event.
    pub(crate) fn hear(&mut self, event: Event) {
        match event {
            Event::SpindleSpeed(per_min) => self.told = per_min / 60.0,
            Event::MCode(3) => self.direction = 1.0,
            Event::MCode(4) => self.direction = -1.0,
            // Tools are changed, and it is turned to an angle, at rest.
            Event::MCode(5 | 6 | 19) => self.direction = 0.0,
            _ => {}
        }
    }

    /// Turns for a period. What is seen of it is of `at_ns`.
    pub(crate) fn turn(&mut self, period_t: f64, at_ns: u64) -> SpindleSeen {
        let away = self.told * self.direction - self.speed;
        let most = ACCELERATION * period_t;
        let change = away.clamp(-most, most);
        self.angle += period_t * (self.speed + 0.5 * change);
        self.speed += change;
        SpindleSeen {
            turn: Turn {
                sample_ns: at_ns,
                angle: self.angle,
                speed: self.speed,
                acceleration: change / period_t,
                is_settled: true,
                index_count: None,
            },
            at_speed: change.abs() < most,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Event, SimulatedSpindle};

    #[test]
    fn it_stops_for_a_tool_and_to_be_oriented() {
        for code in [5, 6, 19] {
            let mut spindle = SimulatedSpindle::default();
            for event in [Event::SpindleSpeed(600.0), Event::MCode(3)] {
                spindle.hear(event);
            }
            assert!(spindle.turn(1.0, 0).turn.speed > 9.0);
            spindle.hear(Event::MCode(code));
            assert!(spindle.turn(1.0, 1).turn.speed.abs() < 1e-12, "M{code}");
        }
    }
}
