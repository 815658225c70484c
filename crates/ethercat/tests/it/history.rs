//! What the diagnosis history of a drive has to say of its fault, read beside the cycles.

use crate::machine::{Case, Hands, Outcome, Setup, run};
use glidepath_emulator::{InjectedFault, Segment};
use glidepath_ethercat::Event;
use glidepath_link::{Command, MachineState};

const PROGRAM: &str = "G21 G90 G64 P0.02 F3000\nG1 X40\nM2\n";

/// A fault of a drive while it moves.
#[derive(Debug)]
struct Failing {
    /// The fault, and whether the device notes it.
    fault: u16,
    is_noted: bool,
    asked: u64,
    began: bool,
    failed: Option<u64>,
    runs: bool,
}

impl Failing {
    const fn new(fault: u16, is_noted: bool) -> Self {
        Self {
            fault,
            is_noted,
            asked: 0,
            began: false,
            failed: None,
            runs: false,
        }
    }
}

impl Case for Failing {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        assert!(hands.tick < 5_000, "{:?}", hands.events);
        let state = hands.state();
        // From the fault on, too: the history is asked then.
        self.runs |= state == Some(MachineState::Running);
        if let Some(failed) = self.failed {
            // Who leaves the bus may allocate again.
            self.runs = hands.tick < failed + 590;
            hands.wants.end = hands.tick > failed + 600;
            return;
        }
        let moves = hands.last.is_some_and(|s| s.velocity[0].abs() > 20.0);
        let rested = hands.tick > self.asked + 25;
        match state {
            Some(MachineState::Off) if rested => {
                hands.wants.command = Some(Command::Enable);
                self.asked = hands.tick;
            }
            Some(MachineState::Idle) if rested && !self.began => {
                hands.wants.program = Some(PROGRAM);
                self.began = true;
            }
            Some(MachineState::Running) if moves => {
                self.failed = Some(hands.tick);
                let fault = InjectedFault::Fault(self.fault);
                if self.is_noted {
                    segment.inject(1, fault, hands.now_ns);
                } else {
                    segment.upset_axis(1, 0, fault, hands.now_ns);
                }
            }
            _ => {}
        }
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

fn failed(setup: &Setup, fault: u16, is_noted: bool) -> Outcome {
    let outcome = run(setup, &mut Failing::new(fault, is_noted));
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    let counts = &outcome.counts;
    let bad = (counts.lost, counts.short, counts.stale, counts.missed);
    assert_eq!(bad, (0, 0, 0, 0));
    assert!(
        outcome.events.contains(&Event::Fault(1, fault)),
        "{:?}",
        outcome.events
    );
    outcome
}

/// What was told of histories, in words.
fn told(outcome: &Outcome) -> Vec<String> {
    let events = outcome.events.iter();
    let histories = events.filter(|e| matches!(e, Event::History(..) | Event::TerminalHistory(..)));
    histories.map(ToString::to_string).collect()
}

fn setup() -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    for drive in &mut setup.emulated {
        drive.has_history = true;
    }
    setup
}

#[test]
fn the_history_of_a_drive_is_told_behind_its_fault() {
    let outcome = failed(&setup(), 0x7305, true);
    assert_eq!(
        told(&outcome),
        [
            "J1: the drive's diagnosis history has an error, 0x7305, encoder error, text 0x4305 in its manual or \
          ESI file"
        ]
    );
    let at = |wanted: &dyn Fn(&Event) -> bool| outcome.events.iter().position(wanted);
    let fault = at(&|event| matches!(event, Event::Fault(1, _)));
    let history = at(&|event| matches!(event, Event::History(1, _)));
    assert!(fault < history, "{:?}", outcome.events);
}

#[test]
fn what_was_in_it_before_is_not_told_and_neither_is_what_is_not_there() {
    // A fault of yesterday, which a master reset.
    let setup = setup();
    let mut segment = Segment::new_at(&setup.emulated, crate::machine::START_NS - 3_000_000_000);
    segment.inject(
        1,
        InjectedFault::Fault(0x2310),
        crate::machine::START_NS - 2_000_000_000,
    );
    segment.keep_records();
    let mut case = Failing::new(0x7121, false);
    let outcome = crate::machine::run_on(&setup, &mut case, segment, crate::machine::START_NS);
    assert!(
        outcome.events.contains(&Event::Fault(1, 0x7121)),
        "{:?}",
        outcome.events
    );
    assert_eq!(told(&outcome), [""; 0]);
    // Without a history nobody is asked twice.
    let without = failed(&Setup::absolute(2_000_000), 0x7305, true);
    assert_eq!(told(&without), [""; 0]);
}
