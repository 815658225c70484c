//! The job of a planner, from when it was accepted to its first frame.
//!
//! Reading, checking and planning take from a tenth of a second to many seconds, in another process.
//! What an operator wants meanwhile must hold for the motion that comes of it, whenever it comes. So
//! it is settled here, where every operator's command arrives and where every frame has to pass, and
//! not in the planner, which may be stopped, busy or dead when the command is given:
//!
//! * **An abort uses up the number of the next epoch** ([`crate::ports::frame_validation::FrameValidator::bar`]). The
//!   planner was given that number when its job took the machine, and has no other. Frames that
//!   carry it are refused from then on, also by the real-time thread, where they may be under way;
//!   there is no moment at which an abort comes between two looks of the planner.
//! * **A hold is in force when the first frame comes**: the real-time thread keeps it from then on.
//! * **Whatever makes the machine unfit for a program ends the job**, and so does a first frame that is
//!   refused: the planner is told by the status why its epoch does not begin.
//! * **A planner of which nothing is heard** is taken for dead; its job does not begin, and one that rests under way
//!   does not go on: what is known of it would be driven, and then the machine would stand anywhere.
//! * **A planner that hung tells of a job late.** Whoever asked for it said when. A stop after that counts for it.
//!
//! While a job has the machine, nothing else moves it.

use crate::shared::message::TickReport;
use glidepath_link::{EndOfEpoch, JobPhase, JobStage, MachineState, Status, Text};

/// A planner that has not told of its job for so long is taken for dead, ns.
const SILENCE_NS: u64 = 3_000_000_000;

/// The outcome of telling of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Told {
    /// Nothing new for anybody else.
    Nothing,
    /// The job takes the machine.
    Takes,
    /// It gives the machine back, and begins no epoch.
    GivesBack,
}

/// The job told of last.
#[derive(Debug)]
pub(crate) struct JobBook {
    number: u64,
    stage: JobStage,
    /// It is to begin held.
    is_held: bool,
    is_stream: bool,
    heard_ns: u64,
    text: Text,
    /// Why it does not begin.
    end: Text,
    /// When an abort, or the loss of power, was ordered last, ns: what was asked for before does not begin.
    stopped_ns: u64,
    /// How that ends such a job, and why.
    stopped_by: (JobStage, Text),
    /// When a hold was ordered last with nothing to hold, ns: what was asked for before begins held.
    held_ns: u64,
    /// When any hold was ordered last, ns.
    any_hold_ns: u64,
}

impl JobBook {
    pub(crate) fn new() -> Self {
        Self {
            number: 0,
            stage: JobStage::None,
            is_held: false,
            is_stream: false,
            heard_ns: 0,
            text: Text::default(),
            end: Text::default(),
            stopped_ns: 0,
            stopped_by: (JobStage::Aborted, Text::default()),
            held_ns: 0,
            any_hold_ns: 0,
        }
    }

    /// Whether it has the machine, and no frame of it has come.
    pub(crate) fn has_machine(&self) -> bool {
        self.stage == JobStage::Preparing
    }

    /// Whether it has not begun, and may yet.
    pub(crate) fn is_to_come(&self) -> bool {
        matches!(self.stage, JobStage::Waiting | JobStage::Preparing)
    }

    pub(crate) const fn is_held(&self) -> bool {
        self.is_held
    }

    /// What the machine does, with the job taken into account.
    pub(crate) fn state(&self, report: &TickReport) -> MachineState {
        if self.has_machine() && report.state == MachineState::Idle {
            MachineState::Preparing
        } else {
            report.state
        }
    }

    /// A planner tells of a job. `free`: whether the machine can be taken now.
    ///
    /// # Errors
    /// Why the job cannot be what the planner says that it is.
    pub(crate) fn tell(
        &mut self,
        (number, phase, asked_ns): (u64, JobPhase, u64),
        text: Text,
        now_ns: u64,
        free: Result<(), &'static str>,
    ) -> Result<Told, String> {
        let had_machine = self.has_machine();
        if number != self.number {
            if phase == JobPhase::Over {
                return Ok(Told::Nothing);
            }
            self.take_up(number, asked_ns);
            if had_machine {
                // There is one planner at a time: that of the job before is no more.
                (self.heard_ns, self.text) = (now_ns, text);
                return Ok(Told::GivesBack);
            }
        }
        (self.heard_ns, self.text) = (now_ns, text);
        match (self.stage, phase) {
            (JobStage::Aborted | JobStage::Refused, JobPhase::Over) => Ok(Told::Nothing),
            (JobStage::Aborted | JobStage::Refused, _) => Err(self.end.as_str().to_owned()),
            (_, JobPhase::Over) => {
                (self.stage, self.is_held) = (JobStage::Over, false);
                Ok(if had_machine {
                    Told::GivesBack
                } else {
                    Told::Nothing
                })
            }
            (JobStage::Waiting, JobPhase::Preparing) => {
                free?;
                self.stage = JobStage::Preparing;
                Ok(Told::Takes)
            }
            (JobStage::None | JobStage::Over, _) => Err("that job is over".to_owned()),
            (JobStage::Waiting | JobStage::Preparing | JobStage::Begun, _) => Ok(Told::Nothing),
        }
    }

