//! Real devices: their EEPROMs, and what they answered to other masters.
//!
//! Runs where the environment variable `GLIDEPATH_CAPTURES` names the directory of captures; says so and
//! passes where it does not.

mod line;
mod pcap;
mod recorded;
mod replay;

use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{Channels, ClockKind, DriveSettings as Emulated, Segment};
use glidepath_ethercat::{
    At, BusError, BusSettings, Device, DigitalOutput, Init, Settings, Signal, TerminalSettings,
    Wire, object,
};
use glidepath_link::servo::ServoSettings;
use glidepath_testing::captures;
use pcap::{datagrams, frames, word};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

const START_NS: u64 = 9_000_000_000_000;

/// The folder of those of EtherCAT: the one that is named, or one in it.
fn of_ethercat() -> Option<PathBuf> {
    let named = captures()?;
    let inner = named.join("ethercat");
    Some(if inner.is_dir() { inner } else { named })
}

/// A device with the EEPROM of a real one.
fn with_eeprom(folder: &Path, file: &str, like: Emulated) -> Emulated {
    let image = std::fs::read(folder.join("eeprom").join(file)).unwrap();
    Emulated {
        eeprom: Some(image),
        ..like
    }
}

fn simple(clock: ClockKind) -> Emulated {
    Emulated::terminal("ANOTHER", clock)
}

fn found(device: Emulated) -> Device {
    let segment = Segment::new_at(&[device], START_NS - 1_000_000_000);
    let mut wire = MemoryWire::new(segment, Quiet, START_NS);
    let found = Init::find(&mut wire).unwrap();
    found.devices()[0].clone()
}

/// File, vendor, product, name, and windows: sync manager, start, outputs or not, entries, bits.
type Known = (
    &'static str,
    [u32; 2],
    &'static str,
    &'static [(u8, u16, bool, usize, u32)],
);

/// What is known of them.
const KNOWN: [Known; 10] = [
    (
        "ek1100.hex",
        [2, 0x044c_2c52],
        "EK1100 EtherCAT-Koppler (2A E-Bus)",
        &[],
    ),
    (
        "ek1100-eeprom-dump.bin",
        [2, 0x044c_2c52],
        "EK1100 EtherCAT-Koppler (2A E-Bus)",
        &[],
    ),
    (
        "el2004-eeprom-dump.bin",
        [2, 0x07d4_3052],
        "EL2004 4K. Dig. Ausgang 24V, 0.5A",
        &[(0, 0xf00, true, 4, 4)],
    ),
    (
        "el2828.hex",
        [2, 0x0b0c_3052],
        "EL2828 8K. Dig. Ausgang 24V, 2A",
        &[(0, 0xf00, true, 8, 8)],
    ),
    (
        "el2889.hex",
        [2, 0x0b49_3052],
        "EL2889 16K. Dig. Ausgang 24V, 0.5A, negativ",
        &[(0, 0xf00, true, 8, 8), (1, 0xf01, true, 8, 8)],
    ),
    (
        "el2262.bin",
        [2, 0x08d6_3052],
        "EL2262 2K. Dig. Ausgang 24V, 1µs, DC Oversample",
        &[
            (0, 0x1000, true, 10, 53),
            (1, 0x1200, true, 10, 53),
            (2, 0x998, false, 1, 32),
        ],
    ),
    (
        "akd.hex",
        [0x6a, 0x0041_4b44],
        "AKD EtherCAT Drive (CoE)",
        &[(2, 0x1100, true, 0, 0), (3, 0x1140, false, 0, 0)],
    ),
    ("akd_null_strings.hex", [0x6a, 0x0041_4b44], "", &[]),
    (
        "hbm_clipx_eeprom_dump.bin",
        [0x11d, 0xf01],
        "ClipX",
        &[(2, 0x1100, true, 0, 0), (3, 0x1d00, false, 0, 0)],
    ),
    (
        "issue-286-empty-eeprom-example.bin",
        [1, 0],
        "without a name",
        &[],
    ),
];

