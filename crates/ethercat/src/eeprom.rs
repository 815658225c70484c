//! The reader of a device's EEPROM (SII, ETG.1000.6 and ETG.2010).

use crate::device::{ClockKind, Device, Identity, SyncManager, Window};
use crate::entry::Entry;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::registers::{ALIAS, EEPROM_CONTROL, EEPROM_DATA, EEPROM_OWNER, FEATURES, PORTS};
use crate::wire::Wire;

/// Word addresses.
const IDENTITY: u16 = 0x08;
const MAILBOXES: u16 = 0x18;
const PROTOCOLS: u16 = 0x1c;
const CATEGORIES: u16 = 0x40;
/// Category types.
const STRINGS: u16 = 10;
const GENERAL: u16 = 30;
const MANAGERS: u16 = 41;
const INPUT_MAPS: u16 = 50;
const OUTPUT_MAPS: u16 = 51;
const SYNC_MODES: u16 = 60;
const END: u16 = 0xffff;
/// What sync managers are for: process data to a device, and from it.
const OUTPUT_KIND: u8 = 3;
const INPUT_KIND: u8 = 4;
/// Bit of the protocols: CoE.
const COE: u32 = 4;
/// Bit of the features, and of the flags of the general category: it does not know LRW.
const LACKS_LRW: u16 = 1 << 9;
const NOT_LRW: u8 = 1 << 1;
/// Of the two bits of a port: frames go out by it, and there is somebody.
const OPEN: u8 = 0b10;
/// Words that are read of one category, and categories of one device, at most.
const MOST_WORDS: u16 = 2048;
const MOST_CATEGORIES: usize = 64;
/// How long a device may be busy reading, and how often it is asked.
const BUSY_NS: u64 = 500_000;
const BUSY_TRIES: u32 = 100;

const READING: &str = "while its EEPROM was read";

/// Two words.
fn words<W: Wire>(bus: &mut Exchange<'_, W>, nth: usize, at: u16) -> Result<u32, BusError> {
    let [low, high] = at.to_le_bytes();
    bus.write(nth, EEPROM_CONTROL, &[0, 1, low, high, 0, 0], READING)?;
    for _ in 0..BUSY_TRIES {
        let [_, control] = bus.read(nth, EEPROM_CONTROL, READING)?;
        if control & 0x80 == 0 {
            // The bits of errors: no acknowledgement, or a command that it does not know.
            if control & 0x60 != 0 {
                break;
            }
            return bus.read(nth, EEPROM_DATA, READING).map(u32::from_le_bytes);
        }
        let until_ns = bus.wire.now_ns() + BUSY_NS;
        bus.wire.sleep_until(until_ns);
    }
    Err(BusError::NoAnswer {
        device: nth,
        action: READING,
        tries: BUSY_TRIES,
    })
}

#[allow(clippy::cast_possible_truncation, reason = "two halves")]
const fn halves(both: u32) -> (u16, u16) {
    (both as u16, (both >> 16) as u16)
}

fn bytes<W: Wire>(
    bus: &mut Exchange<'_, W>,
    nth: usize,
    at: u16,
    count: u16,
) -> Result<Vec<u8>, BusError> {
    let mut bytes = Vec::new();
    for word in (0..count.min(MOST_WORDS)).step_by(2) {
        bytes.extend_from_slice(&words(bus, nth, at.saturating_add(word))?.to_le_bytes());
    }
    bytes.truncate(2 * usize::from(count));
    Ok(bytes)
}

/// The nth text of the category of texts, from 1.
fn text(strings: &[u8], nth: u8) -> Option<String> {
    let mut at = 1;
    for _ in 1..nth {
        at += 1 + usize::from(*strings.get(at)?);
    }
    let length = usize::from(*strings.get(at)?);
    let bytes = strings.get(at + 1..at + 1 + length).filter(|_| nth > 0)?;
    let shown = |c: char| if c.is_control() { ' ' } else { c };
    // UTF-8 by the standard, Latin-1 as many have it.
    Some(core::str::from_utf8(bytes).map_or_else(
        |_| bytes.iter().map(|byte| shown(char::from(*byte))).collect(),
        |text| text.chars().map(shown).collect(),
    ))
}

fn managers(bytes: &[u8]) -> Vec<(SyncManager, u8)> {
    let rows = bytes.chunks_exact(8);
    rows.map(|row| {
        let manager = SyncManager {
            start: u16::from_le_bytes([row[0], row[1]]),
            length: u16::from_le_bytes([row[2], row[3]]),
            control: row[4],
        };
        (manager, row[7])
    })
    .collect()
}

/// A map of process data, and the number of the sync manager that it belongs to; that of none is not
/// there.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Map {
    manager: u8,
    is_output: bool,
    entries: Vec<Entry>,
}

/// The maps of a category, as far as they are whole.
fn maps(bytes: &[u8], is_output: bool) -> Vec<Map> {
    let (mut maps, mut rows) = (Vec::new(), bytes.chunks_exact(8));
    while let Some(&[_, _, count, manager, ..]) = rows.next() {
        let entry = |row: &[u8]| Entry {
            index: u16::from_le_bytes([row[0], row[1]]),
            sub: row[2],
            bits: row[5].into(),
        };
        let entries: Vec<_> = rows.by_ref().take(count.into()).map(entry).collect();
        if entries.len() < usize::from(count) {
            break;
        }
        maps.push(Map {
            manager,
            is_output,
            entries,
        });
    }
    maps
}

