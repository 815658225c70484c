//! The conversion of what grbl and grblHAL print on `$$` (settings) and `$#` (offsets).

mod gantries;
mod homing;

use crate::conversion::Conversion;
use crate::draft::{Draft, float};
use crate::ini::ReadError;
use crate::inputs::{At, Fate, Inputs};

/// Axes in the order of the settings.
const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];

/// Most lines of an input.
const MOST_LINES: usize = 20_000;

/// What is being converted.
struct Machine {
    inputs: Inputs,
    draft: Draft,
    axes: Vec<(usize, char)>,
    /// Those that two motors move.
    gantries: Vec<usize>,
}

/// Converts settings of grbl or grblHAL.
///
/// # Errors
/// The input has more lines than such a list ever has.
pub fn from_grbl(text: &str) -> Result<Conversion, ReadError> {
    let mut machine = Machine {
        inputs: read(text)?,
        draft: Draft::default(),
        axes: Vec::new(),
        gantries: Vec::new(),
    };
    machine.axes = AXES
        .into_iter()
        .enumerate()
        .filter(|(n, _)| {
            [100, 110, 120, 130]
                .iter()
                .any(|first| machine.find(first + n).is_some())
        })
        .collect();
    if machine.axes.is_empty() {
        let why = "the input has no setting of an axis: $100 to $135";
        machine.draft.ask_axis("X", why);
    }
    for (number, letter) in machine.axes.clone() {
        machine.axis(number, letter);
    }
    machine.gantries();
    machine.homing();
    machine.path();
    machine.offsets();
    machine.others();
    Ok(machine
        .draft
        .finish(&machine.inputs, "the settings of grbl"))
}

/// How a key is written.
fn written(section: &str, key: &str) -> String {
    match section {
        "$" => format!("${key}"),
        _ => key.to_owned(),
    }
}

/// Reads lines such as `$110=5000.000 (x max rate, mm/min)` and `[G54:0.000,0.000,0.000]`.
fn read(text: &str) -> Result<Inputs, ReadError> {
    let mut inputs = Inputs::named(written);
    for (index, line) in text.lines().enumerate() {
        let place = format!("line {}", index + 1);
        if index >= MOST_LINES {
            let reason = format!("more than {MOST_LINES} lines: not a list of settings");
            return Err(ReadError { place, reason });
        }
        let line = line.trim().trim_start_matches(['>', '<']).trim();
        if line.is_empty() || line.eq_ignore_ascii_case("ok") || line == "$$" || line == "$#" {
            continue;
        }
        let setting = line.strip_prefix('$').and_then(|rest| rest.split_once('='));
        let report = line
            .strip_prefix('[')
            .and_then(|rest| rest.trim_end_matches(']').split_once(':'));
        match (setting, report) {
            (Some((key, value)), _) => inputs.add("$", key.trim(), value, place),
            (None, Some((key, value))) => inputs.add("[", key.trim(), value, place),
            (None, None) => inputs.add("?", line, "", place),
        }
    }
    Ok(inputs)
}

impl Machine {
    fn find(&self, number: usize) -> Option<At> {
        self.inputs.find("$", &number.to_string())
    }

    /// A setting as a number; what is none has no counterpart.
    fn number(&mut self, number: usize) -> Option<(At, f64)> {
        let (at, value) = self.inputs.number("$", &number.to_string())?;
        match value {
            Ok(value) => Some((at, value)),
            Err(why) => {
                self.inputs.decide(at, Fate::NoCounterpart, why);
                None
            }
        }
    }

    fn axis(&mut self, number: usize, letter: char) {
        let table = format!("axis.{letter}");
        self.travel(&table, number);
        let limits = [
            (
                110,
                "max_velocity",
                1.0 / 60.0,
                "÷ 60: per second here, per minute there",
            ),
            (120, "max_acceleration", 1.0, "as it is"),
            (800, "max_jerk", 1.0, "as it is"),
        ];
        for (first, key, factor, note) in limits {
            match self.number(first + number).filter(|(_, value)| *value > 0.0) {
                Some((at, value)) => {
                    let from = self.inputs.name(at);
                    self.draft.known(&table, key, float(value * factor), &from);
                    self.inputs.decide(at, Fate::Converted, format!("{table}.{key}, {note}"));
                }
                None if key == "max_jerk" => self.draft.ask(
                    &table,
                    key,
                    "grbl does not limit jerk. Ten times max_acceleration is gentle, twenty a stiff mill, a \
                     hundred a light machine",
                ),
                None => self.draft.ask(&table, key, "the setting is not there, or is zero"),
            }
            if let Some(at) = self.find(first + number) {
                self.inputs
                    .decide(at, Fate::Changed, "zero is no limit here");
            }
        }
    }

