//! The epochs of a program: one, and one more behind each probing move.
//!
//! ```text
//!   ── items ──► probing move │ ── items ──► probing move │ ── items ──►
//!      epoch 1          trips ▲    epoch 2          trips ▲    epoch 3
//!                             └ where it stands, and what was found: the source goes on from there
//! ```

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{Command, LinkError, MachineState};

use crate::exchange::attend::Attend;
use crate::exchange::machine::{POLL, aborted};
use crate::plan::pipeline::Pipeline;
use crate::publish::frame_publisher::FramePublisher;
use crate::run::control::Control;
use crate::run::error::RunError;
use crate::run::statistics::Statistics;
use crate::source::item_source::ItemSource;

impl FramePublisher<'_> {
    /// Publishes all frames of a pipeline that starts where [`FramePublisher::wait_until_ready`] said,
    /// and waits until they are executed. They are planned in a thread of its own.
    ///
    /// # Errors
    /// Why the motion ended before the end of the program. A refusal of the program comes when the
    /// motion up to the last good item is executed.
    pub fn publish<S: ItemSource + Send>(
        &mut self,
        pipeline: &mut Pipeline<S>,
        control: &mut Control<'_>,
    ) -> Result<Statistics, RunError> {
        self.publish_and_attend(pipeline, &mut |_: Duration| {}, control)
    }

    /// As [`FramePublisher::publish`], for a source that has others to answer to.
    ///
    /// # Errors
    /// As [`FramePublisher::publish`].
    pub fn publish_and_attend<S: ItemSource + Send>(
        &mut self,
        pipeline: &mut Pipeline<S>,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> Result<Statistics, RunError> {
        let published = self.publish_epochs(pipeline, attend, control);
        self.remarks = None;
        let published = published.map_err(|error| self.lost(error));
        self.release(control);
        published
    }

    /// An interpolator that gives no sign of life may hang, which is another thing than its death.
    fn lost(&self, error: RunError) -> RunError {
        let is_silent = self.machine.status().is_none();
        let process = self.transport.interpolator_process();
        match (error, process.filter(|_| is_silent)) {
            (RunError::InterpolatorLost, Some(process)) => RunError::InterpolatorSilent { process },
            (error, _) => error,
        }
    }

    /// One epoch, and one more behind each probing move.
    fn publish_epochs<S: ItemSource + Send>(
        &mut self,
        pipeline: &mut Pipeline<S>,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> Result<Statistics, RunError> {
        let mut goes_on = false;
        loop {
            let epoch = self.next_epoch(goes_on)?;
            let is_tripped = self.publish_epoch(epoch, pipeline, attend, control)?;
            goes_on = true;
            if !pipeline.comes_to_probe(is_tripped)? {
                return Ok(pipeline.statistics());
            }
            let stands = self.stand_behind_probe(control)?;
            let probed = self.machine.probed(stands)?;
            pipeline.go_on_from(stands, self.machine.path_s());
            let inputs = self.inputs.as_ref();
            let told = inputs.map_or(Ok(()), |inputs| inputs.answer_probe(probed));
            if let Err(error) = told {
                let _told = self.machine.command(Command::Abort, control);
                return Err(error);
            }
        }
    }

    /// Where the machine stands behind a probing move, and waits for the rest of the program.
    fn stand_behind_probe(&mut self, control: &mut Control<'_>) -> Result<AxisVector, RunError> {
        loop {
            if control.is_stopped() {
                // If the interpolator cannot be told, it waits until somebody else does.
                let _told = self.machine.command(Command::Abort, control);
                return Err(RunError::Interrupted);
            }
            self.machine.observe()?;
            let status = self.machine.status().ok_or(RunError::InterpolatorLost)?;
            match status.state().map_err(LinkError::from)? {
                MachineState::Waiting => return Ok(AxisVector::from(status.position)),
                MachineState::Faulted => return Err(RunError::fault(status)),
                MachineState::Idle | MachineState::Off | MachineState::NotHomed => {
                    return Err(aborted(status));
                }
                MachineState::Running
                | MachineState::Holding
                | MachineState::Held
                | MachineState::Starving
                | MachineState::Starved
                | MachineState::ProgramStop
                | MachineState::Stopping
                | MachineState::Awaiting
                | MachineState::Jogging
                | MachineState::Homing
                | MachineState::Preparing => self.machine.pause(POLL, control),
            }
        }
    }
}
