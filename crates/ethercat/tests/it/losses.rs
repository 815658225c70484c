//! What is lost is told to the interpolator, by its own cause, and what stopped by it stays so until that
//! is reset.

use crate::machine::{Case, Hands, Outcome, Setup, run};
use crate::terminals::{FIFTH, FLOOD, FORWARD, INPUTS, LAMP, LEVEL, Pins, QUARTER, pins, setup};
use glidepath_emulator::Segment;
use glidepath_ethercat::Event;
use glidepath_link::{Command, MachineState, SpindleState};

/// Without M2, which would stop spindle and coolant at its end.
const TURNING: &str = "G21 G90 G64 P0.02 F3000\nM3 S6000\nM8\nM62 P5\nG1 X1\n";
const LONG: &str = "G21 G90 G64 P0.02 F3000\nM3 S6000\nM8\nM62 P5\nG1 X50\nM2\n";
const NEXT: &str = "G21 G90 G64 P0.02 F3000\nM3 S6000\nG1 X5 Y5\n";
/// The host stands still for 60 ms.
const PAUSE: u64 = 15;

/// What was seen of the machine at one moment.
#[derive(Debug, Clone, PartialEq)]
struct Seen {
    state: Option<MachineState>,
    fault: Option<String>,
    pins: Pins,
    /// What the interpolator says of the spindle.
    spindle: Option<SpindleState>,
}

/// What is done, so many ticks after the one before.
#[derive(Debug, Clone, Copy)]
enum Do {
    Command(Command),
    Program(&'static str),
    Pause,
    /// The terminals are unplugged, or plugged in.
    Plug(bool),
    Look,
}

#[derive(Debug)]
struct Script {
    steps: Vec<(u64, Do)>,
    nth: usize,
    since: u64,
    seen: Vec<Seen>,
}

impl Script {
    /// After the drives were switched on and the machine is idle, or off where nobody switches them on.
    fn new(steps: &[(u64, Do)]) -> Self {
        Self {
            steps: steps.to_vec(),
            nth: 0,
            since: 0,
            seen: Vec::new(),
        }
    }

    fn seen(hands: &Hands<'_>, segment: &Segment) -> Seen {
        Seen {
            state: hands.state(),
            fault: hands.status.and_then(|status| status.fault_text()),
            pins: pins(segment),
            spindle: hands.auxiliary.and_then(|record| record.spindle().ok()),
        }
    }
}

impl Case for Script {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        segment.set_input(INPUTS, 2, true);
        let Some((after, what)) = self.steps.get(self.nth).copied() else {
            hands.wants.end = true;
            return;
        };
        if hands.tick < self.since + after {
            return;
        }
        (self.since, self.nth) = (hands.tick, self.nth + 1);
        match what {
            Do::Command(command) => hands.wants.command = Some(command),
            Do::Program(text) => hands.wants.program = Some(text),
            Do::Pause => hands.wants.pause = Some(PAUSE),
            Do::Plug(is_there) => {
                segment.unplug(INPUTS..LEVEL + 1, !is_there, hands.now_ns);
            }
            Do::Look => self.seen.push(Self::seen(hands, segment)),
        }
    }
}

fn machine() -> Setup {
    let mut setup = setup();
    (setup.homing, setup.probe) = (None, None);
    setup
}

fn play(steps: &[(u64, Do)]) -> (Vec<Seen>, Outcome) {
    let mut script = Script::new(steps);
    let outcome = run(&machine(), &mut script);
    (script.seen, outcome)
}

/// As long as the servos wait for setpoints.
const HEARD: &str = "the drives heard no setpoints for 12 ms";

#[test]
fn a_pause_at_rest_is_told_and_outputs_wait_for_a_reset() {
    let (seen, outcome) = play(&[
        (400, Do::Command(Command::Enable)),
        (100, Do::Program(TURNING)),
        (150, Do::Look),
        (1, Do::Pause),
        (PAUSE + 20, Do::Look),
        (200, Do::Look),
        (1, Do::Command(Command::Reset)),
        (20, Do::Look),
        (1, Do::Command(Command::Enable)),
        (100, Do::Program(NEXT)),
        (200, Do::Look),
    ]);
    let running = FORWARD | FLOOD | FIFTH;
    assert_eq!(seen[0].pins, (running, QUARTER), "{seen:#?}");
    for later in &seen[1..3] {
        assert_eq!(later.state, Some(MachineState::Faulted), "{seen:#?}");
        assert_eq!(later.fault.as_deref(), Some(HEARD));
        assert_eq!(later.pins, (LAMP, 0));
        assert_eq!(later.spindle, Some(SpindleState::Stopped));
    }
    // Outputs of programs are what was commanded again, and the spindle stands.
    assert_eq!(
        (seen[3].state, seen[3].pins),
        (Some(MachineState::Off), (FIFTH, 0))
    );
    // The machine goes on from there, with everything that it did before.
    assert_eq!(
        (seen[4].state, &seen[4].fault),
        (Some(MachineState::Idle), &None)
    );
    assert_eq!(seen[4].pins, (FORWARD | FIFTH, QUARTER));
    let is_told = |event: &&Event| matches!(event, Event::Silence(12_000_000));
    assert_eq!(outcome.events.iter().filter(is_told).count(), 1);
    assert!(Event::Silence(12_000_000).to_string().starts_with(HEARD));
}

