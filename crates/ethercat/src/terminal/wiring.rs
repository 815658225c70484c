//! The wiring of devices: where in the image of all each input and output is.

use super::at::At;
use super::bits::bit;
use super::encoder::WiredEncoder;
use super::encoder_settings::EncoderSettings;
use super::joint_encoder::WiredJointEncoder;
use super::settings::{AnalogInput, AnalogOutput, DigitalInput, DigitalOutput, TerminalSettings};
use super::spindle_settings::SpindleSettings;
use super::spindle_wiring::WiredSpindle;
use super::unwired::{NotThere, Unwired};
use crate::device::Window;
use crate::entry::{Entry, bits, bytes};

/// A bit or a number in the image, and what it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wired<T> {
    /// From the beginning of the inputs or outputs of all, bits.
    pub(crate) bit: usize,
    /// How long it is, bits.
    pub(crate) bits: u32,
    /// What it is.
    pub(crate) what: T,
}

/// What is in the image: the outputs of all devices, and their inputs.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Wiring {
    pub(crate) inputs: Vec<Wired<DigitalInput>>,
    pub(crate) analog_inputs: Vec<Wired<AnalogInput>>,
    pub(crate) outputs: Vec<Wired<DigitalOutput>>,
    pub(crate) analog_outputs: Vec<Wired<AnalogOutput>>,
    /// The encoder of the spindle.
    pub(crate) encoder: Option<WiredEncoder>,
    /// The encoders of joints.
    pub(crate) joint_encoders: Vec<WiredJointEncoder>,
    /// The drive of the spindle.
    pub(crate) spindle: Option<WiredSpindle>,
    /// Bytes of the outputs and of the inputs.
    pub(crate) sizes: (usize, usize),
    /// What is put out where nothing is wired.
    pub(crate) unwired: Vec<u8>,
    /// Devices so far.
    pub(crate) devices: usize,
}

/// The windows of one way of a device, one after the other, each in whole bytes.
#[derive(Debug, Clone, Copy)]
struct Row<'w> {
    what: &'static str,
    windows: &'w [Window],
    is_output: bool,
    /// Where it begins among those of all devices, bits.
    from: usize,
}

impl Row<'_> {
    fn windows(&self) -> impl Iterator<Item = &Window> {
        let is_output = self.is_output;
        self.windows
            .iter()
            .filter(move |window| window.is_output == is_output)
    }

    fn bytes(&self) -> usize {
        self.windows().map(|window| bytes(&window.entries)).sum()
    }

    /// Where a value is: bits from the beginning of the row, and how many it has.
    fn place(&self, at: At) -> Option<(usize, u32)> {
        match at {
            At::Bit(bit) => {
                let bit = bit as usize;
                (bit < 8 * self.bytes()).then_some((bit, 1))
            }
            At::Object { index, sub } => {
                let mut before = 0;
                for window in self.windows() {
                    let is_meant = |entry: &Entry| (entry.index, entry.sub) == (index, sub);
                    if let Some(nth) = window.entries.iter().position(is_meant) {
                        let into = bits(&window.entries[..nth]) as usize;
                        return Some((8 * before + into, window.entries[nth].bits));
                    }
                    before += bytes(&window.entries);
                }
                None
            }
        }
    }

    /// Finds a value that `fits` says may be so many bits, beginning at such a bit.
    fn find<T>(
        &self,
        at: At,
        what: T,
        fits: impl Fn(usize, u32) -> bool,
    ) -> Result<Wired<T>, NotThere> {
        let found = self.place(at);
        if let Some((bit, bits)) = found.filter(|(bit, bits)| fits(*bit, *bits)) {
            let bit = self.from + bit;
            return Ok(Wired { bit, bits, what });
        }
        Err(self.lacks(at))
    }

    /// That there is nothing that would fit at a place.
    fn lacks(&self, at: At) -> NotThere {
        let entries = self.windows().flat_map(|window| &window.entries);
        NotThere {
            what: self.what,
            at,
            found: self.place(at).map(|(_, bits)| bits),
            known: entries.copied().collect(),
        }
    }
}

