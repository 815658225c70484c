//! Tests of the way of terminals into operation, and of what is said where that does not work.

use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, Maps, OutputWatchdog, Segment};
use glidepath_ethercat::{
    AnalogOutput, At, BusError, BusSettings, DigitalInput, DigitalOutput, Init, Mapping, Parameter,
    Quantity, Settings, Signal, SpindleMode, SpindleSettings, TerminalSettings,
};
use glidepath_link::servo::ServoSettings;

const START_NS: u64 = 9_000_000_000_000;

const fn object(index: u16, sub: u8) -> At {
    At::Object { index, sub }
}

fn at(position: usize) -> TerminalSettings {
    TerminalSettings {
        position,
        ..TerminalSettings::default()
    }
}

fn input(at: At) -> DigitalInput {
    DigitalInput {
        at,
        number: Some(0),
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    }
}

fn output(at: At, rest: bool) -> DigitalOutput {
    DigitalOutput {
        at,
        from: Signal::Output(0),
        is_inverted: false,
        rest,
    }
}

fn settings(terminals: Vec<TerminalSettings>) -> Settings {
    Settings {
        bus: BusSettings::default(),
        drives: vec![crate::machine::drive(0)],
        drive_inputs: Vec::new(),
        terminals,
        servo: ServoSettings::default(),
    }
}

/// A drive, a coupler, and a terminal.
fn wire(terminal: Emulated) -> MemoryWire<Quiet> {
    let line = [
        Emulated::default(),
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        terminal,
    ];
    let segment = Segment::new_at(&line, START_NS - 1_000_000_000);
    MemoryWire::new(segment, Quiet, START_NS)
}

fn come_up(wire: &mut MemoryWire<Quiet>, terminals: Vec<TerminalSettings>) -> Result<(), BusError> {
    let settings = settings(terminals);
    let bus = Init::find(wire)?.into_pre_op()?;
    bus.into_safe_op(&settings)?.into_op(&settings.bus)?;
    Ok(())
}

const fn spindle(mode: SpindleMode, mapping: Mapping) -> SpindleSettings {
    SpindleSettings {
        mode,
        units_per_rpm: 1.0,
        is_inverted: false,
        max_rpm: 24_000.0,
        ramp_rpm_per_s: 8000.0,
        at_speed_r: 0.03,
        gears: None,
        orientation: None,
        tells_load: false,
        mapping,
    }
}

#[test]
fn what_cannot_be_a_spindle_is_refused_with_what_it_is() {
    let with = |spindle| TerminalSettings {
        spindle: Some(spindle),
        ..at(2)
    };
    let told = refusal(
        Emulated::inputs(4),
        with(spindle(SpindleMode::Velocity, Mapping::Written)),
    );
    assert!(told.contains("it has no mailbox with CoE"), "{told}");
    let inverter = Emulated {
        clock: ClockKind::ReceiveTimes,
        maps: Maps::Fixed {
            outputs: vec![0x6040_0010, 0x6042_0010],
            inputs: vec![0x6041_0010],
        },
        ..Emulated::default()
    };
    let told = refusal(
        inverter.clone(),
        with(spindle(SpindleMode::CyclicVelocity, Mapping::Kept)),
    );
    assert!(told.contains("it has no distributed clock"), "{told}");
    let told = refusal(
        inverter.clone(),
        with(spindle(SpindleMode::Velocity, Mapping::Written)),
    );
    assert!(told.contains("map = \"keep\" in its table"), "{told}");
    let kept = with(spindle(SpindleMode::Velocity, Mapping::Kept));
    let told = refusal(inverter, kept);
    assert!(
        told.ends_with(
            "there is no input 0x6044:00 in its process data, which has 0x6041:00 (16 bit)"
        ),
        "{told}"
    );
}

fn refusal(terminal: Emulated, settings: TerminalSettings) -> String {
    let mut wire = wire(terminal);
    come_up(&mut wire, vec![settings]).unwrap_err().to_string()
}

#[test]
fn outputs_are_at_rest_as_soon_as_they_are_anything() {
    let mut wire = wire(Emulated::outputs(4));
    wire.segment.keep_records();
    let terminal = TerminalSettings {
        outputs: vec![
            output(object(0x7000, 1), false),
            output(object(0x7010, 1), true),
            output(At::Bit(3), true),
        ],
        ..at(2)
    };
    come_up(&mut wire, vec![at(1), terminal]).unwrap();
    let records = wire.segment.take_output_records(2);
    // None was ever anything else.
    let seen: Vec<_> = records.iter().map(|record| &record.outputs[..]).collect();
    assert_eq!(seen, [&[0][..], &[0b1010]], "{records:?}");
}

#[test]
fn terminals_that_nobody_names_are_left_alone() {
    let mut named = wire(Emulated::outputs(4));
    come_up(&mut named, vec![at(1)]).unwrap();
    assert_eq!(named.segment.outputs(2), [0]);
    let mut none = wire(Emulated::outputs(4));
    come_up(&mut none, Vec::new()).unwrap();
}

#[test]
fn what_a_terminal_has_is_told_before_anything_is_written() {
    let mut wire = wire(Emulated::analog_inputs(2));
    let mut bus = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let windows = bus.windows(2).unwrap();
    let seen: Vec<_> = windows
        .iter()
        .map(|window| (window.number, window.is_output, window.entries.len()))
        .collect();
    // Nine entries of state and value, of both channels.
    assert_eq!(seen, [(2, true, 0), (3, false, 18)]);
    assert!(bus.windows(1).unwrap().is_empty());
    let watchdog = bus.watchdog(2).unwrap();
    assert_eq!(
        (watchdog.time_ns, watchdog.has_expired),
        (100_000_000, false)
    );
}

