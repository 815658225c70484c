//! The touch probes of the drives of a device, and their inputs.

use super::Device;
use crate::dictionary::{AxisObjects, PROBE_SOURCE};
use crate::process;
use crate::way::Ways;

impl Device {
    /// Whether its drives have touch probes.
    pub(crate) const fn has_probe(&self) -> bool {
        self.settings.touch_probe.is_some()
    }

    /// Keeps the ways of its motors from here on.
    pub(crate) fn keep_ways(&mut self) {
        for drive in &mut self.drives {
            drive.ways.get_or_insert_with(Ways::default);
        }
    }

    /// An edge at the touch probes of all of its drives.
    pub(crate) fn capture(&mut self, rises: bool, at_ns: u64) {
        for (axis, drive) in (0..).zip(&mut self.drives) {
            let all = &self.objects;
            let objects = AxisObjects { all, axis };
            let source = |unit| objects.value((PROBE_SOURCE, unit));
            drive.capture(rises, at_ns, [source(1), source(2)]);
        }
        self.show_drives();
    }

    /// A bit of the inputs of a drive is high or low.
    pub(crate) fn show_at_drive(&mut self, axis: usize, bit: u8, is_high: bool) {
        if let Some(drive) = self.drives.get_mut(axis) {
            drive.set_digital(bit, is_high);
        }
        self.show_drives();
    }

    /// The master reads what its drives have to tell.
    pub(super) fn show_drives(&mut self) {
        for (axis, drive) in (0..).zip(&self.drives) {
            let inputs = drive.inputs();
            process::put_inputs(&mut self.memory, &self.inputs, inputs, axis);
            process::put_objects(&mut self.objects, &inputs, axis);
        }
    }
}
