//! The conversion of Klipper's printer.cfg.

mod gantries;
mod homing;

use crate::conversion::Conversion;
use crate::draft::{Draft, float, quoted};
use crate::ini::{Include, ReadError, Style, read};
use crate::inputs::{At, Fate, Inputs};

const JERK: &str = "Klipper does not limit jerk. Ten times max_acceleration is gentle, a hundred a light \
                    machine";

/// The axes of a printer.
const LETTERS: [char; 3] = ['x', 'y', 'z'];

/// What is being converted.
struct Machine {
    inputs: Inputs,
    draft: Draft,
}

/// Converts Klipper's configuration.
///
/// # Errors
/// A line that cannot be read, or an included file that cannot.
pub fn from_klipper(text: &str, include: Include<'_>) -> Result<Conversion, ReadError> {
    let mut machine = Machine {
        inputs: read(text, Style::Klipper, include)?,
        draft: Draft::default(),
    };
    let kinematics = machine.mechanism();
    for letter in LETTERS {
        machine.axis(letter, kinematics);
    }
    machine.gantries(kinematics);
    match kinematics {
        Some("corexy") => machine.joints(3),
        Some("linear-delta") => machine.joints(3),
        Some(_) => machine.homing(),
        None => {}
    }
    machine.path();
    machine.others();
    Ok(machine
        .draft
        .finish(&machine.inputs, "Klipper's configuration"))
}

impl Machine {
    /// A number; what is none has no counterpart.
    fn number(&mut self, section: &str, key: &str) -> Option<(At, f64)> {
        let (at, value) = self.inputs.number(section, key)?;
        match value {
            Ok(value) => Some((at, value)),
            Err(why) => {
                self.inputs.decide(at, Fate::NoCounterpart, why);
                None
            }
        }
    }

    fn known(&mut self, table: &str, key: &str, (at, value): (At, f64)) {
        let from = self.inputs.name(at);
        self.draft.known(table, key, float(value), &from);
        self.inputs
            .decide(at, Fate::Converted, format!("{table}.{key}"));
    }

