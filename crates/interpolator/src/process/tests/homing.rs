//! Tests of joints that are brought home by the controller.

use super::bench::{Bench, config, numbers};
use crate::shared::config::homing::{IndexPulse, JointHoming};
use glidepath_link::{Command, FaultCause, MachineState};
use glidepath_plant::{INDEX_INPUT, InjectedFault, JointSettings, SwitchSettings};

/// A switch at −10 that is closed below, found at 20 mm/s, with the edge at 1 mm/s off it.
pub(super) const SWITCH: JointHoming = JointHoming {
    search_v: -20.0,
    latch_v: 1.0,
    final_v: 50.0,
    index: None,
    offset: -10.5,
    home: 0.0,
    absolute: None,
    sequence: 0,
    is_shared: false,
    is_volatile: false,
    ignores_limits: false,
    search_travel: 60.0,
    clearance: 2.0,
};

/// Where the edge is, from the middle of the machine.
const EDGE: f64 = -10.0;

/// A joint that stands somewhere, whose drive counts from anywhere.
pub(super) fn joint(start: f64) -> JointSettings {
    JointSettings {
        start,
        count: 1000.0 + start,
        switch: Some(SwitchSettings {
            cam: (EDGE - 8.0, EDGE),
            bounce_ns: 3_000_000,
        }),
        ..JointSettings::default()
    }
}

/// A machine whose first joint is homed so, and whose others are where they are.
fn homed_by(homing: JointHoming, first: JointSettings) -> Bench {
    let mut settings = config(false);
    settings.feedback.as_mut().unwrap().joints[0].homing = Some(homing);
    Bench::new(settings, &among_others(first))
}

fn among_others(first: JointSettings) -> [JointSettings; 3] {
    let others = JointSettings::default();
    [first, others, others]
}

pub(super) fn mill(homing: JointHoming, start: f64) -> Bench {
    homed_by(homing, joint(start))
}

/// Has power, and is on its way home.
pub(super) fn set_out(bench: &mut Bench, joints: u32) {
    bench.enable(MachineState::NotHomed);
    bench.command(Command::Home(joints)).unwrap();
    assert!(bench.run_to(MachineState::Homing, 3));
}

pub(super) fn arrive(bench: &mut Bench) {
    assert!(
        bench.run_to(MachineState::Idle, 8_000),
        "{:?}",
        bench.fault()
    );
}

pub(super) fn home_again(bench: &mut Bench) {
    bench.command(Command::Home(1)).unwrap();
    assert!(bench.run_to(MachineState::Homing, 3));
    arrive(bench);
}

pub(super) fn lose_power(bench: &mut Bench) {
    bench.command(Command::Disable).unwrap();
    assert!(bench.run_to(MachineState::Off, 20));
}

pub(super) fn assert_inside_limits(bench: &Bench) {
    assert!(bench.worst_ratio() <= 1.0 + 1e-6, "{}", bench.worst_ratio());
}

/// Homes, and asserts that the first joint is within so much of where its home is in truth,
/// `truth` being what its count says at the place that the offset names.
fn assert_home(bench: &mut Bench, truth: f64, within: f64) {
    set_out(bench, 1);
    arrive(bench);
    bench.run(10);
    assert_eq!(bench.status().homed, 0b111);
    assert_inside_limits(bench);
    bench.assert_no_joint_jumps();
    // The number that its position has, less the one that it should have.
    let off = bench.last().position[0] - (bench.joints()[0] - truth);
    assert!(off.abs() < within, "{off}");
}

/// The count is 1000 in the middle of the machine; the edge has the position −10.5.
const EDGE_COUNTED: f64 = 1000.0 + EDGE + 10.5;
/// Half of the way between two samples at 1 mm/s, and what the bounce may hide.
const SAMPLED: f64 = 0.0006;
const EXACT: f64 = 1e-9;

#[test]
fn the_edge_is_latched_from_either_side_wherever_the_joint_begins() {
    for latch_v in [1.0, -1.0] {
        for start in [5.0, EDGE - 3.0] {
            let mut bench = mill(JointHoming { latch_v, ..SWITCH }, start);
            assert_home(&mut bench, EDGE_COUNTED, SAMPLED);
            assert!((bench.last().position[0] - SWITCH.home).abs() < 1e-9);
        }
    }
}

