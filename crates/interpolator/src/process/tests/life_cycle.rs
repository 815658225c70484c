//! Tests of a machine's life: off, hand-over, home, and back.

use super::bench::{Bench, config, is_on};
use super::homing;
use crate::shared::config::Config;
use crate::testing::hexapod;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{Kinematics as _, Mechanism};
use glidepath_link::{Command, EndOfEpoch, MachineState, Power, SWITCHED_OFF};
use glidepath_plant::{HomeSettings, InjectedFault, JointSettings};

#[test]
fn off_repeats_the_drives_and_the_hand_over_moves_nothing() {
    let mut bench = Bench::mill();
    bench.run(10);
    assert_eq!(bench.state(), MachineState::Off);
    bench.inject(InjectedFault::Pushed(0, 1.25));
    bench.run(3);
    assert_eq!(bench.last().position[..3], [13.75, -3.0, 40.0]);
    assert_eq!((bench.last().enable, bench.last().reference), (0, 1));
    bench.enable(MachineState::Idle);
    bench.run(100);
    let last = bench.last();
    assert_eq!((last.enable, last.reference), (0b111, 2));
    assert_eq!(last.joint_position[..3], [13.75, -3.0, 40.0]);
    assert_eq!(bench.joints()[..3], [13.75, -3.0, 40.0]);
    assert!(is_on(&bench.status()));
    bench.assert_no_joint_jumps();
}

#[test]
fn the_hand_over_of_a_mechanism_moves_no_joint() {
    let mechanism = hexapod();
    let stands = AxisVector::from([30.0, -20.0, 10.0, 2.0, -1.0, 3.0, 0.0, 0.0, 0.0]);
    let joints = mechanism.inverse(&stands).unwrap();
    let settings: Vec<_> = (0..6)
        .map(|joint| JointSettings {
            start: joints[joint],
            count: joints[joint],
            ..JointSettings::default()
        })
        .collect();
    let config = Config {
        mechanism,
        ..config(false)
    };
    assert!(matches!(config.mechanism, Mechanism::Hexapod(_)));
    let mut bench = Bench::new(config, &settings);
    bench.enable(MachineState::Idle);
    bench.run(50);
    assert!((AxisVector::from(bench.last().position) - stands).amax() < 1e-9);
    for joint in 0..6 {
        assert!((bench.joints()[joint] - joints[joint]).abs() < 1e-9);
    }
}

#[test]
fn without_a_program_there_is_no_way_back_and_none_forward() {
    let mut bench = Bench::mill();
    let refused = |bench: &mut Bench, state: MachineState| {
        assert_eq!(bench.state(), state);
        for command in [Command::Reverse, Command::Forward] {
            let why = bench.command(command).unwrap_err();
            assert!(
                why.contains("no program runs"),
                "{command:?}, {state:?}: {why}"
            );
        }
    };
    bench.run(10);
    refused(&mut bench, MachineState::Off);
    bench.enable(MachineState::Idle);
    refused(&mut bench, MachineState::Idle);
    bench.load(3, 300);
    bench.run(60);
    for command in [Command::Forward, Command::Reverse, Command::Forward] {
        bench.command(command).unwrap();
    }
    bench.inject(InjectedFault::EmergencyStop(true));
    bench.feed.clear();
    assert!(bench.run_to(MachineState::Faulted, 300));
    refused(&mut bench, MachineState::Faulted);
}

#[test]
fn nothing_moves_before_the_drives_are_on() {
    let mut bench = Bench::mill();
    bench.run(10);
    bench.load(1, 100);
    bench.run(200);
    assert_eq!(bench.state(), MachineState::Off);
    assert_eq!(bench.joints()[..3], [12.5, -3.0, 40.0]);
    let status = bench.status();
    assert_eq!((status.epoch, status.fault), (0, 0));
    assert!(status.frames_refused.iter().sum::<u64>() > 0);
    // What was refused then does not move the machine when it is switched on.
    bench.enable(MachineState::Idle);
    bench.run(100);
    assert_eq!(bench.joints()[..3], [12.5, -3.0, 40.0]);
}

#[test]
fn drives_find_their_home_and_only_then_a_program_runs() {
    let joint = |start: f64, switch: f64| JointSettings {
        start,
        count: 1000.0,
        home: Some(HomeSettings {
            switch,
            velocity: 20.0,
            position: switch,
        }),
        ..JointSettings::default()
    };
    let joints = [joint(3.0, -5.0), joint(-2.0, 6.0), joint(1.0, 2.0)];
    let mut bench = Bench::new(config(true), &joints);
    bench.enable(MachineState::NotHomed);
    assert_eq!(bench.status().homed, 0);
    bench.load(2, 100);
    bench.run(100);
    assert_eq!(bench.state(), MachineState::NotHomed);
    assert_eq!(bench.joints()[..3], [1000.0; 3]);
    bench.feed.clear();
    assert!(bench.command(Command::Home(0b1000)).is_err());
    bench.command(Command::Home(0b111)).unwrap();
    assert!(bench.run_to(MachineState::Homing, 3));
    assert!(bench.run_to(MachineState::Idle, 600));
    bench.run(50);
    assert_eq!(bench.last().position[..3], [-5.0, 6.0, 2.0]);
    assert_eq!(bench.joints()[..3], [-5.0, 6.0, 2.0]);
    assert_eq!(bench.status().homed, 0b111);
    bench.load(3, 200);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(bench.run_to(MachineState::Idle, 600));
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert!(bench.worst_ratio() <= 1.0 + 1e-6, "{}", bench.worst_ratio());
    bench.command(Command::Unhome(0b010)).unwrap();
    assert_eq!(bench.status().homed, 0b101);
    assert_eq!(bench.state(), MachineState::NotHomed);
}

