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

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{
    Auxiliary, Command, Delivery, FrameSink, LinkError, MachineState, Record as _, SetpointFrame,
    Transport,
};
use glidepath_program::Override;

use crate::ahead::{FrameQueue, Next, planned_ahead};
use crate::attend::{Attend, Attended};
use crate::claim::Claim;
use crate::epoch::Epoch;
use crate::inputs::InputWatch;
use crate::machine::{HUNGRY_POLL, MachinePorts, POLL, SILENCE, Standing};
use crate::{
    Control, Followed, InputArbiter, ItemSource, Notice, Pace, Pipeline, RemarkLog, RunError,
};

/// Frames offered between two looks at status and stop flag.
const FRAMES_PER_TURN: u32 = 512;

/// Between two notices of progress.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

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

/// What a turn of publishing came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// There may be more to do at once.
    Busy,
    /// Nothing to do until the source has more.
    Hungry,
    /// Waited for frames that are still being planned.
    Waited,
    /// Nothing to do until the interpolator has gone on.
    Wait,
}

/// What an epoch gives out.
struct Plan<'q> {
    queue: &'q FrameQueue,
    /// The fingerprint of the program.
    program: u64,
    /// The override it is planned with.
    wanted: Override,
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

    /// Whether a jog in a hold has moved the axes off the path of the newest epoch, as far as is known.
    #[must_use]
    pub const fn was_off_path(&self) -> bool {
        self.machine.was_off_path()
    }

    /// Number of the epoch that the machine is in, or was in last; `None` if unknown.
    #[must_use]
    pub fn epoch(&self) -> Option<u64> {
        Some(self.machine.status()?.epoch)
    }

    /// Answers what the program asks of inputs, once the machine rests where it asks.
    fn answer_inputs(&mut self, epoch: &Epoch, waited: Duration) -> Result<(), RunError> {
        let Some(inputs) = &mut self.inputs else {
            return Ok(());
        };
        inputs.look(epoch.rests_at_m_code(66), waited)
    }

    /// The position that the machine was last said to have, mm and degrees.
    #[must_use]
    pub fn position(&self) -> Option<AxisVector> {
        let status = self.machine.status()?;
        Some(AxisVector::from(status.position))
    }

    /// Publishes what is left of a pipeline up to a probing move, or its end. Returns whether the
    /// probe ended it.
    pub(crate) fn publish_epoch<S: ItemSource + Send>(
        &mut self,
        epoch: Epoch,
        pipeline: &mut Pipeline<S>,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> Result<bool, RunError> {
        let wanted = self.machine.wanted_override().unwrap_or(Override::NONE);
        pipeline.follow_override(wanted);
        let program = pipeline.fingerprint();
        let watch = self.watch();
        self.say("planning");
        let room = (self.pace.frames_ahead(), self.pace.head_start());
        let published = planned_ahead(pipeline, room, |queue| {
            let plan = Plan {
                queue,
                program,
                wanted,
            };
            let published = self.publish_planned(plan, epoch, attend, control);
            if published.is_err() {
                // The thread that plans may be reading for long.
                watch.end();
            }
            published
        });
        published.map_err(RunError::NoThread)?
    }

    fn publish_planned(
        &mut self,
        mut plan: Plan<'_>,
        mut epoch: Epoch,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> Result<bool, RunError> {
        let mut waited = Duration::ZERO;
        loop {
            if control.is_stopped() {
                self.abort(&epoch, control)?;
                return Err(RunError::Interrupted);
            }
            self.machine.observe()?;
            match attend.attend(waited, &self.doing()) {
                Attended::GoesOn => {}
                // What could be resumed before stays so.
                Attended::IsEmpty if !epoch.has_begun() => return Ok(false),
                Attended::IsEmpty => {}
                Attended::End(why) => {
                    self.abort(&epoch, control)?;
                    return Err(RunError::Ended { why });
                }
            }
            // A fault tells more than that the job is over.
            epoch.follow(self.standing(&epoch)?);
            self.say(if epoch.is_known() {
                ""
            } else {
                attend.doing().unwrap_or("planning")
            });
            self.tend(waited)?;
            if let Err(error) = self.answer_inputs(&epoch, waited) {
                self.abort(&epoch, control)?;
                return Err(error);
            }
            attend.follow(&self.followed(&plan, &epoch));
            if epoch.is_over() {
                self.report(&epoch, &plan, control);
                return match epoch.ended {
                    Some(Err(refusal)) => Err(refusal.into()),
                    _ => Ok(epoch.is_tripped()),
                };
            }
            if let Some(wanted) = self.machine.wanted_override()
                && wanted != plan.wanted
                && epoch.ended.is_none()
            {
                plan.wanted = wanted;
                plan.queue.replan(wanted);
            }
            plan.queue
                .ask_again(epoch.unexecuted() <= self.pace.horizon_frames / 2);
            let turn = self.turn(&plan, &mut epoch, attend, control)?;
            waited = match turn {
                Turn::Busy => Duration::ZERO,
                Turn::Hungry => HUNGRY_POLL,
                Turn::Waited | Turn::Wait => POLL,
            };
            // Waiting for input, and thinking for long, are no death.
            if matches!(turn, Turn::Hungry | Turn::Waited) {
                self.show_life(&mut epoch, waited)?;
            }
            match turn {
                Turn::Busy => {}
                Turn::Waited => self.machine.count_silence(waited),
                Turn::Hungry | Turn::Wait => self.machine.pause(waited, control),
            }
            epoch.since_progress += waited;
            if epoch.since_progress >= PROGRESS_INTERVAL {
                epoch.since_progress = Duration::ZERO;
                self.report(&epoch, &plan, control);
            }
        }
    }

    pub(crate) fn next_epoch(&mut self, goes_on: bool) -> Result<Epoch, RunError> {
        let status = *self.machine.status().ok_or(RunError::InterpolatorLost)?;
        // That of a job is the one it was given with the machine: what was aborted since is over.
        let number = self.take_epoch(&status)?.unwrap_or(status.next_epoch);
        let mut epoch = Epoch::new(status.boot_id, number, self.pace.horizon_frames);
        epoch.goes_on = goes_on;
        Ok(epoch)
    }

    /// Offers frames until there is nothing to do or it is time to look around.
    fn turn(
        &mut self,
        plan: &Plan<'_>,
        epoch: &mut Epoch,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> Result<Turn, RunError> {
        for _ in 0..FRAMES_PER_TURN {
            if let Some(frame) = epoch.in_hand {
                let begins = frame.sequence == 0 && !epoch.goes_on;
                if frame.sequence >= epoch.limit()
                    || (begins && !attend.may_begin())
                    || self.sink.offer(&frame)? != Delivery::Delivered
                {
                    return Ok(Turn::Wait);
                }
                epoch.delivered();
                if frame.sequence == 0 {
                    // What was said in front of where a program is gone on with was said.
                    let _before = self.remarks.as_ref().map(|log| log.executed(frame.block));
                    (control.notify)(&Notice::Started {
                        epoch: epoch.number,
                    });
                }
            }
            if epoch.ended.is_some() {
                return Ok(Turn::Wait);
            }
            match plan.queue.next() {
                Next::Frame(frame) => {
                    epoch.in_hand = Some(SetpointFrame {
                        program: plan.program,
                        ..SetpointFrame::from_frame(&frame, epoch.number, self.pace.period_ns)
                    });
                }
                Next::Busy if plan.queue.wait(POLL) => {}
                Next::Busy => return Ok(Turn::Waited),
                Next::Pending => return Ok(Turn::Hungry),
                Next::End(Err(refusal)) if refusal.leaves_motion_open() => {
                    self.abort(epoch, control)?;
                    return Err(refusal.into());
                }
                Next::End(end) => epoch.ended = Some(end),
                Next::Died => {
                    // Why is told by the panic of that thread, which is handed on.
                    self.abort(epoch, control)?;
                    return Err(RunError::Interrupted);
                }
            }
        }
        Ok(Turn::Busy)
    }

    /// How far what was planned is executed.
    fn followed(&self, plan: &Plan<'_>, epoch: &Epoch) -> Followed {
        let state = self.machine.status().and_then(|status| status.state().ok());
        let is_waiting = matches!(state, Some(MachineState::Waiting | MachineState::Starved));
        let is_executed = epoch.in_hand.is_none() && epoch.unexecuted() == 0;
        let planned = epoch.unexecuted() + plan.queue.waiting() as u64;
        #[allow(clippy::cast_precision_loss, reason = "far below 2^53 ns")]
        let ahead_t = planned.saturating_mul(self.pace.period_ns) as f64 * 1e-9;
        Followed {
            ahead_t,
            rests: is_executed && plan.queue.is_dry() && (is_waiting || !epoch.has_begun()),
            block: if epoch.is_known() {
                self.machine.block()
            } else {
                0
            },
        }
    }

    fn standing(&self, epoch: &Epoch) -> Result<Standing, RunError> {
        self.machine.standing(
            epoch.boot_id,
            epoch.number,
            (epoch.is_known(), epoch.goes_on),
        )
    }

    fn report(&mut self, epoch: &Epoch, plan: &Plan<'_>, control: &mut Control<'_>) {
        let at = (self.machine.line(), self.machine.block());
        let progress = epoch.progress(plan.queue.statistics(), at, self.pace.period_ns);
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

    /// Tells the interpolator, now and then, that there will be more.
    fn show_life(&mut self, epoch: &mut Epoch, waited: Duration) -> Result<(), LinkError> {
        if epoch.since_offer.is_over_after(waited)
            && let Some(last) = &epoch.last
        {
            epoch.since_offer.restart();
            // If it cannot be delivered now, the next will be.
            self.sink.offer(last)?;
        }
        Ok(())
    }

    /// Ends the epoch by command and waits until the machine rests.
    fn abort(&mut self, epoch: &Epoch, control: &mut Control<'_>) -> Result<(), RunError> {
        if !epoch.has_begun() {
            return Ok(());
        }
        // If the interpolator cannot be told, it stops by starvation.
        if self.machine.command(Command::Abort, control).is_err() {
            return Ok(());
        }
        let mut waited = Duration::ZERO;
        while waited < SILENCE {
            self.machine.observe()?;
            match self.standing(epoch) {
                Ok(Standing::Open { .. } | Standing::NotStarted) => {}
                Ok(Standing::Completed | Standing::Tripped) | Err(_) => break,
            }
            self.machine.pause(POLL, control);
            waited += POLL;
        }
        Ok(())
    }
}