#[test]
fn late_feedback_changes_nothing_of_where_the_edge_is() {
    let mut bench = mill(SWITCH, 5.0);
    let plant = glidepath_plant::Plant::new(5, &among_others(joint(5.0)));
    bench.plant = plant.with_latency(5_000_000);
    assert_home(&mut bench, EDGE_COUNTED, SAMPLED);
}

#[test]
fn the_index_pulse_after_the_switch() {
    let mut first = joint(5.0);
    first.index = Some((4.0, -7.3));
    let homing = JointHoming {
        index: Some(IndexPulse::Input(INDEX_INPUT)),
        latch_v: 2.0,
        offset: 3.0,
        home: 8.0,
        ..SWITCH
    };
    let mut bench = homed_by(homing, first);
    // The first pulse off the switch is at −7.3, and is latched by the drive: exact.
    assert_home(&mut bench, 1000.0 - 7.3 - 3.0, EXACT);
}

#[test]
fn the_index_pulse_alone() {
    let mut first = joint(5.0);
    first.index = Some((4.0, 0.7));
    let homing = JointHoming {
        search_v: 0.0,
        latch_v: -3.0,
        index: Some(IndexPulse::Input(INDEX_INPUT)),
        offset: 0.0,
        ..SWITCH
    };
    let mut bench = homed_by(homing, first);
    // From 5.0 downwards the first pulse is at 4.7.
    assert_home(&mut bench, 1000.0 + 4.7, EXACT);
}

#[test]
fn the_index_pulse_that_a_drive_keeps_when_it_is_asked() {
    for search_v in [0.0, -20.0] {
        let mut first = joint(5.0);
        first.index = Some((4.0, 0.7));
        let homing = JointHoming {
            search_v,
            latch_v: 3.0,
            index: Some(IndexPulse::Drive),
            offset: 0.0,
            ..SWITCH
        };
        let mut bench = homed_by(homing, first);
        // From 5.0 upwards the first pulse is at 8.7; from the switch, whose edge is at −10, at −7.3.
        let truth = if search_v == 0.0 { 8.7 } else { -7.3 };
        assert_home(&mut bench, 1000.0 + truth, EXACT);
        assert_eq!(bench.last().index, 0, "it is asked no more");
    }
}

#[test]
fn a_drive_that_is_not_ready_for_the_index_pulse_does_not_set_out() {
    let homing = JointHoming {
        search_v: 0.0,
        latch_v: 3.0,
        index: Some(IndexPulse::Drive),
        ..SWITCH
    };
    let mut bench = homed_by(homing, joint(5.0));
    let stood = fail(
        &mut bench,
        "was not ready to keep the index pulse within 5 s",
    );
    assert!((stood - 5.0).abs() < 1e-9, "{stood}");
}

#[test]
fn without_a_search_the_place_is_believed() {
    let homing = JointHoming {
        search_v: 0.0,
        latch_v: 0.0,
        offset: 7.0,
        home: 9.0,
        ..SWITCH
    };
    let mut bench = mill(homing, 5.0);
    assert_home(&mut bench, 1005.0 - 7.0, EXACT);
    assert!((bench.joints()[0] - 1007.0).abs() < 1e-9);
}

#[test]
fn an_absolute_encoder_is_believed_and_moves_only_if_asked_to() {
    for moves in [false, true] {
        let homing = JointHoming {
            absolute: Some(moves),
            offset: -990.0,
            home: 12.0,
            ..SWITCH
        };
        let mut bench = mill(homing, 5.0);
        assert_home(&mut bench, 990.0, EXACT);
        let stands = if moves { 1002.0 } else { 1005.0 };
        assert!((bench.joints()[0] - stands).abs() < 1e-9);
    }
}

