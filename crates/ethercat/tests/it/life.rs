//! A machine on the bus: switched on, homed, used, switched off.

use crate::judge::{audited, model_error, rounding};
use crate::machine::{COUNTS, Case, Hands, Outcome, Setup, run};
use crate::wire::Fate;
use glidepath_emulator::Segment;
use glidepath_ethercat::Event;
use glidepath_link::{Command, MachineState};

const PROGRAM: &str =
    "G21 G90 G64 P0.02 G1 X8 Y2 F9000\nX-4 Y-6\nG2 X-4 Y-6 I5 J2\nG1 X5 Y5 Z3\nM2\n";

/// Switches on, comes home, runs a program, switches off.
#[derive(Debug, Default)]
pub(crate) struct Day {
    asked: u64,
    has_run: bool,
    runs: bool,
    is_slow: bool,
}

impl Case for Day {
    fn tick(&mut self, hands: &mut Hands<'_>, _: &mut Segment) {
        let rested = hands.tick.saturating_sub(self.asked) > 25;
        let is_over = self.has_run && hands.last.is_some_and(|s| s.epoch > 0);
        let mut command = None;
        self.runs = hands.state() == Some(MachineState::Running);
        match hands.state() {
            Some(MachineState::Off) if self.has_run && rested => hands.wants.end = true,
            Some(MachineState::Off) => command = Some(Command::Enable),
            Some(MachineState::NotHomed) => command = Some(Command::Home(7)),
            Some(MachineState::Idle) if is_over => command = Some(Command::Disable),
            Some(MachineState::Idle) if !self.has_run => {
                self.has_run = true;
                self.asked = hands.tick;
                hands.wants.program = Some(PROGRAM);
            }
            _ => {}
        }
        if rested && command.is_some() {
            self.asked = hands.tick;
            hands.wants.command = command;
        }
        let seen = (
            hands.now_ns,
            hands.state(),
            hands.status,
            hands.feedback,
            hands.events,
        );
        assert!(hands.tick < 40_000, "{seen:#?}");
    }

