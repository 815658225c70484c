//! Tests of `drives.toml`, right and wrong.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use super::{Found, parse, written};
use crate::config::{self, MachineConfig};
use glidepath_ethercat::{
    At, ClockKind, Device, Entry, Identity, Mapping, OutputWatchdog, Quantity, Signal, SyncManager,
    Window,
};

fn machine(homing: &str) -> MachineConfig {
    let text = config::EMBEDDED.replace("homing = \"none\"", &format!("homing = \"{homing}\""));
    config::parse("machine.toml", &text).unwrap()
}

fn found(position: usize) -> Found {
    let window = Some((SyncManager::default(), SyncManager::default()));
    Found {
        device: Device {
            position,
            identity: Identity {
                vendor: 0xe1e,
                product: 0x402,
                revision: 1,
                serial: 0,
            },
            name: format!("DRIVE {position}"),
            mailbox: window,
            has_coe: true,
            process: window,
            lacks_lrw: false,
            clock: ClockKind::Bits64,
            open_ports: [true, true, false, false],
            ..Device::default()
        },
        counts_per_revolution: Some(8_388_608.0),
        modes: Some((true, true)),
        axes: 1,
        windows: Vec::new(),
        watchdog: None,
    }
}

/// What is wrong with a text: line and message of each.
fn wrong(text: &str) -> Vec<(usize, String)> {
    let error = parse("drives.toml", text, &machine("none")).unwrap_err();
    let diagnostics = error.diagnostics().iter();
    diagnostics
        .map(|told| {
            let line = error.line_and_column(told).map_or(0, |(line, _)| line);
            (line, told.message.clone())
        })
        .collect()
}

#[test]
fn a_first_file_is_refused_until_somebody_says_how_far_a_turn_is() {
    let text = written("enp3s0", &[found(0), found(1), found(2)]);
    assert!(text.contains("8388608 counts of a revolution"), "{text}");
    let told = wrong(&text);
    assert_eq!(told.len(), 3, "{told:?}");
    assert!(
        told[0]
            .1
            .contains("drive.counts_per_mm = 0 counts is out of range"),
        "{told:?}"
    );
    let line = text
        .lines()
        .position(|line| line.starts_with("counts_per_mm"))
        .unwrap();
    assert_eq!(told[0].0, line + 1);
    let mended = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let drives = parse("drives.toml", &mended, &machine("none")).unwrap();
    assert_eq!(
        (drives.interface.as_str(), drives.bus.period_ns),
        ("enp3s0", 2_000_000)
    );
    assert_eq!(
        (drives.drives[2].joint, drives.drives[2].vendor),
        (2, 0xe1e)
    );
    assert!((drives.drives[1].max_v - 200.0).abs() < 1e-9);
    // What is written for machines without absolute encoders is right, too.
    let homes = mended.replace("# homing = {", "homing = {");
    let drives = parse("drives.toml", &homes, &machine("drive")).unwrap();
    assert_eq!(drives.drives[0].homing.unwrap().method, 17);
    assert!(
        wrong(&homes)[0]
            .1
            .contains("does not have drives find their home")
    );
}

#[test]
fn everything_that_is_wrong_is_told_with_its_place() {
    let text = "[bus]\ninterface = \"eth9\"\nperiod_us = 100\n[[drive]]\njoint = 7\nposition = 0\n\
                counts_per_mm = 1000.0\nfollowing_error = 1.0\nquick_stop = 1e99\ncolour = 3\n";
    let told = wrong(text);
    let has = |line: usize, words: &str| told.iter().any(|(l, m)| *l == line && m.contains(words));
    assert!(has(10, "unknown key `colour`"), "{told:?}");
    assert!(has(3, "bus.period_us = 100 is out of range"), "{told:?}");
    let drive = "[[drive]]\njoint = 0\nposition = 0\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
                 quick_stop = 2000.0\n";
    let twice = format!("[bus]\ninterface = \"eth9\"\n{drive}{drive}");
    let told = wrong(&twice);
    assert!(
        told.iter()
            .any(|(_, m)| m == "two drives have the same joint"),
        "{told:?}"
    );
    assert!(
        told.iter()
            .any(|(_, m)| m == "J1 of the machine has no drive"),
        "{told:?}"
    );
}

#[test]
fn what_is_no_drive_gets_no_table() {
    let mut other = found(1);
    other.modes = None;
    let text = written("eth1", &[found(0), other]);
    assert_eq!(text.matches("[[drive]]").count(), 1);
    assert!(
        text.contains("alias 0: no drive, without process data"),
        "{text}"
    );
}