#[test]
fn the_eeproms_of_real_devices_say_what_they_are() {
    let Some(folder) = of_ethercat() else { return };
    for (file, [vendor, product], name, windows) in KNOWN {
        let device = found(with_eeprom(&folder, file, simple(ClockKind::ReceiveTimes)));
        let id = device.identity;
        assert_eq!((id.vendor, id.product), (vendor, product), "{file}");
        // The one that is cut off says nothing reliable behind its identity.
        if file == "akd_null_strings.hex" {
            continue;
        }
        assert_eq!(device.name, name, "{file}");
        let seen: Vec<_> = device
            .windows
            .iter()
            .map(|window| {
                let bits = window.entries.iter().map(|entry| entry.bits).sum::<u32>();
                let (number, start) = (window.number, window.manager.start);
                (number, start, window.is_output, window.entries.len(), bits)
            })
            .collect();
        assert_eq!(seen, windows, "{file}");
    }
}

/// A drive, and a line of terminals with the EEPROMs of real ones.
fn line(folder: &Path, last: Emulated) -> Vec<Emulated> {
    let outputs = |count, file| with_eeprom(folder, file, Emulated::outputs(count));
    vec![
        Emulated::default(),
        with_eeprom(folder, "ek1100.hex", simple(ClockKind::Bits64)),
        outputs(4, "el2004-eeprom-dump.bin"),
        outputs(8, "el2828.hex"),
        Emulated {
            clock: ClockKind::Bits64,
            ..outputs(16, "el2889.hex")
        },
        last,
    ]
}

fn come_up(line: &[Emulated], terminals: Vec<TerminalSettings>) -> Result<(), BusError> {
    let segment = Segment::new_at(line, START_NS - 1_000_000_000);
    let mut wire = MemoryWire::new(segment, Quiet, START_NS);
    let settings = Settings {
        bus: BusSettings::default(),
        drives: vec![crate::machine::drive(0)],
        drive_inputs: Vec::new(),
        terminals,
        servo: ServoSettings::default(),
    };
    let bus = Init::find(&mut wire)?.into_pre_op()?;
    bus.into_safe_op(&settings)?.into_op(&settings.bus)?;
    Ok(())
}

#[test]
fn terminals_with_the_eeproms_of_real_ones_come_to_op() {
    let Some(folder) = of_ethercat() else { return };
    let at = |position: usize, product, last: u16| TerminalSettings {
        position,
        vendor: 2,
        product,
        outputs: vec![DigitalOutput {
            at: At::Object {
                index: last,
                sub: 1,
            },
            from: Signal::Output(0),
            is_inverted: false,
            rest: false,
        }],
        ..TerminalSettings::default()
    };
    let coupler = TerminalSettings {
        outputs: Vec::new(),
        ..at(1, 0x044c_2c52, 0)
    };
    let terminals = vec![
        coupler,
        at(2, 0x07d4_3052, 0x7030),
        at(3, 0x0b0c_3052, 0x7070),
        at(4, 0x0b49_3052, 0x70f0),
    ];
    let oversampling = Emulated {
        channels: Some(Channels::default()),
        ..simple(ClockKind::Bits64)
    };
    let oversampling = with_eeprom(&folder, "el2262.bin", oversampling);
    let line = line(&folder, oversampling);
    come_up(&line, terminals.clone()).unwrap();
    // One that has to be told when.
    let mut all = terminals.clone();
    all.push(TerminalSettings {
        outputs: Vec::new(),
        ..at(5, 0x08d6_3052, 0)
    });
    let refused = come_up(&line, all).unwrap_err().to_string();
    assert!(
        refused.starts_with("device 5 (EL2262") && refused.contains("works with SYNC0 alone"),
        "{refused}"
    );
    let mut other = terminals;
    other[1].outputs = at(2, 0, 0x7040).outputs;
    let refused = come_up(&line, other).unwrap_err().to_string();
    assert!(
        refused.contains("there is no output 0x7040:01") && refused.contains("0x7030:01 (1 bit)"),
        "{refused}"
    );
}

/// Index and subindex.
type Asked = (u16, u8);

fn is_coe(message: &[u8]) -> bool {
    message.len() >= 16 && message[5] & 15 == 3
}

