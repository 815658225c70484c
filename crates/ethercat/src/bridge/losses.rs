//! The losses of a bridge: setpoints, a device, the bus, the drive of the spindle.
//!
//! One rule for all: joints that stopped and outputs that came to rest by a loss stay so until the fault
//! that came of it was reset, or another interpolator is there. Until then feedback tells the first loss.

use super::Bridge;
use super::loss::BridgeLoss;
use crate::event::Event;
use crate::terminal::{SpindleLoss, Terminals};
use glidepath_link::{Feedback, Setpoint, Subscriber};

impl<S: Subscriber<Setpoint>> Bridge<S> {
    /// Whether no setpoint is near the time that is played, and none was for as long as the drives wait.
    pub(super) fn is_silent(&self, meant_ns: u64) -> bool {
        let last = self.servo.last();
        last.is_none_or(|last| meant_ns > last.apply_ns.saturating_add(self.patience_ns))
    }

    /// Setpoints stayed away for longer than the drives' patience, and something stopped by that.
    pub(super) fn lose_setpoints(&mut self, tell: &mut dyn FnMut(Event)) {
        if self.loss.is_none() {
            self.loss = Some(BridgeLoss::Setpoints(self.patience_ns));
            tell(Event::Silence(self.patience_ns));
        }
    }

    /// Outputs that were obeyed came to rest because somebody is missing. Not because the bridge ends.
    pub(super) fn note_dropped_outputs(&mut self, tell: &mut dyn FnMut(Event)) {
        if self.is_bus_lost {
            self.loss.get_or_insert(BridgeLoss::Bus);
        } else if let Some(loss) = self.lost_device() {
            self.loss.get_or_insert(loss);
        } else if self.has_lost_drive() {
            self.loss.get_or_insert(BridgeLoss::Bus);
        } else if !self.ends {
            self.lose_setpoints(tell);
        }
    }

    /// The drive of the spindle has failed, or its gear.
    pub(super) fn note_spindle(&mut self) {
        let failed = self.terminals.as_ref().and_then(Terminals::spindle_fault);
        if let Some(failed) = failed {
            self.loss.get_or_insert(match failed {
                SpindleLoss::Drive(code) => BridgeLoss::Spindle(code),
                SpindleLoss::Gear(gear) => BridgeLoss::Gear(gear),
            });
        }
    }

    /// The device that is lost now, drives left out.
    fn lost_device(&self) -> Option<BridgeLoss> {
        let terminals = self.terminals.as_ref()?;
        let is_lost = terminals.has_lost();
        is_lost.then(|| BridgeLoss::Device(terminals.missing()))
    }

    /// Adds what was lost, or is.
    pub(super) fn tell_loss(&self, feedback: &mut Feedback) {
        if let Some(loss) = self.loss.or_else(|| self.lost_device()) {
            loss.tell(feedback);
        }
    }
}
