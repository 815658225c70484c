//! The EEPROM of a device (SII): its identity, and its sync managers.

use crate::channels::{Channels, INPUTS, OUTPUTS};
use crate::memory::{EEPROM_ADDRESS, EEPROM_CONTROL, EEPROM_DATA, Memory};
use crate::settings::{DriveSettings, ImageAccess, OutputWatchdog};

/// Mailboxes, both of this length.
pub(crate) const MAILBOX: u16 = 128;
/// Where what the master writes goes, and where it reads.
pub(crate) const MAILBOX_OUT: u16 = 0x1000;
pub(crate) const MAILBOX_IN: u16 = 0x1080;

/// Vendor, product, revision, serial number.
pub(crate) type Identity = [u32; 4];

/// CRC-8 of the first 14 bytes: polynomial x⁸ + x² + x + 1, from 0xFF.
fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0xff, |crc, byte| {
        (0..8).fold(crc ^ byte, |crc, _| {
            if crc & 0x80 == 0 {
                crc << 1
            } else {
                crc << 1 ^ 0x07
            }
        })
    })
}

/// The image of a drive with a mailbox, CoE and four sync managers, or of a device without all that.
pub(crate) fn image(settings: &DriveSettings) -> Vec<u8> {
    if let Some(image) = &settings.eeprom {
        return image.clone();
    }
    let (name, has_mailbox) = (&settings.name, settings.has_mailbox);
    let mut image = vec![0; 128];
    image[0] = 0x05;
    image[14] = checksum(&image[..14]);
    for (at, value) in (16..).step_by(4).zip(settings.identity) {
        image[at..at + 4].copy_from_slice(&value.to_le_bytes());
    }
    // Words 0x18 to 0x1C: mailboxes for the standard protocol, and that it is CoE.
    let mailboxes = [MAILBOX_OUT, MAILBOX, MAILBOX_IN, MAILBOX, 4];
    for (at, value) in (0x30..).step_by(2).zip(mailboxes) {
        let value = if has_mailbox { value } else { 0 };
        image[at..at + 2].copy_from_slice(&value.to_le_bytes());
    }
    // Word 0x3E: size in KiBit less one; word 0x3F: version.
    image[0x7c] = 15;
    image[0x7e] = 1;
    let mut strings = vec![1, u8::try_from(name.len()).unwrap_or(0)];
    strings.extend_from_slice(name.as_bytes());
    category(&mut image, 10, &strings);
    let mut general = [0; 32];
    // The name is string 1, CoE has SDO, SDO information, PDO assignment and PDO configuration.
    (general[2], general[3], general[14]) = (1, 1, 0x11);
    if has_mailbox {
        general[5] = 0x0f;
    }
    if settings.image == ImageAccess::NoLrwByEeprom {
        general[11] = 2;
    }
    category(&mut image, 30, &general);
    if has_mailbox && settings.tells_managers {
        process_categories(&mut image, settings.watchdog);
    }
    if let Some(channels) = &settings.channels
        && !has_mailbox
    {
        channel_categories(&mut image, channels);
    }
    image.extend_from_slice(&[0xff; 64]);
    image
}

/// What each window onto its memory is for, and where it is.
fn process_categories(image: &mut Vec<u8>, watchdog: OutputWatchdog) {
    let output_control = match watchdog {
        OutputWatchdog::Told => 0x64,
        OutputWatchdog::Untold | OutputWatchdog::Never => 0x24,
    };
    category(image, 40, &[1, 2, 3, 0]);
    let managers = [
        (MAILBOX_OUT, MAILBOX, 0x26, 1),
        (MAILBOX_IN, MAILBOX, 0x22, 2),
        (OUTPUTS, 0, output_control, 3),
        (INPUTS, 0, 0x20, 4),
    ];
    let managers = managers.map(|(start, length, control, kind)| {
        let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length.to_le_bytes());
        [s0, s1, l0, l1, control, 0, 1, kind]
    });
    category(image, 41, &managers.concat());
}

/// Which windows a simple terminal has, and what is in each. Their lengths are 0, as an EL2004 has it.
fn channel_categories(image: &mut Vec<u8>, channels: &Channels) {
    let (mut managers, mut inputs, mut outputs) = (Vec::new(), Vec::new(), Vec::new());
    for (window, maps) in channels.simple_windows() {
        let [s0, s1] = window.start.to_le_bytes();
        let (control, kind) = if window.is_output { (0x44, 3) } else { (0, 4) };
        managers.extend([s0, s1, 0, 0, control, 0, 9, kind]);
        let (rows, first) = if window.is_output {
            (&mut outputs, 0x1600_u16)
        } else {
            (&mut inputs, 0x1a00)
        };
        for (map, entries) in (first..).zip(maps) {
            let [low, high] = map.to_le_bytes();
            let count = u8::try_from(entries.len()).unwrap_or(0);
            rows.extend([low, high, count, window.manager, 0, 0, 0x11, 0]);
            for entry in entries {
                let [bits, sub, low, high] = entry.to_le_bytes();
                rows.extend([low, high, sub, 0, 1, bits, 0, 0]);
            }
        }
    }
    category(image, 41, &managers);
    // Some have others between those that masters know.
    category(image, 43, &[0; 2]);
    for (kind, rows) in [(50, inputs), (51, outputs)] {
        if !rows.is_empty() {
            category(image, kind, &rows);
        }
    }
}

fn category(image: &mut Vec<u8>, kind: u16, data: &[u8]) {
    let words = u16::try_from(data.len().div_ceil(2)).unwrap_or(0);
    image.extend_from_slice(&kind.to_le_bytes());
    image.extend_from_slice(&words.to_le_bytes());
    image.extend_from_slice(data);
    image.resize(image.len() + data.len() % 2, 0);
}

/// Answers a command that was written to the interface of the EEPROM: reading takes no time, and
/// gives eight bytes.
pub(crate) fn serve(memory: &mut Memory, image: &[u8]) {
    let reads = memory.byte(EEPROM_CONTROL + 1) & 7 == 1;
    if reads {
        let from = 2 * usize::from(memory.word(EEPROM_ADDRESS));
        let mut data = [0xff; 8];
        for (place, byte) in data.iter_mut().zip(image.iter().skip(from)) {
            *place = *byte;
        }
        memory.put(EEPROM_DATA, &data);
    }
    // Not busy, no error, eight bytes at a time.
    memory.put(EEPROM_CONTROL, &[0x40, 0]);
}