/// Homes into a failure; returns where the joint came to rest from the middle of the machine.
fn fail(bench: &mut Bench, why: &str) -> f64 {
    set_out(bench, 1);
    assert!(bench.run_to(MachineState::Faulted, 4_000));
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::Homing)));
    assert_eq!(status.fault_joint(), Some(0));
    assert!(
        status.last_error.as_str().contains(why),
        "{}",
        status.last_error.as_str()
    );
    assert_eq!(status.homed, 0b110);
    assert_inside_limits(bench);
    let rest = bench.joints();
    bench.run(50);
    assert_eq!(bench.joints(), rest);
    // And it can be tried again.
    bench.command(Command::Reset).unwrap();
    bench.run(5);
    assert_eq!(bench.state(), MachineState::NotHomed);
    rest[0] - 1000.0
}

#[test]
fn a_dead_switch_ends_the_search_at_its_bound() {
    let mut bench = mill(SWITCH, 5.0);
    bench.inject(InjectedFault::Contact(0, Some(false)));
    let rest = fail(&mut bench, "did not close");
    assert!((rest - (5.0 - 60.0)).abs() < 1e-6, "{rest}");
}

#[test]
fn a_stuck_switch_ends_the_way_off_it_at_its_bound() {
    let mut bench = mill(SWITCH, 5.0);
    // Taken to stand on it, so it backs off.
    bench.inject(InjectedFault::Contact(0, Some(true)));
    let rest = fail(&mut bench, "did not open");
    assert!((rest - (5.0 + 60.0)).abs() < 1e-6, "{rest}");
    // Stuck once it has closed: twice the clearance off it is the bound.
    let mut bench = mill(SWITCH, 5.0);
    set_out(&mut bench, 1);
    assert!((0..1_000).any(|_| {
        bench.tick();
        bench.joints()[0] - 1000.0 < EDGE
    }));
    bench.inject(InjectedFault::Contact(0, Some(true)));
    assert!(bench.run_to(MachineState::Faulted, 4_000));
    let rest = bench.joints()[0] - 1000.0;
    assert!(rest > EDGE - 2.0 && rest < EDGE + 4.0, "{rest}");
    assert_inside_limits(&bench);
}

#[test]
fn a_cam_that_is_shorter_than_the_way_past_it_is_told() {
    let mut first = joint(5.0);
    first.switch = Some(SwitchSettings {
        cam: (EDGE - 0.2, EDGE),
        bounce_ns: 0,
    });
    fail(&mut homed_by(SWITCH, first), "opened again");
}

#[test]
fn a_shared_switch_that_is_closed_is_not_searched() {
    let homing = JointHoming {
        is_shared: true,
        ..SWITCH
    };
    let mut bench = mill(homing, EDGE - 3.0);
    let rest = fail(&mut bench, "shared");
    assert!((rest - (EDGE - 3.0)).abs() < 1e-9, "it did not move");
}

#[test]
fn a_search_goes_no_further_past_the_edge_than_it_says() {
    let bounds = config(false).joint_bounds()[0];
    for seed in 0..12 {
        let mut numbers = numbers(seed);
        let search_v = -(5.0 + 5.0 * f64::from(numbers.whole(0, 9) as u32));
        let homing = JointHoming {
            search_v,
            clearance: 8.0,
            ..SWITCH
        };
        let allowed = homing.overshoot(&bounds, 0.004);
        let start = EDGE + 3.0 + 0.01 * f64::from(numbers.whole(0, 300) as u32);
        let mut bench = mill(homing, start);
        set_out(&mut bench, 1);
        let mut lowest = f64::INFINITY;
        for _ in 0..400 {
            bench.tick();
            lowest = lowest.min(bench.joints()[0] - 1000.0);
        }
        let past = EDGE - lowest;
        assert!(past <= allowed, "{seed}: {past} of {allowed} at {search_v}");
        assert!(past > 0.2 * allowed, "{seed}: {past} of {allowed}");
    }
}