    /// Travel: machine coordinates are zero or below, unless homing says otherwise.
    fn travel(&mut self, table: &str, number: usize) {
        let travel = self.number(130 + number);
        let homing = self.number(22).map(|(_, value)| value);
        let Some((at, length)) = travel.filter(|(_, value)| *value > 0.0) else {
            for key in ["min_position", "max_position"] {
                self.draft
                    .ask(table, key, "the soft limit, machine coordinates");
            }
            if let Some((at, _)) = travel {
                self.inputs
                    .decide(at, Fate::Changed, "no travel is no soft limit here");
            }
            return;
        };
        let span = match homing {
            Some(homing) if bit(homing, 0) => self.span(number, homing, length),
            _ => Err(
                "homing ($22) is off, so machine coordinates begin wherever the machine was switched on",
            ),
        };
        match span {
            Ok((min, max)) => {
                let from = self.inputs.name(at);
                self.draft.known(table, "min_position", float(min), &from);
                self.draft.known(table, "max_position", float(max), &from);
                let note = format!("{table}.min_position = {min}, max_position = {max}");
                self.inputs.decide(at, Fate::Converted, note);
            }
            Err(why) => {
                let why = format!("the travel is {length}; {why}");
                for key in ["min_position", "max_position"] {
                    self.draft.ask(table, key, &why);
                }
                self.inputs.decide(at, Fate::Changed, why);
            }
        }
    }

