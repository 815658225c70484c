//! What stands at the inputs of emulated devices, by a file that somebody edits while they run.
//!
//! ```text
//! # one input a line; those that are not here are off
//! input 3 on
//! home 0 on
//! analog 1 4.5
//! input 1 at J2 -7.25
//! ```

use super::input_line::{InputError, Meaning, Stands, line_of};
use glidepath_emulator::Probe;
use glidepath_ethercat::{AnalogInput, At, DigitalInput, DriveSettings, TerminalSettings};

/// What stands at inputs of a device: bytes from one on, and which of their bits are meant.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Level {
    /// A bit of the inputs of the device at a position.
    Bit(usize, usize, bool),
    /// Two bytes, from one on.
    Number(usize, usize, [u8; 2]),
    /// A bit of the inputs of a drive: device, axis, bit.
    OfDrive(usize, usize, u8, bool),
    /// A bit that changes where a drive passes a place.
    Passing(Probe),
}

/// An input of an emulated device.
#[derive(Debug, Clone, Copy)]
enum Pin {
    Digital(DigitalInput),
    Analog(AnalogInput),
}

/// The inputs of all emulated devices.
#[derive(Debug, Default)]
pub(super) struct Pins {
    pins: Vec<(usize, usize, Pin)>,
    /// Those of drives: device, axis, bit of 0x60FD.
    of_drives: Vec<(usize, usize, u8, DigitalInput)>,
    /// The drives, and where the joint of each begins.
    drives: Vec<(DriveSettings, f64)>,
}

impl Pins {
    /// Those of these drives, and of no device yet.
    pub(super) fn beside(
        drives: Vec<(DriveSettings, f64)>,
        inputs: &[(usize, DigitalInput)],
    ) -> Self {
        let of_drives = inputs.iter().filter_map(|(nth, input)| {
            let (drive, _) = drives.get(*nth)?;
            let At::Bit(bit) = input.at else {
                return None;
            };
            let bit = u8::try_from(bit).ok()?;
            Some((drive.position, drive.axis.into(), bit, *input))
        });
        Self {
            of_drives: of_drives.collect(),
            pins: Vec::new(),
            drives,
        }
    }

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
        self.pins.extend(placed);
    }

    /// What stands at all of them by a text.
    pub(super) fn read(&self, text: &str) -> Result<Vec<Level>, InputError> {
        let mut said: Vec<(Meaning, Stands)> = Vec::new();
        for (line, written) in (1..).zip(text.lines()) {
            let told = line_of(line, written)?;
            let Some((meaning, column, stands)) = told else {
                continue;
            };
            let error = |what: &str| InputError {
                line,
                column,
                what: what.to_owned(),
            };
            let is_of_drive = |(.., input): &(_, _, _, DigitalInput)| means(input, meaning);
            let is_there = self.pins.iter().any(|(.., pin)| pin.means(meaning));
            if !is_there && !self.of_drives.iter().any(is_of_drive) {
                return Err(error("no device has such an input"));
            }
            if let Stands::At(joint, place) = stands
                && self.drive(joint, place).is_none()
            {
                return Err(error("no drive gets there"));
            }
            if said.iter().any(|(other, _)| *other == meaning) {
                return Err(error("this input is in the file already"));
            }
            said.push((meaning, stands));
        }
        let levels = self.pins.iter().map(|(position, bit, pin)| {
            let stands = said.iter().find(|(meaning, _)| pin.means(*meaning));
            let stands = stands.map(|(_, stands)| *stands);
            match (pin, stands) {
                (Pin::Digital(input), stands) => {
                    let level = |is_high| Level::Bit(*position, *bit, is_high);
                    self.digital(input, stands, level, |probe| {
                        probe.inputs.push((*position, *bit));
                    })
                }
                (Pin::Analog(input), stands) => {
                    let value = match stands {
                        Some(Stands::Value(value)) => value,
                        _ => 0.0,
                    };
                    Level::Number(*position, bit / 8, counts(input, value))
                }
            }
        });
        let of_drives = self.of_drives.iter().map(|(device, axis, bit, input)| {
            let stands = said.iter().find(|(meaning, _)| means(input, *meaning));
            let stands = stands.map(|(_, stands)| *stands);
            let level = |is_high| Level::OfDrive(*device, *axis, *bit, is_high);
            self.digital(input, stands, level, |probe| {
                probe.drive_inputs.push((*device, *axis, *bit));
            })
        });
        Ok(levels.chain(of_drives).collect())
    }

    /// What stands at a digital input, as a level or as a probe that is wired to it.
    fn digital(
        &self,
        input: &DigitalInput,
        stands: Option<Stands>,
        level: impl Fn(bool) -> Level,
        wire: impl Fn(&mut Probe),
    ) -> Level {
        if let Some(Stands::At(joint, place)) = stands
            && let Some(mut probe) = self.passing(input, (joint, place))
        {
            wire(&mut probe);
            return Level::Passing(probe);
        }
        level((stands == Some(Stands::On)) != input.is_inverted)
    }

    /// The drive of a joint: itself, where the joint begins, and its counts at a place.
    fn drive(&self, joint: usize, place: f64) -> Option<(&DriveSettings, f64, i32)> {
        let mut drives = self.drives.iter();
        let (drive, begins) = drives.find(|(drive, _)| drive.joint == joint)?;
        let counts = i32::try_from(drive.counts(place)?).ok()?;
        Some((drive, *begins, counts))
    }

    /// A probe that is on at a place of a joint and beyond it, as seen from where the joint begins. All touch
    /// probes of drives are wired to it.
    fn passing(&self, what: &DigitalInput, (joint, place): (usize, f64)) -> Option<Probe> {
        let (drive, begins, counts) = self.drive(joint, place)?;
        let is_on_above = begins < place;
        Some(Probe {
            drive: (drive.position, drive.axis.into()),
            at_counts: counts.into(),
            is_closed_above: is_on_above != (drive.is_inverted != what.is_inverted),
            inputs: Vec::new(),
            filter_ns: 0,
            drive_inputs: Vec::new(),
        })
    }
}

