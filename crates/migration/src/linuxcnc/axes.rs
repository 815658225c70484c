//! The conversion of `[AXIS_l]`: limits and travel.

use super::Machine;
use crate::draft::float;
use crate::inputs::{At, Fate};

/// LinuxCNC's values for no limit are beyond this.
const ENDLESS: f64 = 1e9;

/// The largest play that is taken, mm.
const MOST_PLAY: f64 = 10.0;

/// How two values of the same kind become one.
type Stricter = fn(f64, f64) -> f64;

/// What LinuxCNC calls a limit, ours, and which of two is the stricter one.
const LIMITS: [(&str, &str, Stricter); 4] = [
    ("MIN_LIMIT", "min_position", f64::max),
    ("MAX_LIMIT", "max_position", f64::min),
    ("MAX_VELOCITY", "max_velocity", f64::min),
    ("MAX_ACCELERATION", "max_acceleration", f64::min),
];

impl Machine {
    pub(crate) fn axes(&mut self) {
        let mut done = Vec::new();
        for (joint, letter) in self.letters.clone().into_iter().enumerate() {
            if !done.contains(&letter) {
                done.push(letter);
                self.axis(letter, joint);
                self.backlash(letter, joint);
            }
        }
    }

    /// The play of a joint, where joints are axes and each axis has one.
    fn backlash(&mut self, letter: char, joint: usize) {
        let own = self
            .letters
            .iter()
            .filter(|other| **other == letter)
            .count()
            == 1;
        if self.kinematics != Some("trivial") || !own {
            return;
        }
        let section = format!("JOINT_{joint}");
        let Some((at, value)) = self.inputs.number(&section, "BACKLASH") else {
            return;
        };
        let has_table = self.inputs.find(&section, "COMP_FILE").is_some();
        match (value, self.units.of_letter(letter)) {
            (Ok(_), _) if has_table => {
                let note = "not used there beside COMP_FILE, whose two columns differ by it";
                self.inputs.decide(at, Fate::Changed, note);
            }
            (Ok(0.0), _) => {
                let note = "none, as where it is left out here";
                self.inputs.decide(at, Fate::Converted, note);
            }
            (Ok(value), Some(factor)) if value > 0.0 && value * factor <= MOST_PLAY => {
                let table = format!("compensation.J{joint}");
                let from = self.inputs.name(at);
                self.draft
                    .known(&table, "backlash", float(value * factor), &from);
                let note = format!(
                    "{table}.backlash: taken up inside the joint's limits, of which plans leave a share free"
                );
                self.inputs.decide(at, Fate::Changed, note);
            }
            _ => {
                let note = "not 0 to 10 mm, or not in a unit that is known";
                self.inputs.decide(at, Fate::NoCounterpart, note);
            }
        }
    }

    fn axis(&mut self, letter: char, joint: usize) {
        let table = format!("axis.{letter}");
        let axis = format!("AXIS_{letter}");
        // The limits of a joint are those of its axis where every axis has a drive of its own.
        let joint = (self.kinematics == Some("trivial")).then(|| format!("JOINT_{joint}"));
        for (theirs, ours, stricter) in LIMITS {
            let mut found = self.limit(&axis, theirs, letter);
            if let Some(joint) = &joint
                && let Some((at, value)) = self.limit(joint, theirs, letter)
            {
                found = Some(match found {
                    Some((first, other)) => {
                        let note = format!("{table}.{ours}: the stricter one of axis and joint");
                        self.inputs.decide(at, Fate::Changed, note.clone());
                        self.inputs.decide(first, Fate::Changed, note);
                        (first, stricter(other, value))
                    }
                    None => (at, value),
                });
            }
            self.put(&table, ours, found, letter);
        }
        self.jerk(&table, &axis, joint.as_deref(), letter);
    }

    /// A limit in our units; `None` if the file has none that can be used.
    fn limit(&mut self, section: &str, key: &str, letter: char) -> Option<(At, f64)> {
        let (at, value) = self.inputs.number(section, key)?;
        let is_end = key.ends_with("_LIMIT");
        match (value, self.units.of_letter(letter)) {
            (Err(why), _) => {
                self.inputs.decide(at, Fate::NoCounterpart, why);
                None
            }
            (Ok(_), None) => {
                let note = "its unit is not known";
                self.inputs.decide(at, Fate::NoCounterpart, note);
                None
            }
            (Ok(value), Some(_)) if value.abs() >= ENDLESS => {
                let note = if is_end && "ABC".contains(letter) {
                    "no limit: it is left out here"
                } else {
                    "no limit there; here there has to be one"
                };
                self.inputs.decide(at, Fate::Changed, note);
                None
            }
            (Ok(value), Some(_)) if !is_end && value <= 0.0 => {
                let note = "not above zero, which is no limit here";
                self.inputs.decide(at, Fate::NoCounterpart, note);
                None
            }
            (Ok(value), Some(factor)) => Some((at, value * factor)),
        }
    }

    fn put(&mut self, table: &str, key: &str, found: Option<(At, f64)>, letter: char) {
        let is_end = key.ends_with("_position");
        match found {
            Some((at, value)) => {
                let from = self.inputs.name(at);
                self.draft.known(table, key, float(value), &from);
                self.inputs
                    .decide(at, Fate::Converted, format!("{table}.{key}"));
            }
            None if is_end && "ABC".contains(letter) => {
                let remark = format!("{key} is left out: the axis turns without end");
                self.draft.remark(table, &remark);
            }
            None if is_end => self
                .draft
                .ask(table, key, "the soft limit, machine coordinates, mm"),
            None => self.draft.ask(table, key, "there is no such limit there"),
        }
    }

    /// Jerk, which only later versions of LinuxCNC know.
    fn jerk(&mut self, table: &str, axis: &str, joint: Option<&str>, letter: char) {
        let mut jerk: Option<(At, f64)> = None;
        for section in [Some(axis), joint].into_iter().flatten() {
            let Some((at, value)) = self.inputs.number(section, "MAX_JERK") else {
                continue;
            };
            match (value, self.units.of_letter(letter)) {
                (Ok(value), Some(factor)) if value > 0.0 && value < ENDLESS => {
                    let value = value * factor;
                    let stricter = jerk.is_none_or(|(_, other)| value < other);
                    if stricter {
                        jerk = Some((at, value));
                    }
                    self.inputs
                        .decide(at, Fate::Converted, format!("{table}.max_jerk"));
                }
                _ => {
                    let note = "no limit there; here jerk is limited always";
                    self.inputs.decide(at, Fate::Changed, note);
                }
            }
        }
        match jerk {
            Some((at, value)) => {
                let from = self.inputs.name(at);
                self.draft.known(table, "max_jerk", float(value), &from);
            }
            None => self.draft.ask(
                table,
                "max_jerk",
                "jerk is not limited there. Ten times max_acceleration is gentle, twenty a stiff mill, a \
                 hundred a light machine",
            ),
        }
    }
}