#[test]
fn a_pause_in_motion_blames_no_joint() {
    for moment in [20, 60, 130] {
        let (seen, _) = play(&[
            (400, Do::Command(Command::Enable)),
            (100, Do::Program(LONG)),
            (moment, Do::Pause),
            (PAUSE + 120, Do::Look),
            (1, Do::Command(Command::Reset)),
            (20, Do::Command(Command::Enable)),
            (100, Do::Program(NEXT)),
            (300, Do::Look),
        ]);
        let fault = seen[0].fault.clone().unwrap_or_default();
        assert!(fault.starts_with(HEARD), "{seen:#?}");
        assert_eq!(
            (seen[0].pins, seen[0].spindle),
            ((LAMP, 0), Some(SpindleState::Stopped))
        );
        assert_eq!(
            (seen[1].state, &seen[1].fault),
            (Some(MachineState::Idle), &None)
        );
    }
}

#[test]
fn without_power_a_pause_is_told_where_outputs_were_on_and_nowhere_else() {
    let (seen, _) = play(&[
        (400, Do::Command(Command::Enable)),
        (100, Do::Program(TURNING)),
        (150, Do::Command(Command::Disable)),
        (50, Do::Look),
        (1, Do::Pause),
        (PAUSE + 20, Do::Look),
        (1, Do::Command(Command::Reset)),
        (20, Do::Look),
    ]);
    // Spindle and coolant stop with the power, and outputs of programs do not.
    assert_eq!(
        (seen[0].state, seen[0].pins),
        (Some(MachineState::Off), (FIFTH, 0))
    );
    assert_eq!(
        (seen[1].state, seen[1].pins),
        (Some(MachineState::Faulted), (LAMP, 0))
    );
    assert_eq!(seen[1].fault.as_deref(), Some(HEARD));
    assert_eq!(
        (seen[2].state, seen[2].pins),
        (Some(MachineState::Off), (FIFTH, 0))
    );
    // With power and nothing on, nothing stops by it, and the machine goes on as if nothing had been.
    let mut setup = machine();
    setup.terminals[2].outputs.pop();
    let mut script = Script::new(&[
        (400, Do::Command(Command::Enable)),
        (100, Do::Pause),
        (PAUSE + 20, Do::Look),
        (1, Do::Program(NEXT)),
        (300, Do::Look),
    ]);
    run(&setup, &mut script);
    for seen in script.seen {
        assert_eq!((seen.state, seen.fault), (Some(MachineState::Idle), None));
    }
    // A lamp that is on at rest is switched off by whoever is obeyed, and is on again without.
    let mut setup = machine();
    setup.terminals[2].outputs.pop();
    let mut script = Script::new(&[
        (400, Do::Pause),
        (PAUSE + 20, Do::Look),
        (1, Do::Command(Command::Enable)),
        (100, Do::Look),
    ]);
    run(&setup, &mut script);
    let seen = script.seen;
    assert_eq!(
        (seen[0].state, &seen[0].fault),
        (Some(MachineState::Off), &None)
    );
    assert_eq!(seen[1].state, Some(MachineState::Idle));
}

#[test]
fn a_lost_terminal_is_told_by_its_place() {
    let (seen, _) = play(&[
        (400, Do::Command(Command::Enable)),
        (100, Do::Program(TURNING)),
        (150, Do::Plug(false)),
        (100, Do::Look),
        (1, Do::Plug(true)),
        (600, Do::Look),
        (1, Do::Command(Command::Reset)),
        (20, Do::Look),
        (1, Do::Command(Command::Enable)),
        (100, Do::Look),
    ]);
    assert_eq!(
        seen[0].fault.as_deref(),
        Some("a device on the bus of the drives is lost: the one at position 4 of the line")
    );
    assert_eq!(
        (seen[1].state, seen[1].pins),
        (Some(MachineState::Faulted), (LAMP, 0))
    );
    assert_eq!(
        (seen[2].state, seen[2].pins),
        (Some(MachineState::Off), (FIFTH, 0))
    );
    assert_eq!(
        (seen[3].state, &seen[3].fault),
        (Some(MachineState::Idle), &None)
    );
}
