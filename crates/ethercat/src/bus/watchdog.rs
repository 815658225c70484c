//! The watchdog of a device's outputs: they fall when no frame has written them for so long.

use super::windows::WATCHED;
use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::registers::{
    OUTPUT_WATCHDOG, SYNC_MANAGER, WATCHDOG_COUNT, WATCHDOG_DIVIDER, WATCHDOG_STATUS,
};
use crate::wire::Wire;

const ACTION: &str = "about the watchdog of its outputs";

/// The watchdog of a device's outputs, as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutputWatchdog {
    /// How long outputs may stay away, ns; 0 for ever.
    pub time_ns: u64,
    /// They stay away for longer.
    pub has_expired: bool,
    /// How often that was.
    pub count: u8,
}

/// The unit of watchdogs, ns: a divider of 25 MHz.
fn unit_ns<W: Wire>(bus: &mut Exchange<'_, W>, nth: usize) -> Result<u64, BusError> {
    let divider = u16::from_le_bytes(bus.read(nth, WATCHDOG_DIVIDER, ACTION)?);
    Ok((u64::from(divider) + 2) * 40)
}

/// Reads the watchdog of a device.
pub(super) fn read<W: Wire>(
    bus: &mut Exchange<'_, W>,
    nth: usize,
) -> Result<OutputWatchdog, BusError> {
    let units = u16::from_le_bytes(bus.read(nth, OUTPUT_WATCHDOG, ACTION)?);
    let [status] = bus.read(nth, WATCHDOG_STATUS, ACTION)?;
    let [count] = bus.read(nth, WATCHDOG_COUNT, ACTION)?;
    Ok(OutputWatchdog {
        time_ns: u64::from(units) * unit_ns(bus, nth)?,
        has_expired: status & 1 == 0,
        count,
    })
}

/// Sets how long the outputs in a window may stay away, and looks whether the device will notice.
pub(super) fn set<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    manager: u8,
    time_ns: u64,
) -> Result<(), BusError> {
    let nth = device.position;
    let units = time_ns / unit_ns(bus, nth)?;
    let units = u16::try_from(units).unwrap_or(u16::MAX).max(1);
    bus.write(nth, OUTPUT_WATCHDOG, &units.to_le_bytes(), ACTION)?;
    let register = SYNC_MANAGER + 8 * u16::from(manager) + 4;
    let [control] = bus.read(nth, register, ACTION)?;
    if control & WATCHED != 0 {
        return Ok(());
    }
    Err(BusError::Unfit {
        device: nth,
        name: device.name.clone(),
        what: format!(
            "it does not let the watchdog of its outputs be switched on (bit 6 of {register:#06x}), so \
             that it would go on when the bus is lost: its manufacturer has to say how it stops"
        ),
    })
}