/// The encoder of the spindle, in the image.
fn encoder_of(
    encoder: (EncoderSettings, usize),
    outputs: &Row<'_>,
    inputs: &Row<'_>,
) -> Result<WiredEncoder, NotThere> {
    let at = |(index, sub)| At::Object { index, sub };
    let place = |row: &Row<'_>, object| {
        let (bit, bits) = row.place(at(object))?;
        Some((row.from + bit, bits))
    };
    let (of_outputs, of_inputs) = (
        |object| place(outputs, object),
        |object| place(inputs, object),
    );
    WiredEncoder::find(encoder, of_outputs, of_inputs).map_err(|(object, is_output)| {
        let row = if is_output { outputs } else { inputs };
        row.lacks(at(object))
    })
}

/// The drive of the spindle, in the image.
fn spindle_of(
    spindle: (SpindleSettings, usize),
    outputs: &Row<'_>,
    inputs: &Row<'_>,
) -> Result<WiredSpindle, NotThere> {
    let at = |index| At::Object { index, sub: 0 };
    let place = |row: &Row<'_>, index| {
        let (bit, bits) = row.place(at(index))?;
        Some((row.from + bit, bits))
    };
    let (of_outputs, of_inputs) = (|index| place(outputs, index), |index| place(inputs, index));
    WiredSpindle::find(spindle, of_outputs, of_inputs).map_err(|(index, is_output)| {
        let row = if is_output { outputs } else { inputs };
        row.lacks(at(index))
    })
}

const fn is_bit(_: usize, bits: u32) -> bool {
    bits == 1
}

const fn is_number(bit: usize, bits: u32) -> bool {
    bit.is_multiple_of(8) && matches!(bits, 8 | 16 | 32)
}

impl Wiring {
    /// Adds a device with these windows behind those that there are.
    pub(crate) fn add(
        &mut self,
        settings: &TerminalSettings,
        windows: &[Window],
    ) -> Result<(), Unwired> {
        let row = |what, is_output, from: usize| Row {
            what,
            windows,
            is_output,
            from: 8 * from,
        };
        let outputs = row("output", true, self.sizes.0);
        let inputs = row("input", false, self.sizes.1);
        for input in &settings.inputs {
            self.inputs.push(inputs.find(input.at, *input, is_bit)?);
        }
        for input in &settings.analog_inputs {
            let wire = inputs.find(input.at, *input, is_number)?;
            self.analog_inputs.push(wire);
        }
        for output in &settings.outputs {
            self.outputs.push(outputs.find(output.at, *output, is_bit)?);
        }
        for output in &settings.analog_outputs {
            let has_room = |bits: u32| u64::from(output.full_counts) < 1 << bits;
            let fits = |bit, bits| is_number(bit, bits) && has_room(bits);
            let wire = outputs.find(output.at, *output, fits)?;
            self.analog_outputs.push(wire);
        }
        if let Some(spindle) = settings.spindle {
            self.spindle = Some(spindle_of((spindle, self.devices), &outputs, &inputs)?);
        }
        if let Some(encoder) = settings.encoder {
            self.encoder = Some(encoder_of((encoder, self.devices), &outputs, &inputs)?);
        }
        for encoder in &settings.joint_encoders {
            let wire = inputs.find(encoder.at, *encoder, WiredJointEncoder::fits)?;
            let place = (wire.bit, wire.bits);
            let wired = WiredJointEncoder::new(wire.what, self.devices, place);
            self.joint_encoders.push(wired);
        }
        self.devices += 1;
        self.sizes.0 += outputs.bytes();
        self.unwired.resize(self.sizes.0, 0);
        self.sizes.1 += inputs.bytes();
        self.has_each_output_once()
    }

    /// The digital inputs by their numbers.
    pub(crate) fn numbered(&self, inputs: &[u8]) -> u64 {
        let on = self.inputs.iter();
        on.fold(0, |all, wired| {
            all | wired.what.numbered(bit(inputs, wired.bit))
        })
    }

