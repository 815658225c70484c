//! The homing of joints from `[JOINT_n]`, their following errors, and the settings of moving by
//! hand.

use super::{AXES, Machine};
use crate::draft::float;
use crate::inputs::Fate;

/// Numbers of a joint: LinuxCNC's key, ours, and whether zero says nothing.
const NUMBERS: [(&str, &str, bool); 5] = [
    ("HOME_SEARCH_VEL", "search_velocity", false),
    ("HOME_LATCH_VEL", "latch_velocity", false),
    ("HOME_FINAL_VEL", "final_velocity", true),
    ("HOME_OFFSET", "offset", false),
    ("HOME", "position", false),
];

const FLAGS: [(&str, &str); 3] = [
    ("HOME_IS_SHARED", "shared"),
    ("VOLATILE_HOME", "volatile"),
    ("HOME_IGNORE_LIMITS", "ignore_limits"),
];

impl Machine {
    /// `[home.J0]` and the others, and `[feedback]`.
    pub(crate) fn homing(&mut self) {
        if self.kinematics != Some("trivial") {
            return;
        }
        let mut has_home = false;
        for (theirs, ours) in self.joint_numbers() {
            has_home |= self.home_of(theirs, ours);
        }
        if has_home {
            let text = "source = \"drives\" and homing = \"controller\" bring the joints home as [home.J0] \
                        says, once each that searches has its bounds, search_travel and clearance; LinuxCNC \
                        has none";
            self.draft.remark("feedback", text);
        }
        self.following_errors();
        self.by_hand();
    }

    /// LinuxCNC's joints with ours: those of the axes in our order, then second ones.
    pub(super) fn joint_numbers(&self) -> Vec<(usize, usize)> {
        let place = |letter: char| AXES.find(letter).unwrap_or(AXES.len());
        let is_second = |joint: usize, letter: char| {
            let mut before = self.joints.iter().filter(|(other, _)| *other < joint);
            before.any(|(_, other)| *other == letter)
        };
        let joints = self.joints.iter();
        let mut sorted: Vec<_> = joints
            .map(|(joint, letter)| (is_second(*joint, *letter), place(*letter), *joint))
            .collect();
        sorted.sort_unstable();
        let ours = sorted.into_iter().enumerate();
        ours.map(|(ours, (_, _, theirs))| (theirs, ours)).collect()
    }

    /// A joint's keys; whether it looks for anything.
    fn home_of(&mut self, joint: usize, ours: usize) -> bool {
        let section = format!("JOINT_{joint}");
        let table = format!("home.J{ours}");
        let of = self.joints.iter().find(|(number, _)| *number == joint);
        let letter = of.map_or('X', |(_, letter)| *letter);
        let factor = self.units.of_letter(letter);
        let mut searches = false;
        for (theirs, key, zero_is_none) in NUMBERS {
            let Some((at, number)) = self.inputs.number(&section, theirs) else {
                continue;
            };
            let (Ok(value), Some(factor)) = (number, factor) else {
                continue;
            };
            if zero_is_none && value <= 0.0 {
                let note = "the joint's highest velocity, as it is without the key";
                self.inputs.decide(at, Fate::Converted, note);
                continue;
            }
            searches |= key.ends_with("_velocity") && value != 0.0;
            let from = self.inputs.name(at);
            self.draft.known(&table, key, float(value * factor), &from);
            let note = format!("{table}.{key}");
            self.inputs.decide(at, Fate::Converted, note);
        }
        for (theirs, key) in FLAGS {
            let Some((at, text)) = self.inputs.text(&section, theirs) else {
                continue;
            };
            let is_on = is_true(text);
            let from = self.inputs.name(at);
            self.draft.known(&table, key, is_on.to_string(), &from);
            self.inputs
                .decide(at, Fate::Converted, format!("{table}.{key}"));
        }
        self.sequence_and_encoder(&section, &table);
        searches
    }

    fn sequence_and_encoder(&mut self, section: &str, table: &str) {
        if let Some((at, Ok(number))) = self.inputs.number(section, "HOME_SEQUENCE") {
            let from = self.inputs.name(at);
            self.draft
                .known(table, "sequence", format!("{number:.0}"), &from);
            self.inputs
                .decide(at, Fate::Converted, format!("{table}.sequence"));
        }
        if let Some((at, Ok(number))) = self.inputs.number(section, "HOME_ABSOLUTE_ENCODER") {
            let ours = match number {
                1.0 => "\"move\"",
                2.0 => "\"stay\"",
                _ => "\"no\"",
            };
            let from = self.inputs.name(at);
            self.draft.known(table, "absolute", ours.to_owned(), &from);
            self.inputs
                .decide(at, Fate::Converted, format!("{table}.absolute"));
        }
        if let Some((at, text)) = self.inputs.text(section, "HOME_USE_INDEX") {
            if is_true(text) {
                let note = "the index pulse is one that the drive keeps (index = \"drive\"), or an input that the servo stack latches: name \
                     it as index_input";
                self.draft.remark(table, note);
                self.inputs.decide(at, Fate::Changed, note);
            } else {
                let note = "the edge of the switch, as it is without index and index_input";
                self.inputs.decide(at, Fate::Converted, note);
            }
        }
    }

