//! States of the devices (EtherCAT state machine, ETG.1000.6).

use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::registers::{AL_CONTROL, AL_STATUS};
use crate::wire::Wire;

pub(super) const INIT: u8 = 1;
pub(super) const PRE_OP: u8 = 2;
pub(super) const SAFE_OP: u8 = 4;
pub(super) use crate::device_state::OP;
/// Bit of the state: there is an error; of the control: it is taken note of.
pub(super) const ERROR: u8 = 0x10;

/// How long a device may take.
const PATIENCE_NS: u64 = 5_000_000_000;
const POLL_NS: u64 = 1_000_000;

pub(super) const fn name(state: u8) -> &'static str {
    match state & 15 {
        INIT => "INIT",
        PRE_OP => "PRE-OP",
        SAFE_OP => "SAFE-OP",
        OP => "OP",
        _ => "BOOT",
    }
}

/// Asks a device for a state, and waits until it has it.
pub(super) fn request<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    wanted: u8,
) -> Result<(), BusError> {
    let action = "to a change of its state";
    let nth = device.position;
    bus.write(nth, AL_CONTROL, &[wanted, 0], action)?;
    let until_ns = bus.wire.now_ns() + PATIENCE_NS;
    loop {
        let status: [u8; 6] = bus.read(nth, AL_STATUS, action)?;
        if status[0] & 31 == wanted {
            return Ok(());
        }
        let has_failed = status[0] & ERROR != 0;
        if has_failed || bus.wire.now_ns() > until_ns {
            return Err(BusError::State {
                device: nth,
                name: device.name.clone(),
                wanted: name(wanted),
                code: u16::from_le_bytes([status[4], status[5]]),
            });
        }
        let next_ns = bus.wire.now_ns() + POLL_NS;
        bus.wire.sleep_until(next_ns);
    }
}
