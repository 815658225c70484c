//! The start-ups of real devices: what each answered to another master is what it answers to ours.
//!
//! A line goes as far as it went in its capture, and none is refused there. Where other masters wrote sync managers,
//! windows and delays, ours has to write the same. A refusal of what is no drive is one of those that are listed
//! here, with its words.

use super::line::Line;
use super::of_ethercat;
use super::recorded::{Known, Recorded, devices};
use glidepath_ethercat::{BusError, BusSettings, Init, Mapping, Settings, TerminalSettings};
use glidepath_link::servo::ServoSettings;
use std::collections::{BTreeMap, BTreeSet};

const START_NS: u64 = 9_000_000_000_000;
const PRE_OP: u8 = 2;
const SAFE_OP: u8 = 4;
const OP: u8 = 8;

/// A capture, how many devices it has, and the state that those came to that came furthest.
type Case = (&'static str, usize, u8);

const CASES: [Case; 13] = [
    ("replay-dc.pcapng", 3, OP),
    ("replay-ek1100-alias-address.pcapng", 3, PRE_OP),
    ("replay-ek1100-el2828-el2889.pcapng", 3, OP),
    ("replay-ek1914-el3004-configure.pcapng", 2, PRE_OP),
    ("replay-ek1914-el3004-mailbox.pcapng", 2, PRE_OP),
    ("replay-ek1914-no-complete-access.pcapng", 2, OP),
    ("replay-ek1914-segmented-upload.pcapng", 2, PRE_OP),
    ("replay-issue-255.pcapng", 3, OP),
    ("soem-dual-lan9252.pcapng", 2, PRE_OP),
    ("soem-sdinfo-akd.pcapng", 1, PRE_OP),
    ("soem-sdinfo-ek1100-el1004.pcapng", 2, PRE_OP),
    ("soem-sdinfo-ek1100-only.pcapng", 1, PRE_OP),
    ("soem-single-lan9252.pcapng", 1, PRE_OP),
];

/// Captures that do not have what a start has to know of every device: its functions, its ports, who it is. Masters
/// only looked there for somebody, read an EEPROM alone, or had started before.
const TOO_LITTLE: [&str; 8] = [
    "rs-detect-slaves-ek1100-el1004.pcapng",
    "rs-detect-slaves-ek1100-only.pcapng",
    "rs-example-sii-el2004.pcapng",
    "soem-sdinfo-no-slaves.pcapng",
    "twincat-run-ek1100-el1004.pcapng",
    "twincat-scan-boxes.pcapng",
    "twincat-scan-devices-2.pcapng",
    "twincat-scan-devices.pcapng",
];

/// Registers that our start reads and other masters did not read of one device alone: its type, the time that it
/// has beside the one that was latched, and how far it is off the reference.
const UNREAD: [core::ops::Range<u16>; 3] = [0..1, 0x910..0x914, 0x92c..0x930];

/// What nobody else asked in OP: the newest message of a diagnosis history.
const HISTORY: (u16, u8) = (0x10f3, 2);

/// Starts a line as far as it went.
fn start(known: &[Known], target: u8) -> (Result<(), BusError>, Vec<Recorded>) {
    let mut line = Line::new(known, START_NS);
    let goes_on = |known: &Known| known.reached() >= SAFE_OP;
    let places = known.iter().enumerate().filter(|(_, known)| goes_on(known));
    let terminals = places.map(|(nth, _)| TerminalSettings {
        position: nth + 1,
        ..TerminalSettings::default()
    });
    let settings = Settings {
        bus: BusSettings::default(),
        drives: vec![crate::machine::drive(0)],
        drive_inputs: Vec::new(),
        terminals: terminals.collect(),
        servo: ServoSettings::default(),
    };
    let bus = Init::find(&mut line).and_then(Init::into_pre_op);
    let came = match bus {
        Ok(bus) if target >= SAFE_OP => {
            let bus = bus.into_safe_op(&settings);
            bus.and_then(|bus| bus.into_op(&settings.bus).map(|_| ()))
        }
        came => came.map(|_| ()),
    };
    (came, line.devices)
}

/// The bytes that another master wrote last.
fn written(known: &Known) -> BTreeMap<u16, u8> {
    let all = known.written.iter();
    all.flat_map(|(register, data)| (*register..).zip(data.iter().copied()))
        .collect()
}

fn bytes<const N: usize>(written: &BTreeMap<u16, u8>, register: u16) -> Option<[u8; N]> {
    let mut bytes = [0; N];
    for (byte, at) in bytes.iter_mut().zip(register..) {
        *byte = *written.get(&at)?;
    }
    Some(bytes)
}

/// Sync managers: where, how long, how, and whether they are on. Our master switches the watchdog on.
fn manager([a, b, c, d, control, _, on, _]: [u8; 8]) -> (u16, u16, u8, u8) {
    let control = if control & 0x0c == 0x04 {
        control | 0x40
    } else {
        control
    };
    (
        u16::from_le_bytes([a, b]),
        u16::from_le_bytes([c, d]),
        control,
        on,
    )
}

/// Windows: where in the device, how long, and which way; whatever their number and place in the image.
fn window(fmmu: [u8; 13]) -> (u16, u16, u8) {
    let word = |at: usize| u16::from_le_bytes([fmmu[at], fmmu[at + 1]]);
    (word(8), word(4), fmmu[11])
}

/// What is not as another master wrote it, and how much was compared.
fn differs(device: &Recorded, target: u8) -> (Vec<String>, usize) {
    let theirs = written(&device.known);
    let (mut told, mut compared) = (Vec::new(), 0);
    for nth in 0..8 {
        let register = 0x800 + 8 * nth;
        let Some(other) = bytes::<8>(&theirs, register).map(manager) else {
            continue;
        };
        let own = manager(device.at(register));
        // One that is off is none, and those of process data come with SAFE-OP.
        let is_mailbox = other.2 & 3 == 2;
        let is_due = other.3 & 1 == 1 && (target >= SAFE_OP || is_mailbox);
        compared += usize::from(is_due);
        if is_due && own != other {
            told.push(format!(
                "sync manager {nth}: {own:x?}, and {other:x?} of the other master"
            ));
        }
    }
    let all = |of: &dyn Fn(u16) -> Option<[u8; 13]>| -> BTreeSet<_> {
        let windows = (0..8).filter_map(|nth| of(0x600 + 16 * nth));
        let on = windows.filter(|window| window[12] & 1 == 1 && window[4] > 0);
        on.map(window).collect()
    };
    let own = all(&|register| Some(device.at(register)));
    let other = all(&|register| bytes(&theirs, register));
    if target >= SAFE_OP && !other.is_empty() {
        compared += other.len();
        if own != other {
            told.push(format!(
                "windows {own:x?}, and {other:x?} of the other master"
            ));
        }
    }
    (told, compared)
}

/// How late each clock is against the first one, ns: by our master, and by the other one.
fn delays(line: &[Recorded]) -> Vec<(i64, i64)> {
    let own = |device: &Recorded| i64::from(u32::from_le_bytes(device.at(0x928)));
    let other = |device: &Recorded| {
        let told = bytes(&written(&device.known), 0x928)?;
        Some(i64::from(u32::from_le_bytes(told)))
    };
    let told = line
        .iter()
        .filter_map(|device| Some((own(device), other(device)?)));
    let told: Vec<_> = told.filter(|(own, _)| *own > 0).collect();
    let Some(first) = told.first().copied() else {
        return Vec::new();
    };
    let from_first = told
        .iter()
        .map(|(own, other)| (own - first.0, other - first.1));
    from_first.collect()
}

/// The captures, by their names.
fn captures() -> Option<BTreeMap<String, Vec<Known>>> {
    let folder = of_ethercat()?.join("captures");
    let files = std::fs::read_dir(folder).unwrap();
    let read = files.map(|file| {
        let path = file.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, devices(&std::fs::read(&path).unwrap()))
    });
    Some(read.collect())
}

