//! What stands at the inputs of emulated devices, by a file that somebody edits while they run.
//!
//! ```text
//! # one input a line; those that are not here are off
//! input 3 on
//! home 0 on
//! analog 1 4.5
//! ```

use crate::command::failure::Failure;
use crate::file_error::FileError;
use crate::{output, text_file};
use core::fmt;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use glidepath_ethercat::{AnalogInput, At, DigitalInput, TerminalSettings};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;

/// Largest file, bytes.
const MOST_BYTES: u64 = 1 << 16;
/// Between two looks at the file.
const POLL: Duration = Duration::from_millis(50);
/// Digital and analog inputs of a device that no file names.
const INPUTS: usize = 16;
const ANALOG_INPUTS: usize = 4;
const KNOWN: &str = "a line is `input 3 on`, `home 0 on`, `limit_low 0 on`, `limit_high 0 on` or \
                     `analog 1 4.5`";

/// What an input is to programs and to the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meaning {
    Input(usize),
    Home(usize),
    LimitLow(usize),
    LimitHigh(usize),
    Analog(usize),
}

impl Meaning {
    fn of(word: &str, number: usize) -> Option<Self> {
        Some(match word {
            "input" => Self::Input(number),
            "home" => Self::Home(number),
            "limit_low" => Self::LimitLow(number),
            "limit_high" => Self::LimitHigh(number),
            "analog" => Self::Analog(number),
            _ => return None,
        })
    }
}

/// What is wrong in the file, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct InputError {
    line: usize,
    column: usize,
    what: String,
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.what)
    }
}

/// What stands at inputs of a device: bytes from one on, and which of their bits are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    /// A bit of the inputs of the device at a position.
    Bit(usize, usize, bool),
    /// Two bytes, from one on.
    Number(usize, usize, [u8; 2]),
}

/// An input of an emulated device.
#[derive(Debug, Clone, Copy)]
enum Pin {
    Digital(DigitalInput),
    Analog(AnalogInput),
}

/// The inputs of all emulated devices.
#[derive(Debug, Default)]
pub(super) struct Pins(Vec<(usize, usize, Pin)>);

impl Pins {
    /// Adds those of a device; `place` is where it has each, bits.
    pub(super) fn add(&mut self, settings: &TerminalSettings, place: &dyn Fn(At) -> Option<usize>) {
        let digital = settings
            .inputs
            .iter()
            .map(|input| (input.at, Pin::Digital(*input)));
        let analog = settings
            .analog_inputs
            .iter()
            .map(|input| (input.at, Pin::Analog(*input)));
        let placed = digital
            .chain(analog)
            .filter_map(|(at, pin)| Some((settings.position, place(at)?, pin)));
        self.0.extend(placed);
    }

    /// What stands at all of them by a text.
    pub(super) fn read(&self, text: &str) -> Result<Vec<Level>, InputError> {
        let mut said: Vec<(Meaning, f64)> = Vec::new();
        for (line, written) in (1..).zip(text.lines()) {
            let told = line_of(line, written)?;
            let Some((meaning, column, value)) = told else {
                continue;
            };
            let error = |what: &str| InputError {
                line,
                column,
                what: what.to_owned(),
            };
            if !self.0.iter().any(|(.., pin)| pin.means(meaning)) {
                return Err(error("no device has such an input"));
            }
            if said.iter().any(|(other, _)| *other == meaning) {
                return Err(error("this input is in the file already"));
            }
            said.push((meaning, value));
        }
        let levels = self.0.iter().map(|(position, bit, pin)| match pin {
            Pin::Digital(input) => {
                let is_on = said
                    .iter()
                    .any(|(meaning, value)| *value != 0.0 && pin.means(*meaning));
                Level::Bit(*position, *bit, is_on != input.is_inverted)
            }
            Pin::Analog(input) => {
                let value = said.iter().find(|(meaning, _)| pin.means(*meaning));
                let counts = counts(input, value.map_or(0.0, |(_, value)| *value));
                Level::Number(*position, bit / 8, counts)
            }
        });
        Ok(levels.collect())
    }
}