#[test]
fn a_search_for_home_ends_when_it_is_aborted() {
    let mut joints = [JointSettings::default(); 3];
    joints[1].home = Some(HomeSettings {
        switch: 500.0,
        velocity: 10.0,
        position: 500.0,
    });
    let mut settings = config(false);
    settings.feedback.as_mut().unwrap().joints[1].homes = true;
    let mut bench = Bench::new(settings, &joints);
    bench.enable(MachineState::NotHomed);
    bench.command(Command::Home(0b010)).unwrap();
    bench.run(100);
    assert_eq!(bench.state(), MachineState::Homing);
    bench.command(Command::Abort).unwrap();
    bench.run(20);
    let rest = bench.joints()[1];
    assert!(rest > 3.0 && rest < 10.0, "{rest}");
    bench.run(100);
    assert_eq!(bench.state(), MachineState::NotHomed);
    assert_eq!(bench.joints()[1], rest);
    assert_eq!(bench.last().joint_position[1], rest);
}

/// A machine whose first joint is at home by its drive, which then does not stir and keeps its word.
fn home_with_a_stuck_drive() -> Bench {
    let mut joints = [JointSettings::default(); 3];
    joints[0].home = Some(HomeSettings {
        switch: 2.0,
        velocity: 100.0,
        position: 2.0,
    });
    let mut settings = config(false);
    settings.feedback.as_mut().unwrap().joints[0].homes = true;
    let mut bench = Bench::new(settings, &joints);
    bench.enable(MachineState::NotHomed);
    bench.command(Command::Home(1)).unwrap();
    assert!(bench.run_to(MachineState::Homing, 3) && bench.run_to(MachineState::Idle, 100));
    assert_eq!(bench.status().homed, 0b111);
    bench.inject(InjectedFault::Stuck(0, true));
    bench
}

#[test]
fn a_joint_whose_way_home_did_not_end_well_is_not_homed_whatever_its_drive_says() {
    for (unhomes, end) in [false, true].into_iter().flat_map(|unhomes| {
        let ends = [None, Some(Command::Abort), Some(Command::Disable)];
        ends.map(|end| (unhomes, end))
    }) {
        let mut bench = home_with_a_stuck_drive();
        if unhomes {
            bench.command(Command::Unhome(1)).unwrap();
            bench.run(5);
        }
        bench.command(Command::Home(1)).unwrap();
        assert!(bench.run_to(MachineState::Homing, 3));
        bench.run(20);
        match end {
            Some(command) => bench.command(command).unwrap(),
            None => assert!(bench.run_to(MachineState::Faulted, 600)),
        }
        bench.run(5);
        assert_eq!(bench.plant.measured().homed & 1, 1, "its drive says so");
        assert_eq!(bench.status().homed, 0b110, "{unhomes} {end:?}");
        if end.is_none() {
            bench.command(Command::Reset).unwrap();
        }
        if end == Some(Command::Disable) {
            assert!(bench.run_to(MachineState::Off, 20));
            bench.enable(MachineState::NotHomed);
        }
        bench.run(5);
        assert_eq!(bench.state(), MachineState::NotHomed, "{unhomes} {end:?}");
        bench.load(3, 200);
        bench.run(50);
        assert_eq!(bench.state(), MachineState::NotHomed, "no program begins");
        // The next way home can end well.
        bench.feed.clear();
        bench.inject(InjectedFault::Stuck(0, false));
        bench.run(3);
        bench.command(Command::Home(1)).unwrap();
        assert!(bench.run_to(MachineState::Idle, 200), "{unhomes} {end:?}");
        assert_eq!(bench.status().homed, 0b111);
    }
}

#[test]
fn a_joint_that_is_at_home_comes_home_again() {
    let mut bench = home_with_a_stuck_drive();
    bench.inject(InjectedFault::Stuck(0, false));
    bench.command(Command::Home(1)).unwrap();
    assert!(bench.run_to(MachineState::Homing, 3));
    assert!(bench.run_to(MachineState::Idle, 100));
    assert_eq!(bench.status().homed, 0b111);
}

