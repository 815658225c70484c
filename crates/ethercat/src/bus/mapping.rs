//! What is in the process data of a drive: mapped by the master, or taken as the drive has it.

use super::{offsets, parameters, probes};
use crate::abort_text;
use crate::coe::{Object, object, read, write};
use crate::device::Device;
use crate::entry::{Entry, Mapping, bytes};
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::layout::{Layout, Needs};
use crate::settings::DriveSettings;
use crate::wire::Wire;

/// What is mapped: index, subindex and bits of each object.
const OUTPUTS: [u32; 3] = [0x6040_0010, 0x607a_0020, 0x6060_0008];
const INPUTS: [u32; 4] = [0x6041_0010, 0x6064_0020, 0x6061_0008, 0x603f_0010];
/// Digital inputs of a drive, if they are wanted.
const DIGITAL: u32 = 0x60fd_0020;
/// The same of a touch probe: what it is to do; what it has done, in front of what it keeps.
const PROBE_OUTPUT: u32 = 0x60b8_0010;
const PROBE_STATUS: u32 = 0x60b9_0010;
/// A gap of a byte.
const GAP: u32 = 0x0000_0008;

pub(super) const OUTPUT_ASSIGNMENT: u16 = 0x1c12;
pub(super) const INPUT_ASSIGNMENT: u16 = 0x1c13;
const OUTPUT_MAP: u16 = 0x1600;
const INPUT_MAP: u16 = 0x1a00;
/// Bytes of a map that every drive takes. Some take no more (Kollmorgen AKD).
const SHORT_BYTES: usize = 8;
/// Maps of a drive, and entries of a map, that are read at most.
const MOST: u32 = 64;

/// Cyclic synchronous position.
const CYCLIC_POSITION: u32 = 8;

/// What is in the process data of a device with drives.
#[derive(Debug)]
pub(super) struct Mapped {
    /// Where each of them has its objects.
    pub(super) layouts: Vec<Layout>,
    /// What is sent beside what is led.
    pub(super) rest: Vec<u8>,
    /// Bytes of the inputs.
    pub(super) input_bytes: usize,
}

/// Sees to what is in the process data of a device with these drives.
pub(super) fn set<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    drives: &[&DriveSettings],
) -> Result<Mapped, BusError> {
    for drive in drives {
        offsets::check(bus, device, drive)?;
    }
    let is_kept = drives.iter().any(|drive| drive.mapping == Mapping::Kept);
    let (outputs, inputs) = if is_kept {
        (
            mapped(bus, device, OUTPUT_ASSIGNMENT)?,
            mapped(bus, device, INPUT_ASSIGNMENT)?,
        )
    } else {
        map(bus, device, drives)?
    };
    let mut layouts = Vec::new();
    for drive in drives {
        let own = |index| drive.own(index);
        let layout = Layout::of(&outputs, &inputs, &own, Needs::of(drive));
        let mut layout = layout.map_err(|lacks| BusError::Unfit {
            device: device.position,
            name: device.name.clone(),
            what: format!(
                "its process data lacks {lacks}{}: map it with the manufacturer's tool, or leave map = \
                 \"keep\" out of its table in drives.toml",
                of_axis(drive)
            ),
        })?;
        if layout.mode.is_none() {
            let mode = object(drive.own(0x6060), 0, 1);
            write(bus, device, mode, CYCLIC_POSITION)?;
        }
        if let Some(probe) = drive.touch_probe() {
            let access = probes::prepare(bus, device, drive, probe)?;
            layout.probe = Some(access.find((&outputs, &inputs), &own));
        }
        if drive.is_modulo {
            layout.round = Some(parameters::round(bus, device, drive)?);
        }
        layouts.push(layout);
    }
    let mut rest = vec![0; bytes(&outputs)];
    keep(bus, device, &outputs, &mut rest)?;
    Ok(Mapped {
        layouts,
        rest,
        input_bytes: bytes(&inputs),
    })
}

/// Which of several axes of a device it is.
fn of_axis(drive: &DriveSettings) -> String {
    if drive.axis == 0 {
        String::new()
    } else {
        format!(" of axis {}", drive.axis)
    }
}

