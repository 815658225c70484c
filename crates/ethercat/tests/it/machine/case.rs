//! A case: the operator and the machine's surroundings, what they see, and what they want.

use crate::wire::Fate;
use glidepath_emulator::{Segment, SyncRecord};
use glidepath_ethercat::{Counts, Event};
use glidepath_link::{Auxiliary, Command, Feedback, MachineState, Setpoint, Status};

/// The operator and the machine's surroundings, as a case has them: called at every tick.
pub(crate) trait Case {
    /// Looks at the machine and does something, once a period, before the tick.
    fn tick(&mut self, machine: &mut Hands<'_>, segment: &mut Segment);

    /// What becomes of a frame.
    fn fate(&mut self, _now_ns: u64) -> Fate {
        Fate::Whole
    }

    /// Whether allocations of the bus thread are counted now.
    fn counts(&self) -> bool {
        false
    }
}

/// What a case can see and do.
pub(crate) struct Hands<'m> {
    pub(crate) now_ns: u64,
    pub(crate) tick: u64,
    pub(crate) last: Option<Setpoint>,
    pub(crate) status: Option<Status>,
    pub(crate) events: &'m [Event],
    /// What the bridge said of the joints last.
    pub(crate) feedback: Option<Feedback>,
    /// What the interpolator says that spindle and outputs are to be.
    pub(crate) auxiliary: Option<Auxiliary>,
    pub(crate) wants: Wants,
}

/// What a case wants of the machine.
#[derive(Debug, Default)]
pub(crate) struct Wants {
    pub(crate) command: Option<Command>,
    /// A program is to run.
    pub(crate) program: Option<&'static str>,
    /// The interpolator is killed, or started anew.
    pub(crate) interpolator: Option<bool>,
    /// The host does not let it run for so many ticks.
    pub(crate) pause: Option<u64>,
    /// The bridge is to end in good order.
    pub(crate) end: bool,
    /// Its process is killed: it does nothing any more.
    pub(crate) killed: bool,
}

impl Hands<'_> {
    pub(crate) fn state(&self) -> Option<MachineState> {
        self.last.and_then(|setpoint| setpoint.state().ok())
    }

    /// Gives power, and then runs a program: the commands of a case that has not begun.
    pub(crate) fn set_out(
        &mut self,
        asked: &mut u64,
        began: &mut Option<u64>,
        program: &'static str,
    ) {
        if began.is_some() || self.tick <= *asked + 25 {
            return;
        }
        match self.state() {
            Some(MachineState::Off) => {
                self.wants.command = Some(Command::Enable);
                *asked = self.tick;
            }
            Some(MachineState::Idle) => {
                self.wants.program = Some(program);
                *began = Some(self.tick);
            }
            _ => {}
        }
    }
}

/// What a case came to.
pub(crate) struct Outcome {
    pub(crate) counts: Counts,
    pub(crate) events: Vec<Event>,
    pub(crate) setpoints: Vec<Setpoint>,
    /// What each drive did at each SYNC0.
    pub(crate) records: Vec<Vec<SyncRecord>>,
    /// Allocations of the bus thread while it was counted.
    pub(crate) allocations: u64,
    /// The drives as they are at the end, and when that was.
    pub(crate) left: (Segment, u64),
}
