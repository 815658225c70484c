//! What is told of an epoch while it is executed: how far it is, and what the program says there.

use std::time::Duration;

use glidepath_link::MachineState;

use super::FramePublisher;
use crate::plan::ahead::FrameQueue;
use crate::publish::epoch::Epoch;
use crate::run::control::{Control, Notice};
use crate::source::sent::Followed;

/// Between two notices of progress.
pub(super) const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

impl FramePublisher<'_> {
    /// How far what was planned is executed.
    pub(super) fn followed(&self, queue: &FrameQueue, epoch: &Epoch) -> Followed {
        let state = self.machine.status().and_then(|status| status.state().ok());
        let is_waiting = matches!(state, Some(MachineState::Waiting | MachineState::Starved));
        let is_executed = epoch.in_hand.is_none() && epoch.unexecuted() == 0;
        let planned = epoch.unexecuted() + queue.waiting() as u64;
        #[allow(clippy::cast_precision_loss, reason = "far below 2^53 ns")]
        let ahead_t = planned.saturating_mul(self.pace.period_ns) as f64 * 1e-9;
        Followed {
            ahead_t,
            rests: is_executed && queue.is_dry() && (is_waiting || !epoch.has_begun()),
            block: if epoch.is_known() {
                self.machine.block()
            } else {
                0
            },
        }
    }

    pub(super) fn report(&mut self, epoch: &Epoch, queue: &FrameQueue, control: &mut Control<'_>) {
        let at = (self.machine.line(), self.machine.block());
        let progress = epoch.progress(queue.statistics(), at, self.pace.period_ns);
        let is_whole = epoch.is_over() && matches!(epoch.ended, Some(Ok(())));
        let upto = if is_whole { u32::MAX } else { progress.block };
        self.pass_on_remarks(upto, control);
        (control.notify)(&Notice::Progress(progress));
    }

    /// Tells what the program says in front of a block.
    fn pass_on_remarks(&mut self, block: u32, control: &mut Control<'_>) {
        let Some(log) = &self.remarks else {
            return;
        };
        let remarks = log.executed(block);
        for remark in &remarks {
            (control.notify)(&Notice::Remark(remark));
        }
        // A status has room for one. An interpolator that does not answer is found by its silence,
        // and ends no motion that goes on.
        let _told = remarks
            .last()
            .map(|remark| self.machine.tell(&remark.text, control));
    }
}
