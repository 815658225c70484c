//! What is done with the machine, one part after the other, and what is seen of it meanwhile.

use super::{EDGES, GAUGE, INPUTS, LEVEL, OUTPUTS, SPINDLE};
use crate::machine::{Case, Hands};
use core::ops::Range;
use glidepath_emulator::Segment;
use glidepath_link::{Command, MachineState};

/// What happens one after the other.
#[derive(Debug, Clone)]
pub(super) enum Part {
    /// A program is run to its end.
    Program(&'static str),
    /// It is aborted so many ticks after its first feed.
    Aborted(&'static str, u64),
    /// These devices are unplugged so many ticks after that.
    Unplugged(&'static str, u64, Range<usize>),
    /// They are plugged in again.
    Plugged(Range<usize>),
    /// The fault is reset.
    Reset,
}

/// Outputs of the terminals: digital ones, and counts of the speed.
pub(super) type Pins = (u8, i16);

/// Switches on, comes home, and does the parts.
#[derive(Debug)]
pub(super) struct Work {
    parts: Vec<Part>,
    nth: usize,
    began: Option<u64>,
    /// When the first feed of the part was seen.
    fed: Option<u64>,
    asked: u64,
    over: u32,
    runs: bool,
    /// After each part.
    pub(super) after: Vec<Pins>,
    /// What it was told at the end of each, and the fault.
    pub(super) faults: Vec<Option<String>>,
    pub(super) contact: Option<(u32, f64)>,
    pub(super) gauge: Option<f64>,
    /// When devices were unplugged, and when something was aborted.
    pub(super) unplugged_ns: Option<u64>,
    pub(super) aborted_ns: Option<u64>,
    /// How far the spindle has turned, by time.
    pub(super) turned: Vec<(u64, f64)>,
}

impl Work {
    pub(super) fn new(parts: &[Part]) -> Self {
        Self {
            parts: parts.to_vec(),
            nth: 0,
            began: None,
            fed: None,
            asked: 0,
            over: 0,
            runs: false,
            after: Vec::new(),
            faults: Vec::new(),
            contact: None,
            gauge: None,
            unplugged_ns: None,
            aborted_ns: None,
            turned: Vec::new(),
        }
    }

    /// What stands at the inputs, by where the drives are.
    fn press(hands: &Hands<'_>, segment: &mut Segment) {
        let Some(feedback) = hands.feedback else {
            return;
        };
        for (joint, edge) in EDGES.iter().enumerate() {
            segment.set_input(INPUTS, joint, feedback.position[joint] <= *edge);
        }
        segment.set_input_bytes(GAUGE, 4, &8192_i16.to_le_bytes());
    }

    fn pins(segment: &Segment) -> Pins {
        let (bits, speed) = (segment.outputs(OUTPUTS), segment.outputs(LEVEL));
        (bits[0], i16::from_le_bytes([speed[2], speed[3]]))
    }

    fn is_over(&self, hands: &Hands<'_>, part: &Part, since: u64) -> bool {
        let state = hands.state();
        match part {
            Part::Unplugged(..) => since > 200 && state == Some(MachineState::Faulted),
            Part::Plugged(_) => since > 600,
            Part::Reset => since > 25 && state == Some(MachineState::Off),
            Part::Aborted(..) => self.aborted_ns.is_some() && state == Some(MachineState::Idle),
            // Behind a contact nobody says how the program goes on.
            Part::Program(_) => {
                since > 25 && matches!(state, Some(MachineState::Idle | MachineState::Waiting))
            }
        }
    }

    fn begin(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let Some(part) = self.parts.get(self.nth) else {
            hands.wants.end = true;
            return;
        };
        (self.began, self.fed) = (Some(hands.tick), None);
        match part {
            Part::Program(text) | Part::Aborted(text, _) | Part::Unplugged(text, ..) => {
                hands.wants.program = Some(text);
            }
            Part::Reset => hands.wants.command = Some(Command::Reset),
            Part::Plugged(devices) => segment.unplug(devices.clone(), false, hands.now_ns),
        }
    }

    fn go_on(&mut self, hands: &mut Hands<'_>, segment: &mut Segment, began: u64) {
        let part = self.parts[self.nth].clone();
        let feeds = hands
            .last
            .is_some_and(|s| s.velocity.iter().any(|v| v.abs() > 1.0));
        if self.runs && feeds && self.fed.is_none() {
            self.fed = Some(hands.tick);
        }
        let fed = self.fed.map(|fed| hands.tick - fed);
        match &part {
            Part::Aborted(_, ticks) if fed == Some(*ticks) => {
                hands.wants.command = Some(Command::Abort);
                self.aborted_ns = Some(hands.now_ns);
            }
            Part::Unplugged(_, ticks, devices) if fed == Some(*ticks) => {
                segment.unplug(devices.clone(), true, hands.now_ns);
                self.unplugged_ns = Some(hands.now_ns);
            }
            _ => {}
        }
        let is_over = self.is_over(hands, &part, hands.tick - began);
        self.over = if is_over { self.over + 1 } else { 0 };
        // Outputs are played later than setpoints say, and a spindle takes its time.
        if self.over > 200 {
            self.over = 0;
            self.after.push(Self::pins(segment));
            self.faults
                .push(hands.status.and_then(|status| status.fault_text()));
            (self.nth, self.began) = (self.nth + 1, None);
        }
    }
}

impl Case for Work {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        Self::press(hands, segment);
        self.runs = hands.state() == Some(MachineState::Running);
        if let Some(turned) = segment.revolutions((SPINDLE, 0), hands.now_ns) {
            self.turned.push((hands.now_ns, turned));
        }
        self.gauge = hands.feedback.map(|said| said.analog_in[2]).or(self.gauge);
        let contact = hands.status.filter(|status| status.contact_kind != 0);
        self.contact = contact
            .map(|status| (status.contact_kind, status.contact[2]))
            .or(self.contact);
        let rested = hands.tick.saturating_sub(self.asked) > 25;
        let command = match (hands.state(), self.began) {
            (_, Some(began)) => {
                self.go_on(hands, segment, began);
                None
            }
            (Some(MachineState::Off), None) if self.nth == 0 => Some(Command::Enable),
            (Some(MachineState::NotHomed), None) if self.nth == 0 => Some(Command::Home(7)),
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
        assert!(hands.tick < 40_000, "part {} {seen:#?}", self.nth);
    }

    fn counts(&self) -> bool {
        self.runs
    }
}
