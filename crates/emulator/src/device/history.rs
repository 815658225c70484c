//! The diagnosis history of a device (0x10F3): what it has to say of its faults.

use super::Device;
use crate::dictionary::{HISTORY, MESSAGES, NEWEST};

/// The subindex of the first message.
const FIRST: u32 = 6;
/// A code that says that the number of a fault of CiA 402 is behind it, and the flag of an error.
const FAULT: u16 = 0xe800;
const ERROR: u16 = 2;
/// The number of its text is that of the fault behind this.
const TEXT: u16 = 0x4000;

impl Device {
    /// A message about a fault: the oldest one gives way.
    #[allow(clippy::cast_possible_truncation, reason = "9 at most")]
    pub(super) fn note_fault(&mut self, code: u16, now_ns: u64) {
        if !self.settings.has_history {
            return;
        }
        let newest = self.objects.value(NEWEST);
        let next = if (FIRST..FIRST + MESSAGES - 1).contains(&newest) {
            newest + 1
        } else {
            FIRST
        };
        let words = [FAULT, code, ERROR, TEXT | code & 0xfff];
        let mut bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        bytes.extend(self.system_register(now_ns).to_le_bytes());
        // A parameter: a number of four bytes.
        bytes.extend([0x07, 0x00, 1, 2, 3, 4]);
        self.mailbox.long.put((HISTORY, next as u8), bytes);
        self.objects.set(NEWEST, next);
    }
}
