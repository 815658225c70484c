//! The reader of a device's EEPROM (SII, ETG.1000.6 and ETG.2010).

use crate::device::{ClockKind, Device, Identity, SyncManager};
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
const END: u16 = 0xffff;
/// Bit of the protocols: CoE.
const COE: u32 = 4;
/// Bit of the features, and of the flags of the general category: it does not know LRW.
const LACKS_LRW: u16 = 1 << 9;
const NOT_LRW: u8 = 1 << 1;
/// Of the two bits of a port: frames go out by it, and there is somebody.
const OPEN: u8 = 0b10;
/// Words that are read of one category, and categories of one device, at most.
const MOST_WORDS: u16 = 512;
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
    Some(String::from_utf8_lossy(bytes).chars().map(shown).collect())
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
                let found = managers(&bytes(bus, nth, from, length.min(64))?);
                let of = |kind| found.iter().find(|(_, k)| *k == kind).map(|(m, _)| *m);
                device.process = of(3).zip(of(4));
            }
            _ => {}
        }
        at = from.saturating_add(length);
    }
    let named = text(&strings, name.0).or_else(|| text(&strings, name.1));
    device.name = named.unwrap_or_else(|| "without a name".to_owned());
    Ok(())
}
