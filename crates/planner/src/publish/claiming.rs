//! The publisher's work on its claim: it asks for the machine, says what is being done, and has it
//! done while it looks whether the job still stands.

use std::time::Duration;

use glidepath_gcode::ReadingWatch;
use glidepath_geometry::AxisVector;
use glidepath_link::{JobPhase, JobStage, Status};

use crate::exchange::attend::{Attend, Attended};
use crate::exchange::machine::POLL;
use crate::publish::claim::Claim;
use crate::publish::frame_publisher::FramePublisher;
use crate::run::control::Control;
use crate::run::error::RunError;

impl FramePublisher<'_> {
    /// Tells the interpolator of a job that was asked for at `asked_ns` (of the host's steady clock; 0 if that is not
    /// known). From now on it can be aborted and held there, whatever it is at; so it could before, by who had
    /// asked for it by then.
    pub fn claim(&mut self, name: &str, asked_ns: u64, control: &mut Control<'_>) {
        self.stake(Claim::new(name, asked_ns), control);
    }

    fn stake(&mut self, claim: Claim, control: &mut Control<'_>) {
        let (command, text) = (claim.command(JobPhase::Waiting), claim.text());
        self.claim = Some(claim);
        if self.machine.status().is_some() {
            // One that does not answer now is told again.
            let _told = self.machine.tell_of_job(command, &text, control);
        }
    }

    /// The watch on the reading of the job's program: to be given to whatever reads it.
    #[must_use]
    pub fn watch(&self) -> ReadingWatch {
        let claim = self.claim.as_ref();
        claim.map_or_else(ReadingWatch::default, |claim| claim.watch.clone())
    }

    /// The text of what is being done for the job, for people; empty without one.
    #[must_use]
    pub fn doing(&self) -> String {
        self.claim.as_ref().map(Claim::text).unwrap_or_default()
    }

    /// One look at whether the job has the machine, which it takes as soon as it can be taken. Returns
    /// where the machine stands: it stays there until the job moves it.
    ///
    /// # Errors
    /// The job is ended, a fault is latched, [`RunError::PeriodMismatch`], or a failure of the link.
    pub fn take(&mut self, control: &mut Control<'_>) -> Result<Option<AxisVector>, RunError> {
        self.machine.observe()?;
        let ready = self.ready()?;
        let (Some(status), Some(claim)) = (self.machine.status(), &mut self.claim) else {
            return Ok(None);
        };
        claim.stands(status)?;
        let is_told = status.job_number == claim.number;
        if is_told && status.job_stage() == Ok(JobStage::Preparing) {
            claim.epoch = Some((status.boot_id, status.next_epoch));
            "is being prepared".clone_into(&mut claim.doing);
            return Ok(Some(AxisVector::from(status.position)));
        }
        if ready.is_some() && claim.phase == JobPhase::Waiting {
            let (command, text) = (claim.command(JobPhase::Preparing), claim.text());
            match self.machine.tell_of_job(command, &text, control) {
                Ok(()) => claim.phase = JobPhase::Preparing,
                // The status tells why, or the machine is not ready after all.
                Err(RunError::CommandRefused { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }

    /// Takes the machine, which is known to be ready, for a stream of segments that was asked for at a time (as
    /// [`FramePublisher::claim`] has it), and waits a moment for it.
    ///
    /// # Errors
    /// As [`FramePublisher::take`].
    pub(crate) fn take_for_stream(
        &mut self,
        (asked_ns, patience): (u64, Duration),
        control: &mut Control<'_>,
    ) -> Result<Option<AxisVector>, RunError> {
        self.stake(Claim::of_stream(asked_ns), control);
        let mut waited = Duration::ZERO;
        while waited < patience {
            if let Some(position) = self.take(control)? {
                return Ok(Some(position));
            }
            self.machine.pause(POLL, control);
            waited += POLL;
        }
        self.release(control);
        Ok(None)
    }

    /// Says what is being done for the job from now on.
    pub fn say(&mut self, doing: &str) {
        if let Some(claim) = &mut self.claim
            && claim.doing != doing
        {
            doing.clone_into(&mut claim.doing);
            claim.since_told.end();
        }
    }

    /// Tells the interpolator, now and then, that the job goes on.
    ///
    /// # Errors
    /// The interpolator has ended the job, or the link fails.
    pub(crate) fn tend(&mut self, waited: Duration) -> Result<(), RunError> {
        let Some(claim) = &mut self.claim else {
            return Ok(());
        };
        if claim.since_told.is_over_after(waited) {
            claim.since_told.restart();
            self.machine
                .post(claim.command(claim.phase), &claim.text())?;
        }
        match self.machine.status() {
            Some(status) => claim.stands(status),
            None => Ok(()),
        }
    }

    /// The job is over, or given up: the machine is free.
    pub fn release(&mut self, control: &mut Control<'_>) {
        let Some(claim) = self.claim.take() else {
            return;
        };
        if self.machine.status().is_some() {
            // An interpolator that does not answer ends the job when it hears no more of it.
            let command = claim.command(JobPhase::Over);
            let _told = self.machine.tell_of_job(command, &claim.text(), control);
        }
    }

    /// Has something done in a thread of its own that takes long, while others are attended to. What
    /// reads a program is to have its [`FramePublisher::watch`]: by that it is ended.
    ///
    /// # Errors
    /// The job was ended meanwhile, or no thread is to be had. What was done is dropped.
    pub fn work<T: Send>(
        &mut self,
        doing: &str,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, RunError> {
        self.say(doing);
        let watch = self.watch();
        std::thread::scope(|scope| {
            let thread = std::thread::Builder::new().name("preparing".to_owned());
            let worker = thread
                .spawn_scoped(scope, work)
                .map_err(RunError::NoThread)?;
            let attended = loop {
                if let Err(error) = self.attend_to_work(attend, control) {
                    break Err(error);
                }
                if worker.is_finished() {
                    break Ok(());
                }
                self.machine.pause(POLL, control);
            };
            if attended.is_err() {
                watch.end();
            }
            let done = worker.join();
            attended.and_then(|()| match done {
                Ok(done) => Ok(done),
                Err(panic) => std::panic::resume_unwind(panic),
            })
        })
    }

    fn attend_to_work(
        &mut self,
        attend: &mut dyn Attend,
        control: &Control<'_>,
    ) -> Result<(), RunError> {
        if control.is_stopped() {
            return Err(RunError::Interrupted);
        }
        self.machine.observe()?;
        if let Attended::End(why) = attend.attend(POLL, &self.doing()) {
            return Err(RunError::Ended { why });
        }
        self.tend(POLL)
    }

    /// The number of the first epoch of the job, once.
    pub(crate) fn take_epoch(&mut self, status: &Status) -> Result<Option<u64>, RunError> {
        let taken = self.claim.as_mut().and_then(|claim| claim.epoch.take());
        match taken {
            Some((boot_id, _)) if boot_id != status.boot_id => Err(RunError::InterpolatorLost),
            Some((_, epoch)) => Ok(Some(epoch)),
            None => Ok(None),
        }
    }
}
