//! Limits of torque, forwards and backwards.

use crate::life::Day;
use crate::machine::{COUNTS, Outcome, Setup, run};
use crate::maps::{comes_up, refusal};
use glidepath_emulator::{Maps, PositionLoop};
use glidepath_ethercat::Mapping;

/// Torque for a mm/s², thousandths of the rated one.
const INERTIA: f64 = 0.3;

/// Three axes whose motors have an inertia alone: an acceleration is a torque.
fn setup(limits: [Option<u16>; 2]) -> Setup {
    let mut setup = Setup::absolute(1_000_000);
    (setup.resting_error, setup.drives[0].following_error) = (50.0, 50.0);
    for drive in &mut setup.drives {
        drive.following_error = 50.0;
        drive.torque_limits = limits;
    }
    for drive in &mut setup.emulated {
        drive.position_loop = Some(PositionLoop {
            position_gain: 50.0,
            velocity_gain: 500.0,
            integral_t: 0.0,
            inertia: INERTIA / COUNTS,
            viscous: 0.0,
            coulomb: 0.0,
        });
    }
    setup
}

/// The highest acceleration of a joint either way, mm/s² in the direction of the joint.
fn accelerations(setup: &Setup, outcome: &Outcome, joint: usize) -> (f64, f64) {
    let drive = &setup.drives[joint];
    let places = outcome.records[joint].windows(3).filter_map(|around| {
        let follow = around.iter().all(|record| record.follows);
        let [a, b, c] = [around[0], around[1], around[2]].map(|record| drive.place(record.actual));
        follow.then_some((c - 2.0 * b + a) / 1e-6)
    });
    places.fold((0.0, 0.0), |(most, least): (f64, f64), a| {
        (most.max(a), least.min(a))
    })
}

#[test]
fn each_direction_of_a_joint_has_its_own_limit() {
    // 300 and 150 thousandths are 1000 and 500 mm/s², of the 2000 that are planned.
    let limited = setup([Some(300), Some(150)]);
    let free = setup([None; 2]);
    let (with, without) = (
        run(&limited, &mut Day::default()),
        run(&free, &mut Day::default()),
    );
    // J1 counts the other way.
    for joint in [0, 1] {
        let (up, down) = accelerations(&limited, &with, joint);
        assert!((up - 1000.0).abs() < 20.0, "J{joint}: {up}");
        assert!((down + 500.0).abs() < 20.0, "J{joint}: {down}");
        let (up, down) = accelerations(&free, &without, joint);
        assert!(up > 1300.0 && down < -1300.0, "J{joint}: {up} {down}");
    }
}

#[test]
fn what_a_drive_is_told_counts_where_its_maps_stay() {
    // A limit that is in the maps is sent in every cycle, as it is to be and not as it was.
    let mut setup = setup([Some(300), Some(150)]);
    for (drive, emulated) in setup.drives.iter_mut().zip(&mut setup.emulated) {
        drive.mapping = Mapping::Kept;
        emulated.maps = Maps::Fixed {
            outputs: vec![
                0x6040_0010,
                0x607a_0020,
                0x60e0_0010,
                0x60e1_0010,
                0x6065_0020,
            ],
            inputs: vec![0x6041_0010, 0x6064_0020],
        };
        emulated.following_counts = 1;
    }
    let outcome = run(&setup, &mut Day::default());
    let (up, down) = accelerations(&setup, &outcome, 0);
    assert!((up - 1000.0).abs() < 20.0, "{up}");
    assert!((down + 500.0).abs() < 20.0, "{down}");
    comes_up(&setup);
}

#[test]
fn a_drive_without_the_limits_is_refused_by_the_object() {
    let mut setup = setup([Some(300), None]);
    setup.emulated[2].lacks = vec![0x60e0];
    let refused = refusal(&setup);
    assert!(
        refused.contains("device 2") && refused.contains("object 0x60e0:0 was refused"),
        "{refused}"
    );
    setup.drives[2].torque_limits = [None, Some(100)];
    comes_up(&setup);
}
