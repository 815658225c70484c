//! The losses that servo stacks tell of: setpoints, a device, the bus.
//!
//! A stack tells a loss until it hears that the fault which came of it was reset. What it has sent before it
//! could hear that is no new loss: neither after a reset, nor to an interpolator that was started since.

use super::drive_monitor::DriveMonitor;
use super::joint_ownership::{Joints, LossTold};
use crate::shared::fault::Fault;
use crate::shared::message::{Order, TickReport};

impl DriveMonitor {
    /// Takes note of whether a fault is latched: what is told by who heard of that alone is known.
    pub(super) const fn note_fault(&mut self, report: &TickReport) {
        if report.fault.is_some() {
            self.cleared_from = report.setpoint.number + 1;
        }
    }

    /// The loss that counts now.
    fn loss(&self, joints: &Joints, report: &TickReport) -> Option<LossTold> {
        let is_of_this_life = |loss: &LossTold| loss.heard <= report.setpoint.number;
        let is_known = |loss: &LossTold| report.fault.is_none() && loss.heard < self.cleared_from;
        let loss = joints.loss.filter(is_of_this_life);
        loss.filter(|loss| !is_known(loss))
    }

    /// The joints that are not led any more because of a loss: as soon as that is the fault, or another is,
    /// their power is to go. Before, the power would be the reason.
    pub(super) fn lost(&self, joints: &Joints, report: &TickReport) -> u32 {
        let loss = self.loss(joints, report).filter(|_| report.fault.is_some());
        let is_lost = loss.is_some_and(|loss| loss.cause.is_loss_of_joints());
        if is_lost { self.all } else { 0 }
    }

    /// Whether a loss is to be a fault, whether or not the drives have power: joints that stand because of
    /// it are not to be taken for joints that are kept back.
    pub(super) fn judge_loss(&self, joints: &Joints, report: &TickReport) -> Option<Order> {
        let loss = self.loss(joints, report)?;
        let (line, sequence) = report.place();
        report.fault.is_none().then(|| {
            Order::Fault(Fault {
                value: loss.value,
                ..Fault::new(loss.cause, line, sequence)
            })
        })
    }
}