impl Pin {
    fn means(&self, meaning: Meaning) -> bool {
        match (self, meaning) {
            (Self::Digital(input), Meaning::Input(number)) => input.number == Some(number),
            (Self::Digital(input), Meaning::Home(joint)) => input.home == Some(joint),
            (Self::Digital(input), Meaning::LimitLow(joint)) => input.limit_low == Some(joint),
            (Self::Digital(input), Meaning::LimitHigh(joint)) => input.limit_high == Some(joint),
            (Self::Analog(input), Meaning::Analog(number)) => input.number == number,
            _ => false,
        }
    }
}

/// The counts of a value: at most those of a number of 16 bits, as a converter has it.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "it is inside the type, and a negative number is written as its bits"
)]
fn counts(input: &AnalogInput, value: f64) -> [u8; 2] {
    let (least, most) = if input.is_signed {
        (-32_768.0, 32_767.0)
    } else {
        (0.0, 65_535.0)
    };
    let counts = ((value - input.offset) / input.scale).round();
    (counts.clamp(least, most) as i32 as u16).to_le_bytes()
}

/// What a line says, and in which column; `None` if it says nothing.
fn line_of(line: usize, written: &str) -> Result<Option<(Meaning, usize, f64)>, InputError> {
    let text = written.split('#').next().unwrap_or_default();
    let column = 1 + text
        .chars()
        .take_while(|letter| letter.is_whitespace())
        .count();
    let error = |what: String| InputError { line, column, what };
    let words: Vec<&str> = text.split_whitespace().collect();
    let [word, number, value] = words[..] else {
        return match words[..] {
            [] => Ok(None),
            _ => Err(error(KNOWN.to_owned())),
        };
    };
    let meaning = number
        .parse()
        .ok()
        .and_then(|number| Meaning::of(word, number));
    let meaning = meaning.ok_or_else(|| error(KNOWN.to_owned()))?;
    let value = match (meaning, value) {
        (Meaning::Analog(_), value) => value.parse().ok().filter(|value: &f64| value.is_finite()),
        (_, "on" | "1") => Some(1.0),
        (_, "off" | "0") => Some(0.0),
        _ => None,
    };
    let value = value.ok_or_else(|| error(KNOWN.to_owned()))?;
    Ok(Some((meaning, column, value)))
}

/// A device that has inputs of every kind, for a machine that no file describes.
pub(super) fn desk(position: usize, joints: usize) -> TerminalSettings {
    let object = |index: usize, sub| At::Object {
        index: u16::try_from(index).unwrap_or(u16::MAX),
        sub,
    };
    let blank = |at| DigitalInput {
        at,
        number: None,
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    };
    let mut inputs: Vec<_> = (0..INPUTS)
        .map(|number| DigitalInput {
            number: Some(number),
            ..blank(object(0x6000 + 0x10 * number, 1))
        })
        .collect();
    for joint in 0..joints {
        let at = |sub| object(0x6400 + 0x10 * joint, sub);
        let (home, low, high) = (blank(at(1)), blank(at(2)), blank(at(3)));
        inputs.push(DigitalInput {
            home: Some(joint),
            ..home
        });
        inputs.push(DigitalInput {
            limit_low: Some(joint),
            ..low
        });
        inputs.push(DigitalInput {
            limit_high: Some(joint),
            ..high
        });
    }
    let analog = |number| AnalogInput {
        at: object(0x6800 + 0x10 * number, 0x11),
        number,
        scale: 0.001,
        offset: 0.0,
        is_signed: true,
    };
    TerminalSettings {
        position,
        inputs,
        analog_inputs: (0..ANALOG_INPUTS).map(analog).collect(),
        ..TerminalSettings::default()
    }
}

/// The file, and what it said last.
#[derive(Debug)]
pub(super) struct InputFile {
    path: PathBuf,
    pins: Pins,
    text: String,
}

impl InputFile {
    /// Reads the file for the first time: what is wrong in it then is refused.
    ///
    /// # Errors
    /// It cannot be read, or is wrong.
    pub(super) fn open(path: &Path, pins: Pins) -> Result<(Self, Vec<Level>), Failure> {
        let text = read(path).map_err(FileError::file("read", path))?;
        let levels = pins.read(&text).map_err(|error| Failure::Inputs {
            file: path.display().to_string(),
            error: error.to_string(),
        })?;
        let path = path.to_owned();
        Ok((Self { path, pins, text }, levels))
    }

