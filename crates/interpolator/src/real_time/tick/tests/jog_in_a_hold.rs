//! Tests of jogs away from a held path, and back to it.

use super::jog::{Hand, settle};
use super::*;
use glidepath_link::JogMode;

/// Runs a plan, with what happens to it at a tick while it is held.
fn with_hold(seed: u64, held: impl Fn(&mut Rig)) -> (Rig, usize) {
    let mut rig = rig(seed, 3, 400).0;
    rig.run(80);
    rig.command(Command::Hold);
    assert!(rig.run_until(200, |s| s.state() == Ok(MachineState::Held)));
    rig.run(5);
    held(&mut rig);
    rig.command(Command::Resume);
    let resumed = rig.setpoints.len();
    assert!(rig.run_until(3_000, is_idle));
    (rig, resumed)
}

#[test]
fn after_a_jog_in_a_hold_and_a_return_the_path_is_the_same_to_the_bit() {
    for seed in 1..6 {
        let (without, from) = with_hold(seed, |_| {});
        let (with, to) = with_hold(seed, |rig| {
            let path = AxisVector::from(rig.setpoints.last().unwrap().position);
            let mut hand = Hand::new(1);
            hand.hold(rig, 30 + seed as usize, [-30.0, 7.0, 50.0]);
            hand.hold(rig, 20, [10.0, 0.0, 0.0]);
            hand.ask(rig, JogMode::None, [0.0; 3]);
            settle(rig, MachineState::Held);
            let now = rig.setpoints.last().unwrap();
            let away = AxisVector::from(now.position) - path;
            assert_eq!(AxisVector::from(now.away), away);
            assert!(away.amax() > 1.0);
            // The path begins where the axes are not.
            rig.command(Command::Resume);
            rig.run(20);
            assert_eq!(rig.state(), MachineState::Held);
            rig.command(Command::Return);
            let begins = rig.setpoints.len();
            settle(rig, MachineState::Held);
            // The tool axis goes last: Z does not move before the others are there.
            let z_moves = |s: &Setpoint| s.position[2] != now_z(rig, begins - 1);
            let first = rig.setpoints[begins..].iter().find(|s| z_moves(s)).unwrap();
            assert_eq!(first.position[..2], path.as_slice()[..2]);
            assert_eq!(rig.setpoints.last().unwrap().away, [0.0; 9]);
            assert!(!rig.last.unwrap().is_away);
        });
        assert!(with.worst_ratio() <= INSIDE);
        let positions = |rig: &Rig, from: usize| -> Vec<[u64; 9]> {
            let after = rig.setpoints[from..].iter();
            after.map(|s| s.position.map(f64::to_bits)).collect()
        };
        assert_eq!(positions(&without, from), positions(&with, to));
    }
}

fn now_z(rig: &Rig, number: usize) -> f64 {
    rig.setpoints[number].position[2]
}

/// Where in the program the motion is held does not depend on where the axes are: between two frames in general.
#[test]
fn a_jog_in_a_hold_leaves_the_place_in_the_program() {
    let place = |s: &Setpoint| (s.path_s.to_bits(), s.line, s.block, s.sequence);
    for backwards in [false, true] {
        let mut between = 0;
        for seed in 1..6 {
            let mut rig = rig(seed, 3, 400).0;
            rig.run(80);
            if backwards {
                rig.command(Command::Reverse);
                rig.run(60);
            }
            rig.command(Command::Hold);
            settle(&mut rig, MachineState::Held);
            rig.run(2);
            let held = *rig.setpoints.last().unwrap();
            between += u32::from(held.fraction > 0.0);
            let begins = rig.setpoints.len();
            let mut hand = Hand::new(1);
            hand.hold(&mut rig, 30, [-30.0, 7.0, 50.0]);
            hand.ask(&mut rig, JogMode::None, [0.0; 3]);
            settle(&mut rig, MachineState::Held);
            assert_ne!(rig.setpoints.last().unwrap().away, [0.0; 9]);
            rig.command(Command::Return);
            settle(&mut rig, MachineState::Held);
            for setpoint in &rig.setpoints[begins..] {
                assert_eq!(place(setpoint), place(&held), "seed {seed}, {backwards}");
            }
        }
        assert!(between > 0, "held at frames only");
    }
}

#[test]
fn an_abort_ends_the_epoch_where_a_jog_has_led() {
    for moving in [false, true] {
        let mut rig = rig(3, 3, 400).0;
        rig.run(80);
        rig.command(Command::Hold);
        settle(&mut rig, MachineState::Held);
        let mut hand = Hand::new(1);
        hand.hold(&mut rig, 30, [0.0, 0.0, 40.0]);
        if !moving {
            hand.ask(&mut rig, JogMode::None, [0.0; 3]);
            settle(&mut rig, MachineState::Held);
        }
        rig.command(Command::Abort);
        rig.feed.clear();
        settle(&mut rig, MachineState::Idle);
        let report = rig.last.unwrap();
        assert_eq!(report.end_of_epoch, EndOfEpoch::Aborted);
        assert_eq!(report.setpoint.away, [0.0; 9]);
        assert!(!report.is_away);
        // The key is still down, and means nothing.
        let end = report.setpoint.position;
        hand.again(&mut rig);
        rig.run(10);
        assert_eq!(rig.setpoints.last().unwrap().position, end);
        assert!(rig.worst_ratio() <= INSIDE);
    }
}

#[test]
fn a_hold_by_the_override_is_one_after_a_jog_whatever_the_override_becomes() {
    let mut rig = rig(3, 3, 400).0;
    rig.run(80);
    rig.command(Command::FeedOverride(0.0));
    settle(&mut rig, MachineState::Held);
    let mut hand = Hand::new(1);
    hand.ask(&mut rig, JogMode::Incremental, [0.0, 0.0, 5.0]);
    rig.run(10);
    rig.command(Command::FeedOverride(1.0));
    settle(&mut rig, MachineState::Held);
    let at = rig.setpoints.last().unwrap().sequence;
    rig.command(Command::Return);
    settle(&mut rig, MachineState::Held);
    rig.run(20);
    assert_eq!(rig.setpoints.last().unwrap().sequence, at);
    assert_eq!(rig.state(), MachineState::Held);
    rig.command(Command::Resume);
    assert!(rig.run_until(3_000, is_idle));
    assert!(rig.worst_ratio() <= INSIDE);
}
