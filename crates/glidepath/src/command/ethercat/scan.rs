//! The scan of the wire: a list of the devices on it.

use crate::cli::ScanArgs;
use crate::command::failure::Failure;
use crate::drives::{Found, FoundProbe, written};
use crate::exit::Exit;
use crate::output;
use glidepath_ethercat::{BusError, DEVICE_AXES, Init, PacketWire, PreOp, RunError, Wire, object};
use serde_json::json;

#[cfg(test)]
mod tests;

/// Lists the devices as a first `drives.toml`.
///
/// # Errors
/// The interface cannot be used, or nobody answers.
pub(super) fn scan(args: &ScanArgs) -> Result<Exit, Failure> {
    let mut wire = PacketWire::open_alone(&args.interface)?;
    let found = look(&mut wire).map_err(RunError::from)?;
    if args.json {
        let device = |found: &Found| {
            let (device, id) = (&found.device, found.device.identity);
            json!({
                "position": device.position,
                "name": device.name,
                "vendor": id.vendor,
                "product": id.product,
                "revision": id.revision,
                "serial": id.serial,
                "alias": device.alias,
                "has_clock": device.clock.is_clock(),
                "counts_per_revolution": found.counts_per_revolution,
                "drive": found.is_drive(),
                "axes": found.axes,
                "touch_probe_units": found.probes.iter().map(units).collect::<Vec<_>>(),
                "input_bits": bits(found, false),
                "output_bits": bits(found, true),
                "output_watchdog": found.watchdog.map(|watchdog| json!({
                    "time_us": watchdog.time_ns / 1000,
                    "expired": watchdog.has_expired,
                    "count": watchdog.count,
                })),
            })
        };
        let devices: Vec<_> = found.iter().map(device).collect();
        output::object(&json!({ "interface": args.interface, "devices": devices }));
    } else {
        output::result(&written(&args.interface, &found));
    }
    Ok(Exit::Done)
}

/// The touch probes of a drive, by their numbers.
fn units(probe: &FoundProbe) -> Vec<usize> {
    let units = (1..).zip(probe.units);
    units
        .filter(|(_, has)| *has)
        .map(|(unit, _)| unit)
        .collect()
}

/// Bits of its inputs or outputs.
fn bits(found: &Found, is_output: bool) -> u32 {
    let windows = found.windows.iter().filter(|w| w.is_output == is_output);
    let entries = windows.flat_map(|window| &window.entries);
    entries.map(|entry| entry.bits).sum()
}

fn look<W: Wire>(wire: &mut W) -> Result<Vec<Found>, BusError> {
    let mut bus = Init::find(wire)?.into_pre_op()?;
    let devices = bus.devices().to_vec();
    Ok(devices
        .into_iter()
        .map(|device| {
            let position = device.position;
            let mut read = |index, sub| bus.read(position, object(index, sub, 4)).ok();
            // CiA 402 in the low half; what is not asked for by a mailbox is no drive.
            let is_drive =
                device.has_coe && read(0x1000, 0).is_some_and(|kind| kind & 0xffff == 402);
            let modes = is_drive.then(|| read(0x6502, 0).unwrap_or(0));
            // Objects of an axis are 0x800 behind those of the one before.
            let has = |axis: &u16| read(0x6502 + 0x800 * axis, 0).is_some();
            let axes = modes.map_or(1, |_| 1 + (1..DEVICE_AXES).take_while(has).count());
            let axes = u16::try_from(axes).unwrap_or(1);
            let of_drive = 0..modes.map_or(0, |_| axes);
            let probes = of_drive.map(|axis| probe(&mut bus, position, axis));
            let probes = probes.collect();
            let counts = modes.and_then(|_| counts_per_revolution(&mut bus, position));
            Found {
                // One that does not tell has none that can be named.
                windows: if modes.is_none() {
                    bus.windows(position).unwrap_or_default()
                } else {
                    Vec::new()
                },
                watchdog: bus.watchdog(position).ok(),
                device,
                axes,
                probes,
                counts_per_revolution: counts,
                modes: modes.map(|modes| (modes & 1 << 7 != 0, modes & 1 << 5 != 0)),
            }
        })
        .collect())
}

/// What a drive has of touch probes: both edges of a unit, as the bridge asks for them.
fn probe<W: Wire>(bus: &mut PreOp<'_, W>, position: usize, axis: u16) -> FoundProbe {
    let first = 0x800 * axis;
    let mut has = |index, sub, size| {
        let object = object(first + index, sub, size);
        bus.read(position, object).is_ok()
    };
    let has_units = has(0x60b8, 0, 2) && has(0x60b9, 0, 2);
    let mut unit = |places: [u16; 2]| has_units && places.iter().all(|place| has(*place, 0, 4));
    FoundProbe {
        units: [unit([0x60ba, 0x60bb]), unit([0x60bc, 0x60bd])],
        has_sources: has_units && has(0x60d0, 1, 2),
        has_inputs: has(0x60fd, 0, 4),
    }
}

/// Encoder increments over motor revolutions; `None` where the drive does not tell.
fn counts_per_revolution<W: Wire>(bus: &mut PreOp<'_, W>, position: usize) -> Option<f64> {
    let increments = bus.read(position, object(0x608f, 1, 4)).ok()?;
    let revolutions = bus.read(position, object(0x608f, 2, 4)).ok()?;
    // One for one is what a drive has that was never told.
    (revolutions > 0 && increments > 1).then(|| f64::from(increments) / f64::from(revolutions))
}