    fn fate(&mut self, now_ns: u64) -> Fate {
        // One frame in fifty comes after the next one was sent.
        if self.is_slow && self.runs && (now_ns / 2_000_000).is_multiple_of(50) {
            Fate::Late(2_500_000)
        } else {
            Fate::Whole
        }
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

pub(crate) fn assert_clean(setup: &Setup, outcome: &Outcome) {
    let counts = &outcome.counts;
    let bad = (counts.lost, counts.short, counts.stale, counts.missed);
    assert_eq!(bad, (0, 0, 0, 0));
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    let report = audited(setup, &outcome.records);
    for (nth, worst) in [
        (1, report.max_velocity_ratio),
        (2, report.max_acceleration_ratio),
        (3, report.max_jerk_ratio),
    ] {
        let most = 1.0 + 1e-6 + rounding(setup, nth);
        let period_ms = setup.bus.period_ns / 1_000_000;
        eprintln!(
            "bus {period_ms} ms, difference {}: {:.4}, {most:.4} allowed",
            nth, worst.ratio
        );
        assert!(worst.ratio <= most, "{worst:?}");
    }
    for joint in 0..3 {
        let error = model_error(setup, outcome, joint);
        assert!(error <= 1.01 / COUNTS, "J{joint}: {error} mm off the model");
    }
    let last = outcome.records[0].last().unwrap();
    assert!(!last.follows, "without power at the end");
}

#[test]
fn a_day_with_absolute_encoders() {
    for period_ns in [1_000_000, 2_000_000, 4_000_000] {
        let setup = Setup::absolute(period_ns);
        let outcome = run(&setup, &mut Day::default());
        assert_clean(&setup, &outcome);
        let end = outcome.setpoints.last().unwrap();
        assert!((end.position[0] - 5.0).abs() < 1e-3 && (end.position[2] - 3.0).abs() < 1e-3);
        let times = |wanted: Event| outcome.events.iter().filter(|e| **e == wanted).count();
        assert_eq!((times(Event::Follows(1)), times(Event::Off(1))), (1, 1));
    }
}

#[test]
fn a_day_with_drives_that_look_for_their_home() {
    let setup = Setup::homing(2_000_000);
    let outcome = run(&setup, &mut Day::default());
    let order: Vec<_> = outcome
        .events
        .iter()
        .filter(|event| !matches!(event, Event::Follows(_) | Event::Off(_)))
        .copied()
        .collect();
    // Joint 2 comes before the others, which go together.
    assert_eq!(
        order,
        [
            Event::InOperation,
            Event::Homing(2),
            Event::Home(2),
            Event::Homing(0),
            Event::Homing(1),
            Event::Home(0),
            Event::Home(1),
        ]
    );
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    // Home is zero, whatever was counted before.
    let end = outcome.setpoints.last().unwrap();
    assert!((end.position[0] - 5.0).abs() < 1e-3, "{}", end.position[0]);
}

#[test]
fn a_drive_may_look_for_its_home_for_minutes() {
    let mut setup = Setup::homing(4_000_000);
    let slow = setup.drives[2].homing.as_mut().unwrap();
    slow.fast_v = 0.06;
    let outcome = run(&setup, &mut Day::default());
    let took_t = outcome.records[2].len() as f64 * 0.004;
    assert!(took_t > 83.0, "{took_t} s");
    assert!(outcome.events.contains(&Event::Home(2)));
    let end = outcome.setpoints.last().unwrap();
    assert!((end.position[2] - 3.0).abs() < 1e-3, "{}", end.position[2]);
}

/// Switches on and sends the joints home, and the interpolator is killed on the way of joint 2.
#[derive(Debug, Default)]
struct Orphan {
    killed: Option<u64>,
}

impl Case for Orphan {
    fn tick(&mut self, hands: &mut Hands<'_>, _: &mut Segment) {
        let is_on_its_way = hands.events.contains(&Event::Homing(2));
        match (self.killed, hands.state()) {
            (Some(killed), _) => hands.wants.end = hands.tick > killed + 100,
            (None, _) if is_on_its_way && hands.tick.is_multiple_of(100) => {
                self.killed = Some(hands.tick);
                hands.wants.interpolator = Some(false);
            }
            (None, Some(MachineState::Off)) if hands.tick.is_multiple_of(25) => {
                hands.wants.command = Some(Command::Enable);
            }
            (None, Some(MachineState::NotHomed)) if hands.tick.is_multiple_of(25) => {
                hands.wants.command = Some(Command::Home(7));
            }
            _ => {}
        }
        assert!(hands.tick < 5_000, "{:?}", hands.events);
    }
}

#[test]
fn nobody_looks_for_home_when_the_interpolator_is_gone() {
    let mut setup = Setup::homing(4_000_000);
    let slow = setup.drives[2].homing.as_mut().unwrap();
    slow.fast_v = 0.06;
    let outcome = run(&setup, &mut Orphan::default());
    assert!(!outcome.events.contains(&Event::Home(2)));
    // 100 periods were between the end of the interpolator and that of the bridge.
    let records = &outcome.records[2];
    let [looked, left, ended] = [160, 80, 1].map(|before| records[records.len() - before].actual);
    assert!(looked != left, "{looked} {left} {ended}");
    assert_eq!(left, ended);
}

#[test]
fn frames_that_come_back_late_are_passed_over() {
    let setup = Setup::absolute(2_000_000);
    let mut day = Day {
        is_slow: true,
        ..Day::default()
    };
    let outcome = run(&setup, &mut day);
    let counts = &outcome.counts;
    assert!(
        counts.lost > 5 && counts.stale == counts.lost,
        "{counts:#?}"
    );
    // They reached the drives all the same, so that the motion is what it was.
    let report = audited(&setup, &outcome.records);
    let most = 1.0 + 1e-6 + rounding(&setup, 3);
    assert!(
        report.max_jerk_ratio.ratio <= most,
        "{:?}",
        report.max_jerk_ratio
    );
}