/// What the devices of a capture answered to questions for whole objects of theirs, by station.
fn answers(capture: &[u8]) -> BTreeMap<(u16, Asked), Vec<u8>> {
    let (mut asked, mut answers) = (BTreeMap::new(), BTreeMap::new());
    for frame in frames(capture) {
        let is_answer = frame[6] & 2 != 0;
        for datagram in datagrams(frame).iter().filter(|d| is_coe(d.data)) {
            let data = datagram.data;
            match datagram.command {
                5 if !is_answer && data[7] >> 4 == 2 => {
                    // Not of all subindices at once.
                    let upload = (data[8] == 0x40).then(|| (word(data, 9), data[11]));
                    asked.insert(datagram.station, upload);
                }
                4 if is_answer && datagram.counter == 1 => {
                    if let Some(Some(object)) = asked.remove(&datagram.station) {
                        answers.insert((datagram.station, object), data.to_vec());
                    }
                }
                _ => {}
            }
        }
    }
    answers
}

/// A wire on which a device answers what another one did.
struct Played {
    segment: Segment,
    answer: Vec<u8>,
    back: Option<Vec<u8>>,
    now_ns: u64,
}

impl Wire for Played {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.now_ns = self.now_ns.max(deadline_ns);
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        let mut frame = frame.to_vec();
        self.segment.pass(&mut frame, self.now_ns);
        let is_message = frame[16] == 4 && word(&frame, 20) == 0x1080 && word(&frame, 22) == 128;
        if is_message && word(&frame, 26 + 128) == 1 {
            let length = self.answer.len().min(128);
            frame[26..26 + length].copy_from_slice(&self.answer[..length]);
        }
        self.back = Some(frame);
        Ok(())
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        let Some(frame) = self.back.take() else {
            self.now_ns = self.now_ns.max(until_ns);
            return Ok(None);
        };
        self.now_ns += 20_000;
        into[..frame.len()].copy_from_slice(&frame);
        Ok(Some(frame.len()))
    }
}

#[test]
fn the_answers_of_real_devices_are_read_as_they_are_meant() {
    let Some(folder) = of_ethercat() else { return };
    let (mut read, mut texts, mut seen) = (0, 0, BTreeSet::new());
    for capture in std::fs::read_dir(folder.join("captures")).unwrap() {
        let path = capture.unwrap().path();
        let capture = std::fs::read(&path).unwrap();
        for ((_, (index, sub)), answer) in answers(&capture) {
            let mut wire = Played {
                segment: Segment::new_at(&[Emulated::default()], START_NS - 1_000_000_000),
                answer: answer.clone(),
                back: None,
                now_ns: START_NS,
            };
            let mut bus = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
            let told = bus.read(0, object(index, sub, 4));
            let (command, case) = (answer[8], (&path, index, sub));
            seen.insert(command);
            if command & 0x02 == 0 {
                // Longer than four bytes: no number is made of it, and it comes as a whole.
                assert!(
                    matches!(told, Err(BusError::Transfer { .. })),
                    "{case:?}: {told:?}"
                );
                let meant = &answer[16..16 + usize::from(word(&answer, 12))];
                let told = bus.read_bytes(0, (index, sub), 256);
                assert_eq!(told.unwrap(), meant, "{case:?}");
                texts += 1;
                continue;
            }
            let size = 4 - usize::from(command >> 2 & 3);
            let bytes = answer[12..12 + size].iter().rev();
            let meant = bytes.fold(0, |number, byte| number << 8 | u32::from(*byte));
            assert_eq!(told.unwrap(), meant, "{case:?}");
            read += 1;
        }
    }
    // One, two and four bytes, and a text.
    assert!(read > 60 && texts > 0, "{read} {texts}");
    assert_eq!(seen, BTreeSet::from([0x41, 0x43, 0x4b, 0x4f]));
}

/// Lengths and working counters of process data in a capture.
fn counters(capture: &[u8]) -> BTreeSet<(usize, u16)> {
    let back = frames(capture).into_iter().filter(|f| f[6] & 2 != 0);
    let datagrams = back.flat_map(datagrams);
    let data = datagrams.filter(|datagram| datagram.command == 12);
    data.map(|datagram| (datagram.data.len(), datagram.counter))
        .collect()
}

#[test]
fn a_device_counts_once_however_many_windows_it_has() {
    let Some(folder) = of_ethercat() else { return };
    let path = folder.join("captures/replay-ek1100-el2828-el2889.pcapng");
    let counters = counters(&std::fs::read(path).unwrap());
    // An EL2828 with a window of a byte, and an EL2889 with two, a datagram each.
    assert_eq!(counters, BTreeSet::from([(1, 2), (2, 2)]));
}
