//! Tests of faults of the drives, at any moment.

use super::bench::{Bench, numbers};
use glidepath_link::{Command, EndOfEpoch, FaultCause, MachineState, Power};
use glidepath_plant::{InjectedFault, JointSettings};

/// A machine in the middle of a program.
fn running(seed: u64, ticks: usize) -> Bench {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.load(seed, 600);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(ticks);
    bench
}

#[test]
fn feedback_that_stays_away_stops_the_motion_and_then_takes_the_power() {
    let mut bench = running(1, 100);
    bench.inject(InjectedFault::Dropout(true));
    let since = bench.setpoints.len();
    assert!(bench.run_to(MachineState::Stopping, 10));
    let after = bench.setpoints.len() - since;
    assert!((3..=6).contains(&after), "{after} ticks");
    let off = (0..60).position(|_| bench.tick().enable == 0).unwrap() + after;
    assert!((25..=29).contains(&off), "{off} ticks");
    assert_eq!(bench.fault(), Some(FaultCause::FeedbackLost));
    // The age that was found, and the one allowed: three periods.
    let status = bench.status();
    let (age_t, allowed_t) = (status.fault_value, status.fault_limit);
    assert!((allowed_t - 0.012).abs() < 1e-9, "{allowed_t} s allowed");
    assert!((allowed_t..0.025).contains(&age_t), "{age_t} s");
    assert!(bench.worst_ratio() <= 1.0 + 1e-6);
    // Nothing is reset while nothing is heard, but then it is on again by the operator alone.
    bench.inject(InjectedFault::Dropout(false));
    bench.feed.clear();
    bench.run(200);
    assert_eq!(bench.state(), MachineState::Faulted);
    assert!(
        bench
            .command(Command::Enable)
            .unwrap_err()
            .contains("reset")
    );
    bench.command(Command::Reset).unwrap();
    bench.enable(MachineState::Idle);
}

#[test]
fn a_fault_is_not_reset_while_what_it_is_of_goes_on() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.inject(InjectedFault::Dropout(true));
    assert!(bench.run_to(MachineState::Faulted, 10));
    assert_ne!(
        bench.last().enable,
        0,
        "not for long enough to take the power"
    );
    let why = bench.command(Command::Reset).unwrap_err();
    assert!(why.contains("do not say where they are"), "{why}");
    // Nothing is left to stop, and the fault stays.
    bench.command(Command::Abort).unwrap();
    bench.run(2);
    assert_eq!(bench.state(), MachineState::Faulted);
    bench.inject(InjectedFault::Dropout(false));
    bench.run(2);
    bench.command(Command::Reset).unwrap();
    bench.run(5);
    assert_eq!((bench.state(), bench.fault()), (MachineState::Idle, None));
}

#[test]
fn after_an_emergency_stop_setpoints_never_lead_the_drives() {
    let mut bench = running(2, 120);
    bench.inject(InjectedFault::EmergencyStop(true));
    bench.run(5);
    let stands = bench.joints();
    bench.feed.clear();
    for _ in 0..100 {
        let setpoint = bench.tick();
        assert_eq!(setpoint.joint_position, stands);
        assert_eq!((setpoint.enable, setpoint.joint_velocity), (0, [0.0; 9]));
    }
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::EnableLost)));
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Faulted));
    // Released, nothing moves; and not by a reset either.
    bench.inject(InjectedFault::EmergencyStop(false));
    bench.run(50);
    bench.command(Command::Reset).unwrap();
    bench.run(50);
    assert_eq!((bench.state(), bench.joints()), (MachineState::Off, stands));
    bench.enable(MachineState::Idle);
    assert_eq!(bench.joints(), stands);
}

#[test]
fn one_drive_without_power_brings_the_others_to_rest_on_the_path() {
    let mut bench = running(3, 120);
    bench.inject(InjectedFault::PowerLost(2, true));
    assert!(bench.run_to(MachineState::Faulted, 100));
    assert!(bench.worst_ratio() <= 1.0 + 1e-6);
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::EnableLost)));
    assert_eq!(status.fault_joint(), Some(2));
    assert_eq!(status.power(), Ok(Power::Off));
    assert_eq!(bench.last().enable, 0);
}

#[test]
fn a_fault_of_a_drive_is_told_with_its_number() {
    let mut bench = running(4, 120);
    bench.inject(InjectedFault::DriveFault(1, 0x7305));
    assert!(bench.run_to(MachineState::Faulted, 100));
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::Drive)));
    assert_eq!(
        (status.fault_joint(), status.drive_fault),
        (Some(1), 0x7305)
    );
    assert_eq!(status.drive_faults, 0b010);
    bench.feed.clear();
    bench.command(Command::Reset).unwrap();
    bench.run(10);
    assert!(
        bench
            .command(Command::Enable)
            .unwrap_err()
            .contains("fault")
    );
    bench.inject(InjectedFault::DriveFault(1, 0));
    bench.enable(MachineState::Idle);
}