#[test]
fn a_drive_may_keep_its_maps() {
    let text = written("enp3s0", &[found(0), found(1), found(2)]);
    let mended = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let kept = mended.replacen("invert = false\n", "invert = false\nmap = \"keep\"\n", 1);
    let drives = parse("drives.toml", &kept, &machine("none")).unwrap();
    let mappings: Vec<_> = drives.drives.iter().map(|drive| drive.mapping).collect();
    let (kept, written) = (Mapping::Kept, Mapping::Written);
    assert_eq!(mappings, [kept, written, written]);
    let other = mended.replacen("invert = false\n", "invert = false\nmap = \"kept\"\n", 1);
    let told = wrong(&other);
    let line = other
        .lines()
        .position(|line| line.starts_with("map"))
        .unwrap()
        + 1;
    let is_told = |(at, what): &(usize, String)| *at == line && what.contains("`keep`");
    assert!(told.iter().any(is_told), "{told:?}");
}

#[test]
fn a_drive_whose_eeprom_does_not_say_where_its_data_is_asks_for_it() {
    let mut silent = found(1);
    silent.device.process = None;
    let text = written("enp3s0", &[found(0), silent, found(2)]);
    let text = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let told = wrong(&text);
    let line = |key: &str| text.lines().position(|line| line.starts_with(key)).unwrap() + 1;
    let lines: Vec<_> = told.iter().map(|(line, _)| *line).collect();
    assert_eq!(lines, [line("outputs_at"), line("inputs_at")], "{told:?}");
    let mended = text.replace("outputs_at = 0x0", "outputs_at = 0x1100");
    let one = mended.replace("inputs_at = 0x0\n", "");
    assert!(wrong(&one)[0].1.contains("both outputs_at and inputs_at"));
    let mended = mended.replace("inputs_at = 0x0", "inputs_at = 0x1400");
    let drives = parse("drives.toml", &mended, &machine("none")).unwrap();
    let places: Vec<_> = drives.drives.iter().map(|drive| drive.process_at).collect();
    assert_eq!(places, [None, Some((0x1100, 0x1400)), None]);
}

#[test]
fn a_device_with_several_drives_has_a_table_for_each() {
    let mut both = found(0);
    both.axes = 2;
    let text = written("enp3s0", &[both, found(1)]);
    let text = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let drives = parse("drives.toml", &text, &machine("none"))
        .unwrap()
        .drives;
    let places: Vec<_> = drives
        .iter()
        .map(|d| (d.joint, d.position, d.axis))
        .collect();
    assert_eq!(places, [(0, 0, 0), (1, 0, 1), (2, 1, 0)]);
    assert_eq!(drives[1].map_step, 0x10);
    let line = |text: &str, key: &str| text.lines().position(|l| l.starts_with(key)).unwrap() + 1;
    for (from, to, words) in [
        (
            "axis = 1\n",
            "axis = 0\n",
            "two drives have the same position",
        ),
        ("axis = 1\n", "axis = 8\n", "drive.axis = 8 is out of range"),
        (
            "axis = 1\n",
            "axis = 1\nmap_step = 1\n",
            "drives of one device differ in what is the",
        ),
        (
            "axis = 1\n",
            "axis = 1\nmap_step = 0\n",
            "drive.map_step = 0 is out of range",
        ),
    ] {
        let text = text.replace(from, to);
        let told = wrong(&text);
        let is_told = |(_, what): &(usize, String)| what.contains(words);
        let found = told.iter().find(|told| is_told(told));
        assert!(found.is_some(), "{to}: {told:?}");
        if to.contains('8') {
            assert_eq!(found.unwrap().0, line(&text, "axis = 8"));
        }
    }
}

fn terminal(position: usize, windows: &[(bool, &[u32])]) -> Found {
    let entry = |entry: &u32| Entry {
        index: u16::try_from(entry >> 16).unwrap(),
        sub: u8::try_from(entry >> 8 & 0xff).unwrap(),
        bits: entry & 0xff,
    };
    let window = |(is_output, entries): &(bool, &[u32])| Window {
        is_output: *is_output,
        entries: entries.iter().map(entry).collect(),
        ..Window::default()
    };
    let mut found = found(position);
    found.modes = None;
    found.device.name = format!("TERMINAL {position}");
    found.windows = windows.iter().map(window).collect();
    found.watchdog = Some(OutputWatchdog {
        time_ns: 100_000_000,
        has_expired: true,
        count: 3,
    });
    found
}

