//! The mailbox of a device, in the cycles of OP.

use crate::device::Device;
use crate::exchange::station;

/// The mailbox of a device: whose, and where and how long both ways are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Mailbox {
    /// The number of the device, drives first.
    pub(super) nth: usize,
    pub(super) station: u16,
    /// Start and length, of that to the device, and of that from it.
    pub(super) out: (u16, u16),
    pub(super) back: (u16, u16),
}

impl Mailbox {
    pub(super) fn of(nth: usize, device: &Device) -> Option<Self> {
        let (out, back) = device.mailbox?;
        Some(Self {
            nth,
            station: station(device.position),
            out: (out.start, out.length),
            back: (back.start, back.length),
        })
    }
}
