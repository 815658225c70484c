//! Tests of jogging: keys that stay pressed, and axes that are not at home.

use super::bench::{Bench, numbers};
use super::client::{Machine, settings};
use crate::shared::config::SoftLimits;
use glidepath_geometry::AxisVector;
use glidepath_link::{Command, MachineState};
use glidepath_plant::{InjectedFault, JointSettings};

#[test]
fn a_key_that_stays_pressed_moves_nothing_after_an_emergency_stop() {
    for seed in 0..12 {
        let mut machine = Machine::new();
        machine.bench.enable(MachineState::NotHomed);
        machine.home();
        machine.jog([30.0, -20.0, 10.0], numbers(seed).whole(2, 80) as usize);
        machine.bench.inject(InjectedFault::EmergencyStop(true));
        let pressed = Some([30.0, 0.0, 0.0]);
        machine.run(30, pressed);
        let rest = machine.bench.joints();
        machine.bench.inject(InjectedFault::EmergencyStop(false));
        machine.run(40, pressed);
        machine.bench.command(Command::Reset).unwrap();
        machine.run(10, pressed);
        machine.bench.command(Command::Enable).unwrap();
        machine.run(120, pressed);
        assert_eq!(machine.bench.state(), MachineState::Idle);
        assert_eq!(machine.bench.joints(), rest, "{seed}");
        // Let go and pressed again, it moves.
        machine.let_go();
        machine.bench.run(2);
        machine.jog([30.0, 0.0, 0.0], 20);
        assert_eq!(machine.bench.state(), MachineState::Jogging);
    }
}

/// Presses a key for so many ticks, and waits until the machine rests.
fn jog(machine: &mut Machine, velocity: [f64; 3], ticks: usize) {
    machine.jog(velocity, ticks);
    machine.let_go();
    assert!(machine.bench.run_to(MachineState::NotHomed, 200));
}

#[test]
fn an_axis_that_is_not_home_is_slow_and_the_others_keep_their_travel() {
    let mut settings = settings();
    settings.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-5.0),
        highest: AxisVector::repeat(5.0),
    };
    // The second joint stands outside of its travel, by 3 mm.
    let outside = JointSettings {
        start: 8.0,
        count: 8.0,
        ..JointSettings::default()
    };
    let others = JointSettings::default();
    let mut machine = Machine::with(settings, &[others, outside, others]);
    machine.bench.enable(MachineState::NotHomed);
    jog(&mut machine, [100.0, 0.0, 0.0], 400);
    let fastest = |bench: &Bench, joint: usize| {
        let speeds = bench
            .setpoints
            .iter()
            .map(|s| s.joint_velocity[joint].abs());
        speeds.fold(0.0, f64::max)
    };
    // A tenth of the axis' speed, and the length of travel from where it began.
    assert!((fastest(&machine.bench, 0) - 20.0).abs() < 1e-9);
    assert!((machine.bench.last().position[0] - 10.0).abs() < 1e-9);
    // Those at home: outwards not at all, inwards to the other end.
    jog(&mut machine, [0.0, 50.0, 0.0], 100);
    let at = machine.bench.last().position;
    assert!((at[1] - 8.0).abs() < 1e-9, "{at:?}");
    // Together along a line up to where the first of them is at its end; the other goes on.
    let before = machine.bench.setpoints.len();
    jog(&mut machine, [0.0, -50.0, 25.0], 350);
    let is_on_line = |at: &[f64; 9]| (at[1] - 8.0 + 2.0 * at[2]).abs() < 1e-9;
    let passed = machine.bench.setpoints[before..].iter().map(|s| s.position);
    let corner = passed.rev().find(is_on_line).unwrap();
    assert!((corner[1] + 2.0).abs() < 1e-9 && (corner[2] - 5.0).abs() < 1e-9);
    let at = machine.bench.last().position;
    assert!(
        (at[1] + 5.0).abs() < 1e-9 && (at[2] - 5.0).abs() < 1e-9,
        "{at:?}"
    );
    assert!(machine.bench.worst_ratio() <= 1.0 + 1e-6);
}

/// What the status says of the last error.
fn told(machine: &mut Machine) -> String {
    machine.bench.status().last_error.as_str().to_owned()
}

#[test]
fn what_ended_a_jog_is_told_of_that_jog_alone() {
    let mut machine = Machine::new();
    machine.bench.enable(MachineState::NotHomed);
    machine.home();
    machine.bench.inject(InjectedFault::DriveFault(0, 7));
    assert!(machine.bench.run_to(MachineState::Faulted, 20));
    assert_ne!(told(&mut machine), "");
    machine.bench.inject(InjectedFault::DriveFault(0, 0));
    machine.bench.run(20);
    machine.bench.command(Command::Reset).unwrap();
    machine.bench.enable(MachineState::Idle);
    for (command, why) in [
        (None, ""),
        (Some(Command::Hold), "a hold ended the jog"),
        (None, ""),
        (Some(Command::Abort), "an abort ended the jog"),
        (Some(Command::Disable), "the drives were switched off"),
    ] {
        machine.jog([30.0, 0.0, 0.0], 20);
        assert_eq!(machine.bench.state(), MachineState::Jogging, "{command:?}");
        if let Some(command) = command {
            machine.bench.command(command).unwrap();
        }
        machine.let_go();
        machine.bench.run(100);
        assert_eq!(told(&mut machine), why, "{command:?}");
    }
}