    fn mechanism(&mut self) -> Option<&'static str> {
        let Some((at, text)) = self.inputs.text("printer", "kinematics") else {
            self.draft
                .choose("machine", "kinematics", "[printer]kinematics is not there");
            return None;
        };
        let known = match text {
            "cartesian" => Some("trivial"),
            "corexy" => Some("corexy"),
            "delta" => Some("linear-delta"),
            _ => None,
        };
        let Some(name) = known else {
            let why = format!("{text} has no counterpart by that name");
            self.draft.choose("machine", "kinematics", &why);
            self.inputs.decide(at, Fate::NoCounterpart, why);
            return None;
        };
        let from = self.inputs.name(at);
        self.draft
            .known("machine", "kinematics", quoted(name), &from);
        self.inputs.decide(
            at,
            Fate::Converted,
            format!("machine.kinematics = \"{name}\""),
        );
        if name == "linear-delta" {
            self.delta();
        }
        known
    }

    fn delta(&mut self) {
        let table = "machine.linear-delta";
        let rods: Vec<Option<(At, f64)>> = ["a", "b", "c"]
            .iter()
            .map(|tower| self.number(&format!("stepper_{tower}"), "arm_length"))
            .collect();
        // Klipper takes that of the first tower where the others have none.
        let first = rods[0];
        let are_same = |rod: &Option<(At, f64)>| {
            rod.is_none_or(|(_, length)| {
                first.is_some_and(|(_, first)| first.to_bits() == length.to_bits())
            })
        };
        match first.filter(|_| rods.iter().all(are_same)) {
            Some(rod) => {
                self.known(table, "rod", rod);
                for (at, _) in rods.into_iter().flatten() {
                    self.inputs
                        .decide(at, Fate::Converted, format!("{table}.rod"));
                }
            }
            None => {
                self.draft
                    .ask(table, "rod", "the arms are not given, or not of one length");
                for (at, _) in rods.into_iter().flatten() {
                    self.inputs
                        .decide(at, Fate::Changed, "rods have one length here");
                }
            }
        }
        match self.number("printer", "delta_radius") {
            Some(radius) => self.known(table, "radius", radius),
            None => self
                .draft
                .ask(table, "radius", "[printer]delta_radius is not there"),
        }
        let mut angles = [210.0, 330.0, 90.0];
        for (tower, angle) in ["a", "b", "c"].iter().zip(&mut angles) {
            if let Some((at, value)) = self.number(&format!("stepper_{tower}"), "angle") {
                *angle = value;
                self.inputs
                    .decide(at, Fate::Converted, format!("{table}.tower_angles"));
            }
        }
        let list = format!("[{}]", angles.map(float).join(", "));
        self.draft
            .known(table, "tower_angles", list, "towers a, b and c");
    }

    fn axis(&mut self, letter: char, kinematics: Option<&str>) {
        let table = format!("axis.{}", letter.to_ascii_uppercase());
        let section = format!("stepper_{letter}");
        let is_delta = kinematics == Some("linear-delta");
        if is_delta {
            self.delta_travel(letter, &table);
        } else {
            match self.number(&section, "position_min") {
                Some(found) => self.known(&table, "min_position", found),
                None => {
                    let from = "position_min is not there: Klipper's 0";
                    self.draft
                        .known(&table, "min_position", "0.0".to_owned(), from);
                }
            }
            match self.number(&section, "position_max") {
                Some(found) => self.known(&table, "max_position", found),
                None => self
                    .draft
                    .ask(&table, "max_position", "position_max is not there"),
            }
        }
        for (general, of_z, key) in [
            ("max_velocity", "max_z_velocity", "max_velocity"),
            ("max_accel", "max_z_accel", "max_acceleration"),
        ] {
            let own = (letter == 'z')
                .then(|| self.number("printer", of_z))
                .flatten();
            let is_own = own.is_some();
            match own.or_else(|| self.number("printer", general)) {
                Some((at, value)) if value > 0.0 => {
                    let from = self.inputs.name(at);
                    self.draft.known(&table, key, float(value), &from);
                    let note = if is_own {
                        format!("{table}.{key}")
                    } else {
                        format!(
                            "{key} of the axes: there a limit of the head along its path, here of each axis"
                        )
                    };
                    let fate = if is_own {
                        Fate::Converted
                    } else {
                        Fate::Changed
                    };
                    self.inputs.decide(at, fate, note);
                }
                _ => self.draft.ask(&table, key, "[printer] does not say it"),
            }
        }
        self.draft.ask(&table, "max_jerk", JERK);
    }

    fn delta_travel(&mut self, letter: char, table: &str) {
        if letter != 'z' {
            for key in ["min_position", "max_position"] {
                let why = "a delta's head goes as far as its circle; give a rectangle inside it";
                self.draft.ask(table, key, why);
            }
            return;
        }
        match self.number("printer", "minimum_z_position") {
            Some(found) => self.known(table, "min_position", found),
            None => {
                let from = "minimum_z_position is not there: Klipper's 0";
                self.draft
                    .known(table, "min_position", "0.0".to_owned(), from);
            }
        }
        self.draft.ask(
            table,
            "max_position",
            "the height at which the whole travel of X and Y is in reach",
        );
    }

    fn joints(&mut self, count: usize) {
        for joint in 0..count {
            let table = format!("joint.J{joint}");
            for key in ["max_velocity", "max_acceleration", "max_jerk"] {
                let why = "Klipper limits the head alone; here each drive has its own limits";
                self.draft.ask(&table, key, why);
            }
        }
    }

    fn path(&mut self) {
        if let Some(at) = self.inputs.find("printer", "square_corner_velocity") {
            let why = "there a speed at corners that stay exact; here the deviation that rounding them may \
                       take, mm: 0.02 is usual, and the speed follows from it and the limits";
            self.draft.choose("path", "tolerance", why);
            self.inputs.decide(at, Fate::Changed, why);
        } else {
            self.draft
                .remark("path", "tolerance = 0.02 is the default, mm");
        }
        self.draft.remark(
            "program",
            "dialect = \"marlin\" reads programs of printers; extruder = \"U\" lets an axis U move the filament",
        );
    }

    fn others(&mut self) {
        for at in 0..self.inputs.len() {
            let Some(input) = self.inputs.get(at).filter(|_| !self.inputs.is_decided(at)) else {
                continue;
            };
            let section = input.section.to_ascii_lowercase();
            let key = input.key.to_ascii_lowercase();
            let first = section.split_whitespace().next().unwrap_or_default();
            let is_repeated = self.inputs.find(&section, &key) != Some(at);
            let reason = match (first, key.as_str()) {
                _ if is_repeated => "it stands there before, or again in what is saved",
                (_, key)
                    if key.starts_with("homing_")
                        || key == "second_homing_speed"
                        || key == "position_endstop" =>
                {
                    "the joints of such a machine come home by their drives"
                }
                ("printer", "minimum_cruise_ratio" | "max_accel_to_decel") => {
                    "jerk makes short moves gentle here"
                }
                ("printer", _) => "nothing here corresponds to it",
                (first, _) if first.starts_with("stepper") => {
                    "steps, pins and their timing belong to the drive"
                }
                (first, _) if first.starts_with("tmc") => "currents belong to the drive",
                ("mcu", _) => "there is no microcontroller: drives take setpoints",
                ("input_shaper" | "resonance_tester" | "adxl345", _) => {
                    "there is no input shaper; a lower jerk is what there is"
                }
                (first, _) if first.starts_with("extruder") => {
                    "there is no extruder with pressure advance; E words may move an axis (program.extruder)"
                }
                (
                    "bed_mesh" | "bed_screws" | "z_tilt" | "quad_gantry_level" | "skew_correction",
                    _,
                ) => "the bed is not corrected",
                ("gcode_macro" | "delayed_gcode", _) => "there are no macros",
                (first, _)
                    if first.starts_with("heater")
                        || first.starts_with("fan")
                        || first == "verify_heater" =>
                {
                    "heaters and fans are not controlled"
                }
                ("probe" | "bltouch", _) => {
                    "a probe is an input of feedback here: see the table [probe]"
                }
                _ => "nothing here corresponds to it",
            };
            self.inputs.decide(at, Fate::NoCounterpart, reason);
        }
    }
}