/// Whether a digital input is what is meant.
fn means(input: &DigitalInput, meaning: Meaning) -> bool {
    match meaning {
        Meaning::Input(number) => input.number == Some(number),
        Meaning::Home(joint) => input.home == Some(joint),
        Meaning::LimitLow(joint) => input.limit_low == Some(joint),
        Meaning::LimitHigh(joint) => input.limit_high == Some(joint),
        Meaning::Analog(_) => false,
    }
}

impl Pin {
    fn means(&self, meaning: Meaning) -> bool {
        match (self, meaning) {
            (Self::Digital(input), meaning) => means(input, meaning),
            (Self::Analog(input), Meaning::Analog(number)) => input.number == number,
            (Self::Analog(_), _) => false,
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::super::desk::desk;
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

    /// A drive that counts the other way, whose joint begins at 1 mm.
    fn drive() -> (DriveSettings, f64) {
        let drive = DriveSettings {
            joint: 2,
            position: 5,
            axis: 1,
            map_step: 0x10,
            vendor: 0,
            product: 0,
            alias: 0,
            process_at: None,
            mapping: glidepath_ethercat::Mapping::Written,
            counts_per_unit: 1000.0,
            is_modulo: false,
            is_inverted: true,
            home_offset: 0.0,
            homing: None,
            following_error: 1.0,
            following_ms: 10,
            enable_window: 0.05,
            quick_stop_a: 1000.0,
            torque_limits: [None; 2],
            feed_forward: None,
            probe: None,
            index: None,
            has_inputs: false,
            max_v: 100.0,
        };
        (drive, 1.0)
    }

    #[test]
    fn an_input_can_be_on_from_a_place_of_a_joint_on() {
        let mut pins = pins();
        pins.drives = vec![drive()];
        let passing = |text: &str| {
            let levels = pins.read(text).unwrap();
            levels.into_iter().find_map(|level| match level {
                Level::Passing(probe) => Some(probe),
                _ => None,
            })
        };
        // Down to -7.25 mm, which is up in counts.
        let probe = passing("input 0 at J2 -7.25\n").unwrap();
        assert_eq!((probe.drive, probe.inputs.clone()), ((5, 1), vec![(7, 0)]));
        assert!((probe.at_counts - 7250.0).abs() < 1e-9 && probe.is_closed_above);
        assert!(!passing("input 0 at J2 3\n").unwrap().is_closed_above);
        // One that opens.
        assert!(!passing("input 3 at J2 -7.25\n").unwrap().is_closed_above);
        let error = pins.read("input 0 at J1 5\n").unwrap_err().to_string();
        assert!(error.starts_with("1:1: no drive gets there"), "{error}");
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
            ("input 0 at J2", "1:1: a line is"),
            ("input 0 at 2 3.5", "1:1: a line is"),
            ("analog 0 at J2 3.5", "1:1: a line is"),
            ("input 0 at J2 3.5", "1:1: no drive gets there"),
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