#[test]
fn a_limit_switch_stops_the_motion() {
    let mut joints = [JointSettings::default(); 3];
    joints[0].limits = (-2.0, 2.0);
    let mut bench = Bench::new(super::bench::config(false), &joints);
    bench.enable(MachineState::Idle);
    bench.load(5, 600);
    assert!(bench.run_to(MachineState::Faulted, 600));
    assert_eq!(bench.fault(), Some(FaultCause::LimitSwitch));
    assert!(bench.worst_ratio() <= 1.0 + 1e-6);
}

/// One random case: a fault injected at a random moment, and what must be true of it.
fn inject_at_random(seed: u64) {
    let mut numbers = numbers(seed);
    let mut bench = running(seed, numbers.whole(0, 300) as usize);
    if numbers.whole(0, 3) == 0 {
        bench.command(Command::Hold).ok();
        bench.run(numbers.whole(0, 40) as usize);
    }
    let joint = numbers.whole(0, 2) as usize;
    let (upset, undo) = match numbers.whole(0, 4) {
        0 => (
            InjectedFault::EmergencyStop(true),
            InjectedFault::EmergencyStop(false),
        ),
        1 => (
            InjectedFault::PowerLost(joint, true),
            InjectedFault::PowerLost(joint, false),
        ),
        2 => (
            InjectedFault::DriveFault(joint, 9),
            InjectedFault::DriveFault(joint, 0),
        ),
        3 => (InjectedFault::Dropout(true), InjectedFault::Dropout(false)),
        _ => (
            InjectedFault::Stuck(joint, true),
            InjectedFault::Stuck(joint, false),
        ),
    };
    bench.inject(upset);
    let is_over = |s: MachineState| matches!(s, MachineState::Faulted | MachineState::Idle);
    bench.run(numbers.whole(1, 60) as usize);
    bench.inject(undo);
    bench.run(200);
    bench.feed.clear();
    if bench.state() == MachineState::Held {
        bench.command(Command::Abort).unwrap();
    }
    assert!(
        (0..900).any(|_| is_over(bench.tick().state().unwrap())),
        "{seed} {upset:?}"
    );
    bench.run(5);
    let rest = bench.joints();
    bench.run(50);
    assert_eq!(
        bench.joints(),
        rest,
        "{seed} {upset:?}: it moves and nobody asked"
    );
    assert!(bench.worst_ratio() <= 1.0 + 1e-6, "{seed} {upset:?}");
    bench.assert_no_joint_jumps();
    // The operator goes on.
    if bench.state() == MachineState::Faulted {
        bench.command(Command::Reset).unwrap();
        bench.run(3);
    }
    if bench.state() == MachineState::Off {
        bench.enable(MachineState::Idle);
        assert_eq!(
            bench.joints(),
            rest,
            "{seed} {upset:?}: the hand-over moves"
        );
    }
    bench.load(seed + 1, 50);
    assert!(bench.run_to(MachineState::Running, 50), "{seed} {upset:?}");
    assert!(bench.run_to(MachineState::Idle, 1_500), "{seed} {upset:?}");
}

#[test]
fn whatever_goes_wrong_with_the_drives_the_machine_rests_and_can_go_on() {
    for seed in 0..60 {
        inject_at_random(seed);
    }
}

#[test]
fn every_mask_bit_in_every_state() {
    // Of each joint: no power, a fault; off, not homed, ready, running, held.
    for joint in 0..3 {
        for state in 0..4 {
            for upset in [
                InjectedFault::PowerLost(joint, true),
                InjectedFault::DriveFault(joint, 3),
            ] {
                let mut bench = Bench::mill();
                bench.run(10);
                if state > 0 {
                    bench.enable(MachineState::Idle);
                }
                if state > 1 {
                    bench.load(9, 300);
                    bench.run(80);
                }
                if state > 2 {
                    bench.command(Command::Hold).unwrap();
                    assert!(bench.run_to(MachineState::Held, 100));
                }
                bench.inject(upset);
                bench.run(120);
                let expected = if state == 0 {
                    MachineState::Off
                } else {
                    MachineState::Faulted
                };
                assert_eq!(bench.state(), expected, "{upset:?} in state {state}");
                assert_eq!(bench.last().enable, 0, "{upset:?} in state {state}");
                assert!(bench.worst_ratio() <= 1.0 + 1e-6);
            }
        }
    }
}
