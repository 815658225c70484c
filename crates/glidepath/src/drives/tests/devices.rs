//! Tests of the tables of devices that are no drives.

use super::{found, machine, wrong};
use crate::drives::{Found, parse, written};
use glidepath_ethercat::{
    At, BusError, Entry, Mapping, OutputWatchdog, Quantity, Signal, SpindleMode, Window,
};

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
[[device]]
position = 8
spindle = { mode = "cyclic-velocity", units_per_rpm = 1000.0, max_rpm = 24000.0, ramp = 8000.0, map = "keep" }
"#;

#[test]
fn devices_that_are_no_drives_have_inputs_and_outputs() {
    let drives = parse("drives.toml", &with(DEVICES), &machine("none")).unwrap();
    let [inputs, outputs, speed, level, spindle] = &drives.terminals[..] else {
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
    assert_eq!((parameter.index, parameter.value), (0x8000, u64::MAX));
    assert_eq!(speed.analog_outputs[0].from, Quantity::SpindleSpeed);
    assert_eq!(level.assign_inputs, Some(vec![0x1a00, 0x1a02]));
    assert!(!level.analog_inputs[0].is_signed);
    let spindle = spindle.spindle.unwrap();
    assert_eq!(spindle.mode, SpindleMode::CyclicVelocity);
    assert_eq!(
        (spindle.mapping, spindle.is_inverted),
        (Mapping::Kept, false)
    );
    assert!((spindle.at_speed_r - 0.03).abs() < 1e-12);
    // Below 0 it falls.
    let falls = with(DEVICES).replace("scale = 0", "scale = -0");
    let drives = parse("drives.toml", &falls, &machine("none")).unwrap();
    assert!(drives.terminals[3].analog_inputs[0].scale < 0.0);
}

#[test]
fn a_machine_has_one_spindle_and_an_inverter_counts_its_revolutions() {
    let spindle = |position| {
        format!(
            "[[device]]\nposition = {position}\nspindle = {{ mode = \"velocity\", max_rpm = 24000.0, ramp = \
             8000.0 }}\n"
        )
    };
    let drives = parse("drives.toml", &with(&spindle(4)), &machine("none")).unwrap();
    let units = drives.terminals[0].spindle.unwrap().units_per_rpm;
    assert!((units - 1.0).abs() < 1e-12);
    let told = wrong(&with(&(spindle(4) + &spindle(5))));
    assert_eq!(told[0].1, "two devices are the drive of the spindle");
    // 0x6042 has 16 bits.
    let fast = spindle(4).replace("24000.0", "33000.0");
    assert!(
        wrong(&with(&fast))[0]
            .1
            .contains("more than its drive can be told")
    );
}

#[test]
fn what_the_bus_refuses_is_told_by_its_place_in_the_file() {
    let text = with(DEVICES);
    let drives = parse("drives.toml", &text, &machine("none")).unwrap();
    let told = |error: &BusError| {
        let refusal = drives.source.refusal(error)?;
        let diagnostic = refusal.diagnostics().first()?.clone();
        let (line, _) = refusal.line_and_column(&diagnostic)?;
        Some((
            text.lines().nth(line - 1)?.trim().to_owned(),
            diagnostic.message,
        ))
    };
    let unwired = |at, is_output| BusError::Unwired {
        device: 5,
        name: "EL2004".to_owned(),
        at,
        is_output,
        what: "there is none".to_owned(),
    };
    let (line, message) = told(&unwired(At::Bit(1), true)).unwrap();
    assert!(line.starts_with("{ bit = 1, from = \"output 5\""), "{line}");
    assert_eq!(message, "device 5 (EL2004): there is none");
    // What is not named there is the device's.
    let (line, _) = told(&unwired(At::Bit(1), false)).unwrap();
    assert_eq!(line, "[[device]]");
    let missing = BusError::Missing {
        position: 2,
        found: 2,
    };
    assert_eq!(told(&missing).unwrap().0, "[[drive]]");
    assert_eq!(told(&BusError::Nobody), None);
    let elsewhere = BusError::Missing {
        position: 60,
        found: 2,
    };
    assert_eq!(told(&elsewhere), None);
}

/// What is changed in the tables, into what, and what is said of it.
const WRONG: [(&str, &str, &str); 26] = [
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
    (
        "scale = 0.00030519",
        "scale = 0.0",
        "device.analog_inputs.scale = 0 a count is out of range",
    ),
    (
        "scale = 0.00030519",
        "scale = -1e10",
        "device.analog_inputs.scale = -10000000000 a count is out of range",
    ),
    (
        "counts = 32767",
        "counts = 32767, rest = 24001.0",
        "device.analog_outputs.rest = 24001 units is out of range",
    ),
    (
        "\"cyclic-velocity\"",
        "\"cyclic\"",
        "device.spindle.mode = \"cyclic\" is not known",
    ),
    ("units_per_rpm = 1000.0, ", "", "units_per_rpm is missing"),
    (
        "max_rpm = 24000.0",
        "max_rpm = 24000000.0",
        "device.spindle.max_rpm = 24000000 rev/min is out of range",
    ),
    (
        "units_per_rpm = 1000.0",
        "units_per_rpm = 100000.0",
        "device.spindle.max_rpm = 24000 rev/min is more than its drive can be told",
    ),
    (
        "ramp = 8000.0",
        "ramp = 0.0",
        "device.spindle.ramp = 0 rev/min per s is out of range",
    ),
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
        let last = place(&text, "position = 8");
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
    let page = include_str!("../../../docs/drives.md");
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
    let (_, section) = section.split_once("\n### A spindle\n").unwrap();
    let (_, example) = section.split_once("```toml\n").unwrap();
    let (example, _) = example.split_once("```").unwrap();
    let drives = parse("drives.toml", &with(example), &machine("none")).unwrap();
    assert_eq!(
        drives.terminals[0].spindle.unwrap().mode,
        SpindleMode::Velocity
    );
}
