//! The interpolator as the planner sees it: its status, and commands to it.

use std::time::Duration;

use glidepath_gcode::Probed;
use glidepath_geometry::AxisVector;
use glidepath_link::{
    Client, Command, CommandReply, CommandRequest, ContactKind, EndOfEpoch, JobStage, LinkError,
    MachineState, Record, Status, Subscriber, Transport, tells_end,
};
use glidepath_program::Override;

use crate::run::control::Control;
use crate::run::error::RunError;

/// Between two looks at the status.
pub(crate) const POLL: Duration = Duration::from_millis(2);

/// The same while the planner waits for items, so that a client's requests flow.
pub(crate) const HUNGRY_POLL: Duration = Duration::from_micros(200);

/// An interpolator that has not updated its status for so long is gone. It does so every few ticks.
pub(crate) const SILENCE: Duration = Duration::from_secs(3);

/// How long a command may wait for its answer.
const COMMAND_PATIENCE: Duration = Duration::from_secs(2);

/// Why an epoch does not begin of which nobody says why.
const GIVEN_AWAY: &str = "the machine was given to something else before the first frame came";

/// How the epoch of this planner stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Standing {
    /// Its first frame has not been accepted yet.
    NotStarted,
    /// It goes on.
    Open {
        /// Frames executed.
        executed: u64,
        /// Frames received, those included.
        received: u64,
        /// The machine rests because these frames are too few.
        starved: bool,
    },
    /// The last frame was executed.
    Completed,
    /// The probe found what it looked for, and the rest was left out.
    Tripped,
}

/// Status and command ports, and what was last heard.
pub(crate) struct MachinePorts {
    status: Box<dyn Subscriber<Status>>,
    commands: Box<dyn Client<CommandRequest, CommandReply>>,
    latest: Option<Status>,
    /// Whether a status was heard that is newer than the first, which may be a dead process'
    /// legacy.
    alive: bool,
    /// Time waited since the last news.
    silent: Duration,
    client: u64,
    commands_sent: u64,
}

impl std::fmt::Debug for MachinePorts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MachinePorts")
            .field("latest", &self.latest)
            .field("alive", &self.alive)
            .finish_non_exhaustive()
    }
}

impl MachinePorts {
    pub(crate) fn connect(transport: &dyn Transport) -> Result<Self, LinkError> {
        Ok(Self {
            status: transport.status_source()?,
            commands: transport.command_client()?,
            latest: None,
            alive: false,
            silent: Duration::ZERO,
            client: u64::from(std::process::id()),
            commands_sent: 0,
        })
    }

    /// Takes in the newest status.
    pub(crate) fn observe(&mut self) -> Result<(), LinkError> {
        while let Some(status) = self.status.take()? {
            status.check()?;
            let before = self
                .latest
                .map(|latest| (latest.boot_id, latest.updated_ns));
            if before.is_some_and(|before| before != (status.boot_id, status.updated_ns)) {
                self.alive = true;
                self.silent = Duration::ZERO;
            }
            self.latest = Some(status);
        }
        Ok(())
    }

    /// Waits a little, and counts it as silence until the next news.
    pub(crate) fn pause(&mut self, time: Duration, control: &mut Control<'_>) {
        (control.pause)(time);
        self.count_silence(time);
    }

    /// Counts time that was waited otherwise.
    pub(crate) fn count_silence(&mut self, time: Duration) {
        self.silent = self.silent.saturating_add(time);
        if self.silent >= SILENCE {
            self.alive = false;
        }
    }

    /// The last status of an interpolator that lives.
    pub(crate) fn status(&self) -> Option<&Status> {
        self.latest.as_ref().filter(|_| self.alive)
    }

    /// The override to plan with, if one was commanded that can be planned with, whichever way the
    /// motion goes. An override of zero cannot: the interpolator holds the motion then.
    pub(crate) fn wanted_override(&self) -> Option<Override> {
        let status = self.status()?;
        let (feed_r, rapid_r) = (status.feed_override.abs(), status.rapid_override.min(1.0));
        (feed_r > 0.0 && rapid_r > 0.0).then_some(Override { feed_r, rapid_r })
    }

    /// How the epoch stands, or why it is over before its end.
    pub(crate) fn standing(
        &self,
        boot_id: u64,
        epoch: u64,
        (started, goes_on): (bool, bool),
    ) -> Result<Standing, RunError> {
        let status = self.status().ok_or(RunError::InterpolatorLost)?;
        if status.boot_id != boot_id {
            return Err(RunError::InterpolatorLost);
        }
        let state = status.state().map_err(LinkError::from)?;
        let end = status.end_of_epoch().map_err(LinkError::from)?;
        if state == MachineState::Faulted || (status.epoch == epoch && end == EndOfEpoch::Faulted) {
            return Err(RunError::fault(status));
        }
        if status.epoch < epoch && status.next_epoch > epoch {
            // Its number was used up: it does not begin any more.
            return Err(why_not_begun(status, end));
        }
        if status.epoch != epoch {
            // Another epoch in the middle of ours means that somebody ended ours and started again.
            // So does an abort of the epoch before, behind which the program was to go on.
            let is_ended = end == EndOfEpoch::Aborted && goes_on;
            return if is_ended {
                Err(aborted(status))
            } else if started {
                Err(RunError::Aborted)
            } else {
                Ok(Standing::NotStarted)
            };
        }
        match end {
            EndOfEpoch::Completed => Ok(Standing::Completed),
            EndOfEpoch::Tripped => Ok(Standing::Tripped),
            EndOfEpoch::Aborted => Err(aborted(status)),
            EndOfEpoch::None | EndOfEpoch::Open | EndOfEpoch::Faulted => Ok(Standing::Open {
                executed: status.frames_executed,
                received: status.frames_received,
                starved: state == MachineState::Starved,
            }),
        }
    }