/// Fills in what is not led with what the drive has: a limit of torque that is mapped is not to become
/// none.
pub(super) fn keep<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    outputs: &[Entry],
    rest: &mut [u8],
) -> Result<(), BusError> {
    for (nth, entry) in outputs.iter().enumerate() {
        let at = bytes(&outputs[..nth]);
        let size = entry.bits / 8;
        let is_whole = matches!(entry.bits, 8 | 16 | 32);
        if entry.index == 0 || entry.is_led() || !is_whole {
            continue;
        }
        #[allow(clippy::cast_possible_truncation, reason = "1, 2 or 4")]
        match read(bus, device, object(entry.index, entry.sub, size as u8)) {
            Ok(value) => {
                let value = value.to_le_bytes();
                for (place, byte) in rest.iter_mut().skip(at).zip(&value[..size as usize]) {
                    *place = *byte;
                }
            }
            // It cannot be read: it is one that has no value of its own.
            Err(BusError::Object { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// What is mapped, as the device tells.
pub(super) fn mapped<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    assignment: u16,
) -> Result<Vec<Entry>, BusError> {
    let mut entries = Vec::new();
    for nth in 1..=count(bus, device, assignment)? {
        let map = read(bus, device, object(assignment, nth, 2))?;
        let map = u16::try_from(map).unwrap_or(0);
        for sub in 1..=count(bus, device, map)? {
            let entry = read(bus, device, object(map, sub, 4))?;
            entries.push(Entry::new(entry));
        }
    }
    Ok(entries)
}

#[allow(clippy::cast_possible_truncation, reason = "64 at most")]
fn count<W: Wire>(bus: &mut Exchange<'_, W>, device: &Device, index: u16) -> Result<u8, BusError> {
    Ok(read(bus, device, object(index, 0, 1))?.min(MOST) as u8)
}

/// Maps: the index and the entries of each.
type Maps = Vec<(u16, Vec<u32>)>;

/// How entries are spread over maps.
type Split = fn(&[u32]) -> Vec<Vec<u32>>;

/// What of a drive is mapped beside what every one needs.
#[derive(Debug, Clone, Copy)]
struct With {
    probes: bool,
    offsets: bool,
}

/// Maps what is needed of each drive. Returns both ways. Touch probes that a drive does not let be mapped
/// are asked by its mailbox; offsets of targets have to be mapped.
fn map<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    drives: &[&DriveSettings],
) -> Result<(Vec<Entry>, Vec<Entry>), BusError> {
    let mut map_all = |probes, offsets| {
        let with = With { probes, offsets };
        map_as(bus, device, &|split| {
            (
                of_all(drives, OUTPUT_MAP, &|drive| outputs(drive, with), split),
                of_all(drives, INPUT_MAP, &|drive| inputs(drive, with), split),
            )
        })
    };
    let has_probes = drives.iter().any(|drive| drive.touch_probe().is_some());
    let has_offsets = drives.iter().any(|drive| offsets::has_any(drive));
    let mapped = match map_all(has_probes, has_offsets) {
        Err(BusError::Unfit { .. }) if has_probes => map_all(false, has_offsets),
        done => done,
    };
    match mapped {
        // Is it they?
        Err(BusError::Unfit { .. }) if has_offsets && map_all(false, false).is_ok() => {
            Err(offsets::unmappable(device, drives))
        }
        done => done,
    }
}

/// The outputs that a drive needs.
fn outputs(drive: &DriveSettings, with: With) -> Vec<u32> {
    let probe = drive.touch_probe().filter(|_| with.probes);
    let mut entries = OUTPUTS.to_vec();
    entries.extend(probe.map(|_| PROBE_OUTPUT));
    entries.extend(offsets::entries(drive).filter(|_| with.offsets));
    entries
}

/// The inputs that a drive needs.
fn inputs(drive: &DriveSettings, with: With) -> Vec<u32> {
    let mut entries = INPUTS.to_vec();
    entries.extend(drive.has_inputs.then_some(DIGITAL));
    if let Some(probe) = drive.touch_probe().filter(|_| with.probes) {
        let kept = probe.places().map(|index| u32::from(index) << 16 | 0x20);
        entries.push(PROBE_STATUS);
        entries.extend(kept);
    }
    entries
}

/// Maps these outputs and inputs.
pub(super) fn map_entries<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    (outputs, inputs): (&[u32], &[u32]),
) -> Result<(), BusError> {
    map_as(bus, device, &|split| {
        (
            (OUTPUT_MAP..).zip(split(outputs)).collect(),
            (INPUT_MAP..).zip(split(inputs)).collect(),
        )
    })?;
    Ok(())
}

/// Maps outputs and inputs into one map each, or, where the device does not take that, into maps of 8 bytes
/// and an even length each. Returns both.
fn map_as<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    maps: &dyn Fn(Split) -> (Maps, Maps),
) -> Result<(Vec<Entry>, Vec<Entry>), BusError> {
    let mut try_both = |split: Split| {
        let (outputs, inputs) = maps(split);
        try_maps(bus, device, OUTPUT_ASSIGNMENT, &outputs)?;
        try_maps(bus, device, INPUT_ASSIGNMENT, &inputs)?;
        Ok((told(&outputs), told(&inputs)))
    };
    let (index, sub, code) = match try_both(|entries| vec![entries.to_vec()]) {
        Err(BusError::Object {
            index, sub, code, ..
        }) => (index, sub, code),
        done => return done,
    };
    match try_both(short) {
        // The first refusal is the one to know.
        Err(BusError::Object { .. }) => Err(BusError::Unfit {
            device: device.position,
            name: device.name.clone(),
            what: format!(
                "it does not let its process data be mapped ({index:#06x}:{sub} was refused: {}): map = \"keep\" \
                 in its table in drives.toml takes it as it is",
                abort_text::text(code)
            ),
        }),
        done => done,
    }
}

/// The maps of all drives of a device, with the objects that are each one's own.
fn of_all(
    drives: &[&DriveSettings],
    first: u16,
    wanted: &dyn Fn(&DriveSettings) -> Vec<u32>,
    split: Split,
) -> Maps {
    let of = |drive: &&DriveSettings| {
        let first = first + drive.map_step * drive.axis;
        let entries: Vec<u32> = wanted(drive)
            .iter()
            .map(|entry| {
                let own = drive.own(Entry::new(*entry).index);
                u32::from(own) << 16 | entry & 0xffff
            })
            .collect();
        (first..).zip(split(&entries)).collect::<Maps>()
    };
    drives.iter().flat_map(of).collect()
}

fn told(maps: &Maps) -> Vec<Entry> {
    let entries = maps.iter().flat_map(|(_, entries)| entries);
    entries.copied().map(Entry::new).collect()
}

/// The same entries in maps of 8 bytes at most, each of an even length.
fn short(entries: &[u32]) -> Vec<Vec<u32>> {
    let length = |map: &[u32]| {
        map.iter()
            .map(|entry| (entry & 0xff) as usize)
            .sum::<usize>()
            / 8
    };
    let mut maps: Vec<Vec<u32>> = Vec::new();
    for entry in entries {
        match maps.last_mut() {
            Some(map) if length(map) + length(&[*entry]) <= SHORT_BYTES => map.push(*entry),
            _ => maps.push(vec![*entry]),
        }
    }
    for map in &mut maps {
        if length(map) % 2 == 1 {
            map.push(GAP);
        }
    }
    maps
}

/// Writes maps. The counts are 0 while the rest changes, and are written back to what they were if the
/// drive refuses.
fn try_maps<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    assignment: u16,
    maps: &Maps,
) -> Result<(), BusError> {
    let assigned = object(assignment, 0, 1);
    let mut counts = vec![assigned];
    counts.extend(maps.iter().map(|(map, _)| object(*map, 0, 1)));
    let mut before = Vec::new();
    for count in counts {
        before.push((count, read(bus, device, count)?));
    }
    let written = write_maps(bus, device, assignment, maps);
    if written.is_err() {
        // The drive may refuse that, too; the first refusal is the one to know.
        for (count, value) in before.iter().rev() {
            let _ = write(bus, device, *count, *value);
        }
    }
    written
}

#[allow(clippy::cast_possible_truncation, reason = "a handful of objects")]
fn write_maps<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    assignment: u16,
    maps: &Maps,
) -> Result<(), BusError> {
    let mut set = |object: Object, value: u32| write(bus, device, object, value);
    set(object(assignment, 0, 1), 0)?;
    for (map, entries) in maps {
        set(object(*map, 0, 1), 0)?;
        for (sub, entry) in (1..).zip(entries) {
            set(object(*map, sub, 4), *entry)?;
        }
        set(object(*map, 0, 1), entries.len() as u32)?;
    }
    for (sub, (map, _)) in (1..).zip(maps) {
        set(object(assignment, sub, 2), (*map).into())?;
    }
    set(object(assignment, 0, 1), maps.len() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_maps_have_eight_bytes_at_most_and_an_even_length() {
        assert_eq!(
            short(&OUTPUTS),
            [vec![OUTPUTS[0], OUTPUTS[1], OUTPUTS[2], GAP]]
        );
        let inputs = short(&INPUTS);
        assert_eq!(
            inputs,
            [vec![INPUTS[0], INPUTS[1], INPUTS[2], GAP], vec![INPUTS[3]]]
        );
    }
}
