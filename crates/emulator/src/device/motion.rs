//! The drives of a device, step by step: at every SYNC0, or with a frame.

use super::{Device, SyncRecord};
use crate::dictionary::AxisObjects;
use crate::drive::Drive;
use crate::drive_io::Outputs;
use crate::memory::SYNC0_CYCLE;
use crate::process;
use crate::states::OP;

impl Device {
    #[allow(clippy::cast_precision_loss, reason = "a period")]
    pub(super) fn sync(&mut self, at_ns: u64) {
        let cycle_ns = self.memory.number(SYNC0_CYCLE, 4);
        self.next_sync = self.next_sync.map(|sync| sync + cycle_ns.max(1) as f64);
        self.step(at_ns);
    }

    /// What the drive does with the outputs there are.
    #[allow(clippy::cast_precision_loss, reason = "a period")]
    pub(super) fn step(&mut self, at_ns: u64) {
        if self.settings.channels.is_some() {
            return;
        }
        let from_ns = core::mem::replace(&mut self.stepped_ns, at_ns);
        for axis in 0..self.drives.len() {
            self.step_axis(axis, from_ns, at_ns);
        }
    }

    #[allow(clippy::cast_precision_loss, reason = "a period")]
    fn step_axis(&mut self, nth: usize, from_ns: u64, at_ns: u64) {
        let step_t = at_ns.saturating_sub(from_ns).max(1) as f64 * 1e-9;
        let axis = u16::try_from(nth).unwrap_or(0);
        let outputs = if self.state() == OP {
            process::outputs(&self.memory, &self.outputs, &mut self.objects, axis)
        } else {
            Outputs::default()
        };
        let all = &self.objects;
        let drive = &mut self.drives[nth];
        let from = drive.told_place();
        drive.step(step_t, outputs, AxisObjects { all, axis });
        drive.end_step((from_ns, at_ns.max(from_ns + 1)), from);
        let inputs = drive.inputs();
        process::put_inputs(&mut self.memory, &self.inputs, inputs, axis);
        process::put_objects(&mut self.objects, &inputs, axis);
        let index = self.index;
        if let Some(records) = &mut self.records {
            records[nth].push(SyncRecord {
                at_ns,
                index,
                target: outputs.target,
                offsets: (outputs.velocity_offset, outputs.torque_offset),
                actual: inputs.actual,
                status: inputs.status,
                follows: inputs.status & 0x1000 != 0,
            });
        }
    }

    /// No drive waits for the bus.
    pub(super) fn lose_bus(&mut self) {
        self.drives.iter_mut().for_each(Drive::lose_bus);
    }
}
