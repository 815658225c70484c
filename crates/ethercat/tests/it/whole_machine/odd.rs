//! Everything that real devices have oddly, all at once on one line.

use super::{at, cables, input, object, output};
use crate::life::{Day, assert_clean};
use crate::machine::{START_NS, Setup, run_on};
use glidepath_emulator::{
    ClockKind, DriveSettings as Emulated, ImageAccess, Maps, OutputWatchdog, Segment, SyncType,
};
use glidepath_ethercat::{
    AnalogInput, AnalogOutput, BusError, DigitalInput, EncoderSettings, Init, Mapping, Quantity,
    Settings, Signal, TerminalSettings,
};

/// A coupler whose clock is the reference; inputs without a mailbox; outputs in two windows; analog ones; an
/// encoder; a junction without a system time; and three drives.
fn emulated() -> Vec<Emulated> {
    vec![
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::inputs(4),
        Emulated {
            // As an EL2889: it has a clock, and needs none.
            clock: ClockKind::Bits64,
            drift_ppm: -40.0,
            ..Emulated::outputs(16)
        },
        Emulated {
            drops_repeats: true,
            ..Emulated::analog_outputs(2)
        },
        Emulated {
            clock: ClockKind::None,
            ..Emulated::analog_inputs(4)
        },
        Emulated::encoder(32),
        Emulated::terminal("JUNCTION", ClockKind::ReceiveTimes),
        // Two axes in one device, whose EEPROM says nothing of its process data.
        Emulated {
            name: "TWO AXES".to_owned(),
            axes: 2,
            tells_managers: false,
            drops_repeats: true,
            drift_ppm: 80.0,
            ..Emulated::default()
        },
        // As an AKD: a clock of 32 bits, 8 bytes a map, no watchdog bit, a type that cannot be written.
        Emulated {
            name: "SHORT".to_owned(),
            clock: ClockKind::Bits32,
            maps: Maps::Short,
            watchdog: OutputWatchdog::Untold,
            sync_type: SyncType::Follows,
            drift_ppm: -80.0,
            ..Emulated::default()
        },
        // As a SGD7S: no LRW; and maps of its own, without a mode.
        Emulated {
            name: "FIXED".to_owned(),
            image: ImageAccess::NoLrwByEeprom,
            maps: Maps::Fixed {
                outputs: vec![0x6040_0010, 0x607a_0020],
                inputs: vec![0x6041_0010, 0x6064_0020],
            },
            drops_repeats: true,
            ..Emulated::default()
        },
        Emulated {
            image: ImageAccess::NoLrwByFeatures,
            ..Emulated::inputs(2)
        },
    ]
}

fn terminals() -> Vec<TerminalSettings> {
    vec![
        at(0),
        TerminalSettings {
            inputs: vec![DigitalInput {
                number: Some(3),
                ..input(0x6030)
            }],
            ..at(1)
        },
        TerminalSettings {
            // In the second window.
            outputs: vec![output(0x70f0, Signal::Output(0), false)],
            ..at(2)
        },
        TerminalSettings {
            analog_outputs: vec![AnalogOutput {
                at: object(0x7000, 1),
                from: Quantity::Output(0),
                full: 10.0,
                full_counts: 32_767,
                rest: 0.0,
            }],
            ..at(3)
        },
        TerminalSettings {
            assign_inputs: Some(vec![0x1a00, 0x1a02]),
            analog_inputs: vec![AnalogInput {
                at: object(0x6000, 0x11),
                number: 0,
                scale: 1.0,
                offset: 0.0,
                is_signed: true,
            }],
            ..at(4)
        },
        TerminalSettings {
            encoder: Some(EncoderSettings {
                counts_per_rev: 4096,
                has_index: true,
                is_inverted: false,
                near_r: 0.03,
            }),
            ..at(5)
        },
        at(6),
        TerminalSettings {
            inputs: vec![DigitalInput {
                limit_low: Some(1),
                ..input(0x6010)
            }],
            ..at(10)
        },
    ]
}

/// Three joints: both axes of a device, and another one's.
fn setup() -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    for (drive, (position, axis)) in setup.drives.iter_mut().zip([(7, 0), (7, 1), (8, 0)]) {
        (drive.position, drive.axis) = (position, axis);
        drive.process_at = (position == 7).then_some((0x1100, 0x1180));
    }
    setup.emulated = emulated();
    setup.terminals = terminals();
    setup
}

fn segment(setup: &Setup) -> Segment {
    let mut segment =
        Segment::branched(&setup.emulated, &cables(), START_NS - 3_000_000_000).unwrap();
    segment.keep_records();
    segment
}

#[test]
fn a_line_with_everything_odd_comes_up_and_moves() {
    // The third joint on the drive with short maps, and on the one with fixed ones.
    for (position, mapping) in [(8, Mapping::Written), (9, Mapping::Kept)] {
        let mut setup = setup();
        (setup.drives[2].position, setup.drives[2].mapping) = (position, mapping);
        let outcome = run_on(&setup, &mut Day::default(), segment(&setup), START_NS);
        assert_clean(&setup, &outcome);
        assert_eq!(outcome.counts.restarts, 0);
        let end = outcome.setpoints.last().unwrap();
        assert!((end.position[0] - 5.0).abs() < 1e-3 && (end.position[2] - 3.0).abs() < 1e-3);
        // All of them take their targets over at the same moment, whatever clock they have.
        let records = &outcome.records;
        let common = records[0].iter().skip(50).zip(&records[2][50..]);
        for (one, other) in common {
            assert!(one.at_ns.abs_diff(other.at_ns) < 1_000, "{one:?} {other:?}");
        }
    }
}

/// What such a line is refused with.
fn refusal(setup: &Setup) -> BusError {
    let mut wire =
        crate::wire::MemoryWire::new(segment(setup), crate::wire::Quiet, START_NS - 2_000_000_000);
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives.clone(),
        drive_inputs: Vec::new(),
        terminals: setup.terminals.clone(),
        servo: crate::machine::servo(),
    };
    let bus = Init::find(&mut wire).and_then(Init::into_pre_op);
    let bus = bus.and_then(|bus| bus.into_safe_op(&settings));
    bus.and_then(|bus| bus.into_op(&setup.bus).map(|_| ()))
        .unwrap_err()
}

#[test]
fn one_device_too_odd_is_named_among_all_that_are_not() {
    let mut frames = setup();
    frames.emulated[8].sync_type = SyncType::Fixed(1);
    let told = refusal(&frames).to_string();
    assert!(
        told.starts_with("device 8 (SHORT)") && told.contains("0x1C32:1 is 1"),
        "{told}"
    );
    let mut untold = setup();
    untold.drives[1].process_at = None;
    untold.drives[0].process_at = None;
    let told = refusal(&untold).to_string();
    assert!(
        told.starts_with("device 7 (TWO AXES)") && told.contains("outputs_at"),
        "{told}"
    );
    let mut unwatched = setup();
    unwatched.emulated[2].watchdog = OutputWatchdog::Never;
    let told = refusal(&unwatched).to_string();
    assert!(told.starts_with("device 2"), "{told}");
    let mut fixed = setup();
    fixed.drives[2].position = 9;
    let told = refusal(&fixed).to_string();
    assert!(
        told.starts_with("device 9 (FIXED)") && told.contains("map = \"keep\""),
        "{told}"
    );
}
