//! Tests of axes with two joints, which are squared on their way home.

use super::bench::{ALLOWED, Bench, config};
use super::following::{step, take_the_position_over};
use super::homing::{SWITCH, arrive, assert_inside_limits, home_again, joint, lose_power, set_out};
use crate::shared::config::homing::{IndexPulse, JointHoming};
use crate::shared::config::{Config, Gantry};
use glidepath_link::{Command, FaultCause, MachineState};
use glidepath_plant::{InjectedFault, JointSettings};

/// An axis with two joints, of which the second hangs behind.
fn gantry(lean: f64) -> Bench {
    gantry_with(lean, ALLOWED.min_following_error)
}

/// The same where joints may be so far from their demands.
fn gantry_with(lean: f64, min_following_error: f64) -> Bench {
    let mut settings = Config {
        gantries: [
            Some(Gantry {
                master: 0,
                difference: 1.5,
            }),
            None,
            None,
            None,
        ],
        ..config(false)
    };
    let homing = JointHoming {
        sequence: -1,
        ..SWITCH
    };
    let joints = &mut settings.feedback.as_mut().unwrap().joints;
    joints[0].homing = Some(homing);
    joints[3].homing = Some(homing);
    for joint in joints.iter_mut() {
        joint.min_following_error = min_following_error;
    }
    let others = JointSettings::default();
    let second = JointSettings {
        count: -500.0,
        ..joint(5.0 + lean)
    };
    Bench::new(settings, &[joint(5.0), others, others, second])
}

#[test]
fn two_joints_of_an_axis_go_together_and_are_squared_on_their_way_home() {
    let lean = 0.7;
    let mut bench = gantry(lean);
    bench.enable(MachineState::NotHomed);
    // Power moves neither of them.
    bench.run(50);
    assert_eq!((bench.joints()[0], bench.joints()[3]), (1005.0, -500.0));
    home_again(&mut bench);
    bench.run(10);
    assert_eq!(bench.status().homed, 0b1111);
    // Both are at the same place of the machine now.
    let places = [bench.joints()[0] - 1000.0, bench.joints()[3] + 505.0 + lean];
    assert!((places[0] - places[1]).abs() < 0.001, "{places:?}");
    assert_inside_limits(&bench);
    // They left their switches to go home at the same tick.
    let homeward = |joint: usize| {
        let fast = |s: &glidepath_link::Setpoint| s.joint_velocity[joint] > 5.0;
        bench.setpoints.iter().rposition(fast).unwrap()
    };
    assert!(homeward(0).abs_diff(homeward(3)) <= 12);
    bench.load(8, 300);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(100);
    let s = bench.last();
    let moved = [0, 3].map(|joint| s.joint_velocity[joint]);
    assert_eq!(moved[0], moved[1]);
    assert!(bench.run_to(MachineState::Idle, 1_000));
    bench.run(20);
    let apart = [bench.joints()[0] - 1000.0, bench.joints()[3] + 505.0 + lean];
    assert!((apart[0] - apart[1]).abs() < 0.001, "{apart:?}");
}

#[test]
fn two_joints_of_an_axis_that_go_apart_are_a_fault() {
    // On the way home: the second one's switch is dead, so it goes on where the first one stops.
    let mut bench = gantry(0.0);
    bench.inject(InjectedFault::Contact(3, Some(false)));
    set_out(&mut bench, 1);
    assert!(bench.run_to(MachineState::Faulted, 4_000));
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::FollowingError)));
    assert_eq!(status.fault_joint(), Some(3));
    let apart = (bench.joints()[0] - 1005.0 - (bench.joints()[3] + 500.0)).abs();
    // What is allowed, three periods at the speed of the search, and the way to rest.
    assert!(apart > 1.5 && apart < 1.5 + 0.24 + 0.45 + 0.08, "{apart}");

    // Without power one of them gives way: nothing moves by a hand-over, and beyond what is allowed
    // both have to be squared again.
    for (push, homed) in [(0.9, 0b1111), (1.8, 0b0110)] {
        let mut bench = gantry(0.0);
        set_out(&mut bench, 1);
        arrive(&mut bench);
        lose_power(&mut bench);
        bench.inject(InjectedFault::Pushed(3, push));
        bench.run(20);
        let stands = bench.joints();
        bench.enable(if homed == 0b1111 {
            MachineState::Idle
        } else {
            MachineState::NotHomed
        });
        bench.run(50);
        assert_eq!(bench.joints(), stands);
        assert_eq!(bench.status().homed, homed);
        assert_eq!(bench.status().fault, 0);
    }
}

#[test]
fn two_joints_that_stay_apart_are_cleared_by_what_is_told_and_squared_again() {
    let mut bench = gantry_with(0.0, 50.0);
    set_out(&mut bench, 1);
    arrive(&mut bench);
    bench.run(20);
    bench.inject(InjectedFault::Stuck(3, true));
    step(&mut bench, 1, 10.0);
    assert!(bench.run_to(MachineState::Faulted, 400));
    bench.run(50);
    assert_eq!(bench.fault(), Some(FaultCause::FollowingError));
    let why = bench.command(Command::Reset).unwrap_err();
    assert!(why.contains("still too far"), "{why}");
    take_the_position_over(&mut bench);
    assert!(bench.run_to(MachineState::NotHomed, 200));
    bench.run(100);
    assert_eq!(
        (bench.state(), bench.fault()),
        (MachineState::NotHomed, None)
    );
}

#[test]
fn two_joints_of_an_axis_set_out_together_for_the_index_pulses_that_their_drives_keep() {
    let mut settings = Config {
        gantries: [
            Some(Gantry {
                master: 0,
                difference: 1.5,
            }),
            None,
            None,
            None,
        ],
        ..config(false)
    };
    let homing = JointHoming {
        sequence: -1,
        search_v: 0.0,
        latch_v: 3.0,
        index: Some(IndexPulse::Drive),
        ..SWITCH
    };
    let joints = &mut settings.feedback.as_mut().unwrap().joints;
    joints[0].homing = Some(homing);
    joints[3].homing = Some(homing);
    let others = JointSettings::default();
    // The first pulse of both is at 8.7, and the second drive is ready for it late.
    let of_gantry = |index_ready_ns| JointSettings {
        index: Some((4.0, 0.7)),
        index_ready_ns,
        ..joint(5.0)
    };
    for (first, second) in [(20_000_000, 400_000_000), (400_000_000, 20_000_000)] {
        let joints = [of_gantry(first), others, others, of_gantry(second)];
        let mut bench = Bench::new(settings, &joints);
        set_out(&mut bench, 1);
        arrive(&mut bench);
        assert_eq!(bench.status().homed, 0b1111);
        let moves = |joint: usize| {
            let moves = |s: &glidepath_link::Setpoint| s.joint_velocity[joint] != 0.0;
            bench.setpoints.iter().position(moves).unwrap()
        };
        assert_eq!(moves(0), moves(3));
        let asked = bench.setpoints.iter().position(|s| s.index == 0b1001);
        // 400 ms are 100 ticks.
        assert!(moves(0) >= asked.unwrap() + 100);
        bench.assert_no_joint_jumps();
        assert_inside_limits(&bench);
    }
}
