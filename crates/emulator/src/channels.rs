//! The process data of a device that is no drive: inputs and outputs in windows.
//!
//! A simple terminal has a window for each way, or several, and says in its EEPROM what is in them. One
//! with a mailbox has two like a drive, and says by its dictionary.

/// Where the process data of devices with a mailbox is.
pub(crate) const OUTPUTS: u16 = 0x1100;
pub(crate) const INPUTS: u16 = 0x1180;
/// Where the windows of devices without a mailbox begin.
const SIMPLE_OUTPUTS: u16 = 0x0f00;
const SIMPLE_INPUTS: u16 = 0x1000;
/// Sync managers of process data behind those of a mailbox.
const BEHIND_MAILBOX: [u8; 2] = [2, 3];

/// The maps of a device that is no drive: index, subindex and bits of each entry.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Channels {
    /// Maps of outputs of the master, from 0x1600 on.
    pub outputs: Vec<Vec<u32>>,
    /// Maps of inputs of the master, from 0x1A00 on.
    pub inputs: Vec<Vec<u32>>,
    /// In so many windows outputs go, with as many maps in each, at a device without a mailbox.
    pub output_windows: usize,
    /// The maps of inputs that are assigned as it is delivered; `None` for all.
    pub assigned: Option<Vec<u16>>,
}

/// A window onto the memory of a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) manager: u8,
    pub(crate) start: u16,
    pub(crate) length: u16,
    pub(crate) is_output: bool,
}

pub(crate) fn bits(maps: &[Vec<u32>]) -> u32 {
    maps.iter().flatten().map(|entry| entry & 0xff).sum()
}

fn bytes(maps: &[Vec<u32>]) -> u16 {
    u16::try_from(bits(maps).div_ceil(8)).unwrap_or(u16::MAX)
}

impl Channels {
    /// Entries of one bit, a map each.
    pub(crate) fn bits(first: u16, count: u16) -> Vec<Vec<u32>> {
        let entry = |nth: u16| u32::from(first + 0x10 * nth) << 16 | 0x0101;
        (0..count).map(|nth| vec![entry(nth)]).collect()
    }

    /// The windows of a device without a mailbox: outputs first.
    pub(crate) fn simple_windows(&self) -> Vec<(Window, &[Vec<u32>])> {
        let mut windows = Vec::new();
        let each = self.outputs.len().div_ceil(self.output_windows.max(1));
        let mut start = SIMPLE_OUTPUTS;
        let outputs = self.outputs.chunks(each.max(1)).map(|maps| (true, maps));
        let inputs = (!self.inputs.is_empty()).then_some((false, &self.inputs[..]));
        for ((is_output, maps), manager) in outputs.chain(inputs).zip(0..) {
            let length = bytes(maps);
            let window = Window {
                manager,
                start: if is_output { start } else { SIMPLE_INPUTS },
                length,
                is_output,
            };
            start += length;
            windows.push((window, maps));
        }
        windows
    }

    /// The windows of a device with a mailbox, with so many bytes.
    pub(crate) const fn windows_behind_mailbox(outputs: u16, inputs: u16) -> [Window; 2] {
        let [out, back] = BEHIND_MAILBOX;
        [
            Window {
                manager: out,
                start: OUTPUTS,
                length: outputs,
                is_output: true,
            },
            Window {
                manager: back,
                start: INPUTS,
                length: inputs,
                is_output: false,
            },
        ]
    }
}
