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