/// The windows of process data, and the maps that are in them as the device is delivered.
fn windows(managers: &[(SyncManager, u8)], maps: &[Map]) -> Vec<Window> {
    let numbered = (0..=u8::MAX).zip(managers);
    let of_data = numbered.filter(|(_, (_, kind))| matches!(*kind, OUTPUT_KIND | INPUT_KIND));
    of_data
        .map(|(number, (manager, kind))| {
            let is_output = *kind == OUTPUT_KIND;
            let own = maps
                .iter()
                .filter(|map| (map.manager, map.is_output) == (number, is_output));
            Window {
                number,
                manager: *manager,
                is_output,
                entries: own.flat_map(|map| map.entries.iter().copied()).collect(),
            }
        })
        .collect()
}

/// Reads all that is wanted of a device.
pub(crate) fn read<W: Wire>(
    bus: &mut Exchange<'_, W>,
    nth: usize,
    clock: ClockKind,
) -> Result<Device, BusError> {
    // The EEPROM is taken from the device's own processor, then given to the master.
    bus.write(nth, EEPROM_OWNER, &[2], READING)?;
    bus.write(nth, EEPROM_OWNER, &[0], READING)?;
    let mut device = Device {
        position: nth,
        identity: Identity {
            vendor: words(bus, nth, IDENTITY)?,
            product: words(bus, nth, IDENTITY + 2)?,
            revision: words(bus, nth, IDENTITY + 4)?,
            serial: words(bus, nth, IDENTITY + 6)?,
        },
        alias: u16::from_le_bytes(bus.read(nth, ALIAS, READING)?),
        clock,
        has_coe: words(bus, nth, PROTOCOLS)? & COE != 0,
        ..Device::default()
    };
    let features = u16::from_le_bytes(bus.read(nth, FEATURES, READING)?);
    device.lacks_lrw = features & LACKS_LRW != 0;
    let [_, ports] = bus.read(nth, PORTS, READING)?;
    device.open_ports = core::array::from_fn(|port| ports >> (2 * port) & 3 == OPEN);
    let ((out, out_length), (back, back_length)) = (
        halves(words(bus, nth, MAILBOXES)?),
        halves(words(bus, nth, MAILBOXES + 2)?),
    );
    let mailbox = |start, length, control| SyncManager {
        start,
        length,
        control,
    };
    if out_length >= 16 && back_length >= 16 {
        let both = (
            mailbox(out, out_length, 0x26),
            mailbox(back, back_length, 0x22),
        );
        device.mailbox = Some(both);
    }
    read_categories(bus, nth, &mut device)?;
    Ok(device)
}

fn read_categories<W: Wire>(
    bus: &mut Exchange<'_, W>,
    nth: usize,
    device: &mut Device,
) -> Result<(), BusError> {
    let (mut at, mut strings, mut name) = (CATEGORIES, Vec::new(), (0, 0));
    let (mut found, mut mapped) = (Vec::new(), Vec::new());
    for _ in 0..MOST_CATEGORIES {
        let (kind, length) = halves(words(bus, nth, at)?);
        if kind == END {
            break;
        }
        let from = at.saturating_add(2);
        match kind {
            STRINGS => strings = bytes(bus, nth, from, length)?,
            GENERAL => {
                let general = bytes(bus, nth, from, length.min(16))?;
                let byte = |at: usize| general.get(at).copied().unwrap_or(0);
                name = (byte(3), byte(2));
                device.lacks_lrw |= byte(11) & NOT_LRW != 0;
            }
            MANAGERS => {
                found = managers(&bytes(bus, nth, from, length.min(64))?);
                let of = |kind| found.iter().find(|(_, k)| *k == kind).map(|(m, _)| *m);
                device.process = of(OUTPUT_KIND).zip(of(INPUT_KIND));
            }
            // What has a dictionary is asked for what is mapped.
            INPUT_MAPS | OUTPUT_MAPS if device.mailbox.is_none() || !device.has_coe => {
                let bytes = bytes(bus, nth, from, length)?;
                mapped.extend(maps(&bytes, kind == OUTPUT_MAPS));
            }
            SYNC_MODES => device.has_sync_modes = true,
            _ => {}
        }
        at = from.saturating_add(length);
    }
    device.windows = windows(&found, &mapped);
    let named = text(&strings, name.0).or_else(|| text(&strings, name.1));
    device.name = named.unwrap_or_else(|| "without a name".to_owned());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_belong_to_the_windows_that_they_name() {
        // One map of a bit and a gap at sync manager 1, one of none, and one that is cut off.
        let bytes = [
            [0x00, 0x16, 2, 1, 0, 0, 0x11, 0],
            [0x00, 0x70, 1, 0, 1, 1, 0, 0],
            [0x00, 0x00, 0, 0, 0, 7, 0, 0],
            [0x01, 0x16, 0, 255, 0, 0, 0, 0],
            [0x02, 0x16, 1, 1, 0, 0, 0, 0],
        ];
        let maps = maps(&bytes.concat(), true);
        assert_eq!(maps.len(), 2, "{maps:?}");
        let manager = SyncManager {
            start: 0xf00,
            length: 0,
            control: 0x44,
        };
        let managers = [(manager, INPUT_KIND), (manager, OUTPUT_KIND), (manager, 1)];
        let windows = windows(&managers, &maps);
        let seen: Vec<_> = windows
            .iter()
            .map(|window| (window.number, window.is_output, window.entries.len()))
            .collect();
        assert_eq!(seen, [(0, false, 0), (1, true, 2)]);
        let (bit, gap) = (Entry::new(0x7000_0101), Entry::new(0x0000_0007));
        assert_eq!(windows[1].entries, [bit, gap]);
    }
}
