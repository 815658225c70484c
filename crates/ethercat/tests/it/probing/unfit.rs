//! Drives without touch probes, and those that do not let them be mapped.

use super::telling::is_of_probe;
use super::{PART_Z, TOUCH, probe, searched, setup};
use crate::machine::{COUNTS, servo};
use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, Maps, Probe, Segment};
use glidepath_ethercat::{Init, Mapping, Settings, TouchProbe};

/// Why a bus does not come up.
fn refusal(touch: TouchProbe, change: impl FnOnce(&mut crate::machine::Setup)) -> String {
    let mut setup = setup(2_000_000, Some(touch));
    change(&mut setup);
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives,
        drive_inputs: setup.drive_inputs,
        terminals: setup.terminals,
        servo: servo(),
    };
    let mut wire = MemoryWire::new(Segment::new(&setup.emulated), Quiet, 0);
    let pre_op = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    pre_op.into_safe_op(&settings).unwrap_err().to_string()
}

#[test]
fn a_drive_without_the_objects_is_refused_by_name() {
    let told = refusal(TOUCH, |setup| setup.emulated[1].touch_probe = None);
    assert!(
        told.contains("device 1") && told.contains("J1 has no touch probe"),
        "{told}"
    );
    assert!(
        told.contains("0x60b8:0") && told.contains("leave `probe` out"),
        "{told}"
    );
    let chosen = TouchProbe {
        source: Some(1),
        ..TOUCH
    };
    let told = refusal(chosen, |_| {});
    assert!(
        told.contains("device 0") && told.contains("0x60d0:1"),
        "{told}"
    );
}

#[test]
fn maps_of_eight_bytes_have_room_for_it() {
    let mut setup = setup(2_000_000, Some(TOUCH));
    setup.emulated[2].maps = Maps::Short;
    let (search, _) = searched(&setup, probe(), &["G21 G90 F1200\nG38.2 Z-5\n"]);
    let error = search.found[0].contact[2] - PART_Z;
    assert!(error.abs() <= 1.5 / COUNTS, "{error}");
}

/// Down to the part twice, with a touch of nobody's search between.
const TWICE: &[&str] = &[
    "G21 G90 F1200\nG38.2 Z-5\n",
    "G21 G90 G0 Z1\nZ-2\nZ0.5\n",
    "G21 G90 F600\nG38.2 Z-5\n",
    "G21 G90 F300\nG38.4 Z3\n",
];

#[test]
fn drives_that_do_not_let_it_be_mapped_are_asked_by_their_mailbox() {
    /// Maps that are the drive's own.
    fn keep(setup: &mut crate::machine::Setup, outputs: &[u32], inputs: &[u32]) {
        setup.drives[1].mapping = Mapping::Kept;
        setup.emulated[1].maps = Maps::Fixed {
            outputs: [&[0x6040_0010, 0x607a_0020], outputs].concat(),
            inputs: [&[0x6041_0010, 0x6064_0020], inputs].concat(),
        };
    }
    // All of them; one; one whose maps are its own, with a part of the objects in them, all, or none.
    let changes: [fn(&mut crate::machine::Setup); 6] = [
        |setup| {
            for nth in 0..3 {
                setup.emulated[nth]
                    .touch_probe
                    .as_mut()
                    .unwrap()
                    .is_mappable = false;
            }
        },
        |setup| {
            setup.emulated[2].touch_probe.as_mut().unwrap().is_mappable = false;
            setup.emulated[2].drops_repeats = true;
        },
        |setup| keep(setup, &[0x60b8_0010], &[0x60b9_0010, 0x60ba_0020]),
        |setup| keep(setup, &[], &[0x60b9_0010, 0x60ba_0020, 0x60bb_0020]),
        |setup| {
            keep(
                setup,
                &[0x60b8_0010],
                &[0x60bb_0020, 0x60ba_0020, 0x60b9_0010],
            );
        },
        |setup| keep(setup, &[], &[]),
    ];
    for (case, change) in changes.into_iter().enumerate() {
        let mut setup = setup(2_000_000, Some(TOUCH));
        change(&mut setup);
        let (search, events) = searched(&setup, probe(), TWICE);
        assert!(!events.iter().any(is_of_probe), "{case}: {events:?}");
        for nth in [0, 2, 3] {
            let error = search.found[nth].contact[2] - PART_Z;
            assert!(error.abs() <= 1.5 / COUNTS, "{case} {nth}: {error}");
        }
        // The end is told when they have answered: some tenths of a second, in ticks.
        eprintln!("case {case}: waited {:?} ticks", search.waited);
        assert!(search.waited[0] < 250, "{case}: {:?}", search.waited);
    }
}

#[test]
fn an_emergency_is_told_while_drives_are_asked() {
    let mut setup = setup(2_000_000, Some(TOUCH));
    setup.emulated[1].touch_probe.as_mut().unwrap().is_mappable = false;
    let (search, events) = super::with_emergency(&setup, probe(), TWICE);
    assert!(
        events.contains(&glidepath_ethercat::Event::Emergency(1, 0x7380)),
        "{events:?}"
    );
    let error = search.found[2].contact[2] - PART_Z;
    assert!(error.abs() <= 1.5 / COUNTS, "{error}");
}

/// J0 and J2 are of one device: objects of the second are 0x800 behind those of the first.
#[test]
fn drives_of_one_device_keep_the_place_of_each() {
    for is_mappable in [true, false] {
        let mut setup = setup(2_000_000, Some(TOUCH));
        (setup.drives[2].position, setup.drives[2].axis) = (0, 1);
        let device = &mut setup.emulated[0];
        (device.axes, device.start_counts) = (2, vec![0; 2]);
        device.touch_probe.as_mut().unwrap().is_mappable = is_mappable;
        setup.emulated[2] = Emulated::terminal("COUPLER", ClockKind::Bits64);
        let of_second = Probe {
            drive: (0, 1),
            ..probe()
        };
        let (search, events) = searched(&setup, of_second, &["G21 G90 F1200\nG38.2 X-2 Z-4\n"]);
        assert!(!events.iter().any(is_of_probe), "{events:?}");
        let [x, _, z, ..] = search.found[0].contact;
        let off = [x - PART_Z / 2.0, z - PART_Z];
        assert!(off.iter().all(|off| off.abs() <= 1.5 / COUNTS), "{off:?}");
    }
}
