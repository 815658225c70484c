//! Tests of the check of continuity: what is no motion, where travel is judged, and from where.

use super::*;
use crate::config;

#[test]
fn what_drives_report_is_no_motion_and_what_follows_it_is() {
    let config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    let found = |change: &dyn Fn(&mut Setpoint)| {
        let mut continuity = Continuity::new(&config);
        for tick in 1..40_u32 {
            let mut setpoint = Setpoint::zeroed();
            setpoint.boot_id = 1;
            (setpoint.number, setpoint.tick) = (tick.into(), tick.into());
            setpoint.scheduled_ns = setpoint.tick * config.period_ns();
            setpoint.apply_ns = setpoint.scheduled_ns + config.period_ns();
            setpoint.state = MachineState::Idle.code();
            setpoint.position[0] = if tick < 20 { 0.0 } else { 3.0 };
            if tick < 30 {
                change(&mut setpoint);
            }
            continuity.take(&setpoint);
        }
        continuity.findings.count
    };
    assert_eq!(
        found(&|setpoint| setpoint.state = MachineState::Off.code()),
        0
    );
    assert_eq!(found(&|setpoint| setpoint.home = 1), 0);
    // A fault takes the power, and keeps its own state.
    let faulted = |setpoint: &mut Setpoint, has_power: bool| {
        setpoint.state = MachineState::Faulted.code();
        setpoint.enable = if has_power { 7 } else { 0 };
    };
    assert_eq!(found(&|setpoint| faulted(setpoint, false)), 0);
    assert!(found(&|setpoint| faulted(setpoint, true)) > 0);
    assert!(found(&|_| {}) > 0, "a step of 3 mm in a period");
}

#[test]
fn travel_is_not_judged_before_a_machine_knows_where_it_is() {
    let config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    let end = config.limits().travel.highest[0];
    let found = |homed: u32, state: MachineState| {
        let mut continuity = Continuity::new(&config);
        let mut status = Status::zeroed();
        (status.joints, status.homed) = (0b111, homed);
        continuity.know(&status);
        let mut setpoint = Setpoint::zeroed();
        // A program was executed before, whose epoch is told on.
        (setpoint.boot_id, setpoint.number, setpoint.epoch) = (1, 1, 4);
        (setpoint.state, setpoint.enable) = (state.code(), 0b111);
        setpoint.position[0] = end + 2.0;
        continuity.take(&setpoint);
        let findings = continuity.findings.listed.iter();
        findings
            .filter(|finding| finding.text.contains("beyond"))
            .count()
    };
    for state in [MachineState::Homing, MachineState::NotHomed] {
        assert_eq!(found(0b111, state), 0, "{state:?}: a status may be late");
    }
    for state in [MachineState::Stopping, MachineState::Faulted] {
        assert_eq!(found(0b101, state), 0, "{state:?}");
        assert_eq!(found(0b111, state), 1, "{state:?}");
    }
    assert_eq!(found(0b101, MachineState::Running), 1);
}

#[test]
fn an_axis_beyond_its_travel_in_a_program_is_found_and_by_hand_it_is_not() {
    let config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    let end = config.limits().travel.highest[0];
    let found_at = |x: f64, epoch: u64, state: MachineState, fraction: f64| {
        let mut continuity = Continuity::new(&config);
        let mut setpoint = Setpoint::zeroed();
        (setpoint.boot_id, setpoint.number, setpoint.epoch) = (1, 1, epoch);
        (setpoint.state, setpoint.fraction) = (state.code(), fraction);
        setpoint.position[0] = x;
        continuity.take(&setpoint);
        let texts = continuity.findings.listed.into_iter();
        texts
            .filter(|finding| finding.text.contains("beyond"))
            .count()
    };
    let found = |x, epoch, state| found_at(x, epoch, state, 0.0);
    assert_eq!(found(end, 1, MachineState::Running), 0);
    assert_eq!(found(end + 1e-5, 1, MachineState::Running), 1);
    assert_eq!(found(end + 1e-5, 1, MachineState::Jogging), 0);
    assert_eq!(found(end + 1e-5, 0, MachineState::Idle), 0);
    // Between two frames a motion may be seen beyond.
    let swing = config.limits().jerk[0] * config.period_t().powi(3) / 162.0;
    assert_eq!(found_at(end + swing, 1, MachineState::Held, 0.5), 0);
    assert_eq!(found_at(end + swing, 1, MachineState::Held, 0.0), 1);
    assert_eq!(found_at(end + 1.1 * swing, 1, MachineState::Held, 0.5), 1);
}

/// An axis that stands outside behind an abort, because an offset became part of its position: it stands there,
/// and the next program leaves it there or brings it inwards.
#[test]
fn an_axis_that_stands_outside_may_stay_and_come_inwards_but_goes_no_further_out() {
    let config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    let end = config.limits().travel.highest[0];
    let found = |places: &[(MachineState, u64, u64, f64)]| {
        let mut continuity = Continuity::new(&config);
        for (number, (state, epoch, reference, x)) in (1_u64..).zip(places) {
            let mut setpoint = Setpoint::zeroed();
            (setpoint.boot_id, setpoint.number, setpoint.tick) = (1, number, number);
            (setpoint.epoch, setpoint.reference) = (*epoch, *reference);
            (setpoint.state, setpoint.position[0]) = (state.code(), *x);
            continuity.take(&setpoint);
        }
        let texts = continuity.findings.listed.into_iter();
        texts
            .filter(|finding| finding.text.contains("beyond"))
            .count()
    };
    let (idle, running) = (MachineState::Idle, MachineState::Running);
    let ended = [(running, 4, 1, end), (idle, 4, 2, end + 3.0)];
    assert_eq!(found(&ended), 0, "the offset is part of the position");
    let next = |xs: &[f64]| {
        let moved = xs.iter().map(|x| (running, 5, 2, *x));
        found(&ended.into_iter().chain(moved).collect::<Vec<_>>())
    };
    assert_eq!(next(&[end + 3.0, end + 3.0, end + 2.0, end - 1.0]), 0);
    assert_eq!(next(&[end + 3.0, end + 3.001]), 1);
    // What came inwards has its travel again in the next epoch.
    let inside = [(idle, 5, 2, end - 1.0), (running, 6, 2, end + 0.001)];
    assert_eq!(found(&[&ended[..], &inside[..]].concat()), 1);
    assert_eq!(found(&[(running, 4, 1, end), (idle, 4, 1, end + 3.0)]), 1);
}
