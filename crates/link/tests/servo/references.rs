//! Tests of positions that are taken over, and not gone to.

use super::*;
use glidepath_link::servo::JumpLimits;

/// A setpoint that stands at a position, of a reference and in a state.
pub(super) fn standing(
    number: u64,
    reference: u64,
    state: MachineState,
    position: f64,
) -> Setpoint {
    let mut standing = Setpoint {
        reference,
        state: state.code(),
        ..setpoint(number)
    };
    standing.joint_position[0] = position;
    standing.joint_velocity[0] = 0.0;
    standing.joint_acceleration[0] = 0.0;
    standing
}

#[test]
fn a_new_reference_is_taken_up_at_rest_and_never_gone_to() {
    let mut bench = Bench::new();
    let numbers: Vec<u64> = (0..50).collect();
    bench.run_to(ns_of(50), &numbers);
    assert!(bench.servo.demand(bench.now_ns).is_some());
    // In the middle of a motion the power is lost: the setpoints repeat what the drives report.
    for number in 50..60 {
        bench.publish(&standing(number, 1, MachineState::Off, number as f64));
        let joints = bench.run_to(ns_of(number + 1), &[]);
        assert!(joints.is_empty(), "a drive without power has no demand");
    }
    // A setpoint that moves does not hand a position over.
    let mut moves = standing(60, 2, MachineState::Idle, 500.0);
    moves.joint_velocity[0] = 1.0;
    bench.publish(&moves);
    assert!(bench.run_to(ns_of(61), &[]).is_empty());
    for number in 61..70 {
        bench.publish(&standing(number, 2, MachineState::Idle, 100.0));
        let joints = bench.run_to(ns_of(number + 1), &[]);
        assert_eq!(joints.len(), 40, "a demand in every step");
        let stands = |(_, joint): &(u64, JointState)| *joint == state(100.0, 0.0, 0.0);
        assert!(joints.iter().all(stands), "it went there");
    }
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.references, counts.restarts, counts.stops),
        (2, 0, 0)
    );
}

#[test]
fn a_reference_that_changes_at_rest_leaves_no_moment_without_a_demand() {
    let mut bench = Bench::new();
    for number in 0..20 {
        let reference = number / 5;
        bench.publish(&standing(number, reference, MachineState::Idle, 3.0));
        let joints = bench.run_to(ns_of(number + 1), &[]);
        let expected = if number == 0 { 0 } else { 40 };
        assert_eq!(joints.len(), expected, "setpoint {number}");
    }
}

#[test]
fn a_servo_that_stopped_by_itself_begins_again_when_the_position_was_taken_over() {
    let mut bench = Bench::new();
    let numbers: Vec<u64> = (0..50).collect();
    bench.run_to(ns_of(80), &numbers);
    assert!(!bench.servo.is_armed());
    let rest = bench.servo.demand(bench.now_ns).unwrap()[0].position;
    bench.publish(&standing(80, 0, MachineState::Idle, rest + 1.0));
    let joints = bench.run_to(ns_of(81), &[]);
    let is_there = |(_, joint): &(u64, JointState)| (joint.position - rest).abs() < 1e-9;
    assert!(joints.iter().all(is_there), "not by itself");
    bench.publish(&standing(81, 1, MachineState::Idle, rest + 1.0));
    let joints = bench.run_to(ns_of(82), &[]);
    assert!(bench.servo.is_armed());
    assert!(joints.iter().all(|(_, j)| j.position == rest + 1.0));
}

#[test]
fn a_drive_that_counts_anew_at_its_home_is_no_jump() {
    let jump = JumpLimits::above(200.0, 2000.0);
    let mut bench = Bench::with(ServoSettings {
        jump: [jump; 9],
        ..ServoSettings::default()
    });
    for number in 0..20 {
        let position = if number < 10 { 3.0 } else { -250.0 };
        let mut homing = standing(number, 0, MachineState::Homing, position);
        homing.home = 1;
        bench.publish(&homing);
        let _joints = bench.run_to(ns_of(number + 1), &[]);
    }
    assert_eq!(bench.servo.counts().jumps, 0);
    // Once the drive does not lead any more, it is one.
    for number in 20..23 {
        let place = if number == 22 { 3.0 } else { -250.0 };
        bench.publish(&standing(number, 0, MachineState::Idle, place));
        let _joints = bench.run_to(ns_of(number + 1), &[]);
    }
    assert_eq!(bench.servo.counts().jumps, 1);
}
