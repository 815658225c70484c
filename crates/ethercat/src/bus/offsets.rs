//! The objects in which a drive is told velocity and torque beside its targets.

use crate::coe::{object, read};
use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::settings::DriveSettings;
use crate::wire::Wire;

/// An object: as a map has it, and what it is called.
type Offset = (u32, &'static str);

const VELOCITY: Offset = (0x60b1_0020, "0x60B1 (velocity offset)");
const TORQUE: Offset = (0x60b2_0010, "0x60B2 (torque offset)");

/// Those that a drive is told.
fn wanted(drive: &DriveSettings) -> impl Iterator<Item = Offset> {
    let told = drive.feed_forward;
    let velocity = told.is_some_and(|told| told.velocity_units.is_some());
    let torque = told.is_some_and(|told| told.torque.is_some());
    let velocity = velocity.then_some(VELOCITY);
    velocity.into_iter().chain(torque.then_some(TORQUE))
}

/// The same as a map has them.
pub(super) fn entries(drive: &DriveSettings) -> impl Iterator<Item = u32> {
    wanted(drive).map(|(entry, _)| entry)
}

/// Whether a drive is told any.
pub(super) fn has_any(drive: &DriveSettings) -> bool {
    wanted(drive).next().is_some()
}

/// Looks whether a drive has the objects.
pub(super) fn check<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    drive: &DriveSettings,
) -> Result<(), BusError> {
    for (entry, name) in wanted(drive) {
        let [index, low] = [entry >> 16, entry & 0xff].map(|part| u16::try_from(part).unwrap_or(0));
        let size = u8::try_from(low / 8).unwrap_or(4);
        match read(bus, device, object(drive.own(index), 0, size)) {
            Err(BusError::Object { .. }) => {
                return Err(unfit(device, &format!("it does not have {name}")));
            }
            answered => answered?,
        };
    }
    Ok(())
}

/// The refusal of a device that takes its maps without these alone.
pub(super) fn unmappable(device: &Device, drives: &[&DriveSettings]) -> BusError {
    let mut names: Vec<_> = drives.iter().flat_map(|drive| wanted(drive)).collect();
    names.sort_unstable();
    names.dedup();
    let names: Vec<_> = names.into_iter().map(|(_, name)| name).collect();
    let what = format!(
        "it does not let {} be mapped into its process data",
        names.join(" and ")
    );
    unfit(device, &what)
}

fn unfit(device: &Device, what: &str) -> BusError {
    BusError::Unfit {
        device: device.position,
        name: device.name.clone(),
        what: format!(
            "{what}: leave it out of feed_forward in its table in drives.toml, and let the drive's own \
             feed-forward do its work"
        ),
    }
}