    /// Looks at the file until it is over, and hands on what is new in it. What is wrong in it, or a file
    /// that is gone, is told once, and changes nothing.
    pub(super) fn watch(&mut self, changed: &Sender<Vec<Level>>, is_over: &AtomicBool) {
        while !is_over.load(Ordering::Relaxed) {
            std::thread::sleep(POLL);
            // One that is being written is there again at the next look.
            let Ok(text) = read(&self.path) else {
                continue;
            };
            if text == self.text {
                continue;
            }
            self.text = text;
            match self.pins.read(&self.text) {
                // Nobody is left to be told.
                Ok(levels) => drop(changed.send(levels)),
                Err(error) => output::note(&format!(
                    "ethercat: {}:{error}; the inputs stay as they are",
                    self.path.display()
                )),
            }
        }
    }
}

fn read(path: &Path) -> std::io::Result<String> {
    text_file::read(path, MOST_BYTES)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn pins() -> Pins {
        let mut pins = Pins::default();
        let mut device = desk(7, 2);
        device.inputs[3].is_inverted = true;
        device.analog_inputs[1].offset = 1.0;
        let bit = |at: At| match at {
            At::Object { index, sub } if index < 0x6400 => {
                Some(usize::from(index - 0x6000) / 0x10 + usize::from(sub) - 1)
            }
            At::Object { index, sub } if index < 0x6800 => {
                Some(16 + 3 * (usize::from(index - 0x6400) / 0x10) + usize::from(sub) - 1)
            }
            At::Object { index, .. } => Some(24 + usize::from(index - 0x6800)),
            At::Bit(_) => None,
        };
        pins.add(&device, &bit);
        pins
    }

    #[test]
    fn inputs_are_what_the_file_says_and_off_where_it_says_nothing() {
        let text =
            "# a comment\n\n  input 0 on # another\nlimit_high 1 1\ninput 5 off\nanalog 1 -2.5\n";
        let levels = pins().read(text).unwrap();
        let high: Vec<usize> = levels
            .iter()
            .filter_map(|level| match level {
                Level::Bit(7, bit, true) => Some(*bit),
                _ => None,
            })
            .collect();
        // The third opens.
        assert_eq!(high, [0, 3, 16 + 3 + 2]);
        // (-2.5 - 1) / 0.001 counts.
        assert!(
            levels.contains(&Level::Number(7, 5, (-3500_i16).to_le_bytes())),
            "{levels:?}"
        );
        assert!(levels.contains(&Level::Number(7, 3, [0, 0])), "{levels:?}");
        assert!(
            pins()
                .read("input 3 on\n")
                .unwrap()
                .contains(&Level::Bit(7, 3, false))
        );
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (text, told) in [
            (
                "input 0 on\ninput 16 on",
                "2:1: no device has such an input",
            ),
            (
                "  input 0 on\n input 0 off",
                "2:2: this input is in the file already",
            ),
            ("input 0", "1:1: a line is"),
            ("input 0 high", "1:1: a line is"),
            ("analog 0 nan", "1:1: a line is"),
            ("output 0 on", "1:1: a line is"),
            ("input -1 on", "1:1: a line is"),
        ] {
            let error = pins().read(text).unwrap_err().to_string();
            assert!(error.starts_with(told), "{text}: {error}");
        }
    }

    #[test]
    fn counts_end_where_those_of_a_converter_do() {
        let mut input = desk(0, 1).analog_inputs[0];
        assert_eq!(counts(&input, 1e9), 32_767_i16.to_le_bytes());
        assert_eq!(counts(&input, -1e9), (-32_768_i16).to_le_bytes());
        (input.is_signed, input.scale) = (false, -1.0);
        assert_eq!(counts(&input, -65_535.0), [0xff, 0xff]);
        assert_eq!(counts(&input, 5.0), [0, 0]);
    }
}
