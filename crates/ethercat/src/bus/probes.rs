//! The touch probes of drives, before the cycles begin: whether a drive has one, and what it is wired to.

use crate::abort_text;
use crate::coe::{object, read, write};
use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::layout::ProbeAccess;
use crate::probe::{ProbeUse, TouchProbe};
use crate::settings::DriveSettings;
use crate::wire::Wire;

/// Looks whether a drive has the objects, chooses the source, and tries the zero impulse where that is wanted. Nothing
/// is mapped yet, as far as is known here.
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
    let before = u16::try_from(function).unwrap_or(0);
    if drive.index.is_some() {
        // In the cycles nobody would hear that it refuses that.
        for of in [ProbeUse::Index, ProbeUse::Off] {
            let value = probe.function(before, of).into();
            write(bus, device, own(0x60b8, 0, 2), value)
                .map_err(|error| no_zero_impulse(device, drive, error))?;
        }
    }
    Ok(ProbeAccess {
        probe,
        axis: drive.axis,
        before,
        function: None,
        places: None,
    })
}

/// A drive that has not what `probe` or `index` in its table asks for.
fn unfit(device: &Device, drive: &DriveSettings, error: BusError) -> BusError {
    let without_probe = drive.probe.map(|_| {
        "leave `probe` out of the tables of all drives: the contact is then found from positions".to_owned()
    });
    let without_index = drive.index.map(|_| without_index(drive));
    let remedies: Vec<_> = without_probe.into_iter().chain(without_index).collect();
    let what = "has no touch probe as drives.toml wants it";
    refused(device, drive, (what, &remedies.join("; and ")), error)
}

/// A drive that does not keep the zero impulse, as `index` in its table asks for.
fn no_zero_impulse(device: &Device, drive: &DriveSettings, error: BusError) -> BusError {
    let what = "does not keep the zero impulse of its encoder, as `index` in drives.toml wants it";
    refused(device, drive, (what, &without_index(drive)), error)
}

fn without_index(drive: &DriveSettings) -> String {
    format!(
        "leave `index` out of its table, and index = \"drive\" out of [home.J{}] of the machine: its joint then comes \
         home by a switch",
        drive.joint
    )
}

/// What an object that was refused means, and what is to be done.
fn refused(
    device: &Device,
    drive: &DriveSettings,
    (what, remedy): (&str, &str),
    error: BusError,
) -> BusError {
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
            "the drive of J{} {what} ({index:#06x}:{sub} was refused: {}): {remedy}",
            drive.joint,
            abort_text::text(code)
        ),
    }
}
