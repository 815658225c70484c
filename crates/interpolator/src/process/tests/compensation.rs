//! Tests of compensated joints with drives that answer: hand-over, homing, and what is shown.

use super::bench::{Bench, config};
use super::homing::{SWITCH, joint, set_out};
use crate::shared::config::homing::JointHoming;
use crate::shared::config::{Config, Gantry};
use crate::testing::plan;
use glidepath_kinematics::{CompensationPoint, JOINTS, JointCompensation, JointLimit};
use glidepath_link::{Command, MachineState, Setpoint};
use glidepath_plant::JointSettings;
use glidepath_program::Limits;

fn screw(backlash: f64) -> &'static JointCompensation {
    let limits = crate::testing::mill();
    let drive = JointLimit {
        velocity: limits.velocity[0],
        acceleration: limits.acceleration[0],
        jerk: limits.jerk[0],
        ..JointLimit::NONE
    };
    let points: Vec<_> = (-8..=8)
        .map(|k| {
            let added = 0.02 * (0.9 * f64::from(k)).cos();
            CompensationPoint {
                position: 25.0 * f64::from(k),
                up: added,
                down: added,
            }
        })
        .collect();
    Box::leak(Box::new(
        JointCompensation::new(&points, backlash, &drive).unwrap(),
    ))
}

fn compensated(backlash: f64, mut settings: Config) -> Config {
    let made = screw(backlash);
    let left = made.left();
    settings.limits = Limits::uniform(left.velocity, left.acceleration, left.jerk);
    settings.compensation = [None; JOINTS];
    settings.compensation[..3].fill(Some(made));
    settings
}

#[test]
fn a_hand_over_moves_nothing_and_shows_where_the_axes_are() {
    let at = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let settings = compensated(0.03, config(false));
    let made = settings.compensation[0].unwrap();
    let mut bench = Bench::new(settings, &[at(12.5), at(-3.0), at(40.0)]);
    bench.enable(MachineState::Idle);
    for round in 0..3 {
        let last = bench.last();
        let status = bench.status();
        for joint in 0..3 {
            let told = made.compensated(last.position[joint], 0.0);
            let tolerance = if round == 0 { 1e-9 } else { 0.016 };
            assert!((last.joint_position[joint] - told).abs() < tolerance);
            assert!((status.joint_actual[joint] - last.position[joint]).abs() < 0.02);
        }
        bench.load(round, 400);
        assert!(bench.run_to(MachineState::Running, 50));
        assert!(bench.run_to(MachineState::Idle, 2_000));
        bench.run(60);
        let before = bench.last();
        bench.command(Command::Disable).unwrap();
        let is_off = bench.run_to(MachineState::Off, 20);
        assert!(
            is_off,
            "round {round}: {:?} {:?}",
            bench.state(),
            bench.fault()
        );
        bench.enable(MachineState::Idle);
        let after = bench.last();
        for joint in 0..3 {
            let moved = after.joint_position[joint] - before.joint_position[joint];
            assert!(moved.abs() < 1e-6, "round {round}, J{joint}: {moved}");
            // The side of its play is forgotten: half of it is the most that is shown elsewhere.
            let shown = after.position[joint] - before.position[joint];
            assert!(shown.abs() <= 0.0152, "round {round}, J{joint}: {shown}");
        }
    }
}

/// A program from a place on that stays where the switch is found from.
fn seed_near_home(round: u64, from: &Setpoint, limits: &Limits) -> u64 {
    let stays = |seed: &u64| {
        let frames = plan(*seed, 3, 40, limits, 0.004, from.position.into());
        frames
            .iter()
            .all(|frame| (-5.0..40.0).contains(&frame.position[0]))
    };
    (100 * round..).find(stays).unwrap()
}

#[test]
fn home_is_where_the_settings_say_and_the_same_again() {
    let mut settings = config(false);
    settings.feedback.as_mut().unwrap().joints[0].homing = Some(SWITCH);
    let settings = compensated(0.03, settings);
    let limits = settings.limits;
    let others = JointSettings::default();
    let mut bench = Bench::new(settings, &[joint(7.0), others, others]);
    set_out(&mut bench, 1);
    let is_home = bench.run_to(MachineState::Idle, 8_000);
    assert!(is_home, "{:?} {:?}", bench.state(), bench.fault());
    let mut offsets = Vec::new();
    for round in 0..3 {
        let last = bench.last();
        assert!(
            (last.position[0] - SWITCH.home).abs() < 1e-9,
            "{}",
            last.position[0]
        );
        offsets.push(last.joint_position[0]);
        bench.load(seed_near_home(round, &last, &limits), 40);
        assert!(bench.run_to(MachineState::Running, 50));
        assert!(bench.run_to(MachineState::Idle, 2_000));
        bench.command(Command::Home(1)).unwrap();
        assert!(bench.run_to(MachineState::Homing, 5));
        let is_home = bench.run_to(MachineState::Idle, 8_000);
        assert!(is_home, "{:?} {:?}", bench.state(), bench.fault());
    }
    let spread = offsets
        .iter()
        .copied()
        .fold(0.0_f64, |most, at| most.max((at - offsets[0]).abs()));
    // As near as the search finds the switch, whichever way the joint had gone before.
    assert!(spread < 0.02, "{offsets:?}");
}

#[test]
fn a_position_that_is_set_is_the_position() {
    let mut bench = Bench::new(
        compensated(0.03, config(false)),
        &[JointSettings::default(); 3],
    );
    bench.sets_its_position();
}

/// An axis with two joints, the second of which has another table than the first.
fn gantry() -> Bench {
    let mut settings = compensated(0.03, config(false));
    settings.gantries[0] = Some(Gantry {
        master: 0,
        difference: 1.5,
    });
    let drive = *settings.compensation[0].unwrap().drive();
    let even = [-100.0, 100.0].map(|position| CompensationPoint {
        position,
        up: 0.02,
        down: 0.02,
    });
    let even = JointCompensation::new(&even, 0.05, &drive).unwrap();
    settings.compensation[3] = Some(Box::leak(Box::new(even)));
    let homing = JointHoming {
        sequence: -1,
        ..SWITCH
    };
    let joints = &mut settings.feedback.as_mut().unwrap().joints;
    joints[0].homing = Some(homing);
    joints[3].homing = Some(homing);
    let others = JointSettings::default();
    Bench::new(settings, &[joint(5.0), others, others, joint(5.2)])
}

#[test]
fn both_joints_of_a_gantry_have_tables_and_power_moves_neither() {
    let mut bench = gantry();
    bench.enable(MachineState::NotHomed);
    let told = |bench: &Bench| [0, 3].map(|joint| bench.last().joint_position[joint]);
    let before = told(&bench);
    for _ in 0..3 {
        bench.command(Command::Disable).unwrap();
        assert!(bench.run_to(MachineState::Off, 20));
        bench.enable(MachineState::NotHomed);
        bench.run(60);
        for (after, before) in told(&bench).into_iter().zip(before) {
            assert!((after - before).abs() < 1e-6, "{after} {before}");
        }
    }
    bench.command(Command::Home(1)).unwrap();
    assert!(bench.run_to(MachineState::Homing, 5));
    let is_home = bench.run_to(MachineState::Idle, 8_000);
    assert!(is_home, "{:?} {:?}", bench.state(), bench.fault());
    let last = bench.last();
    assert!((last.position[0] - SWITCH.home).abs() < 1e-9);
}
