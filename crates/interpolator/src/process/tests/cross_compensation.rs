//! Tests of axes that are compensated across each other, with drives that answer: hand-over, homing, set positions.

use super::bench::{Bench, config};
use super::homing::{SWITCH, joint, set_out};
use crate::shared::config::Config;
use glidepath_geometry::Axis;
use glidepath_kinematics::{
    AxisList, CrossCompensation, CrossTable, JointLimit, Kinematics as _, Mechanism, Trivial,
};
use glidepath_link::{Command, MachineState, Setpoint};
use glidepath_plant::JointSettings;

/// X leans along Y by 1 mm in a metre, and Z sags along X.
fn crossed(mut settings: Config) -> Config {
    let limits = crate::testing::mill();
    let limit = JointLimit {
        min_position: -500.0,
        max_position: 500.0,
        velocity: limits.velocity[0],
        acceleration: limits.acceleration[0],
        jerk: limits.jerk[0],
    };
    let lean = CrossTable {
        corrected: Axis::X,
        along: Axis::Y,
        points: vec![(0.0, 0.0), (1_000.0, 1.0)],
    };
    let sag = |k: i32| (25.0 * f64::from(k), 0.03 * (0.7 * f64::from(k)).cos());
    let sag = CrossTable {
        corrected: Axis::Z,
        along: Axis::X,
        points: (-20..=20).map(sag).collect(),
    };
    let axes = [Axis::X, Axis::Y, Axis::Z];
    let cross = CrossCompensation::new(&[lean, sag], &axes.map(|axis| (axis, limit))).unwrap();
    for axis in [Axis::X, Axis::Z] {
        let (left, axis) = (cross.left(axis).unwrap(), axis.index());
        settings.limits.velocity[axis] = left.velocity;
        settings.limits.acceleration[axis] = left.acceleration;
        settings.limits.jerk[axis] = left.jerk;
    }
    settings.mechanism = Mechanism::Trivial(Trivial {
        cross: Some(Box::leak(Box::new(cross))),
        ..Trivial::new(AxisList::new(&axes))
    });
    settings
}

/// Whether the joints are where the axes of a setpoint have them.
fn is_whole(mechanism: &Mechanism, setpoint: &Setpoint) -> bool {
    let joints = mechanism.inverse(&setpoint.position.into());
    let told = setpoint.joint_position;
    let joints = joints.unwrap();
    (0..3).all(|joint| (joints[joint] - told[joint]).abs() < 1e-9)
}

#[test]
fn a_hand_over_moves_nothing_and_shows_where_the_axes_are() {
    let at = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let settings = crossed(config(false));
    let mechanism = settings.mechanism;
    let mut bench = Bench::new(settings, &[at(12.5), at(-30.0), at(40.0)]);
    bench.enable(MachineState::Idle);
    assert!((bench.last().position[0] - 12.53).abs() < 1e-9);
    for round in 0..3 {
        assert!(is_whole(&mechanism, &bench.last()));
        bench.load(round, 400);
        assert!(bench.run_to(MachineState::Running, 50));
        assert!(bench.run_to(MachineState::Idle, 2_000));
        bench.run(60);
        let before = bench.last();
        assert!(is_whole(&mechanism, &before));
        bench.command(Command::Disable).unwrap();
        assert!(bench.run_to(MachineState::Off, 20));
        bench.enable(MachineState::Idle);
        let after = bench.last();
        for axis in 0..3 {
            let moved = after.joint_position[axis] - before.joint_position[axis];
            let shown = after.position[axis] - before.position[axis];
            assert!(moved.abs() < 1e-6 && shown.abs() < 1e-6, "{moved} {shown}");
        }
    }
}

#[test]
fn the_home_of_a_joint_is_the_same_place_wherever_the_other_axes_are() {
    let mut counted = Vec::new();
    for y in [0.0, -40.0, 120.0] {
        let mut settings = config(false);
        settings.feedback.as_mut().unwrap().joints[0].homing = Some(SWITCH);
        let settings = crossed(settings);
        let at_y = JointSettings {
            start: y,
            count: y,
            ..JointSettings::default()
        };
        let mut bench = Bench::new(settings, &[joint(7.0), at_y, JointSettings::default()]);
        set_out(&mut bench, 1);
        let is_home = bench.run_to(MachineState::Idle, 8_000);
        assert!(is_home, "{:?} {:?}", bench.state(), bench.fault());
        bench.run(5);
        let last = bench.last();
        counted.push(last.joint_position[0]);
        // The joint is at its home; the axis leans away from there.
        let shown = last.position[0];
        assert!(
            (shown - (SWITCH.home - 1e-3 * y)).abs() < 1e-6,
            "{shown} at Y {y}"
        );
    }
    assert!(
        counted.iter().all(|at| (at - counted[0]).abs() < 1e-9),
        "{counted:?}"
    );
}

#[test]
fn a_position_that_is_set_is_the_position() {
    let at = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let mut bench = Bench::new(crossed(config(false)), &[at(0.0), at(50.0), at(0.0)]);
    bench.sets_its_position();
}
