//! The touch probes of drives, before the cycles begin: whether a drive has one, and what it is wired to.

use crate::abort_text;
use crate::coe::{object, read, write};
use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::layout::ProbeAccess;
use crate::probe::TouchProbe;
use crate::settings::DriveSettings;
use crate::wire::Wire;

/// Looks whether a drive has the objects, and chooses the source. Nothing is mapped yet, as far as is known here.
pub(super) fn prepare<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    drive: &DriveSettings,
    probe: TouchProbe,
) -> Result<ProbeAccess, BusError> {
    let own = |index, sub, size| object(drive.own(index), sub, size);
    let lacks = |error| unfit(device, drive, error);
    let function = read(bus, device, own(0x60b8, 0, 2)).map_err(lacks)?;
    read(bus, device, own(0x60b9, 0, 2)).map_err(lacks)?;
    for index in probe.places() {
        read(bus, device, own(index, 0, 4)).map_err(lacks)?;
    }
    if let Some(source) = probe.source {
        write(bus, device, own(0x60d0, probe.unit, 2), source.into()).map_err(lacks)?;
    }
    Ok(ProbeAccess {
        probe,
        axis: drive.axis,
        before: u16::try_from(function).unwrap_or(0),
        function: None,
        places: None,
    })
}

/// A drive that has not what `probe` in its table asks for.
fn unfit(device: &Device, drive: &DriveSettings, error: BusError) -> BusError {
    let BusError::Object {
        index, sub, code, ..
    } = error
    else {
        return error;
    };
    BusError::Unfit {
        device: device.position,
        name: device.name.clone(),
        what: format!(
            "the drive of J{} has no touch probe as drives.toml wants it ({index:#06x}:{sub} was refused: {}): leave \
             `probe` out of the tables of all drives, and the contact is found from positions, as without; and `index` \
             out of its own",
            drive.joint,
            abort_text::text(code)
        ),
    }
}
