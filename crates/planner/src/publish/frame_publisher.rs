//! The publisher of frames to the interpolator: paced, lossless, and with an end.
//!
//! ```text
//!            executed            published     horizon
//!  ─────────────┼─────────────────────┼───────────┤
//!   sequence →  ▲ from Status         ▲ one frame in hand until it is delivered
//! ```
//!
//! * **Start.** An epoch starts at rest where the machine stands, so the publisher waits until the
//!   interpolator lives (its status changes) and its job has the machine (the module `claim`), and
//!   takes the position from the status.
//!   The first frame is published with a head start behind it: a few frames at rest before motion
//!   that is hard to plan would be executed, and the machine starve.
//! * **Pace.** Frame *n* is offered when *n* < executed + horizon. What is not yet published can
//!   still be planned otherwise; what is published lets the machine run on while the planner is
//!   held up. If the interpolator rests for want of frames though it has them all, it gets more
//!   than the horizon, little by little, so that the two can never wait for each other.
//! * **Planned ahead.** Frames come from a thread that works far ahead of the horizon (the module
//!   `ahead`); on a change of override what it is ahead by is planned again.
//! * **No loss.** The frame in hand is given up only when the transport says that it is in the
//!   interpolator's queue; a queue that is full, or not connected yet, gets the same frame again.
//! * **Slow input.** While the source has nothing, the last frame is offered again now and then.
//!   The interpolator, which rests for want of frames, knows the frame already and learns from it
//!   that its planner lives.
//! * **End.** The last frame carries the flag `LAST`; the run is over when the interpolator says
//!   that it has executed the epoch, or why not.
//! * **Stop flag.** The publisher sends an abort: the interpolator comes to rest on the path at
//!   once and drops what it has queued, instead of playing up to a horizon of motion that nobody
//!   wants any more. If the command cannot be sent, no more frames come, and the interpolator
//!   stops by starvation, later but as safely.

mod epoch_frames;
mod progress_notices;

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{Auxiliary, EndOfEpoch, FrameSink, LinkError, Record as _, Transport};

use crate::exchange::inputs::InputWatch;
use crate::exchange::machine::{MachinePorts, POLL, SILENCE};
use crate::publish::claim::Claim;
use crate::publish::epoch::Epoch;
use crate::publish::epoch::Pace;
use crate::run::control::Control;
use crate::run::error::RunError;
use crate::source::input_arbiter::InputArbiter;
use crate::source::remarks::RemarkLog;

/// The planner's ports to one interpolator.
pub struct FramePublisher<'t> {
    pub(crate) transport: &'t dyn Transport,
    sink: Box<dyn FrameSink>,
    pub(crate) machine: MachinePorts,
    pub(crate) pace: Pace,
    /// Time waited without an epoch.
    pub(crate) idle_t: Duration,
    pub(crate) inputs: Option<InputWatch>,
    pub(crate) remarks: Option<RemarkLog>,
    /// The job that the interpolator was told of.
    pub(crate) claim: Option<Claim>,
}

impl std::fmt::Debug for FramePublisher<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FramePublisher")
            .field("machine", &self.machine)
            .field("pace", &self.pace)
            .finish_non_exhaustive()
    }
}

impl<'t> FramePublisher<'t> {
    /// Opens the ports.
    ///
    /// # Errors
    /// A port that cannot be opened; [`LinkError::Taken`] if another planner runs.
    pub fn connect(transport: &'t dyn Transport, pace: Pace) -> Result<Self, LinkError> {
        let (sink, machine) = (transport.frame_sink()?, MachinePorts::connect(transport)?);
        Ok(Self {
            transport,
            sink,
            machine,
            pace,
            idle_t: Duration::ZERO,
            inputs: None,
            remarks: None,
            claim: None,
        })
    }

    /// From now on answers at a desk what the machine's inputs are.
    ///
    /// # Errors
    /// Feedback cannot be received.
    pub fn attend_inputs(&mut self, arbiter: InputArbiter) -> Result<(), LinkError> {
        // The ports of the desk before are given back first.
        self.inputs = None;
        let source = self.transport.feedback_source()?;
        self.inputs = Some(InputWatch::new(arbiter, source));
        Ok(())
    }

    /// Tells what the next program notes in a log when the machine comes there: by notices, and in the
    /// status of the interpolator.
    pub fn attend_remarks(&mut self, log: RemarkLog) {
        self.remarks = Some(log);
    }

    /// The state of spindle, coolant, tool and outputs, as far as the interpolator knows.
    ///
    /// # Errors
    /// The link fails.
    pub fn auxiliary(&self, control: &mut Control<'_>) -> Result<Auxiliary, LinkError> {
        let mut source = self.transport.auxiliary_source()?;
        let mut waited = Duration::ZERO;
        while waited < SILENCE {
            if let Some(record) = source.take()? {
                record.check()?;
                return Ok(record);
            }
            (control.pause)(POLL);
            waited += POLL;
        }
        Ok(Auxiliary::default())
    }

    /// Number of the block that the machine is on, 0 if unknown.
    #[must_use]
    pub fn block(&self) -> u32 {
        self.machine.block()
    }

    /// Source line that the machine is on, 0 if unknown.
    #[must_use]
    pub fn line(&self) -> u32 {
        self.machine.line()
    }

    /// The end of the newest epoch; `None` if unknown.
    #[must_use]
    pub fn end_of_epoch(&self) -> Option<EndOfEpoch> {
        self.machine.status()?.end_of_epoch().ok()
    }

    /// Number of the epoch that the machine is in, or was in last; `None` if unknown.
    #[must_use]
    pub fn epoch(&self) -> Option<u64> {
        Some(self.machine.status()?.epoch)
    }

    /// The position that the machine was last said to have, mm and degrees.
    #[must_use]
    pub fn position(&self) -> Option<AxisVector> {
        let status = self.machine.status()?;
        Some(AxisVector::from(status.position))
    }

    pub(crate) fn next_epoch(&mut self, goes_on: bool) -> Result<Epoch, RunError> {
        let status = *self.machine.status().ok_or(RunError::InterpolatorLost)?;
        // That of a job is the one it was given with the machine: what was aborted since is over.
        let number = self.take_epoch(&status)?.unwrap_or(status.next_epoch);
        let mut epoch = Epoch::new(status.boot_id, number, self.pace.horizon_frames);
        epoch.goes_on = goes_on;
        Ok(epoch)
    }
}
