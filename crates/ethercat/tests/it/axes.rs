//! Tests of devices with several drives: objects of each are 0x800 behind those of the one before.

use crate::life::{Day, assert_clean};
use crate::machine::{Case, Hands, Setup, run};
use glidepath_emulator::{DriveSettings as Emulated, ImageAccess, InjectedFault, Maps, Segment};
use glidepath_ethercat::{Event, Mapping};

/// J0 and J2 are of the first device, J1 is the second one; or all of them are one device.
fn shared(setup: Setup, places: [(usize, u16); 3]) -> Setup {
    let mut setup = setup;
    for (drive, (position, axis)) in setup.drives.iter_mut().zip(places) {
        (drive.position, drive.axis) = (position, axis);
    }
    let devices = places.iter().map(|(position, _)| position).max().unwrap() + 1;
    setup.emulated = (0..devices)
        .map(|nth| {
            let own = || places.iter().enumerate().filter(|(_, (at, _))| *at == nth);
            let mut like = setup.emulated[0].clone();
            like.axes = own().count();
            like.start_counts = vec![0; like.axes];
            for (joint, (_, axis)) in own() {
                let before = setup.emulated[joint].start_counts.first();
                like.start_counts[usize::from(*axis)] = before.copied().unwrap_or(0);
            }
            like
        })
        .collect();
    setup
}

const TWO: [(usize, u16); 3] = [(0, 0), (1, 0), (0, 1)];
const ONE: [(usize, u16); 3] = [(0, 2), (0, 0), (0, 1)];

#[test]
fn several_drives_in_a_device_are_led_like_as_many_devices() {
    for places in [TWO, ONE] {
        for change in [
            |_: &mut Emulated| {},
            |like: &mut Emulated| like.maps = Maps::Short,
            |like: &mut Emulated| like.image = ImageAccess::NoLrwByFeatures,
        ] {
            let mut setup = shared(Setup::absolute(2_000_000), places);
            change(&mut setup.emulated[0]);
            let outcome = run(&setup, &mut Day::default());
            assert_clean(&setup, &outcome);
            let end = outcome.setpoints.last().unwrap();
            assert!((end.position[2] - 3.0).abs() < 1e-3, "{}", end.position[2]);
        }
    }
}

#[test]
fn each_drive_of_a_device_finds_its_own_home() {
    let setup = shared(Setup::homing(2_000_000), ONE);
    let outcome = run(&setup, &mut Day::default());
    for joint in 0..3 {
        assert!(outcome.events.contains(&Event::Home(joint)), "J{joint}");
    }
    let end = outcome.setpoints.last().unwrap();
    assert!((end.position[0] - 5.0).abs() < 1e-3, "{}", end.position[0]);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
}

#[test]
fn maps_that_are_kept_have_the_objects_of_all_drives() {
    let both = |first: u32| [first, first + 0x0800_0000];
    let mut setup = shared(Setup::absolute(2_000_000), TWO);
    setup.emulated[0].maps = Maps::Fixed {
        outputs: [0x6072_0010, 0x607a_0020, 0x6040_0010].map(both).concat(),
        inputs: [0x6041_0010, 0x6064_0020].map(both).concat(),
    };
    for nth in [0, 2] {
        setup.drives[nth].mapping = Mapping::Kept;
    }
    let outcome = run(&setup, &mut Day::default());
    assert_clean(&setup, &outcome);
}

/// The second drive of the first device fails in motion.
#[derive(Debug, Default)]
struct Failing {
    day: Day,
    failed: Option<u64>,
}

impl Case for Failing {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let moves = hands.last.is_some_and(|s| s.velocity[0].abs() > 20.0);
        match self.failed {
            None if moves => {
                segment.upset_axis(0, 1, InjectedFault::Fault(0x7380), hands.now_ns);
                self.failed = Some(hands.tick);
            }
            None => self.day.tick(hands, segment),
            Some(failed) => hands.wants.end = hands.tick > failed + 300,
        }
    }
}

#[test]
fn a_fault_of_one_drive_is_none_of_the_other() {
    let setup = shared(Setup::absolute(2_000_000), TWO);
    let outcome = run(&setup, &mut Failing::default());
    let faults: Vec<_> = outcome
        .events
        .iter()
        .filter(|event| matches!(event, Event::Fault(..) | Event::Gone(_) | Event::LeftOp(..)))
        .collect();
    assert_eq!(faults, [&Event::Fault(2, 0x7380)]);
    // The others come to rest on the path.
    assert!(!outcome.events.contains(&Event::NobodyStops));
    let ended = outcome.setpoints.iter().rfind(|s| s.enable != 0).unwrap();
    assert!(ended.velocity[0].abs() < 1e-9);
}
