//! The conversion of LinuxCNC's machine configuration (INI).

mod axes;
mod homing;
mod joints;
mod others;
mod units;

use crate::conversion::Conversion;
use crate::draft::{Draft, quoted};
use crate::ini::{Include, ReadError, Style, read};
use crate::inputs::{Fate, Inputs};
use units::Units;

/// What is being converted.
struct Machine {
    inputs: Inputs,
    draft: Draft,
    units: Units,
    /// The axes, in the order of their joints; a letter may be there twice.
    letters: Vec<char>,
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
        let letters: Vec<char> = text
            .chars()
            .map(|c| c.to_ascii_uppercase())
            .filter(|c| "XYZABCUVW".contains(*c))
            .collect();
        let joints_of = |letter: &char| letters.iter().filter(|of| *of == letter).count();
        let mut gantries = letters.clone();
        gantries.sort_unstable();
        gantries.dedup();
        gantries.retain(|letter| joints_of(letter) > 1);
        for letter in &gantries {
            let why =
                "the axis has two joints: by how much may they differ before the motion stops";
            let table = format!("axis.{letter}");
            self.draft.choose(&table, "gantry_difference", why);
        }
        let (fate, note) = if gantries.iter().any(|letter| joints_of(letter) > 2) {
            let note = "a letter stands there more than twice: an axis has two joints here at most";
            (Fate::NoCounterpart, note)
        } else if gantries.is_empty() {
            (Fate::Converted, "one table [axis.…] for each")
        } else {
            let note = "a letter stands there twice: the second joint of that axis comes after those of \
                        all axes here";
            (Fate::Changed, note)
        };
        self.inputs.decide(at, fate, note);
        self.letters = letters;
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

    /// `[path]` and the period.
    fn path(&mut self) {
        let found = self.inputs.number("RS274NGC", "G64_DEFAULT_TOLERANCE");
        match (found, self.units.linear_mm) {
            (Some((at, Ok(value))), Some(mm)) if value > 0.0 => {
                let value = crate::draft::float(value * mm);
                self.draft
                    .known("path", "tolerance", value, &self.inputs.name(at));
                let note = "path.tolerance: how far the motion may leave the path, all included";
                self.inputs.decide(at, Fate::Converted, note);
            }
            (Some((at, _)), _) => {
                let why = "G64 without P may leave the path by any amount there; here the deviation has \
                           a bound, mm: 0.02 is usual";
                self.draft.choose("path", "tolerance", why);
                self.inputs.decide(at, Fate::Changed, why);
            }
            (None, _) => self
                .draft
                .remark("path", "tolerance = 0.02 is the default, mm"),
        }
        if let Some(at) = self.inputs.find("TRAJ", "MAX_LINEAR_JERK") {
            let note = "a limit along the path there; here max_jerk of each axis, which is better, or \
                        path.max_jerk, which selects effort \"fast\"";
            self.inputs.decide(at, Fate::Changed, note);
        }
        if let Some(at) = self.inputs.find("EMCMOT", "SERVO_PERIOD") {
            let note = "the rate of its control loop; here setpoints come every \
                        interpolator.period_us, which is to be chosen with the drives: 4000 by default";
            self.draft.remark(
                "interpolator",
                &format!("period_us = 4000 is the default; {note}"),
            );
            self.inputs.decide(at, Fate::Changed, note);
        }
    }
}
