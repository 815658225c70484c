//! Inputs of drives (0x60FD): the probe of one, and switches.

use super::telling::is_of_probe;
use super::{PART_Z, TOUCH, probe, searched, setup};
use crate::life::Day;
use crate::machine::{COUNTS, Case, Hands, Setup, run};
use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{DriveSettings as Emulated, Maps, Probe, Segment};
use glidepath_ethercat::{At, DigitalInput, Init, Mapping, Settings};

const fn bit(bit: u32) -> DigitalInput {
    DigitalInput {
        at: At::Bit(bit),
        number: None,
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    }
}

/// The probe is wired to the drives alone: the input of one stops the motion.
#[test]
fn a_probe_needs_no_terminal() {
    for period_ns in [1_000_000, 4_000_000] {
        let mut setup = setup(period_ns, Some(TOUCH));
        setup.terminals.clear();
        setup.emulated.truncate(3);
        setup.drives[0].has_inputs = true;
        setup.drive_inputs = vec![(
            0,
            DigitalInput {
                number: Some(0),
                ..bit(26)
            },
        )];
        let at_drive = Probe {
            inputs: Vec::new(),
            drive_inputs: vec![(0, 0, 26)],
            ..probe()
        };
        let (search, events) = searched(&setup, at_drive, &["G21 G90 F1200\nG38.2 Z-5\n"]);
        assert!(!events.iter().any(is_of_probe), "{events:?}");
        let error = search.found[0].contact[2] - PART_Z;
        assert!(error.abs() <= 1.5 / COUNTS, "{error}");
    }
}

/// Switches of the third drive, looked at while nothing moves.
#[derive(Debug, Default)]
struct Look {
    day: Day,
    /// Ticks with feedback.
    heard: u64,
    /// Inputs, home, lower and upper limits: before, and while all are high.
    seen: Vec<(u64, u32, u32, u32)>,
}

impl Case for Look {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let Some(said) = hands.feedback else {
            return;
        };
        self.heard += 1;
        if matches!(self.heard, 50 | 100) {
            let switches = (said.home_switch, said.limit_low, said.limit_high);
            self.seen
                .push((said.digital_in, switches.0, switches.1, switches.2));
            for bit in [0, 1, 2, 31] {
                segment.set_drive_input((2, 0), bit, self.heard == 50);
            }
        }
        if self.heard > 110 {
            self.day.tick(hands, segment);
        }
    }

    fn counts(&self) -> bool {
        self.day.counts()
    }
}

fn with_switches(mut setup: Setup) -> Setup {
    let low = DigitalInput {
        limit_low: Some(2),
        ..bit(0)
    };
    let high = DigitalInput {
        limit_high: Some(2),
        is_inverted: true,
        ..bit(1)
    };
    let home = DigitalInput {
        home: Some(2),
        number: Some(5),
        ..bit(2)
    };
    let last = DigitalInput {
        number: Some(63),
        ..bit(31)
    };
    setup.drives[2].has_inputs = true;
    setup.drive_inputs = [low, high, home, last].map(|input| (2, input)).to_vec();
    setup
}

#[test]
fn switches_of_a_drive_are_those_of_joints() {
    let kept = Maps::Fixed {
        outputs: vec![0x6040_0010, 0x607a_0020],
        inputs: vec![0x60fd_0020, 0x6041_0010, 0x6064_0020],
    };
    for maps in [Maps::Free, Maps::Short, kept] {
        let mut setup = with_switches(Setup::absolute(2_000_000));
        if matches!(maps, Maps::Fixed { .. }) {
            setup.drives[2].mapping = Mapping::Kept;
        }
        setup.emulated[2] = Emulated {
            maps,
            ..Emulated::default()
        };
        let mut look = Look::default();
        let outcome = run(&setup, &mut look);
        assert_eq!(outcome.allocations, 0, "the bus thread allocates");
        let (before, pressed) = (look.seen[0], look.seen[1]);
        // The upper limit switch is one that opens.
        assert_eq!(before, (0, 0, 0, 4));
        assert_eq!(pressed, (1 << 63 | 1 << 5, 4, 4, 0));
    }
}

#[test]
fn a_drive_whose_maps_lack_the_inputs_is_refused_by_name() {
    let mut setup = with_switches(Setup::absolute(2_000_000));
    setup.drives[2].mapping = Mapping::Kept;
    setup.emulated[2].maps = Maps::Fixed {
        outputs: vec![0x6040_0010, 0x607a_0020],
        inputs: vec![0x6041_0010, 0x6064_0020],
    };
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives,
        drive_inputs: setup.drive_inputs,
        terminals: Vec::new(),
        servo: crate::machine::servo(),
    };
    let mut wire = MemoryWire::new(Segment::new(&setup.emulated), Quiet, 0);
    let pre_op = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let told = pre_op.into_safe_op(&settings).unwrap_err().to_string();
    assert!(
        told.contains("device 2") && told.contains("0x60FD (digital inputs)"),
        "{told}"
    );
}