#[test]
fn the_start_ups_of_real_devices_are_ours() {
    let Some(captures) = captures() else { return };
    let (mut compared, mut late) = (0, 0);
    let mut replayed = BTreeSet::new();
    for (file, known) in &captures {
        if known.is_empty() || !known.iter().all(Known::is_known) {
            assert!(
                TOO_LITTLE.contains(&file.as_str()),
                "{file} is not replayed"
            );
            continue;
        }
        let reached = known.iter().map(Known::reached).max().unwrap();
        let (came, line) = start(known, reached);
        came.unwrap_or_else(|error| panic!("{file}: {error}"));
        for (nth, device) in line.iter().enumerate() {
            let case = format!("{file}, device {nth}");
            let (told, count) = differs(device, reached);
            assert_eq!(told, [""; 0], "{case}");
            compared += count;
            // Nothing that matters was made up for it.
            let is_unread = |at: &u16| UNREAD.iter().any(|range| range.contains(at));
            let unknown = &device.unknown;
            assert!(unknown.iter().all(is_unread), "{case}: {unknown:x?}");
            let asked = device.unknown_objects.iter();
            assert!(asked.copied().all(|object| object == HISTORY), "{case}");
            assert!(!device.beyond, "{case} goes further than it ever went");
            let is_led = reached >= SAFE_OP && device.known.reached() >= SAFE_OP;
            assert!(!is_led || device.state() == OP, "{case}");
        }
        for (own, other) in delays(&line) {
            assert_eq!(own, other, "{file}: ns behind the first clock");
            late += usize::from(other > 0);
        }
        replayed.insert((file.as_str(), known.len(), reached));
    }
    assert_eq!(replayed, BTreeSet::from(CASES));
    assert_eq!(captures.len(), CASES.len() + TOO_LITTLE.len());
    // Managers and windows, and clocks behind the first one.
    assert!(compared > 20 && late >= 4, "{compared} {late}");
}