/// Three drives, and devices with these tables.
fn with(devices: &str) -> String {
    let drives: String = (0..3)
        .map(|joint| {
            format!(
                "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 1000.0\n\
                 following_error = 1.0\nquick_stop = 2000.0\n"
            )
        })
        .collect();
    format!("[bus]\ninterface = \"eth9\"\n{drives}{devices}")
}

const DEVICES: &str = r#"[[device]]
position = 4
vendor = 2
product = 0x03ec3052
inputs = [
    { at = "0x6000:01", number = 3 },
    { at = "0x6010:01", number = 4, home = 0, limit_low = 0, invert = true },
    { bit = 17, limit_high = 2 },
]
[[device]]
position = 5
outputs = [
    { at = "0x7000:01", from = "spindle.forward" },
    { bit = 1, from = "output 5", invert = true },
    { at = "0x7020:01", from = "coolant.flood", rest = true },
]
[[device]]
position = 6
parameters = [{ object = "0x8000:01", bytes = 2, value = -1 }]
analog_outputs = [{ at = "0x7000:01", from = "spindle.speed", full = 24000.0, counts = 32767 }]
[[device]]
position = 7
assign_inputs = [0x1a00, 0x1a02]
analog_inputs = [{ at = "0x6000:11", number = 0, scale = 0.00030519, signed = false }]
"#;

#[test]
fn devices_that_are_no_drives_have_inputs_and_outputs() {
    let drives = parse("drives.toml", &with(DEVICES), &machine("none")).unwrap();
    let [inputs, outputs, speed, level] = &drives.terminals[..] else {
        panic!("{:?}", drives.terminals)
    };
    let object = |index, sub| At::Object { index, sub };
    assert_eq!((inputs.position, inputs.product), (4, 0x03ec_3052));
    let second = inputs.inputs[1];
    assert_eq!(
        (second.at, second.number, second.home, second.limit_low),
        (object(0x6010, 1), Some(4), Some(0), Some(0))
    );
    assert!(second.is_inverted && inputs.inputs[2].at == At::Bit(17));
    let seen: Vec<_> = outputs.outputs.iter().map(|o| (o.from, o.rest)).collect();
    let meant = [
        (Signal::SpindleForward, false),
        // At rest it is what it is while it is not commanded.
        (Signal::Output(5), true),
        (Signal::Flood, true),
    ];
    assert_eq!(seen, meant);
    let parameter = speed.parameters[0];
    assert_eq!((parameter.index, parameter.value), (0x8000, u32::MAX));
    assert_eq!(speed.analog_outputs[0].from, Quantity::SpindleSpeed);
    assert_eq!(level.assign_inputs, Some(vec![0x1a00, 0x1a02]));
    assert!(!level.analog_inputs[0].is_signed);
}

/// What is changed in the tables, into what, and what is said of it.
const WRONG: [(&str, &str, &str); 18] = [
    (
        "position = 4",
        "position = 2",
        "two devices are at position 2",
    ),
    (
        "position = 5",
        "position = 64",
        "device.position = 64 is out of range",
    ),
    (
        "number = 4, home",
        "number = 3, home",
        "two inputs are digital input 3",
    ),
    (
        "home = 0",
        "home = 3",
        "device.inputs.home = 3 is out of range",
    ),
    (
        "\"0x6000:01\", number",
        "\"6000:01\", number",
        "device.inputs.at = \"6000:01\" is no object",
    ),
    ("{ bit = 17, ", "{ ", "it has `at`, or `bit`"),
    (
        ", limit_high = 2",
        "",
        "nothing is said of what this input is",
    ),
    (
        "\"output 5\"",
        "\"output 64\"",
        "device.outputs.from = \"output 64\" is not known",
    ),
    (
        "bit = 1,",
        "at = \"0x7000:01\",",
        "two outputs are at 0x7000:01",
    ),
    (
        "value = -1",
        "value = 65536",
        "device.parameters.value = 65536 is out of range",
    ),
    (
        "bytes = 2",
        "bytes = 3",
        "device.parameters.bytes = 3 is not known",
    ),
    (
        "full = 24000.0",
        "full = 0.0",
        "device.analog_outputs.full = 0",
    ),
    (
        "counts = 32767",
        "counts = 0",
        "device.analog_outputs.counts = 0 is out of range",
    ),
    (
        "\"spindle.speed\"",
        "\"spindle.on\"",
        "device.analog_outputs.from = \"spindle.on\" is not",
    ),
    (
        "0x1a00",
        "0x1600",
        "device.assign_inputs = 5632 is out of range",
    ),
    (
        "number = 0, scale",
        "number = 8, scale",
        "device.analog_inputs.number = 8 is out of range",
    ),
    (
        "from = \"coolant.flood\", ",
        "",
        "the key `from` is missing",
    ),
    ("signed = false", "sign = false", "unknown key `sign`"),
];