#[test]
fn a_watchdog_that_expired_is_told() {
    let mut wire = wire(Emulated::outputs(4));
    let terminal = || TerminalSettings {
        outputs: vec![output(object(0x7000, 1), true)],
        ..at(2)
    };
    come_up(&mut wire, vec![terminal()]).unwrap();
    assert_eq!(wire.segment.outputs(2), [1]);
    let later_ns = glidepath_ethercat::Wire::now_ns(&wire) + 11_000_000;
    glidepath_ethercat::Wire::sleep_until(&mut wire, later_ns);
    wire.segment.advance(later_ns);
    assert_eq!(wire.segment.outputs(2), [0]);
    let mut bus = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let watchdog = bus.watchdog(2).unwrap();
    // Its time stays as it was written, 10 ms.
    let seen = (watchdog.time_ns, watchdog.has_expired, watchdog.count);
    assert_eq!(seen, (10_000_000, true, 1));
}

#[test]
fn what_is_wrong_with_a_terminal_is_said_with_its_place() {
    let other = TerminalSettings { vendor: 3, ..at(2) };
    let refused = refusal(Emulated::inputs(4), other);
    assert!(
        refused.starts_with("position 2: drives.toml wants vendor 0x3"),
        "{refused}"
    );
    let missing = refusal(Emulated::inputs(4), at(3));
    assert!(
        missing.contains("wants a device at position 3, and 3 devices"),
        "{missing}"
    );
    let wrong = TerminalSettings {
        inputs: vec![input(object(0x6040, 1))],
        ..at(2)
    };
    let wrong = refusal(Emulated::inputs(2), wrong);
    assert_eq!(
        wrong,
        "device 2 (INPUTS): there is no input 0x6040:01 in its process data, which has 0x6000:01 (1 bit), \
         0x6010:01 (1 bit)"
    );
    let none = TerminalSettings {
        outputs: vec![output(object(0x7000, 1), false)],
        ..at(2)
    };
    let none = refusal(Emulated::inputs(2), none);
    assert!(none.ends_with("which has none that can be named"), "{none}");
    let value = TerminalSettings {
        analog_outputs: vec![AnalogOutput {
            at: object(0x7000, 1),
            from: Quantity::Output(0),
            full: 10.0,
            full_counts: 70_000,
            rest: 0.0,
        }],
        ..at(2)
    };
    let value = refusal(Emulated::analog_outputs(2), value);
    assert!(
        value.contains("0x7000:01 is 16 bits long, and cannot be what the file says"),
        "{value}"
    );
}

#[test]
fn parameters_that_a_terminal_does_not_take_are_told() {
    let told = |index, size| TerminalSettings {
        parameters: vec![Parameter {
            index,
            sub: 1,
            size,
            value: 1,
        }],
        ..at(2)
    };
    let simple = refusal(Emulated::inputs(4), told(0x8000, 2));
    assert!(
        simple.contains("it has no mailbox with CoE: leave parameters"),
        "{simple}"
    );
    let unknown = refusal(Emulated::analog_outputs(2), told(0x8070, 2));
    assert!(
        unknown.contains("object 0x8070:1 was refused: abort code 0x06020000"),
        "{unknown}"
    );
    let mut known = wire(Emulated::analog_outputs(2));
    come_up(&mut known, vec![told(0x8000, 2)]).unwrap();
    // One of eight bytes goes like any other.
    let long = Emulated {
        long_objects: vec![((0x8010, 1), Vec::new())],
        ..Emulated::analog_outputs(2)
    };
    let mut known = wire(long);
    let eight = TerminalSettings {
        parameters: vec![Parameter {
            index: 0x8010,
            sub: 1,
            size: 8,
            value: 0x0102_0304_0506_0708,
        }],
        ..at(2)
    };
    come_up(&mut known, vec![eight]).unwrap();
    let written = known.segment.long_object(2, (0x8010, 1)).unwrap();
    assert_eq!(written, [8, 7, 6, 5, 4, 3, 2, 1]);
    let assigned = TerminalSettings {
        assign_inputs: Some(vec![0x1a00; 9]),
        ..at(2)
    };
    // It has room for eight.
    let assigned = refusal(Emulated::analog_inputs(4), assigned);
    assert!(
        assigned.contains("object 0x1c13:9 was refused"),
        "{assigned}"
    );
}

#[test]
fn outputs_that_would_go_on_without_the_bus_are_refused() {
    let terminal = TerminalSettings {
        outputs: vec![output(object(0x7000, 1), false)],
        ..at(2)
    };
    for like in [Emulated::outputs(4), Emulated::analog_outputs(2)] {
        let never = Emulated {
            watchdog: OutputWatchdog::Never,
            ..like.clone()
        };
        let terminal = TerminalSettings {
            outputs: if like.has_mailbox {
                Vec::new()
            } else {
                terminal.outputs.clone()
            },
            ..terminal.clone()
        };
        let refused = refusal(never, terminal);
        let why = "it does not let the watchdog of its outputs be switched on (bit 6 of 0x08";
        assert!(refused.contains(why), "{refused}");
    }
}

#[test]
fn more_than_a_frame_has_room_for_is_refused() {
    // Fifty entries of 31 bytes.
    let mut large = Emulated::inputs(1);
    large.channels.as_mut().unwrap().inputs = vec![vec![0x6000_01f8; 50]];
    let refused = refusal(large, at(2));
    assert!(
        refused.starts_with("what is exchanged in a cycle takes 1")
            && refused.contains("a frame has 1514"),
        "{refused}"
    );
}
