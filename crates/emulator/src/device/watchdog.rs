//! The watchdog of a device: without outputs for so long it leaves OP.

use super::Device;
use crate::memory::{
    SYNC_MANAGER, WATCHDOG_COUNT, WATCHDOG_DIVIDER, WATCHDOG_OUTPUTS, WATCHDOG_STATUS,
};
use crate::states::{ERROR, SAFE_OP};

/// The bit in the control of a sync manager that has the watchdog watch it.
const WATCHED: u8 = 1 << 6;

impl Device {
    /// The register with how the sync manager of its outputs works.
    pub(super) const fn output_control(&self) -> u16 {
        let manager = if self.settings.has_mailbox { 2 } else { 0 };
        SYNC_MANAGER + 8 * manager + 4
    }

    /// How long outputs may stay away, ns; 0 for ever.
    pub(super) fn watchdog_ns(&self) -> u64 {
        if self.memory.byte(self.output_control()) & WATCHED == 0 {
            return 0;
        }
        let tick_ns = (u64::from(self.memory.word(WATCHDOG_DIVIDER)) + 2) * 40;
        u64::from(self.memory.word(WATCHDOG_OUTPUTS)) * tick_ns
    }

    /// Outputs have stayed away for longer.
    pub(super) fn expire(&mut self, at_ns: u64) {
        self.set_state(SAFE_OP | ERROR, 0x1b);
        let count = self.memory.byte(WATCHDOG_COUNT).saturating_add(1);
        self.memory.put(WATCHDOG_COUNT, &[count]);
        self.memory.put(WATCHDOG_STATUS, &[0]);
        self.lose_bus();
        self.settle_pins(at_ns);
    }

    /// The watchdog cannot be switched on.
    pub(super) fn refuse_watchdog(&mut self) {
        let register = self.output_control();
        let control = self.memory.byte(register) & !WATCHED;
        self.memory.put(register, &[control]);
    }
}
