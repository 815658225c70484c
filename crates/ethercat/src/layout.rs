//! Where each object is in the process data of a drive.

use crate::device::Device;
use crate::entry::{Entry, bits, bytes};

const CONTROL: Wanted = Wanted(0x6040, 16, "0x6040 (controlword)");
const TARGET: Wanted = Wanted(0x607a, 32, "0x607A (target position)");
const MODE: Wanted = Wanted(0x6060, 8, "0x6060 (mode)");
const STATUS: Wanted = Wanted(0x6041, 16, "0x6041 (statusword)");
const ACTUAL: Wanted = Wanted(0x6064, 32, "0x6064 (actual position)");
const SHOWN_MODE: Wanted = Wanted(0x6061, 8, "0x6061 (mode in force)");
const FAULT: Wanted = Wanted(0x603f, 16, "0x603F (error code)");

/// An object: index, bits, and what it is called.
#[derive(Debug, Clone, Copy)]
struct Wanted(u16, u32, &'static str);

impl Wanted {
    /// Where it begins, bytes; `None` if it is not mapped, with another size, or inside a byte.
    fn place(self, entries: &[Entry]) -> Option<usize> {
        let nth = entries
            .iter()
            .position(|entry| (entry.index, entry.sub, entry.bits) == (self.0, 0, self.1))?;
        let bits = bits(&entries[..nth]);
        bits.is_multiple_of(8).then_some(bits as usize / 8)
    }

    fn place_or_name(self, entries: &[Entry]) -> Result<usize, &'static str> {
        self.place(entries).ok_or(self.2)
    }
}

/// The layout of the process data of a drive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Layout {
    /// What is sent in every cycle beside what is led: 0, or what the drive has.
    pub(crate) rest: Vec<u8>,
    pub(crate) control: usize,
    pub(crate) target: usize,
    /// Where the mode is; `None` if it is not mapped, and was set as a parameter.
    pub(crate) mode: Option<usize>,
    /// Bytes of the inputs.
    pub(crate) input_bytes: usize,
    pub(crate) status: usize,
    pub(crate) actual: usize,
    pub(crate) shown_mode: Option<usize>,
    pub(crate) fault: Option<usize>,
}

impl Layout {
    /// The layout of what is mapped, or the object that is missing or not where a byte begins.
    /// `switches_mode` if the mode has to be switched and seen.
    pub(crate) fn of(
        outputs: &[Entry],
        inputs: &[Entry],
        switches_mode: bool,
    ) -> Result<Self, &'static str> {
        if switches_mode {
            MODE.place_or_name(outputs)?;
            SHOWN_MODE.place_or_name(inputs)?;
        }
        Ok(Self {
            rest: vec![0; bytes(outputs)],
            control: CONTROL.place_or_name(outputs)?,
            target: TARGET.place_or_name(outputs)?,
            mode: MODE.place(outputs),
            input_bytes: bytes(inputs),
            status: STATUS.place_or_name(inputs)?,
            actual: ACTUAL.place_or_name(inputs)?,
            shown_mode: SHOWN_MODE.place(inputs),
            fault: FAULT.place(inputs),
        })
    }
}

/// A drive in the image of all: the outputs of all drives, then the inputs of all.
#[derive(Debug, Clone)]
pub(crate) struct Led {
    pub(crate) device: Device,
    pub(crate) layout: Layout,
    /// Where its outputs are among those of all, bytes.
    pub(crate) outputs_at: usize,
    /// Where its inputs are among those of all, bytes.
    pub(crate) inputs_at: usize,
}

impl Led {
    /// Drives one after the other.
    pub(crate) fn in_a_row(drives: Vec<(Device, Layout)>) -> Vec<Self> {
        let (mut outputs_at, mut inputs_at) = (0, 0);
        let place = |(device, layout): (Device, Layout)| {
            let led = Self {
                device,
                outputs_at,
                inputs_at,
                layout,
            };
            outputs_at += led.layout.rest.len();
            inputs_at += led.layout.input_bytes;
            led
        };
        drives.into_iter().map(place).collect()
    }

    /// Bytes of the outputs and of the inputs of all.
    pub(crate) fn sizes(drives: &[Self]) -> (usize, usize) {
        let outputs = drives.iter().map(|led| led.layout.rest.len()).sum();
        let inputs = drives.iter().map(|led| led.layout.input_bytes).sum();
        (outputs, inputs)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn entries(entries: &[u32]) -> Vec<Entry> {
        entries.iter().copied().map(Entry::new).collect()
    }

    #[test]
    fn objects_are_found_where_they_are_mapped() {
        // As an Omron G5 has it.
        let outputs = entries(&[0x6040_0010, 0x607a_0020, 0x60b8_0010, 0x60fe_0120]);
        let inputs = entries(&[0x603f_0010, 0x6041_0010, 0x6064_0020, 0x60fd_0020]);
        let layout = Layout::of(&outputs, &inputs, false).unwrap();
        assert_eq!((layout.control, layout.target, layout.mode), (0, 2, None));
        assert_eq!((layout.rest.len(), layout.input_bytes), (12, 12));
        let seen = (layout.fault, layout.status, layout.actual);
        assert_eq!(seen, (Some(0), 2, 4));
        let refused = Layout::of(&outputs, &inputs, true);
        assert_eq!(refused, Err("0x6060 (mode)"));
    }

    #[test]
    fn what_is_inside_a_byte_or_of_another_size_does_not_count() {
        let outputs = entries(&[0x0000_0004, 0x6040_0010, 0x0000_0004, 0x607a_0020]);
        let inputs = entries(&[0x6041_0010, 0x6064_0010]);
        let refused = Layout::of(&outputs, &inputs, false);
        assert_eq!(refused, Err("0x6040 (controlword)"));
        let refused = Layout::of(&entries(&[0x6040_0010, 0x607a_0020]), &inputs, false);
        assert_eq!(refused, Err("0x6064 (actual position)"));
    }
}
