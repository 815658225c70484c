//! Velocity and torque that are told beside targets, to drives with loops and inertia.

use crate::life::Day;
use crate::machine::{COUNTS, Outcome, Setup, run};
use crate::maps::{comes_up, refusal};
use glidepath_emulator::{Maps, OffsetAccess, PositionLoop};
use glidepath_ethercat::{FeedForward, Mapping, TorqueModel};

/// What a motion takes, in thousandths of the rated torque: for a mm/s², for a mm/s, for any.
const INERTIA: f64 = 0.25;
const VISCOUS: f64 = 0.5;
const COULOMB: f64 = 60.0;

/// What is told of that.
fn told() -> FeedForward {
    FeedForward {
        velocity_units: Some(COUNTS),
        torque: Some(TorqueModel {
            per_acceleration: INERTIA,
            per_velocity: VISCOUS,
            coulomb: COULOMB,
            coulomb_v: 0.5,
            most: 900.0,
        }),
    }
}

/// Three axes with loops, inertia and friction.
fn setup(period_ns: u64, feed_forward: Option<FeedForward>) -> Setup {
    let mut setup = Setup::absolute(period_ns);
    // Without it a joint is behind when the target has come to rest.
    setup.resting_error = 1.0;
    for drive in &mut setup.drives {
        drive.feed_forward = feed_forward;
    }
    for drive in &mut setup.emulated {
        drive.offsets = OffsetAccess::Mapped;
        drive.position_loop = Some(PositionLoop {
            position_gain: 150.0,
            velocity_gain: 1200.0,
            integral_t: 0.01,
            inertia: INERTIA / COUNTS,
            viscous: VISCOUS / COUNTS,
            coulomb: COULOMB,
        });
    }
    setup
}

/// The largest following error of a joint, mm.
fn following_error(outcome: &Outcome, joint: usize) -> f64 {
    let records = outcome.records[joint].iter();
    let errors = records
        .filter(|record| record.follows)
        .map(|record| (f64::from(record.target) - f64::from(record.actual)).abs());
    errors.fold(0.0, f64::max) / COUNTS
}

#[test]
fn following_errors_are_a_tenth_with_what_the_motion_takes() {
    for period_ns in [1_000_000, 2_000_000, 4_000_000] {
        let with = |feed_forward| run(&setup(period_ns, feed_forward), &mut Day::default());
        let (without, with) = (with(None), with(Some(told())));
        for joint in 0..3 {
            let [before, after] = [&without, &with].map(|day| following_error(day, joint));
            eprintln!("{period_ns} ns, J{joint}: {before:.4} mm without, {after:.4} mm with");
            assert!(before > 0.05, "J{joint} follows without error: {before} mm");
            assert!(10.0 * after <= before, "J{joint}: {after} of {before} mm");
        }
        assert_eq!(with.allocations, 0, "the bus thread allocates");
        // The targets are those that they were.
        let targets = |day: &Outcome| -> Vec<i32> {
            let moving = day.records[0].iter().filter(|record| record.follows);
            moving.map(|record| record.target).collect()
        };
        assert_eq!(targets(&without), targets(&with));
    }
}

