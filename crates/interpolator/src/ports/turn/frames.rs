//! The way of frames to the real-time thread, and the job that they are of.

use super::Ports;
use crate::ports::frame_validation::{FrameVerdict, MachineSnapshot};
use crate::ports::job::unfit;
use crate::shared::fault::Fault;
use crate::shared::message::Order;
use glidepath_geometry::AxisVector;
use glidepath_link::{EndOfEpoch, FaultCause, JobStage, LinkError};

/// Frames moved in one turn.
const FRAMES_PER_TURN: usize = 64;

impl Ports<'_> {
    /// Passes on what may be played.
    pub(super) fn move_frames(&mut self) -> Result<(), LinkError> {
        let Some(report) = self.report else {
            return Ok(());
        };
        let machine = MachineSnapshot {
            state: report.state,
            position: AxisVector::from(report.setpoint.position),
            epoch: report.setpoint.epoch,
            is_open: report.end_of_epoch == EndOfEpoch::Open,
        };
        self.frame_validator.note(&machine);
        for _ in 0..FRAMES_PER_TURN {
            if !self.ends.frames.ready() {
                return Ok(());
            }
            // Whether a jog begins is known with the next report; a program waits for that.
            let may_jog = self.demanded_after == Some(report.setpoint.number);
            let Some(frame) = (match self.pending.take() {
                Some(frame) => Some(frame),
                None => self.links.frames.take()?,
            }) else {
                return Ok(());
            };
            if may_jog && !machine.is_open {
                self.pending = Some(frame);
                return Ok(());
            }
            match self.frame_validator.judge(&frame, &machine) {
                FrameVerdict::Pass => {
                    if frame.sequence == 0 {
                        self.jobs.begin();
                    }
                    self.book.passed(&frame);
                    self.ends.frames.enqueue(frame).ok(); // There is room: it was ready.
                }
                FrameVerdict::Known => {
                    self.ends.order(Order::PlannerLives);
                }
                FrameVerdict::Later => {
                    self.pending = Some(frame);
                    return Ok(());
                }
                // Nothing is wrong with it, and nobody has to hear of it.
                FrameVerdict::Late => {}
                FrameVerdict::Refused(refusal) => {
                    let cause = FaultCause::Frame(refusal);
                    let text = Fault::new(cause, frame.line, frame.sequence).to_string();
                    if self.jobs.end(JobStage::Refused, &text) {
                        self.give_machine_back();
                    }
                    if self.book.refused(refusal) {
                        self.tell(&format!("epoch {}: {text}", frame.epoch));
                    }
                }
                FrameVerdict::Fault(fault) => {
                    if self.frame_validator.entering(machine.epoch).is_some() {
                        let text = fault.to_string();
                        self.jobs.does_not_begin(JobStage::Refused, &text);
                    }
                    if let FaultCause::Frame(refusal) = fault.cause {
                        self.book.refused(refusal);
                    }
                    self.fault(fault);
                }
            }
        }
        Ok(())
    }

    /// Ends a job that cannot begin any more.
    pub(super) fn watch_job(&mut self, now_ns: u64) -> Result<(), LinkError> {
        let Some(report) = self.report else {
            return Ok(());
        };
        let machine_epoch = report.setpoint.epoch;
        // One that broke on its way begins no more than one that came too late.
        if let Some(epoch) = self.frame_validator.entering(machine_epoch)
            && epoch <= report.barred
        {
            let fault = report.fault.map(|fault| fault.to_string());
            let unfit = unfit(report.state).unwrap_or("the machine was given another order");
            let why = fault.as_deref().unwrap_or(unfit);
            self.jobs.does_not_begin(JobStage::Refused, why);
        }
        self.frame_validator.bar(report.barred);
        let is_opening = self.frame_validator.entering(machine_epoch).is_some();
        if self.jobs.watch(&report, is_opening, now_ns) {
            self.give_machine_back();
        }
        if self.jobs.is_orphaned(&report, now_ns) && report.fault.is_none() {
            let setpoint = &report.setpoint;
            let line = setpoint.line;
            self.fault(Fault::new(FaultCause::PlannerLost, line, setpoint.sequence));
        }
        Ok(())
    }

    /// No job has the machine any more, and the epoch that would have come does not begin.
    fn give_machine_back(&mut self) {
        let machine_epoch = self.report.map_or(0, |report| report.setpoint.epoch);
        let epoch = self.frame_validator.next_epoch(machine_epoch);
        self.frame_validator.bar(epoch);
        // The ring has room for many more orders than there are commands in a turn.
        self.ends.order(Order::Bar(epoch));
        self.ends.order(Order::Prepare(false));
        self.status_due_ns = 0;
    }
}