#[test]
fn groups_go_home_in_their_order_and_a_failed_one_stops_the_others() {
    let mut settings = config(false);
    let joints = &mut settings.feedback.as_mut().unwrap().joints;
    for (joint, sequence) in joints.iter_mut().zip([2, 1, 1]) {
        joint.homing = Some(JointHoming { sequence, ..SWITCH });
    }
    let joints = [joint(5.0), joint(3.0), joint(1.0)];
    let mut bench = Bench::new(settings, &joints);
    set_out(&mut bench, 0b111);
    arrive(&mut bench);
    let first_move = |joint: usize| {
        let from = bench.setpoints[40].joint_position[joint];
        let moved = |s: &glidepath_link::Setpoint| (s.joint_position[joint] - from).abs() > 1e-6;
        bench.setpoints.iter().skip(40).position(moved).unwrap()
    };
    assert!(first_move(1).abs_diff(first_move(2)) <= 1);
    assert!(first_move(0) > first_move(1) + 100);
    assert_eq!(bench.status().homed, 0b111);
    assert_inside_limits(&bench);
    bench.assert_no_joint_jumps();

    let mut bench = Bench::new(settings, &joints);
    bench.inject(InjectedFault::Contact(2, Some(false)));
    set_out(&mut bench, 0b111);
    assert!(bench.run_to(MachineState::Faulted, 8_000));
    bench.run(100);
    assert_eq!(bench.joints()[0], 1005.0, "the later group never set out");
    assert_eq!(
        bench.status().homed,
        0,
        "nor is any of the failed group home"
    );
}

#[test]
fn homed_is_not_believed_at_the_start_nor_from_a_stack_that_was_started_again() {
    let mut bench = mill(SWITCH, 5.0);
    // The drive says that its joint is homed; that is not what is asked for.
    assert_eq!(bench.plant.measured().homed & 1, 1);
    bench.enable(MachineState::NotHomed);
    assert_eq!(bench.status().homed, 0b110);
    bench.load(3, 100);
    bench.run(100);
    assert_eq!(bench.state(), MachineState::NotHomed);
    bench.feed.clear();
    home_again(&mut bench);
    // Power goes and comes: homed, unless that is volatile.
    lose_power(&mut bench);
    bench.enable(MachineState::Idle);
    // The stack is started again, and counts from elsewhere.
    bench.plant = glidepath_plant::Plant::new(6, &among_others(joint(5.0)));
    bench.run(100);
    assert_eq!(bench.status().homed, 0b110);
}

#[test]
fn a_volatile_home_goes_with_the_power() {
    let homing = JointHoming {
        is_volatile: true,
        ..SWITCH
    };
    let mut bench = mill(homing, 5.0);
    bench.enable(MachineState::NotHomed);
    home_again(&mut bench);
    lose_power(&mut bench);
    bench.enable(MachineState::NotHomed);
}

#[test]
fn homing_ends_at_rest_when_it_is_aborted_and_nothing_jumps() {
    for after in [1, 5, 20, 77, 150, 190, 220, 260, 400] {
        let mut bench = mill(SWITCH, 5.0);
        bench.enable(MachineState::NotHomed);
        bench.command(Command::Home(1)).unwrap();
        bench.run(after);
        if bench.state() != MachineState::Homing {
            continue;
        }
        assert!(bench.command(Command::Home(1)).is_err());
        bench.command(Command::Abort).unwrap();
        assert!(bench.run_to(MachineState::NotHomed, 100));
        // The drives are a period behind.
        bench.run(3);
        let rest = bench.joints();
        bench.run(100);
        assert_eq!(bench.joints(), rest, "{after}");
        let status = bench.status();
        assert_eq!(status.fault, 0);
        assert_eq!(status.last_error.as_str(), "an abort ended the way home");
        assert!(bench.worst_ratio() <= 1.0 + 1e-6, "{after}");
        bench.assert_no_joint_jumps();
    }
}

#[test]
fn an_abort_at_once_leaves_nothing_behind_that_begins_late() {
    for after in 0..6 {
        let mut bench = mill(SWITCH, 5.0);
        bench.enable(MachineState::NotHomed);
        bench.command(Command::Home(1)).unwrap();
        bench.run(after);
        bench.command(Command::Abort).unwrap();
        bench.run(60);
        assert_eq!(bench.state(), MachineState::NotHomed, "{after}");
        home_again(&mut bench);
    }
}
