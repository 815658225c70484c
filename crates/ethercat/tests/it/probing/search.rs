//! A machine that is switched on, and searches.

use crate::machine::{Case, Hands};
use glidepath_emulator::{InjectedFault, Segment};
use glidepath_link::{Command, EndOfEpoch, MachineState, Status};

/// Runs programs one after the other, each to the end of its epoch.
#[derive(Debug)]
pub(super) struct Search {
    programs: &'static [&'static str],
    nth: usize,
    epoch: u64,
    asked: u64,
    runs: bool,
    /// When the motion stood behind each contact, and when it was told, ticks.
    stood: Option<u64>,
    pub(super) waited: Vec<u64>,
    /// The device that sends an emergency when the motion stands, and its number.
    pub(super) emergency: Option<(usize, u16)>,
    /// What the status said when it told the end of each.
    pub(super) found: Vec<Status>,
}

impl Search {
    pub(super) const fn new(programs: &'static [&'static str]) -> Self {
        Self {
            programs,
            nth: 0,
            epoch: 0,
            asked: 0,
            runs: false,
            stood: None,
            waited: Vec::new(),
            emergency: None,
            found: Vec::new(),
        }
    }
}

impl Case for Search {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let seen = (hands.state(), hands.status, hands.feedback, hands.events);
        assert!(hands.tick < 20_000, "{self:?} {seen:#?}");
        let rested = hands.tick.saturating_sub(self.asked) > 50;
        self.runs = hands.state() == Some(MachineState::Running);
        let (Some(status), true) = (hands.status, rested) else {
            return;
        };
        if self.nth > 0 && self.found.len() < self.nth {
            if status.epoch != self.epoch {
                return;
            }
            let stands = matches!(
                hands.state(),
                Some(MachineState::Waiting | MachineState::Idle)
            );
            if stands && self.stood.is_none() {
                self.stood = Some(hands.tick);
                if let Some((device, code)) = self.emergency {
                    segment.inject(device, InjectedFault::Emergency(code), hands.now_ns);
                }
            }
            let ends = [EndOfEpoch::Tripped, EndOfEpoch::Completed];
            if stands && status.end_of_epoch().is_ok_and(|end| ends.contains(&end)) {
                self.waited.push(hands.tick - self.stood.unwrap());
                self.found.push(status);
                (self.asked, self.stood) = (hands.tick, None);
            }
            return;
        }
        match hands.state() {
            Some(MachineState::Off) => {
                hands.wants.command = Some(Command::Enable);
                self.asked = hands.tick;
            }
            Some(MachineState::Idle | MachineState::Waiting) => {
                let Some(program) = self.programs.get(self.nth) else {
                    hands.wants.end = true;
                    return;
                };
                hands.wants.program = Some(program);
                (self.nth, self.epoch) = (self.nth + 1, self.epoch + 1);
                self.asked = hands.tick;
            }
            _ => {}
        }
    }

    fn counts(&self) -> bool {
        self.runs
    }
}
