//! The parameters that a drive is given before the cycles begin, object by object.

use crate::coe::{Object, object, read, write};
use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::settings::{BusSettings, DriveSettings};
use crate::terminal::SpindleMode;
use crate::turns::Round;
use crate::wire::Wire;

/// The synchronization types of outputs and of inputs, and what they can be.
const SYNC_OUTPUTS: Object = object(0x1c32, 1, 2);
const SYNC_INPUTS: Object = object(0x1c33, 1, 2);
const FREE: u32 = 0;
const BY_FRAME: u32 = 1;
const BY_SYNC0: u32 = 2;

/// By ramp, then without power.
const BY_RAMP: u32 = 2;

/// The codes of refusals to write an object that a drive does not have, or has fixed.
const NOT_THERE: [u32; 4] = [0x0602_0000, 0x0609_0011, 0x0601_0002, 0x0601_0000];

/// Writes all parameters of a drive, before its process data is mapped: what of it is in maps that stay is sent as the
/// drive has it then.
pub(super) fn write_all<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    settings: &BusSettings,
    drive: &DriveSettings,
) -> Result<(), BusError> {
    let own = |index, sub, size| object(drive.own(index), sub, size);
    let mut set = |object, value| write(bus, device, object, value);
    // Interpolation between targets: the period of the bus, as a number of milliseconds, or else of
    // tens of microseconds.
    let (count, exponent) = interpolation_time(settings.period_ns);
    set(own(0x60c2, 1, 1), count)?;
    set(own(0x60c2, 2, 1), exponent)?;
    set(own(0x6065, 0, 4), drive.unsigned(drive.following_error))?;
    set(own(0x6066, 0, 2), drive.following_ms.into())?;
    set(own(0x6085, 0, 4), drive.unsigned(drive.quick_stop_a))?;
    let limits = [0x60e0, 0x60e1].into_iter().zip(drive.own_torque_limits());
    for (index, limit) in limits {
        if let Some(limit) = limit {
            set(own(index, 0, 2), limit.into())?;
        }
    }
    if let Some(homing) = drive.homing {
        #[allow(clippy::cast_sign_loss, reason = "the object is a signed byte")]
        set(own(0x6098, 0, 1), u32::from(homing.method as u8))?;
        set(own(0x6099, 1, 4), drive.unsigned(homing.fast_v))?;
        set(own(0x6099, 2, 4), drive.unsigned(homing.slow_v))?;
        set(own(0x609a, 0, 4), drive.unsigned(homing.acceleration_a))?;
        set(own(0x607c, 0, 4), 0)?;
    }
    // What not all drives let themselves be told: what to do at a quick stop and at a fault, and that
    // outputs and inputs are those of SYNC0, which many see by SYNC0 itself.
    for (option, value) in [
        (own(0x605a, 0, 2), BY_RAMP),
        (own(0x605e, 0, 2), BY_RAMP),
        (SYNC_OUTPUTS, BY_SYNC0),
        (SYNC_INPUTS, BY_SYNC0),
    ] {
        where_possible(write(bus, device, option, value))?;
    }
    Ok(())
}

/// The range of a drive's counter (0x607B); one that does not tell has 32 bits.
pub(super) fn round<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    drive: &DriveSettings,
) -> Result<Round, BusError> {
    round_of(bus, device, drive.own(0x607b))
}

/// The range of a counter, whose object of that is this.
#[allow(
    clippy::cast_possible_wrap,
    reason = "the bits of a number with a sign"
)]
pub(super) fn round_of<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    index: u16,
) -> Result<Round, BusError> {
    let mut ends = [0; 2];
    for (sub, end) in (1..).zip(&mut ends) {
        match read(bus, device, object(index, sub, 4)) {
            Ok(told) => *end = told as i32,
            Err(BusError::Object { .. }) => return Ok(Round::of(0, 0)),
            Err(error) => return Err(error),
        }
    }
    Ok(Round::of(ends[0], ends[1]))
}

/// Gives the drive of the spindle its mode, and tells one that works with SYNC0 its period.
pub(super) fn write_spindle<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    period_ns: u64,
    mode: SpindleMode,
) -> Result<(), BusError> {
    #[allow(clippy::cast_sign_loss, reason = "the object is a signed byte")]
    write(
        bus,
        device,
        object(0x6060, 0, 1),
        u32::from(mode.code() as u8),
    )?;
    if !mode.is_cyclic() {
        return Ok(());
    }
    let (count, exponent) = interpolation_time(period_ns);
    for (option, value) in [
        (object(0x60c2, 1, 1), count),
        (object(0x60c2, 2, 1), exponent),
        (SYNC_OUTPUTS, BY_SYNC0),
        (SYNC_INPUTS, BY_SYNC0),
    ] {
        where_possible(write(bus, device, option, value))?;
    }
    Ok(())
}

/// Looks whether a drive works with SYNC0, as far as it tells. It is known in SAFE-OP.
pub(super) fn check_sync<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
) -> Result<(), BusError> {
    match read(bus, device, SYNC_OUTPUTS) {
        Ok(kind @ (FREE | BY_FRAME)) => Err(BusError::Unfit {
            device: device.position,
            name: device.name.clone(),
            what: format!(
                "it does not take its targets over at SYNC0 (0x1C32:1 is {kind}, and it was to be \
                 2): switch it to distributed clocks with its manufacturer's tool"
            ),
        }),
        Ok(_) | Err(BusError::Object { .. }) => Ok(()),
        Err(error) => Err(error),
    }
}

/// The bus period as 0x60C2 has it: a number and a power of ten of a second.
#[allow(clippy::cast_possible_truncation, reason = "a period of milliseconds")]
const fn interpolation_time(period_ns: u64) -> (u32, u32) {
    if period_ns.is_multiple_of(1_000_000) {
        ((period_ns / 1_000_000) as u32, 0xfd)
    } else {
        ((period_ns / 10_000) as u32, 0xfb)
    }
}

fn where_possible(written: Result<(), BusError>) -> Result<(), BusError> {
    match written {
        Err(BusError::Object { code, .. }) if NOT_THERE.contains(&code) => Ok(()),
        written => written,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_is_told_in_the_form_that_drives_know() {
        assert_eq!(interpolation_time(2_000_000), (2, 0xfd));
        assert_eq!(interpolation_time(500_000), (50, 0xfb));
    }
}