#[test]
fn offsets_are_the_derivatives_of_the_targets() {
    let setup = setup(1_000_000, Some(told()));
    let outcome = run(&setup, &mut Day::default());
    for (joint, records) in outcome.records.iter().enumerate() {
        let mut fastest = 0;
        for around in records.windows(3) {
            let [before, now, after] = [around[0], around[1], around[2]];
            if !(before.follows && now.follows && after.follows) {
                continue;
            }
            let t = 1e-3;
            let [before_mm, now_mm, after_mm] =
                [before, now, after].map(|record| f64::from(record.target) / COUNTS);
            let (v, a) = (
                (after_mm - before_mm) / (2.0 * t),
                (after_mm - 2.0 * now_mm + before_mm) / (t * t),
            );
            // Central differences are off by what the jerk makes of them, j·t²/6 and its change.
            let (velocity, torque) = now.offsets;
            let off_v = f64::from(velocity) / COUNTS - v;
            assert!(off_v.abs() < 0.02, "J{joint}: {off_v} mm/s off at {v}");
            let friction = VISCOUS * v + COULOMB * (v / 0.5).tanh();
            let off_a = (f64::from(torque) - friction) / INERTIA - a;
            // Half a unit of torque is 2 mm/s²; a step of jerk 40 in a millisecond.
            assert!(off_a.abs() < 50.0, "J{joint}: {off_a} mm/s² off at {a}");
            fastest = fastest.max(velocity.abs());
        }
        assert!(f64::from(fastest) / COUNTS > 20.0, "J{joint} moves");
        // Nothing is told to what stands, or has no power.
        let resting = records.iter().filter(|record| !record.follows);
        assert!(resting.clone().count() > 10);
        assert!(
            resting
                .map(|record| record.offsets)
                .all(|told| told == (0, 0))
        );
        let last = records.iter().rfind(|record| record.follows).unwrap();
        assert_eq!(last.offsets, (0, 0), "J{joint} stands at the end");
    }
}

#[test]
fn an_axis_that_counts_the_other_way_is_told_so() {
    // J1 is inverted; all three have the same error above, which no wrong sign would give.
    let setup = setup(2_000_000, Some(told()));
    assert!(setup.drives[1].is_inverted && !setup.drives[0].is_inverted);
    let outcome = run(&setup, &mut Day::default());
    for (joint, records) in outcome.records.iter().enumerate() {
        let agree = records
            .windows(2)
            .filter(|pair| pair[0].follows && pair[1].follows);
        let signs = agree.map(|pair| {
            let step = f64::from(pair[1].target) - f64::from(pair[0].target);
            step * f64::from(pair[1].offsets.0)
        });
        assert!(signs.sum::<f64>() > 0.0, "J{joint}");
    }
}

#[test]
fn a_drive_without_the_objects_is_refused_by_their_names() {
    let mut setup = setup(2_000_000, Some(told()));
    setup.emulated[1].offsets = OffsetAccess::None;
    let refused = refusal(&setup);
    assert!(
        refused.contains("device 1") && refused.contains("does not have 0x60B1 (velocity offset)"),
        "{refused}"
    );
    let torque_alone = FeedForward {
        velocity_units: None,
        ..told()
    };
    setup.drives[1].feed_forward = Some(torque_alone);
    let refused = refusal(&setup);
    assert!(
        refused.contains("does not have 0x60B2 (torque offset)"),
        "{refused}"
    );
    // Nobody asks for them.
    setup.drives[1].feed_forward = None;
    comes_up(&setup);
}

#[test]
fn a_drive_that_does_not_let_them_be_mapped_is_refused_by_their_names() {
    let mut setup = setup(2_000_000, Some(told()));
    setup.emulated[2].offsets = OffsetAccess::Unmapped;
    let refused = refusal(&setup);
    assert!(
        refused
            .contains("does not let 0x60B1 (velocity offset) and 0x60B2 (torque offset) be mapped"),
        "{refused}"
    );
}

#[test]
fn maps_that_are_kept_have_to_have_them() {
    let mut setup = setup(2_000_000, Some(told()));
    setup.drives[0].mapping = Mapping::Kept;
    let inputs = vec![0x6041_0010, 0x6064_0020, 0x6061_0008, 0x603f_0010];
    let mut outputs = vec![0x6040_0010, 0x607a_0020, 0x60b1_0020];
    setup.emulated[0].maps = Maps::Fixed {
        outputs: outputs.clone(),
        inputs: inputs.clone(),
    };
    let refused = refusal(&setup);
    assert!(
        refused.contains("lacks 0x60B2 (torque offset)"),
        "{refused}"
    );
    outputs.push(0x60b2_0010);
    setup.emulated[0].maps = Maps::Fixed { outputs, inputs };
    comes_up(&setup);
}

#[test]
fn short_maps_have_room_for_them() {
    let mut setup = setup(2_000_000, Some(told()));
    for drive in &mut setup.emulated {
        drive.maps = Maps::Short;
    }
    comes_up(&setup);
}
