//! A shift of the machine with terminals: it is switched on, comes home, and does one part after the other.

use super::{EDGE, INPUTS, LEVEL, PART_Z, Pins, pins};
use crate::machine::{Case, Hands};
use glidepath_emulator::Segment;
use glidepath_link::{Command, MachineState};

pub(super) const MARKED: &str =
    "G21 G90 G64 P0.02 F6000\nM3 S6000\nM8\nM62 P5\nG1 X10\nM63 P5\nM62 P6\nG1 X0\n";
pub(super) const TOUCH: &str = "G21 G90 F300\nG38.2 Z-20\n";
pub(super) const LONG: &str = "G21 G90 G64 P0.02 F3000\nM3 S6000\nM8\nM62 P5\nG1 X50\nM2\n";

/// What happens one after the other: a program, or something else.
#[derive(Debug, Clone, Copy)]
pub(super) enum Part {
    /// A program is run to its end.
    Program(&'static str),
    /// It is aborted so many ticks after it began.
    Aborted(&'static str, u64),
    /// The terminals are unplugged so many ticks after it began.
    Unplugged(&'static str, u64),
    /// They are plugged in again.
    Plugged,
    /// The fault is reset.
    Reset,
    /// The interpolator dies so many ticks after it began.
    Orphaned(&'static str, u64),
    /// The bridge dies.
    Killed(&'static str, u64),
    /// Another interpolator is there.
    Adopted,
}

/// Switches on, comes home, and does one part after the other.
#[derive(Debug)]
pub(super) struct Shift {
    parts: Vec<Part>,
    nth: usize,
    began: Option<u64>,
    asked: u64,
    /// For how many ticks the part is over.
    over: u32,
    /// Pins after each part, and while each ran.
    pub(super) after: Vec<Pins>,
    pub(super) during: Vec<Pins>,
    pub(super) contact: Option<(u32, f64)>,
    pub(super) unplugged_ns: Option<u64>,
    runs: bool,
}

impl Shift {
    pub(super) fn new(parts: &[Part]) -> Self {
        Self {
            parts: parts.to_vec(),
            nth: 0,
            began: None,
            asked: 0,
            over: 0,
            after: Vec::new(),
            during: vec![Pins::default(); parts.len()],
            contact: None,
            unplugged_ns: None,
            runs: false,
        }
    }

    /// What stands at the inputs, by where the drives are.
    fn press(hands: &Hands<'_>, segment: &mut Segment) {
        let Some(feedback) = hands.feedback else {
            return;
        };
        segment.set_input(INPUTS, 0, feedback.position[0] <= EDGE);
        segment.set_input(INPUTS, 1, feedback.position[2] <= PART_Z);
        segment.set_input(INPUTS, 2, true);
        segment.set_input_bytes(LEVEL, 4, &(-16_384_i16).to_le_bytes());
    }

    fn is_over(&self, hands: &Hands<'_>, part: Part, since: u64) -> bool {
        let state = hands.state();
        match part {
            Part::Unplugged(..) => since > 200 && state == Some(MachineState::Faulted),
            Part::Plugged => since > 600,
            Part::Reset => since > 25 && state == Some(MachineState::Off),
            Part::Orphaned(_, ticks) | Part::Killed(_, ticks) => since > ticks + 100,
            Part::Adopted => since > 100,
            // Behind a contact nobody says how the program goes on.
            _ => since > 25 && matches!(state, Some(MachineState::Idle | MachineState::Waiting)),
        }
    }

    fn begin(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let Some(part) = self.parts.get(self.nth) else {
            hands.wants.end = true;
            return;
        };
        self.began = Some(hands.tick);
        match part {
            Part::Program(text)
            | Part::Aborted(text, _)
            | Part::Unplugged(text, _)
            | Part::Orphaned(text, _)
            | Part::Killed(text, _) => {
                hands.wants.program = Some(text);
            }
            Part::Adopted => hands.wants.interpolator = Some(true),
            Part::Reset => hands.wants.command = Some(Command::Reset),
            Part::Plugged => segment.unplug(INPUTS..LEVEL + 1, false, hands.now_ns),
        }
    }

    fn go_on(&mut self, hands: &mut Hands<'_>, segment: &mut Segment, began: u64) {
        let (part, since) = (self.parts[self.nth], hands.tick - began);
        match part {
            Part::Aborted(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                hands.wants.command = Some(Command::Abort);
            }
            Part::Unplugged(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                segment.unplug(INPUTS..LEVEL + 1, true, hands.now_ns);
                self.unplugged_ns = Some(hands.now_ns);
            }
            Part::Orphaned(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                hands.wants.interpolator = Some(false);
            }
            Part::Killed(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                hands.wants.killed = true;
                self.unplugged_ns = Some(hands.now_ns);
            }
            _ => {}
        }
        // Outputs are played later than setpoints say.
        self.over = if self.is_over(hands, part, since) {
            self.over + 1
        } else {
            0
        };
        if self.over > 5 {
            self.over = 0;
            self.after.push(pins(segment));
            self.contact = hands
                .status
                .filter(|status| status.contact_kind != 0)
                .map(|status| (status.contact_kind, status.contact[2]))
                .or(self.contact);
            (self.nth, self.began) = (self.nth + 1, None);
        }
    }
}

impl Case for Shift {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        Self::press(hands, segment);
        let rested = hands.tick.saturating_sub(self.asked) > 25;
        self.runs = hands.state() == Some(MachineState::Running);
        let command = match (hands.state(), self.began) {
            (_, Some(began)) => {
                self.go_on(hands, segment, began);
                None
            }
            (Some(MachineState::Off), None) if self.nth == 0 => Some(Command::Enable),
            (Some(MachineState::NotHomed), None) if self.nth == 0 => Some(Command::Home(1)),
            (Some(MachineState::Homing), None) | (None, None) => None,
            (Some(_), None) => {
                if rested {
                    self.begin(hands, segment);
                }
                None
            }
        };
        if rested && command.is_some() {
            self.asked = hands.tick;
            hands.wants.command = command;
        }
        let seen = (hands.state(), hands.status, hands.feedback, hands.events);
        assert!(hands.tick < 40_000, "{self:?} {seen:#?}");
    }

    fn counts(&self) -> bool {
        self.runs
    }
}