#[test]
fn what_is_wrong_with_a_device_is_told_with_its_place() {
    let place = |text: &str, key: &str| text.lines().position(|l| l.contains(key)).unwrap() + 1;
    for (from, to, words) in WRONG {
        let before = with(DEVICES);
        assert!(before.contains(from), "{from}");
        let text = before.replacen(from, to, 1);
        let told = wrong(&text);
        let changed = before.lines().zip(text.lines()).position(|(a, b)| a != b);
        let line = changed.unwrap() + 1;
        let is_told = |(at, what): &(usize, String)| {
            // Of two that are the same, either.
            (*at == line || what.starts_with("two ")) && what.contains(words)
        };
        assert!(
            told.iter().any(is_told),
            "{from} → {to}, line {line}: {told:?}"
        );
        let last = place(&text, "position = 7");
        assert!(told.iter().all(|(at, _)| *at <= last + 2), "{told:?}");
    }
}

#[test]
fn a_first_table_for_a_device_is_right_as_soon_as_it_is_no_comment() {
    let state = [0x6000_0101, 0x6000_0302, 0x0000_0007, 0x6000_1110];
    let found = [
        found(0),
        found(1),
        found(2),
        terminal(3, &[]),
        terminal(
            4,
            &[(false, &[0x6000_0101, 0x6010_0101]), (true, &[0x7000_0101])],
        ),
        terminal(5, &[(true, &[0x7000_0110]), (false, &state)]),
    ];
    let text = written("eth1", &found).replace("counts_per_mm = 0.0", "counts_per_mm = 1.0");
    let drives = parse("drives.toml", &text, &machine("none")).unwrap();
    assert!(drives.terminals.is_empty());
    assert!(
        text.contains("alias 0: no drive, without process data"),
        "{text}"
    );
    assert!(
        text.contains(
            "# Its outputs fall 100 ms after the last frame (0x0420; watchdog_ms is written at the \
                       start); expired (0x0440), 3 times so far"
        ),
        "{text}"
    );
    let (before, tables) = text.split_once("# [[device]]").unwrap();
    let tables: String = tables
        .lines()
        .filter(|line| !line.starts_with("# Its outputs"))
        .map(|line| format!("{}\n", line.strip_prefix("# ").unwrap_or(line)))
        .collect();
    let text = format!("{before}[[device]]{tables}");
    let drives = parse("drives.toml", &text, &machine("none")).unwrap();
    let seen: Vec<_> = drives
        .terminals
        .iter()
        .map(|t| {
            let analog = (t.analog_inputs.len(), t.analog_outputs.len());
            (t.position, t.inputs.len(), t.outputs.len(), analog)
        })
        .collect();
    assert_eq!(
        seen,
        [(3, 0, 0, (0, 0)), (4, 2, 1, (0, 0)), (5, 1, 0, (1, 1))]
    );
    let numbers = drives.terminals.iter().flat_map(|t| &t.inputs);
    let numbers: Vec<_> = numbers.map(|input| input.number).collect();
    assert_eq!(numbers, [Some(0), Some(1), Some(2)]);
    assert_eq!(drives.terminals[2].analog_outputs[0].full_counts, 32_767);
}

#[test]
fn the_tables_of_the_manual_are_right() {
    let page = include_str!("../../docs/drives.md");
    let (_, section) = page.split_once("\n## Terminals\n").unwrap();
    let (_, example) = section.split_once("```toml\n").unwrap();
    let (example, _) = example.split_once("```").unwrap();
    let drives = parse("drives.toml", &with(example), &machine("none")).unwrap();
    let [_coupler, inputs, outputs, speed, level] = &drives.terminals[..] else {
        panic!("{:?}", drives.terminals)
    };
    assert_eq!((inputs.inputs.len(), outputs.outputs.len()), (3, 3));
    let analog = (speed.analog_outputs.len(), level.analog_inputs.len());
    assert_eq!((analog, speed.parameters.len()), ((1, 1), 1));
}
