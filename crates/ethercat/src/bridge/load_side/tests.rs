//! Tests of the second encoder of a joint, sample by sample.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "tests; the numbers are exact in binary"
)]

use super::*;
use crate::settings::DriveSettings;
use crate::terminal::At;

fn encoder(home_offset: Option<f64>) -> JointEncoderSettings {
    JointEncoderSettings {
        joint: 0,
        at: At::Bit(0),
        counts_per_unit: 1000.0,
        is_inverted: false,
        home_offset,
        is_unsigned: false,
        used: EncoderUse::Position,
        apart: 0.25,
    }
}

fn begun(home_offset: Option<f64>) -> (LoadSide, Axis) {
    let mut load_side = LoadSide::new(encoder(home_offset), 0.0, 0.5);
    let mut axis = Axis::new(DriveSettings::of_1000_counts());
    load_side.begin(&mut axis);
    assert_eq!(load_side.sample(Some(0.0), &mut axis, 0), 0.0);
    (load_side, axis)
}

#[test]
fn an_encoder_that_freezes_while_its_motor_sags_is_not_believed() {
    for home_offset in [None, Some(0.0)] {
        let (mut load_side, mut axis) = begun(home_offset);
        for counts in (-20_000..=-125).rev().step_by(125) {
            load_side.sample(Some(0.0), &mut axis, counts);
        }
        let told = load_side.take_event();
        assert!(
            matches!(told, Some(Event::LoadSlipped(0, _, true))),
            "{told:?}"
        );
        assert_eq!(load_side.take_event(), None);
        assert!(matches!(load_side.beyond(), Some((_, true))));
        // The next life of the bus takes nothing back.
        axis = Axis::new(axis.settings);
        load_side.begin(&mut axis);
        load_side.sample(Some(0.0), &mut axis, -20_000);
        assert!(matches!(load_side.beyond(), Some((_, true))));
    }
}

#[test]
fn a_load_that_goes_with_its_motor_has_not_slipped() {
    let (mut load_side, mut axis) = begun(None);
    for counts in (0..20_000).step_by(125) {
        let place = f64::from(i32::try_from(counts).unwrap()) / 1000.0;
        assert_eq!(load_side.sample(Some(place), &mut axis, counts), place);
    }
    assert_eq!((load_side.take_event(), load_side.beyond()), (None, None));
}

#[test]
fn after_a_terminal_was_lost_its_load_may_have_gone_as_far_as_the_joint_can() {
    for (samples, is_doubted) in [(3, true), (30, false)] {
        let (mut load_side, mut axis) = begun(None);
        for _ in 0..samples {
            // Meanwhile the drive's word counts.
            assert_eq!(load_side.sample(None, &mut axis, 0), 0.0);
        }
        assert_eq!(load_side.sample(Some(8.0), &mut axis, 0), 8.0);
        let told = load_side.take_event();
        assert_eq!(told, Some(Event::LoadSlipped(0, 8.0, is_doubted)));
        assert_eq!(load_side.beyond().is_some(), is_doubted);
    }
}
