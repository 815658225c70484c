//! Tests of drives that do not let the master map what it likes.

use crate::life::{Day, assert_clean};
use crate::machine::{Setup, run};
use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{DriveSettings as Emulated, Maps, Segment};
use glidepath_ethercat::{BusError, Event, Init, Mapping, Settings};
use glidepath_link::servo::ServoSettings;

/// As an Omron G5 has it, with its limit of torque: no mode.
fn without_mode() -> Maps {
    Maps::Fixed {
        outputs: vec![
            0x6040_0010,
            0x607a_0020,
            0x6072_0010,
            0x60b8_0010,
            0x60fe_0120,
        ],
        inputs: vec![
            0x603f_0010,
            0x6041_0010,
            0x6064_0020,
            0x6077_0010,
            0x60fd_0020,
        ],
    }
}

/// Other objects before and between those that are wanted, and no error code.
fn with_mode() -> Maps {
    Maps::Fixed {
        outputs: vec![
            0x6072_0010,
            0x6060_0008,
            0x0000_0008,
            0x607a_0020,
            0x6040_0010,
        ],
        inputs: vec![0x6077_0010, 0x6064_0020, 0x6061_0008, 0x6041_0010],
    }
}

fn is_at_the_end(setup: &Setup) {
    let outcome = run(setup, &mut Day::default());
    if setup.drives[1].homing.is_none() {
        assert_clean(setup, &outcome);
    }
    let times = |wanted: Event| outcome.events.iter().filter(|e| **e == wanted).count();
    assert_eq!((times(Event::Follows(1)), times(Event::Off(1))), (1, 1));
    let end = outcome.setpoints.last().unwrap();
    assert!((end.position[1] - 5.0).abs() < 1e-3, "{}", end.position[1]);
}

#[test]
fn maps_of_eight_bytes_are_filled_one_after_the_other() {
    let mut setup = Setup::absolute(2_000_000);
    setup.emulated[1].maps = Maps::Short;
    is_at_the_end(&setup);
}

#[test]
fn maps_that_are_kept_lead_a_drive_as_those_that_are_written() {
    for maps in [without_mode(), with_mode()] {
        let mut setup = Setup::absolute(2_000_000);
        setup.emulated[1].maps = maps;
        setup.drives[1].mapping = Mapping::Kept;
        is_at_the_end(&setup);
    }
    let mut setup = Setup::homing(2_000_000);
    setup.emulated[1].maps = with_mode();
    setup.drives[1].mapping = Mapping::Kept;
    is_at_the_end(&setup);
}

fn to_safe_op(setup: &Setup) -> Result<(), BusError> {
    let segment = Segment::new_at(&setup.emulated, 0);
    let mut wire = MemoryWire::new(segment, Quiet, 5_000_000_000);
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives.clone(),
        drive_inputs: Vec::new(),
        terminals: setup.terminals.clone(),
        servo: ServoSettings::default(),
    };
    let bus = Init::find(&mut wire).and_then(Init::into_pre_op);
    let safe = bus.and_then(|bus| bus.into_safe_op(&settings));
    safe.map(|_| ())
}

/// What a start is refused with.
pub(crate) fn refusal(setup: &Setup) -> String {
    to_safe_op(setup).unwrap_err().to_string()
}

/// A start that is not refused.
pub(crate) fn comes_up(setup: &Setup) {
    to_safe_op(setup).unwrap();
}

#[test]
fn maps_that_do_not_do_are_told_with_what_does() {
    let fixed = |maps, mapping, setup: Setup| {
        let mut setup = setup;
        setup.emulated[1] = Emulated {
            name: "FIXED".to_owned(),
            maps,
            ..setup.emulated[1].clone()
        };
        setup.drives[1].mapping = mapping;
        refusal(&setup)
    };
    let absolute = Setup::absolute(2_000_000);
    let written = fixed(without_mode(), Mapping::Written, absolute.clone());
    assert!(
        written.starts_with("device 1 (FIXED): it does not let its process data be mapped (")
            && written.contains("0x1600:0 was refused")
            && written.ends_with("map = \"keep\" in its table in drives.toml takes it as it is"),
        "{written}"
    );
    let maps = Maps::Fixed {
        outputs: vec![0x6040_0010, 0x60ff_0020],
        inputs: vec![0x6041_0010, 0x6064_0020],
    };
    let lacks = fixed(maps, Mapping::Kept, absolute);
    assert!(
        lacks.contains("device 1 (FIXED): its process data lacks 0x607A (target position): map it"),
        "{lacks}"
    );
    // It would have to be told when to look for its home.
    let homes = fixed(without_mode(), Mapping::Kept, Setup::homing(2_000_000));
    assert!(
        homes.contains("its process data lacks 0x6060 (mode)"),
        "{homes}"
    );
}