    /// Where the machine stands, if it is ready for a new epoch.
    pub(crate) fn ready_position(&self) -> Option<AxisVector> {
        let status = self.status()?;
        let idle = status.state() == Ok(MachineState::Idle);
        idle.then(|| AxisVector::from(status.position))
    }

    /// What the probe has found in the present or last epoch, for a machine that stands there.
    pub(crate) fn probed(&self, stands: AxisVector) -> Result<Probed, RunError> {
        let status = self.status().ok_or(RunError::InterpolatorLost)?;
        let kind = status.contact().map_err(LinkError::from)?;
        Ok(Probed {
            contact: (kind != ContactKind::None).then(|| AxisVector::from(status.contact)),
            was_so: kind == ContactKind::AlreadySo,
            stands,
        })
    }

    /// Path position, mm.
    pub(crate) fn path_s(&self) -> f64 {
        self.status().map_or(0.0, |status| status.path_s)
    }

    /// Number of the item being executed, 0 if unknown.
    pub(crate) fn block(&self) -> u32 {
        self.status().map_or(0, |status| status.block)
    }

    /// Source line being executed, 0 if unknown.
    pub(crate) fn line(&self) -> u32 {
        self.status().map_or(0, |status| status.line)
    }

    /// Has shown, to whoever looks at the machine, what the program says.
    pub(crate) fn tell(&mut self, text: &str, control: &mut Control<'_>) -> Result<(), RunError> {
        self.ask(Command::Tell, text, control)
    }

    /// Sends a command and waits for the answer.
    pub(crate) fn command(
        &mut self,
        command: Command,
        control: &mut Control<'_>,
    ) -> Result<(), RunError> {
        self.ask(command, "", control)
    }

    /// Tells of a job, and waits for the answer.
    pub(crate) fn tell_of_job(
        &mut self,
        command: Command,
        text: &str,
        control: &mut Control<'_>,
    ) -> Result<(), RunError> {
        self.ask(command, text, control)
    }

    /// Sends a command whose answer is not waited for. One that cannot be sent now is left out.
    pub(crate) fn post(&mut self, command: Command, text: &str) -> Result<(), LinkError> {
        while let Ok(Some(_)) = self.commands.reply() {}
        self.commands_sent += 1;
        let request = CommandRequest::new(self.client, self.commands_sent, command).saying(text);
        match self.commands.ask(&request) {
            Err(LinkError::NoServer { .. } | LinkError::TooManyRequests { .. }) => Ok(()),
            sent => sent,
        }
    }

    fn ask(
        &mut self,
        command: Command,
        text: &str,
        control: &mut Control<'_>,
    ) -> Result<(), RunError> {
        self.commands_sent += 1;
        let number = self.commands_sent;
        let request = CommandRequest::new(self.client, number, command).saying(text);
        let (mut waited, mut is_sent) = (Duration::ZERO, false);
        while waited < COMMAND_PATIENCE {
            if !is_sent {
                is_sent = match self.commands.ask(&request) {
                    // An interpolator that hangs has left so many: it is silent, no more.
                    Err(LinkError::TooManyRequests { .. }) => false,
                    sent => sent.map(|()| true)?,
                };
            }
            while let Some(reply) = self.commands.reply()? {
                if reply.number == number {
                    return match reply.outcome().map_err(LinkError::from)? {
                        Ok(()) => Ok(()),
                        Err(refusal) => Err(RunError::CommandRefused {
                            command: command.kind(),
                            why: reply.why(refusal),
                        }),
                    };
                }
            }
            (control.pause)(POLL);
            waited += POLL;
        }
        Err(RunError::CommandUnanswered {
            command: command.kind(),
        })
    }
}

/// Who ended an epoch that was aborted.
pub(crate) fn aborted(status: &Status) -> RunError {
    // Of a job that ended while its first frame was on the way the end of the job tells.
    let told = match status.job_stage() {
        Ok(JobStage::Refused) => status.job_end.as_str(),
        _ => status.last_error.as_str(),
    };
    if tells_end(told) {
        return RunError::Ended {
            why: told.to_owned(),
        };
    }
    RunError::Aborted
}

/// Why the next epoch does not begin.
fn why_not_begun(status: &Status, end: EndOfEpoch) -> RunError {
    match status.job_stage() {
        Ok(JobStage::Aborted) => RunError::Aborted,
        Ok(JobStage::Refused) => RunError::NotBegun {
            why: status.job_end.as_str().to_owned(),
        },
        Ok(
            JobStage::None
            | JobStage::Waiting
            | JobStage::Preparing
            | JobStage::Begun
            | JobStage::Over,
        )
        | Err(_) => {
            if end == EndOfEpoch::Aborted {
                return aborted(status);
            }
            let told = status.last_error.as_str();
            let why = if told.is_empty() { GIVEN_AWAY } else { told };
            RunError::NotBegun {
                why: why.to_owned(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::InProcess;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn an_interpolator_that_never_answers_is_silent_however_often_it_is_asked() {
        let transport = InProcess::default();
        let _never_served = transport.command_server().unwrap();
        let mut machine = MachinePorts::connect(&transport).unwrap();
        let stop = AtomicBool::new(false);
        let mut control = Control {
            stop: &stop,
            pause: &mut |_| {},
            notify: &mut |_| {},
        };
        for _ in 0..64 {
            let asked = machine.command(Command::Ping, &mut control);
            assert!(
                matches!(asked, Err(RunError::CommandUnanswered { .. })),
                "{asked:?}"
            );
        }
    }
}
