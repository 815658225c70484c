//! Windows into the memory of a device, as they are written: sync managers and FMMUs.

use crate::device::SyncManager;
use crate::layout::DriveDevice;

/// Bit in the control of a sync manager: the watchdog waits for what is written.
pub(super) const WATCHED: u8 = 1 << 6;

/// A sync manager as it is written.
pub(super) fn manager(manager: SyncManager) -> [u8; 8] {
    let ([s0, s1], [l0, l1]) = (manager.start.to_le_bytes(), manager.length.to_le_bytes());
    [
        s0,
        s1,
        l0,
        l1,
        manager.control,
        0,
        u8::from(manager.length > 0),
        0,
    ]
}

/// The sync managers of a device's process data, and the windows onto them in the logical image: the
/// outputs of all devices with drives, which are so many bytes, then their inputs.
#[allow(clippy::cast_possible_truncation, reason = "nine drives")]
pub(super) fn process(led: &DriveDevice, outputs: usize) -> (Vec<u8>, Vec<u8>) {
    let (out, back) = led.device.process.unwrap_or_default();
    let sized = |from: SyncManager, length: usize| SyncManager {
        length: length as u16,
        ..from
    };
    let (mut out, back) = (sized(out, led.rest.len()), sized(back, led.input_bytes));
    // Not every EEPROM has it, and without it the drive waits for frames for ever.
    out.control |= WATCHED;
    let (at_out, at_back) = (led.outputs_at as u32, (outputs + led.inputs_at) as u32);
    let managers = [manager(out), manager(back)].concat();
    let windows = [window(at_out, out, 2), window(at_back, back, 1)].concat();
    (managers, windows)
}

/// An FMMU as it is written; `kind` 1 for reading, 2 for writing.
pub(super) fn window(at: u32, manager: SyncManager, kind: u8) -> [u8; 16] {
    let [a, b, c, d] = at.to_le_bytes();
    let ([l0, l1], [p0, p1]) = (manager.length.to_le_bytes(), manager.start.to_le_bytes());
    [a, b, c, d, l0, l1, 0, 7, p0, p1, 0, kind, 1, 0, 0, 0]
}