    /// A job that was not heard of before. Its planner may have hung since somebody asked for it.
    fn take_up(&mut self, number: u64, asked_ns: u64) {
        let is_before = |stop_ns| asked_ns != 0 && asked_ns < stop_ns;
        let (stage, end) = if is_before(self.stopped_ns) {
            match self.stopped_by {
                (JobStage::Aborted, _) => {
                    let why = "the machine was stopped after this was asked for, and before its planner told of it";
                    (JobStage::Aborted, Text::new(why))
                }
                by => by,
            }
        } else {
            (JobStage::Waiting, Text::default())
        };
        *self = Self {
            number,
            stage,
            end,
            is_held: stage == JobStage::Waiting && is_before(self.held_ns),
            stopped_ns: self.stopped_ns,
            stopped_by: self.stopped_by,
            held_ns: self.held_ns,
            any_hold_ns: self.any_hold_ns,
            ..Self::new()
        };
    }

    /// Whether it is a stream of segments.
    pub(crate) fn note_stream(&mut self, number: u64, is_stream: bool) {
        if self.number == number {
            self.is_stream = is_stream;
        }
    }

    /// An abort, or the power is taken: so end jobs that were asked for before, and for this reason.
    pub(crate) fn stop(&mut self, now_ns: u64, (stage, why): (JobStage, &str)) {
        (self.stopped_ns, self.stopped_by) = (now_ns, (stage, Text::new(why)));
    }

    /// A hold; `is_open`: there was a program to hold, so that it does not count for one to come.
    pub(crate) fn hold_what_was_asked(&mut self, now_ns: u64, is_open: bool) {
        self.any_hold_ns = now_ns;
        if !is_open {
            self.held_ns = now_ns;
        }
    }

    /// Whether the machine was brought to rest after something was asked for; 0 if nobody knows when.
    pub(crate) fn was_stopped_after(&self, asked_ns: u64) -> bool {
        asked_ns != 0 && asked_ns < self.stopped_ns.max(self.any_hold_ns)
    }

    /// A hold, or the end of one, for the job that is to come.
    pub(crate) fn hold(&mut self, is_held: bool) {
        if self.is_to_come() {
            self.is_held = is_held;
        }
    }

    /// The job does not begin. Returns whether it had the machine.
    pub(crate) fn end(&mut self, stage: JobStage, why: &str) -> bool {
        let had_machine = self.has_machine();
        if self.is_to_come() {
            (self.stage, self.is_held, self.end) = (stage, false, Text::new(why));
        }
        had_machine
    }

    /// Its first frame was accepted.
    pub(crate) fn begin(&mut self) {
        if self.has_machine() {
            (self.stage, self.is_held) = (JobStage::Begun, false);
        }
    }

    /// The frame that was accepted does not begin an epoch, after all.
    pub(crate) fn does_not_begin(&mut self, stage: JobStage, why: &str) {
        if self.stage == JobStage::Begun {
            (self.stage, self.end) = (stage, Text::new(why));
        }
    }

    /// Looks whether the job may still begin. Returns why not, if it may not any more, and whether it
    /// had the machine.
    pub(crate) fn watch(&mut self, report: &TickReport, is_opening: bool, now_ns: u64) -> bool {
        if self.is_to_come() && now_ns > self.heard_ns.saturating_add(SILENCE_NS) {
            return self.end(JobStage::Refused, "its planner has fallen silent");
        }
        if self.has_machine()
            && let Some(why) = unfit(report.state)
        {
            let fault = report.fault.map(|fault| fault.to_string());
            return self.end(JobStage::Refused, fault.as_deref().unwrap_or(why));
        }
        let is_open = report.end_of_epoch == EndOfEpoch::Open || is_opening;
        if self.stage == JobStage::Begun && !is_open && report.state != MachineState::Waiting {
            self.stage = JobStage::Over;
        }
        false
    }

    /// Whether the job rests under way, and its planner has fallen silent. In motion that is found by the frames.
    pub(crate) fn is_orphaned(&self, report: &TickReport, now_ns: u64) -> bool {
        use MachineState::{Awaiting, Held, ProgramStop};
        self.stage == JobStage::Begun
            && report.end_of_epoch == EndOfEpoch::Open
            && matches!(report.state, Held | ProgramStop | Awaiting)
            && now_ns > self.heard_ns.saturating_add(SILENCE_NS)
    }

    pub(crate) fn write(&self, status: &mut Status) {
        status.job_number = self.number;
        status.job_stage = self.stage.code();
        status.job_held = self.is_held.into();
        status.job_stream = self.is_stream.into();
        (status.job, status.job_end) = (self.text, self.end);
    }
}

/// Why no program can begin in a state.
pub(crate) const fn unfit(state: MachineState) -> Option<&'static str> {
    if matches!(state, MachineState::Idle | MachineState::Preparing) {
        return None;
    }
    Some(state.text())
}

#[cfg(test)]
mod tests;
