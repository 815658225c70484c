//! The frames of one epoch: offered in order, paced, and ended by command where nobody wants them any more.

use std::time::Duration;

use glidepath_link::{Command, Delivery, LinkError, SetpointFrame};
use glidepath_program::Override;

use super::FramePublisher;
use super::progress_notices::PROGRESS_INTERVAL;
use crate::exchange::attend::{Attend, Attended};
use crate::exchange::machine::{HUNGRY_POLL, POLL, SILENCE, Standing};
use crate::plan::ahead::{FrameQueue, Next, planned_ahead};
use crate::plan::pipeline::Pipeline;
use crate::publish::epoch::Epoch;
use crate::run::control::{Control, Notice};
use crate::run::error::RunError;
use crate::source::item_source::ItemSource;

/// Frames offered between two looks at status and stop flag.
const FRAMES_PER_TURN: u32 = 512;

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

impl FramePublisher<'_> {
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
            attend.follow(&self.followed(plan.queue, &epoch));
            if epoch.is_over() {
                self.report(&epoch, plan.queue, control);
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
                self.report(&epoch, plan.queue, control);
            }
        }
    }

    /// Answers what the program asks of inputs, once the machine rests where it asks.
    fn answer_inputs(&mut self, epoch: &Epoch, waited: Duration) -> Result<(), RunError> {
        let Some(inputs) = &mut self.inputs else {
            return Ok(());
        };
        inputs.look(epoch.rests_at_m_code(66), waited)
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

    fn standing(&self, epoch: &Epoch) -> Result<Standing, RunError> {
        self.machine.standing(
            epoch.boot_id,
            epoch.number,
            (epoch.is_known(), epoch.goes_on),
        )
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