/// What a device of a capture is refused with where it is said to be a drive whose maps stay, and the object that
/// the other master did not ask, if that is why.
fn refused_as_drive(known: &[Known], nth: usize) -> (String, Option<(u16, u8)>) {
    let mut line = Line::new(known, START_NS);
    let mut drive = crate::machine::drive(0);
    (drive.position, drive.vendor, drive.product) = (nth + 1, 0, 0);
    drive.mapping = Mapping::Kept;
    let settings = Settings {
        bus: BusSettings::default(),
        drives: vec![drive],
        drive_inputs: Vec::new(),
        terminals: Vec::new(),
        servo: ServoSettings::default(),
    };
    let bus = Init::find(&mut line).and_then(Init::into_pre_op);
    let told = bus.and_then(|bus| bus.into_safe_op(&settings).map(|_| ()));
    let unknown = line.devices[nth].unknown_objects.first().copied();
    (told.unwrap_err().to_string(), unknown)
}

/// Devices that go on until they are told what no capture knows: the first parameter of a drive.
const UNASKED: [(&str, usize, (u16, u8)); 3] = [
    ("soem-dual-lan9252.pcapng", 0, (0x60c2, 1)),
    ("soem-sdinfo-akd.pcapng", 0, (0x60c2, 1)),
    ("soem-single-lan9252.pcapng", 0, (0x60c2, 1)),
];

/// All other refusals: of couplers and simple terminals; of an EK1914 and an EL3004; and of a board whose EEPROM
/// another master did not read to its end, because it is like the one before.
const AS_DRIVES: [&str; 3] = [
    "it has no distributed clock, and setpoints could not be given it in time",
    "it has no mailbox with CoE: it is no drive that this master knows",
    "its EEPROM does not say where its process data is: give outputs_at and inputs_at in its table in drives.toml, \
     the start addresses of its sync managers 2 and 3 by the manufacturer's ESI file",
];

#[test]
fn devices_that_are_no_drives_are_refused_with_what_they_lack() {
    let Some(captures) = captures() else { return };
    let (mut told, mut unasked) = (BTreeSet::new(), BTreeSet::new());
    for (file, known) in &captures {
        if known.is_empty() || !known.iter().all(Known::is_known) {
            continue;
        }
        for nth in 0..known.len() {
            match refused_as_drive(known, nth) {
                (_, Some(object)) => {
                    unasked.insert((file.as_str(), nth, object));
                }
                (words, None) => {
                    let (_, what) = words.split_once("): ").unwrap();
                    told.insert(what.to_owned());
                }
            }
        }
    }
    assert_eq!(unasked, BTreeSet::from(UNASKED));
    assert_eq!(told, BTreeSet::from(AS_DRIVES.map(str::to_owned)));
}
