//! A simulated spindle with an encoder.
//!
//! Its speed follows what it is told with a lag of first order, and changes no faster than its motor
//! can. The encoder rounds down to its counts, and has one index pulse a revolution.

use glidepath_link::SpindleFlags;
use glidepath_program::Event;

/// How near to its speed it is at speed, rev/s, or in parts of that.
const NEAR: f64 = 0.05;
const NEAR_PART: f64 = 0.005;

/// How fast it turns to an angle, rev/s, and how near it is there, revolutions.
const ORIENTING: f64 = 1.0;
const ORIENTED: f64 = 1e-4;

/// How much faster than its motor could a spindle stops that is stuck.
const STUCK: f64 = 10.0;

/// A spindle. By default it is stiff, and its encoder exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleSettings {
    /// How fast its speed changes at most, rev/s².
    pub acceleration: f64,
    /// Lag of its speed, s; 0 for none.
    pub lag_t: f64,
    /// Counts of its encoder in a revolution; 0 if it is exact.
    pub counts: u32,
    /// Its angle when it is switched on, in revolutions behind the index.
    pub angle: f64,
}

impl Default for SpindleSettings {
    fn default() -> Self {
        Self {
            acceleration: 40.0,
            lag_t: 0.0,
            counts: 0,
            angle: 0.0,
        }
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Spindle {
    settings: SpindleSettings,
    /// rev/s, without direction.
    asked: f64,
    /// 1 for M3, −1 for M4, 0 for M5, M6 and M19.
    direction: f64,
    /// What the operator makes of its speed.
    pub(crate) ratio: f64,
    /// The angle for the next M19, revolutions, and the one that it is to stand at.
    next_angle: f64,
    held_angle: Option<f64>,
    pub(crate) speed: f64,
    /// Revolutions.
    pub(crate) angle: f64,
    pub(crate) index_count: u64,
    pub(crate) part: f64,
    pub(crate) is_stuck: bool,
    pub(crate) is_index_lost: bool,
    pub(crate) is_encoder_lost: bool,
    /// What the encoder counted last.
    counted: f64,
}

impl Default for Spindle {
    fn default() -> Self {
        Self::new(SpindleSettings::default())
    }
}

impl Spindle {
    pub(crate) const fn new(settings: SpindleSettings) -> Self {
        Self {
            settings,
            asked: 0.0,
            direction: 0.0,
            ratio: 1.0,
            next_angle: 0.0,
            held_angle: None,
            speed: 0.0,
            angle: settings.angle,
            index_count: 0,
            part: 1.0,
            is_stuck: false,
            is_index_lost: false,
            is_encoder_lost: false,
            counted: settings.angle,
        }
    }

    pub(crate) fn take(&mut self, event: Event) {
        match event {
            Event::SpindleSpeed(per_min) => self.asked = per_min / 60.0,
            Event::MCode(3) => self.direction = 1.0,
            Event::MCode(4) => self.direction = -1.0,
            // Tools are changed, and it is turned to an angle, at rest: as the auxiliary record has it.
            Event::MCode(5 | 6 | 19) => self.direction = 0.0,
            Event::SpindleAngle { deg, .. } => self.next_angle = deg / 360.0,
            _ => {}
        }
        match event {
            Event::MCode(3..=5) => self.held_angle = None,
            Event::MCode(19) => self.held_angle = Some(self.next_angle),
            _ => {}
        }
    }

    pub(crate) fn step(&mut self, step_t: f64) {
        let SpindleSettings {
            acceleration,
            lag_t,
            counts,
            ..
        } = self.settings;
        let wanted = self.told() * self.part;
        let away = if self.is_stuck {
            -self.speed
        } else if lag_t > 0.0 {
            (wanted - self.speed) * (1.0 - (-step_t / lag_t).exp())
        } else {
            wanted - self.speed
        };
        let by_force = if self.is_stuck { STUCK } else { 1.0 };
        let (before, most) = ((self.speed, self.angle), by_force * acceleration * step_t);
        self.speed += away.clamp(-most, most);
        self.angle += f64::midpoint(before.0, self.speed) * step_t;
        if let Some(angle) = self.held_angle.filter(|_| self.speed.abs() < NEAR) {
            // The shorter way, whatever was asked for.
            let off = (angle - self.angle + 0.5).rem_euclid(1.0) - 0.5;
            let most = ORIENTING * step_t;
            self.angle += if self.is_stuck {
                0.0
            } else {
                off.clamp(-most, most)
            };
        }
        if !self.is_index_lost && (self.angle.floor() - before.1.floor()).abs() > 0.5 {
            self.index_count += 1;
        }
        if !self.is_encoder_lost {
            let counts = f64::from(counts);
            self.counted = if counts > 0.0 {
                (self.angle * counts).floor() / counts
            } else {
                self.angle
            };
        }
    }

    /// The speed that it is told to turn at, rev/s, below 0 for M4.
    fn told(&self) -> f64 {
        self.asked * self.ratio * self.direction
    }

    /// What the encoder says.
    pub(crate) const fn counted(&self) -> f64 {
        self.counted
    }

    pub(crate) fn flags(&self) -> SpindleFlags {
        let wanted = self.told() * self.part;
        let is_near = (self.speed - wanted).abs() < NEAR.max(NEAR_PART * wanted.abs());
        let flag = |is: bool, flag: SpindleFlags| if is { flag.0 } else { 0 };
        let is_oriented = self.held_angle.is_some_and(|angle| {
            let off = (angle - self.angle + 0.5).rem_euclid(1.0) - 0.5;
            off.abs() < ORIENTED && self.speed.abs() < NEAR
        });
        SpindleFlags(
            flag(is_oriented, SpindleFlags::ORIENTED)
                | flag(is_near, SpindleFlags::AT_SPEED)
                | flag(self.speed.abs() < NEAR, SpindleFlags::STOPPED)
                | SpindleFlags::SPEED.0
                | SpindleFlags::ANGLE.0
                | SpindleFlags::INDEX.0
                // Whatever gear it is told is in at once: none of them changes what it does.
                | SpindleFlags::IN_GEAR.0,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::{Spindle, SpindleFlags};
    use glidepath_program::{Event, OrientWay};

    #[test]
    fn it_stands_at_the_angle_of_m19_until_it_turns_again() {
        let mut spindle = Spindle::default();
        let way = OrientWay::Shortest;
        for event in [
            Event::SpindleSpeed(600.0),
            Event::MCode(3),
            Event::SpindleAngle { deg: 90.0, way },
            Event::MCode(19),
        ] {
            spindle.take(event);
            for _ in 0..1000 {
                spindle.step(0.001);
            }
        }
        assert!((spindle.angle.rem_euclid(1.0) - 0.25).abs() < 1e-4);
        assert!(spindle.flags().contains(SpindleFlags::ORIENTED));
        spindle.take(Event::MCode(6));
        assert!(spindle.flags().contains(SpindleFlags::ORIENTED));
        spindle.take(Event::MCode(3));
        assert!(!spindle.flags().contains(SpindleFlags::ORIENTED));
    }

    #[test]
    fn it_stops_for_a_tool_and_to_be_oriented() {
        for code in [5, 6, 19] {
            let mut spindle = Spindle::default();
            for event in [Event::SpindleSpeed(600.0), Event::MCode(3)] {
                spindle.take(event);
            }
            spindle.step(1.0);
            assert!((spindle.speed - 10.0).abs() < 1e-12);
            spindle.take(Event::MCode(code));
            spindle.step(1.0);
            assert!(spindle.speed.abs() < 1e-12, "M{code}: {}", spindle.speed);
        }
    }
}
