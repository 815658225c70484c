//! The conversion of `[AXIS_l]`: limits and travel.

use super::Machine;
use crate::draft::float;
use crate::inputs::{At, Fate};

/// LinuxCNC's values for no limit are beyond this.
const ENDLESS: f64 = 1e9;

/// The largest play that is taken, mm.
const MOST_PLAY: f64 = 10.0;

/// Whether the first of two values is the stricter one.
type IsStricter = fn(&f64, &f64) -> bool;

/// What LinuxCNC calls a limit, ours, and which of two is the stricter one.
const LIMITS: [(&str, &str, IsStricter); 4] = [
    ("MIN_LIMIT", "min_position", f64::gt),
    ("MAX_LIMIT", "max_position", f64::lt),
    ("MAX_VELOCITY", "max_velocity", f64::lt),
    ("MAX_ACCELERATION", "max_acceleration", f64::lt),
];

impl Machine {
    pub(crate) fn axes(&mut self) {
        for letter in self.letters.clone() {
            self.axis(letter);
            self.backlash(letter);
        }
    }

    /// The joints of an axis, where joints are axes.
    fn joints_of_axis(&self, letter: char) -> Vec<usize> {
        if self.kinematics != Some("trivial") {
            return Vec::new();
        }
        let own = self.joints.iter().filter(|(_, of)| *of == letter);
        own.map(|(joint, _)| *joint).collect()
    }

    /// The play of a joint, where joints are axes and each axis has one.
    fn backlash(&mut self, letter: char) {
        let &[joint] = self.joints_of_axis(letter).as_slice() else {
            return;
        };
        let numbers = self.joint_numbers();
        let ours = numbers.into_iter().find(|(theirs, _)| *theirs == joint);
        let ours = ours.map_or(joint, |(_, ours)| ours);
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
                let table = format!("compensation.J{ours}");
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

    fn axis(&mut self, letter: char) {
        let table = format!("axis.{letter}");
        // The limits of a joint are those of its axis where every joint is one; all joints of a gantry move with it.
        let joints = self.joints_of_axis(letter);
        let mut sections = vec![format!("AXIS_{letter}")];
        sections.extend(joints.iter().map(|joint| format!("JOINT_{joint}")));
        for (theirs, ours, is_stricter) in LIMITS {
            let limits = sections.iter();
            let limits: Vec<_> = limits
                .filter_map(|section| self.limit(section, theirs, letter))
                .collect();
            let found = limits.iter().copied().reduce(|kept, other| {
                if is_stricter(&other.1, &kept.1) {
                    other
                } else {
                    kept
                }
            });
            if limits.len() > 1 {
                let of = match joints.len() {
                    1 => "the stricter one of axis and joint",
                    _ => "the strictest one of the axis and its joints",
                };
                for (at, _) in limits {
                    self.inputs
                        .decide(at, Fate::Changed, format!("{table}.{ours}: {of}"));
                }
            }
            self.put(&table, ours, found, letter);
        }
        self.jerk(&table, &sections, letter);
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
    fn jerk(&mut self, table: &str, sections: &[String], letter: char) {
        let mut jerk: Option<(At, f64)> = None;
        for section in sections {
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