    /// Where an axis of that length lies in machine coordinates.
    fn span(
        &mut self,
        number: usize,
        homing: f64,
        length: f64,
    ) -> Result<(f64, f64), &'static str> {
        let mask = self.number(23).map_or(0.0, |(_, value)| value);
        let homes_to_minus = bit(mask, u32::try_from(number).unwrap_or(u32::MAX));
        match (homes_to_minus, self.is_zero_at_home(homing)) {
            // Homed at its positive end, at zero either way.
            (false, _) | (true, Some(false)) => Ok((-length, 0.0)),
            (true, Some(true)) => Ok((0.0, length)),
            (true, None) => Err(
                "it homes to its negative end ($23), and whether that is zero depends on how grbl was \
                 built: add the answer to $I ([OPT:…]) to the input, or give both ends",
            ),
        }
    }

    /// The letters of `[OPT:…]`, the options grbl was built with.
    fn options(&self) -> Option<&str> {
        let (_, text) = self.inputs.text("[", "OPT")?;
        text.split(',').next()
    }

    /// Whether it is grblHAL, whose `$22` is a set of flags.
    fn is_hal(&self, homing: f64) -> bool {
        let firmware = self.inputs.text("[", "FIRMWARE");
        let is_named =
            firmware.is_some_and(|(_, name)| name.to_ascii_lowercase().contains("grblhal"));
        homing > 1.0
            || is_named
            || self.find(700).is_some()
            || self.inputs.find("[", "NEWOPT").is_some()
    }

    /// Whether machine coordinates are zero where an axis has come home to; `None` if that is not
    /// known.
    fn is_zero_at_home(&self, homing: f64) -> Option<bool> {
        // grblHAL has a flag, and makes its letter of it; grbl has an option it was built with.
        let is_built = self.options().map(|options| options.contains('Z'));
        if !self.is_hal(homing) {
            return is_built;
        }
        let flag = bit(homing, 3);
        let is_of_another_time = !flag && is_built == Some(true);
        (!is_of_another_time).then_some(flag)
    }

    fn path(&mut self) {
        match self.number(11) {
            Some((at, deviation)) => {
                let tolerance = deviation.max(0.01);
                let note = format!(
                    "path.tolerance = {tolerance}: there the radius of a circle that no corner follows, \
                     which only sets the speed; here how far the motion may really leave the path"
                );
                self.draft.known(
                    "path",
                    "tolerance",
                    float(tolerance),
                    "$11, at least 0.01: see below",
                );
                self.inputs.decide(at, Fate::Changed, note);
            }
            None => self
                .draft
                .remark("path", "tolerance = 0.02 is the default, mm"),
        }
    }

    /// Work offsets: they are kept apart from the configuration.
    fn offsets(&mut self) {
        let in_inches = self.number(13).is_some_and(|(_, value)| value >= 1.0);
        let mut commands = Vec::new();
        for at in 0..self.inputs.len() {
            let Some(input) = self.inputs.get(at).filter(|input| input.section == "[") else {
                continue;
            };
            let name = input.key.to_ascii_uppercase();
            let systems = [
                "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3",
            ];
            if !systems.contains(&name.as_str()) && !["G28", "G30", "G92"].contains(&name.as_str())
            {
                continue;
            }
            let mut words = Vec::new();
            for (letter, value) in AXES.iter().zip(input.value.split(',')) {
                let value: Option<f64> = value.trim().parse().ok().filter(|v: &f64| v.is_finite());
                let is_linear = matches!(letter, 'X' | 'Y' | 'Z');
                let factor = if in_inches && is_linear { 25.4 } else { 1.0 };
                words.push(value.map(|value| format!("{letter}{}", float(value * factor))));
            }
            let words: Option<Vec<String>> = words.into_iter().collect();
            if let Some(words) = words.filter(|words| !words.is_empty()) {
                let command = format!("glidepath offsets set {name} {}", words.join(" "));
                let note = format!("kept apart from the configuration: `{command} --config …`");
                commands.push(command);
                self.inputs.decide(at, Fate::Changed, note);
            }
        }
        if !commands.is_empty() {
            self.draft.remark(
                "state",
                "directory = \"state\" keeps work offsets. To take over those of grbl:",
            );
            for command in commands {
                self.draft.remark("state", &command);
            }
        }
    }

    fn others(&mut self) {
        for at in 0..self.inputs.len() {
            let Some(input) = self.inputs.get(at).filter(|_| !self.inputs.is_decided(at)) else {
                continue;
            };
            let number: Option<u32> = input.key.parse().ok().filter(|_| input.section == "$");
            let reason = match (input.section.as_str(), number) {
                ("$", Some(0..=6 | 29 | 37)) => "steps and their timing belong to the drive",
                ("$", Some(10 | 13)) => "reports have a form of their own here",
                ("$", Some(12)) => "arcs are exact here",
                ("$", Some(20 | 21)) => {
                    "soft limits are always judged; switches belong to the drive"
                }
                ("$", Some(22..=27 | 43..=49)) => "homing ($22) is off",
                ("$", Some(30 | 31 | 33..=36)) => "the spindle takes S words as they are",
                ("$", Some(32)) => "there is no laser mode",
                ("$", Some(100..=105)) => "steps per mm belong to the drive",
                ("$", Some(140..=145 | 210..=215)) => "currents belong to the drive",
                ("$", Some(160..=165)) => "backlash is compensated by the drive",
                ("$", Some(340)) => "nothing waits for the spindle's speed yet",
                ("$", Some(_)) => {
                    "a setting of grblHAL or its plugins that nothing here corresponds to"
                }
                ("[", _) if input.key.eq_ignore_ascii_case("TLO") => {
                    "the length of a tool comes from the tool table: program.tool_table"
                }
                ("[", _) if input.key.eq_ignore_ascii_case("PRB") => {
                    "a result of probing is not kept"
                }
                ("[", _) => "says something about the firmware",
                _ => "not a setting",
            };
            self.inputs.decide(at, Fate::NoCounterpart, reason);
        }
    }
}

/// A bit of a mask that is written as a number.
fn bit(mask: f64, bit: u32) -> bool {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast saturates"
    )]
    let mask = mask as u64;
    mask.checked_shr(bit).unwrap_or(0) & 1 == 1
}
