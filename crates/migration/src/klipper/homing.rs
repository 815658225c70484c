//! The homing of joints, from Klipper's endstops.
//!
//! Klipper goes to the endstop at `homing_speed`, retracts, and goes there again at
//! `second_homing_speed`; the position is that of the endstop then, and the joint stays there.

use super::{LETTERS, Machine};
use crate::draft::float;
use crate::inputs::{At, Fate};

/// Klipper's where `homing_speed` is not there, mm/s.
const SPEED: f64 = 5.0;
/// A search of Klipper's ends after so many times the travel.
const SEARCH_SCALAR: f64 = 1.5;

impl Machine {
    /// `[home.J0]` to `[home.J2]` of a cartesian machine, then those of second joints.
    pub(super) fn homing(&mut self) {
        let mut has_home = false;
        let mut second = Vec::new();
        for (joint, letter) in LETTERS.into_iter().enumerate() {
            let own = self.second_joint(letter);
            let sequence = match own {
                None => (joint + 1).to_string(),
                Some(_) => format!("-{}", joint + 1),
            };
            has_home |= self.home_of(joint, &format!("stepper_{letter}"), &sequence);
            second.extend(own.map(|own| (joint, letter, own, sequence)));
        }
        for (joint, (first, letter, own, sequence)) in (LETTERS.len()..).zip(second) {
            // It goes to the position of the first one.
            if self.inputs.find(&own, "endstop_pin").is_some() {
                self.home_of(joint, &format!("stepper_{letter}"), &sequence);
            } else {
                let note = format!(
                    "[{own}] has no endstop_pin: to be squared, the joint needs an edge of its own, and the \
                     keys of [home.J{first}]"
                );
                self.draft.remark(&format!("home.J{joint}"), &note);
            }
        }
        if has_home {
            let text = "source = \"drives\" and homing = \"controller\" bring the joints home as [home.J0] \
                        says, once each has its clearance, how far it may go past the edge of its switch; \
                        Klipper has none";
            self.draft.remark("feedback", text);
        }
    }

    /// A joint's keys; whether it has an endstop of its own.
    fn home_of(&mut self, joint: usize, section: &str, sequence: &str) -> bool {
        let table = format!("home.J{joint}");
        let Some((at, endstop)) = self.number(section, "position_endstop") else {
            // A probe is its endstop, or it has none.
            return false;
        };
        let min = self
            .number(section, "position_min")
            .map_or(0.0, |(_, min)| min);
        let max = self.number(section, "position_max").map(|(_, max)| max);
        let Some(is_positive) = self.direction(section, endstop, min, max) else {
            let note = "on which side it comes home is not said: homing_positive_dir, or a \
                        position_endstop near an end of the travel";
            self.draft.remark(&table, note);
            self.inputs.decide(at, Fate::Changed, note);
            return false;
        };
        let sign = if is_positive { 1.0 } else { -1.0 };
        let speed = self.number(section, "homing_speed");
        let search_v = speed.map_or(SPEED, |(_, speed)| speed);
        self.speed(
            &table,
            "search_velocity",
            speed.map(|(at, _)| at),
            sign * search_v,
        );
        let second = self.number(section, "second_homing_speed");
        let retract = self.number(section, "homing_retract_dist");
        // Without a retraction there is no second time.
        let is_twice = retract.is_none_or(|(_, way)| way > 0.0);
        let latch_v = match second {
            Some((_, speed)) if is_twice => speed,
            _ if is_twice => search_v / 2.0,
            _ => search_v,
        };
        self.speed(
            &table,
            "latch_velocity",
            second.map(|(at, _)| at),
            sign * latch_v,
        );
        let from = self.inputs.name(at);
        for key in ["offset", "position"] {
            self.draft.known(&table, key, float(endstop), &from);
        }
        let note = format!("{table}.offset and position: the joint stays at the edge");
        self.inputs.decide(at, Fate::Converted, note);
        let way = if is_positive {
            Some(endstop - min)
        } else {
            max.map(|max| max - endstop)
        };
        if let Some(way) = way.filter(|way| *way > 0.0) {
            let from = "1.5 times the way to the other end, as Klipper does";
            let most = float(SEARCH_SCALAR * way);
            self.draft.known(&table, "search_travel", most, from);
        }
        let from = match sequence.starts_with('-') {
            false => "G28's order",
            true => "G28's order; both joints of the axis go together",
        };
        self.draft
            .known(&table, "sequence", sequence.to_owned(), from);
        if let Some((at, _)) = retract {
            let note = "the joint goes off its switch as far as that takes; 0 makes latch_velocity that of \
                        the search";
            self.inputs.decide(at, Fate::Changed, note);
        }
        if let Some((at, _)) = self.number(section, "homing_retract_speed") {
            let note = "the joint goes off its switch at search_velocity";
            self.inputs.decide(at, Fate::NoCounterpart, note);
        }
        true
    }

    fn speed(&mut self, table: &str, key: &str, at: Option<At>, speed: f64) {
        let from = match at {
            Some(at) => self.inputs.name(at),
            None => "not there: Klipper's".to_owned(),
        };
        self.draft.known(table, key, float(speed), &from);
        if let Some(at) = at {
            let note = format!("{table}.{key}, with its direction");
            self.inputs.decide(at, Fate::Converted, note);
        }
    }

    /// Whether a joint comes home upwards: as said, or by the quarter of the travel that its endstop
    /// is in, as Klipper takes it.
    fn direction(
        &mut self,
        section: &str,
        endstop: f64,
        min: f64,
        max: Option<f64>,
    ) -> Option<bool> {
        if let Some((at, text)) = self.inputs.text(section, "homing_positive_dir") {
            let is_positive = ["true", "1", "yes", "on"]
                .iter()
                .any(|word| text.eq_ignore_ascii_case(word));
            let note = "the signs of search_velocity and latch_velocity";
            self.inputs.decide(at, Fate::Converted, note);
            return Some(is_positive);
        }
        let max = max?;
        let quarter = (max - min) / 4.0;
        if endstop <= min + quarter {
            Some(false)
        } else if endstop >= max - quarter {
            Some(true)
        } else {
            None
        }
    }
}