    /// A file can name the same output by its object and by its bit.
    fn has_each_output_once(&self) -> Result<(), Unwired> {
        let digital = self.outputs.iter();
        let digital = digital.map(|wire| (wire.bit, wire.bits, wire.what.at));
        let analog = self.analog_outputs.iter();
        let analog = analog.map(|wire| (wire.bit, wire.bits, wire.what.at));
        let mut all: Vec<(usize, u32, At)> = digital.chain(analog).collect();
        all.sort_by_key(|(bit, ..)| *bit);
        let twice = all.windows(2).find_map(|pair| match *pair {
            [(bit, bits, one), (next, _, other)] if next < bit + bits as usize => {
                Some(Unwired::Twice(one, other))
            }
            _ => None,
        });
        twice.map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;
    use crate::device::SyncManager;
    use crate::terminal::signal::Signal;

    fn window(number: u8, is_output: bool, entries: &[u32]) -> Window {
        Window {
            number,
            manager: SyncManager::default(),
            is_output,
            entries: entries.iter().copied().map(Entry::new).collect(),
        }
    }

    fn input(at: At) -> DigitalInput {
        DigitalInput {
            at,
            number: Some(0),
            home: None,
            limit_low: None,
            limit_high: None,
            is_inverted: false,
        }
    }

    fn object(index: u16, sub: u8) -> At {
        At::Object { index, sub }
    }

    #[test]
    fn values_are_found_behind_those_of_other_devices_and_windows() {
        let mut wiring = Wiring::default();
        let mut settings = TerminalSettings {
            inputs: vec![input(object(0x6010, 1))],
            ..TerminalSettings::default()
        };
        let four = [0x6000_0101, 0x6010_0101, 0x6020_0101, 0x6030_0101];
        wiring.add(&settings, &[window(0, false, &four)]).unwrap();
        // Nine bits in two bytes, then another window, then a number.
        let nine = [0x6000_0108, 0x6010_0101];
        let number = [0x0000_0008, 0x6020_1110];
        let windows = [
            window(0, false, &nine),
            window(1, true, &four),
            window(2, false, &number),
        ];
        settings.inputs.push(input(At::Bit(31)));
        settings.analog_inputs.push(AnalogInput {
            at: object(0x6020, 0x11),
            number: 0,
            scale: 1.0,
            offset: 0.0,
            is_signed: true,
        });
        wiring.add(&settings, &windows).unwrap();
        let bits: Vec<_> = wiring.inputs.iter().map(|wire| wire.bit).collect();
        assert_eq!(bits, [1, 8 + 8, 8 + 31]);
        assert_eq!(wiring.analog_inputs[0].bit, 8 + 16 + 8);
        assert_eq!((wiring.sizes, wiring.analog_inputs[0].bits), ((1, 6), 16));
    }

    #[test]
    fn what_is_not_there_is_told_with_what_is() {
        let mut wiring = Wiring::default();
        let windows = [window(0, false, &[0x6000_0101, 0x0000_0007, 0x6000_1110])];
        let mut told = |at| {
            let settings = TerminalSettings {
                inputs: vec![input(at)],
                ..TerminalSettings::default()
            };
            wiring.add(&settings, &windows).unwrap_err().to_string()
        };
        assert_eq!(
            told(object(0x6000, 2)),
            "there is no input 0x6000:02 in its process data, which has 0x6000:01 (1 bit), 0x6000:11 \
             (16 bit)"
        );
        let number = told(object(0x6000, 0x11));
        assert!(
            number.starts_with("input 0x6000:11 is 16 bits long, and cannot"),
            "{number}"
        );
        let beyond = told(At::Bit(24));
        assert!(beyond.starts_with("there is no input bit 24"), "{beyond}");
    }

    #[test]
    fn an_output_that_is_named_twice_in_different_ways_is_refused() {
        let output = |at| DigitalOutput {
            at,
            from: Signal::Output(0),
            is_inverted: false,
            rest: false,
        };
        let told = |outputs: Vec<DigitalOutput>| {
            let settings = TerminalSettings {
                outputs,
                ..TerminalSettings::default()
            };
            let four = [0x7000_0101, 0x7010_0101, 0x7020_0101, 0x7030_0101];
            Wiring::default().add(&settings, &[window(0, true, &four)])
        };
        assert_eq!(
            told(vec![output(object(0x7000, 1)), output(At::Bit(1))]),
            Ok(())
        );
        let twice = told(vec![output(object(0x7010, 1)), output(At::Bit(1))]).unwrap_err();
        assert_eq!(
            twice.to_string(),
            "output 0x7010:01 and output bit 1 are the same bits, and an output obeys one thing"
        );
    }
}
