//! The conversion of LinuxCNC's machine configuration (INI).

mod axes;
mod homing;
mod joints;
mod others;
mod path;
mod startup;
mod units;

use crate::conversion::Conversion;
use crate::draft::{Draft, quoted};
use crate::ini::{Include, ReadError, Style, read};
use crate::inputs::{Fate, Inputs};
use units::Units;

/// The axes in their order.
const AXES: &str = "XYZABCUVW";

/// What is being converted.
struct Machine {
    inputs: Inputs,
    draft: Draft,
    units: Units,
    /// The axes, each once.
    letters: Vec<char>,
    /// The joints by their numbers, each with its axis; an axis may have several.
    joints: Vec<(usize, char)>,
    kinematics: Option<&'static str>,
}

/// Converts LinuxCNC's machine configuration.
///
/// # Errors
/// A line that cannot be read, or an included file that cannot.
pub fn from_linuxcnc(text: &str, include: Include<'_>) -> Result<Conversion, ReadError> {
    let mut inputs = read(text, Style::LinuxCnc, include)?;
    let units = Units::of(&mut inputs);
    let mut machine = Machine {
        inputs,
        draft: Draft::default(),
        units,
        letters: Vec::new(),
        joints: Vec::new(),
        kinematics: None,
    };
    machine.coordinates();
    machine.mechanism();
    machine.axes();
    machine.joints();
    machine.homing();
    machine.path();
    machine.others();
    Ok(machine
        .draft
        .finish(&machine.inputs, "LinuxCNC's machine configuration"))
}

impl Machine {
    /// Which axes there are, and which joint is whose.
    fn coordinates(&mut self) {
        let Some((at, text)) = self.inputs.text("TRAJ", "COORDINATES") else {
            let why = "[TRAJ]COORDINATES is not there: add a table for each axis of the machine";
            self.draft.ask_axis("X", why);
            return;
        };
        let written = letters_of(text);
        self.joints = self.joints_of(&written);
        let count = |letter: &char| self.joints.iter().filter(|(_, of)| of == letter).count();
        for letter in &written {
            if !self.letters.contains(letter) {
                self.letters.push(*letter);
            }
        }
        let mut gantries = self.letters.clone();
        gantries.sort_unstable();
        gantries.retain(|letter| count(letter) > 1);
        for letter in &gantries {
            let why =
                "the axis has two joints: by how much may they differ before the motion stops";
            let table = format!("axis.{letter}");
            self.draft.choose(&table, "gantry_difference", why);
        }
        let (fate, note) = if gantries.iter().any(|letter| count(letter) > 2) {
            let note = "a letter stands there more than twice: an axis has two joints here at most";
            (Fate::NoCounterpart, note)
        } else if gantries.is_empty() {
            (Fate::Converted, "one table [axis.…] for each")
        } else {
            let note = "an axis has two joints: the second one comes after those of all axes here";
            (Fate::Changed, note)
        };
        self.inputs.decide(at, fate, note);
    }

    /// The axis of each joint. `trivkins` has a list of its own, which counts where it is given; without it the
    /// joints are those of X Y Z A B C U V W in this order, with those that the machine does not name as axes.
    fn joints_of(&self, written: &[char]) -> Vec<(usize, char)> {
        let words = self.inputs.text("KINS", "KINEMATICS");
        let own = words.and_then(|(_, text)| {
            let mut words = text.split_whitespace();
            words.find_map(|word| {
                let (name, list) = word.split_once('=')?;
                let is_list = name.eq_ignore_ascii_case("coordinates");
                is_list.then(|| letters_of(list))
            })
        });
        let count = self.inputs.number("KINS", "JOINTS");
        let is_twice = |(place, letter): (usize, &char)| written[..place].contains(letter);
        let has_more = !written.iter().enumerate().any(is_twice)
            && count.is_some_and(|(_, count)| {
                let most = f64::from(u32::try_from(written.len()).unwrap_or(u32::MAX));
                count.is_ok_and(|count| count > most)
            });
        let all = match own {
            Some(own) => own,
            None if has_more => AXES.chars().collect(),
            None => written.to_vec(),
        };
        let joints = all.into_iter().enumerate();
        joints
            .filter(|(_, letter)| written.contains(letter))
            .collect()
    }

    /// `machine.kinematics`, and what its table needs.
    fn mechanism(&mut self) {
        let Some((at, text)) = self.inputs.text("KINS", "KINEMATICS") else {
            let why = "[KINS]KINEMATICS is not there";
            self.draft.choose("machine", "kinematics", why);
            return;
        };
        let module = text
            .split_whitespace()
            .next()
            .unwrap_or_default()
            .to_owned();
        let known = match module.as_str() {
            "trivkins" => Some("trivial"),
            "corexykins" => Some("corexy"),
            "lineardeltakins" => Some("linear-delta"),
            "genhexkins" => Some("hexapod"),
            _ => None,
        };
        self.kinematics = known;
        let Some(name) = known else {
            let why = format!(
                "{module} has no counterpart by that name: see `glidepath config --explain \
                 machine.kinematics` for the mechanisms there are"
            );
            self.draft.choose("machine", "kinematics", &why);
            self.inputs.decide(at, Fate::NoCounterpart, why);
            return;
        };
        self.draft
            .known("machine", "kinematics", quoted(name), &self.inputs.name(at));
        let note = format!("machine.kinematics = \"{name}\"");
        self.inputs.decide(at, Fate::Converted, note);
        let pins = "LinuxCNC has it in a pin of HAL";
        let lengths: &[&str] = match name {
            "linear-delta" => &["rod", "radius"],
            "hexapod" => &["base_radius", "platform_radius", "half_angle"],
            _ => &[],
        };
        for key in lengths {
            self.draft.ask(&format!("machine.{name}"), key, pins);
        }
    }
}

fn letters_of(text: &str) -> Vec<char> {
    let letters = text.chars().map(|c| c.to_ascii_uppercase());
    letters.filter(|c| AXES.contains(*c)).collect()
}
