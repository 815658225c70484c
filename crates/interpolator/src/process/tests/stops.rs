//! Tests of spindle and coolant, which stop with the motion.

use super::bench::{Bench, config};
use crate::shared::config::Config;
use crate::shared::config::stops::StopSettings;
use glidepath_link::{
    Auxiliary, Command, Coolant, MachineState, Setpoint, SpindleState, Subscriber, Transport as _,
};
use glidepath_plant::{InjectedFault, JointSettings};
use glidepath_program::Event;

/// A machine in the middle of a program that has turned on spindle and coolant.
struct Cutting {
    bench: Bench,
    records: Box<dyn Subscriber<Auxiliary>>,
    since: usize,
}

impl Cutting {
    fn new(stops: StopSettings) -> Self {
        let settings = Config {
            stops,
            ..config(false)
        };
        let mut bench = Bench::new(settings, &[JointSettings::default(); 3]);
        let records = bench.link.auxiliary_source().unwrap();
        bench.enable(MachineState::Idle);
        let codes = [3, 8, 100].map(Event::MCode);
        bench.load_events(
            3,
            300,
            &[&[Event::SpindleSpeed(600.0)], &codes[..]].concat(),
        );
        let is_last = |s: Setpoint| s.event() == Ok(Some(Event::MCode(100)));
        assert!((0..2_000).any(|_| is_last(bench.tick())));
        bench.run(60);
        assert_eq!(bench.state(), MachineState::Running);
        let since = bench.setpoints.len();
        Self {
            bench,
            records,
            since,
        }
    }

    /// The events since then, and how many ticks after that each came.
    fn told(&self) -> Vec<(usize, Event)> {
        let later = self.bench.setpoints[self.since..].iter().enumerate();
        later
            .filter_map(|(tick, s)| Some((tick, s.event().unwrap()?)))
            .collect()
    }

    /// What is latched.
    fn latched(&mut self) -> (SpindleState, Coolant) {
        let mut last = Auxiliary::default();
        while let Some(record) = self.records.take().unwrap() {
            last = record;
        }
        (last.spindle().unwrap(), last.coolant())
    }

    /// Spindle and coolant were stopped, at rest, and nothing else was told.
    fn assert_stopped(&mut self) {
        let told = self.told();
        let events: Vec<Event> = told.iter().map(|(_, event)| *event).collect();
        assert_eq!(events, [Event::MCode(5), Event::MCode(9)]);
        let (tick, _) = told[0];
        let moves = |s: &Setpoint| s.velocity != [0.0; 9];
        let later = &self.bench.setpoints[self.since..];
        assert!(!later[tick..].iter().any(moves), "it moves without spindle");
        assert_eq!(self.latched(), (SpindleState::Stopped, Coolant(0)));
        // Whoever only follows the events does so, too.
        let speed = self.bench.plant.measured().spindle_v.abs();
        assert!(speed < 1e-9, "{speed}");
    }
}

#[test]
fn an_abort_and_a_fault_stop_spindle_and_coolant_when_the_motion_rests() {
    for upset in [None, Some(InjectedFault::DriveFault(1, 0x7305))] {
        let mut cutting = Cutting::new(StopSettings::default());
        match upset {
            None => cutting.bench.command(Command::Abort).unwrap(),
            Some(upset) => cutting.bench.inject(upset),
        }
        let moves = cutting.bench.setpoints[cutting.since..].len();
        assert!(moves < 3, "it takes some ticks to come to rest");
        cutting.bench.feed.clear();
        cutting.bench.run(300);
        cutting.assert_stopped();
    }
}

#[test]
fn without_power_they_stop_at_once() {
    let mut cutting = Cutting::new(StopSettings::default());
    cutting.bench.inject(InjectedFault::EmergencyStop(true));
    cutting.bench.feed.clear();
    cutting.bench.run(200);
    let (tick, _) = cutting.told()[0];
    assert!(tick < 6, "{tick} ticks after the power has gone");
    cutting.assert_stopped();
}

#[test]
fn a_hold_and_the_end_of_a_program_leave_them_on_and_an_abort_without_one_does_not() {
    let mut cutting = Cutting::new(StopSettings::default());
    cutting.bench.command(Command::Hold).unwrap();
    assert!(cutting.bench.run_to(MachineState::Held, 200));
    cutting.bench.run(20);
    cutting.bench.command(Command::Resume).unwrap();
    assert!(cutting.bench.run_to(MachineState::Idle, 2_000));
    cutting.bench.run(20);
    assert_eq!(cutting.told(), []);
    let (spindle, coolant) = cutting.latched();
    assert_eq!(
        (spindle, coolant),
        (SpindleState::Clockwise, Coolant::FLOOD)
    );
    cutting.bench.command(Command::Abort).unwrap();
    cutting.bench.run(300);
    cutting.assert_stopped();
    // Where nothing is on, an abort has been done already.
    let told = cutting.told();
    cutting.bench.command(Command::Abort).unwrap();
    cutting.bench.run(100);
    assert_eq!(cutting.told(), told);
}

#[test]
fn the_next_program_begins_behind_what_the_last_has_left_on() {
    let mut cutting = Cutting::new(StopSettings::default());
    cutting.bench.command(Command::Abort).unwrap();
    cutting.bench.feed.clear();
    let rests = |s: Setpoint| s.state() == Ok(MachineState::Idle);
    assert!((0..300).any(|_| rests(cutting.bench.tick())));
    // At once, with a spindle of its own.
    cutting.bench.load_codes(5, 50, &[4]);
    cutting.bench.run(300);
    let events: Vec<Event> = cutting.told().iter().map(|(_, event)| *event).collect();
    assert_eq!(events, [5, 9, 4].map(Event::MCode));
    assert_eq!(cutting.latched().0, SpindleState::Counterclockwise);
    assert_eq!(cutting.bench.fault(), None);
}

#[test]
fn what_the_configuration_leaves_on_stays_on() {
    let none = StopSettings {
        abort: false,
        fault: false,
        disable: false,
    };
    let mut cutting = Cutting::new(none);
    cutting.bench.inject(InjectedFault::EmergencyStop(true));
    cutting.bench.feed.clear();
    cutting.bench.run(200);
    assert_eq!(cutting.told(), []);
    assert_eq!(cutting.latched().0, SpindleState::Clockwise);
    let mut cutting = Cutting::new(none);
    cutting.bench.command(Command::Abort).unwrap();
    cutting.bench.run(200);
    assert_eq!(cutting.told(), []);
}
