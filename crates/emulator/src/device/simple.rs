//! The part of a device that is no drive: its windows, and its pins.

use super::Device;
use crate::channels::{Channels, Window};
use crate::dictionary::{INPUTS_ASSIGNED, OUTPUTS_ASSIGNED};
use crate::pins::Pins;
use crate::states::OP;

impl Device {
    /// The windows of its process data; none of a drive or a coupler.
    fn windows(&self) -> Vec<Window> {
        let Some(channels) = &self.settings.channels else {
            return Vec::new();
        };
        if self.settings.has_mailbox {
            let length = |assigned| self.objects.mapped(assigned).1;
            let (out, back) = (length(OUTPUTS_ASSIGNED), length(INPUTS_ASSIGNED));
            return Channels::windows_behind_mailbox(out, back).to_vec();
        }
        let windows = channels.simple_windows().into_iter();
        windows.map(|(window, _)| window).collect()
    }

    /// Its outputs are what was written, in OP; else nothing is at its pins.
    pub(super) fn settle_pins(&mut self, at_ns: u64) {
        if self.settings.channels.is_none() {
            return;
        }
        let is_led = self.state() == OP;
        let windows = self.windows().into_iter();
        let outputs = windows
            .filter(|window| window.is_output)
            .flat_map(|window| {
                let bytes = self.memory.get(window.start, window.length.into());
                let bytes = bytes.unwrap_or_default().iter();
                bytes.map(|byte| if is_led { *byte } else { 0 })
            });
        let outputs = outputs.collect();
        self.pins.put(outputs, at_ns);
    }

    /// Something happens at its inputs.
    pub(crate) fn change_inputs(&mut self, change: impl FnOnce(&mut Pins)) {
        change(&mut self.pins);
        self.show_inputs();
    }

    /// Where an object is in maps, bits, and how many it has there.
    fn place(maps: &[Vec<u32>], (index, sub): (u16, u8)) -> Option<(usize, u32)> {
        let wanted = u32::from(index) << 8 | u32::from(sub);
        let mut bits = 0;
        for entry in maps.iter().flatten() {
            if entry >> 8 == wanted {
                return Some((bits, entry & 0xff));
            }
            bits += (entry & 0xff) as usize;
        }
        None
    }

    /// Whether an output of one bit is on.
    pub(crate) fn output_bit(&self, object: (u16, u8)) -> bool {
        let channels = self.settings.channels.as_ref();
        let place = channels.and_then(|channels| Self::place(&channels.outputs, object));
        place.is_some_and(|(bit, _)| {
            let byte = self.pins.outputs.get(bit / 8).copied().unwrap_or(0);
            byte >> (bit % 8) & 1 == 1
        })
    }

    /// A number comes to an input: a bit, or whole bytes.
    pub(crate) fn put_input(&mut self, object: (u16, u8), value: i64) {
        let channels = self.settings.channels.as_ref();
        let place = channels.and_then(|channels| Self::place(&channels.inputs, object));
        let Some((bit, bits)) = place else {
            return;
        };
        self.change_inputs(|pins| {
            if bits == 1 {
                pins.set_bit(bit, value != 0);
            } else {
                let bytes = value.to_le_bytes();
                pins.set_inputs(bit / 8, &bytes[..(bits / 8).min(8) as usize]);
            }
        });
    }

    /// The master reads what is at its inputs.
    pub(super) fn show_inputs(&mut self) {
        let mut at = 0;
        for window in self
            .windows()
            .into_iter()
            .filter(|window| !window.is_output)
        {
            let length = usize::from(window.length);
            let bytes = self.pins.inputs.iter().skip(at).take(length);
            let mut bytes: Vec<u8> = bytes.copied().collect();
            bytes.resize(length, 0);
            self.memory.put(window.start, &bytes);
            at += length;
        }
    }
}