    /// Following errors, where all joints have the same.
    fn following_errors(&mut self) {
        for (theirs, ours) in [
            ("FERROR", "following_error"),
            ("MIN_FERROR", "min_following_error"),
        ] {
            let joints = self.joints.clone();
            let mut found = Vec::new();
            for (joint, letter) in &joints {
                let number = self.inputs.number(&format!("JOINT_{joint}"), theirs);
                let factor = self.units.of_letter(*letter);
                if let (Some((at, Ok(value))), Some(factor)) = (number, factor) {
                    found.push((at, value * factor));
                }
            }
            let Some((first, value)) = found.first().copied() else {
                continue;
            };
            let is_one = found.len() == joints.len()
                && found.iter().all(|(_, other)| (other - value).abs() < 1e-12);
            if is_one && value > 0.0 {
                let from = self.inputs.name(first);
                self.draft.known("feedback", ours, float(value), &from);
            } else {
                let text = format!(
                    "{ours} is one number for all joints, and [JOINT_n]{theirs} are not the same \
                     for all"
                );
                self.draft.remark("feedback", &text);
            }
            for (at, _) in found {
                if is_one && value > 0.0 {
                    let note = format!("feedback.{ours}");
                    self.inputs.decide(at, Fate::Converted, note);
                } else {
                    let note = format!("feedback.{ours} is one number for all joints");
                    self.inputs.decide(at, Fate::Changed, note);
                }
            }
        }
    }

    /// `[jog]`.
    fn by_hand(&mut self) {
        if let Some((at, text)) = self.inputs.text("DISPLAY", "INCREMENTS") {
            let steps: Option<Vec<f64>> = steps(text, self.units.linear_mm);
            if let Some(steps) = steps.filter(|steps| !steps.is_empty()) {
                let list: Vec<String> = steps.iter().map(|step| float(*step)).collect();
                let list = format!("[{}]", list.join(", "));
                self.draft
                    .known("jog", "increments", list, "[DISPLAY]INCREMENTS");
                self.inputs.decide(at, Fate::Converted, "jog.increments");
            } else {
                let note = "not all of them are lengths that are known: see jog.increments";
                self.inputs.decide(at, Fate::Changed, note);
            }
        }
        for section in ["DISPLAY", "TRAJ"] {
            let found = self.inputs.number(section, "DEFAULT_LINEAR_VELOCITY");
            if let (Some((at, Ok(value))), Some(mm)) = (found, self.units.linear_mm)
                && value > 0.0
            {
                let from = self.inputs.name(at);
                let note = "jog.velocity: the top speed of a jog here, what it begins with there";
                self.draft
                    .known("jog", "velocity", float(value * mm), &from);
                self.inputs.decide(at, Fate::Changed, note);
                return;
            }
        }
    }
}

fn is_true(text: &str) -> bool {
    let word = text.split_whitespace().next().unwrap_or_default();
    ["1", "YES", "TRUE", "ON"]
        .iter()
        .any(|known| word.eq_ignore_ascii_case(known))
}

/// Lengths in mm, as `1 mm, .01 in, 1/8 inch`; `None` if one is not known.
fn steps(text: &str, unit_mm: Option<f64>) -> Option<Vec<f64>> {
    let joined = text
        .replace(" mm", "mm")
        .replace(" in", "in")
        .replace(" mil", "mil");
    let words = joined
        .split(|c: char| c == ',' || c.is_whitespace())
        .filter(|word| !word.is_empty());
    let step = |word: &str| {
        let (number, unit) = match word.find(|c: char| c.is_ascii_alphabetic()) {
            Some(at) => word.split_at(at),
            None => (word, ""),
        };
        let factor = match unit {
            "mm" => 1.0,
            "cm" => 10.0,
            "um" => 1e-3,
            "in" | "inch" => 25.4,
            "mil" => 0.0254,
            "" => unit_mm?,
            _ => return None,
        };
        let value = match number.split_once('/') {
            Some((over, under)) => over.parse::<f64>().ok()? / under.parse::<f64>().ok()?,
            None => number.parse().ok()?,
        };
        (value > 0.0 && value.is_finite()).then_some(value * factor)
    };
    words.map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::steps;

    #[test]
    fn steps_have_units_of_their_own() {
        assert_eq!(steps("1 mm, .5cm 10um", None), Some(vec![1.0, 5.0, 0.01]));
        assert_eq!(steps("1/8 in .1", Some(25.4)), Some(vec![3.175, 2.54]));
        assert_eq!(steps("1 deg", Some(1.0)), None);
        assert_eq!(steps("0.1", None), None);
    }
}
