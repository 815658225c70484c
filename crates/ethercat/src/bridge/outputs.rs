//! The devices of a bridge that are no drives: what they tell, and when their outputs are obeyed.

use super::Bridge;
use super::loss::BridgeLoss;
use crate::event::Event;
use crate::terminal::{Answered, Wiring};
use glidepath_link::{Auxiliary, Setpoint, Subscriber};

impl<S: Subscriber<Setpoint>> Bridge<S> {
    /// All that is no drive has come up, too: where its inputs and outputs are, and who it is.
    pub(crate) fn begin_terminals(
        &mut self,
        (wiring, positions): (&Wiring, impl Iterator<Item = usize>),
    ) {
        if let Some(terminals) = &mut self.terminals {
            terminals.begin(wiring, positions);
        }
    }

    /// What all that is no drive has answered.
    pub(crate) fn hear_terminals(&mut self, answered: Answered<'_>, tell: &mut dyn FnMut(Event)) {
        if let Some(terminals) = &mut self.terminals {
            terminals.hear(answered, tell);
        }
    }

    /// The auxiliary record has come.
    pub(crate) fn hear_record(&mut self, record: &Auxiliary, now_ns: u64) {
        if let Some(terminals) = &mut self.terminals {
            terminals.hear_record(record, now_ns);
        }
    }

    /// Writes what outputs are to be, for the setpoints of `meant_ns`, after the cycle of the drives.
    ///
    /// Nobody is to be obeyed without setpoints, when the bridge ends, without the bus, without
    /// one of the devices, and after that as long as what was lost is not known: as soon as no joint is told
    /// to move, because a tool that moves on in the material with its spindle at rest breaks.
    pub(crate) fn outputs(
        &mut self,
        (now_ns, meant_ns): (u64, u64),
        image: &mut [u8],
        tell: &mut dyn FnMut(Event),
    ) {
        // Then the bus is brought up anew, which takes everything that is on.
        let ends_with_drive = self.has_lost_drive() && self.are_drives_off();
        let is_silent = self.is_silent(meant_ns);
        let Some(terminals) = &mut self.terminals else {
            return;
        };
        let is_alone = is_silent
            || self.ends
            || ends_with_drive
            || terminals.has_lost()
            || self.loss.is_some_and(BridgeLoss::stops_outputs);
        let is_safe = self.is_bus_lost || (is_alone && self.rests);
        let resets = core::mem::take(&mut self.resets_spindle);
        if terminals.obey((now_ns, meant_ns), (is_safe, resets), image, tell) {
            self.note_dropped_outputs(tell);
        }
        self.note_spindle();
    }
}