#[test]
fn a_fault_without_a_program_is_of_no_line_and_a_program_that_is_switched_off_says_so() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.load_codes(3, 60, &[8, 9]);
    assert!(bench.run_to(MachineState::Running, 50) && bench.run_to(MachineState::Idle, 1000));
    bench.inject(InjectedFault::DriveFault(0, 7));
    assert!(bench.run_to(MachineState::Faulted, 20));
    let status = bench.status();
    assert_ne!(status.line, 0, "a program ran before");
    assert_eq!((status.fault_line, status.fault_sequence), (0, 0));
    bench.inject(InjectedFault::DriveFault(0, 0));
    bench.run(20);
    bench.command(Command::Reset).unwrap();
    bench.enable(MachineState::Idle);
    bench.load(3, 300);
    assert!(bench.run_to(MachineState::Running, 50));
    assert_eq!(bench.status().last_error.as_str(), "", "it is of the fault");
    bench.command(Command::Disable).unwrap();
    assert!(bench.run_to(MachineState::Off, 200));
    assert_eq!(bench.status().last_error.as_str(), SWITCHED_OFF);
}

#[test]
fn a_fault_is_what_keeps_joints_from_their_home_and_from_another_number() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.inject(InjectedFault::DriveFault(0, 7));
    assert!(bench.run_to(MachineState::Faulted, 20));
    let set = Command::SetPosition {
        joint: 1,
        position: 200.0,
    };
    for command in [Command::Home(1), Command::Unhome(1), set] {
        let why = bench.command(command).unwrap_err();
        assert!(why.contains("a fault is latched"), "{command:?}: {why}");
    }
}

#[test]
fn a_position_beyond_any_travel_is_no_position() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    for (position, is_one) in [(1e9, false), (-1_000_001.0, false), (-1e6, true)] {
        let set = Command::SetPosition { joint: 0, position };
        let refused = bench.command(set).err().unwrap_or_default();
        assert_eq!(
            refused.contains("no position of a joint"),
            !is_one,
            "{refused}"
        );
    }
}

#[test]
fn what_keeps_joints_from_their_way_home_is_told() {
    let mut bench = Bench::mill();
    let why = |bench: &mut Bench| bench.command(Command::Home(1)).unwrap_err();
    bench.run(20);
    assert!(why(&mut bench).contains("`glidepath enable`"));
    bench.enable(MachineState::Idle);
    bench.load(3, 300);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(why(&mut bench).contains("`glidepath abort` ends one"));
    bench.command(Command::Hold).unwrap();
    assert!(bench.run_to(MachineState::Held, 200));
    assert!(why(&mut bench).contains("`glidepath abort` ends one"));
    let mut bench = homing::mill(homing::SWITCH, 5.0);
    homing::set_out(&mut bench, 1);
    assert!(why(&mut bench).contains("on their way home"));
}

#[test]
fn a_position_is_set_without_moving_anything() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    let reference = bench.last().reference;
    let set = Command::SetPosition {
        joint: 1,
        position: 200.0,
    };
    bench.command(set).unwrap();
    bench.run(50);
    let last = bench.last();
    assert_eq!(last.position[..3], [12.5, 200.0, 40.0]);
    assert_eq!(last.reference, reference + 1);
    assert_eq!(bench.joints()[..3], [12.5, -3.0, 40.0]);
    assert_eq!(bench.status().joint_actual[1], 200.0);
    // A program runs in the new count, and the drive in its own.
    bench.load(4, 200);
    bench.run(60);
    assert!(bench.run_to(MachineState::Idle, 600));
    bench.run(5);
    let (last, joints) = (bench.last(), bench.joints());
    assert!((last.position[1] - joints[1] - 203.0).abs() < 1e-9);
    assert!(bench.worst_ratio() <= 1.0 + 1e-6);
    bench.assert_no_joint_jumps();
    // Not while it moves.
    bench.load(5, 200);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(bench.command(set).is_err());
}

#[test]
fn power_goes_after_the_motion_has_come_to_rest() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.load(6, 400);
    bench.run(150);
    assert_eq!(bench.state(), MachineState::Running);
    bench.command(Command::Disable).unwrap();
    assert!(bench.run_to(MachineState::Off, 100));
    let rest = bench.joints();
    bench.feed.clear();
    bench.run(50);
    assert_eq!(bench.joints(), rest, "it was at rest");
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
    assert_eq!((status.power(), status.fault), (Ok(Power::Off), 0));
    assert!(bench.worst_ratio() <= 1.0 + 1e-6);
    // On again, and a program from there.
    bench.enable(MachineState::Idle);
    bench.load(7, 200);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(bench.run_to(MachineState::Idle, 600));
}

#[test]
fn without_feedback_there_are_no_drives_to_command() {
    let settings = Config {
        feedback: None,
        ..config(false)
    };
    let mut bench = Bench::new(settings, &[JointSettings::default(); 3]);
    bench.run(10);
    assert_eq!(bench.state(), MachineState::Idle);
    for command in [Command::Enable, Command::Disable, Command::Home(1)] {
        assert!(bench.command(command).unwrap_err().contains("simulated"));
    }
    let status = bench.status();
    assert_eq!(status.power(), Ok(Power::Simulated));
    assert_eq!((status.homed, status.enabled), (0b111, 0b111));
}
