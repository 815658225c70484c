//! The interpolator as `run` sees it: its status, and the few commands `run` gives.

use crate::command::failure::Failure;
use crate::command::operator;
use glidepath_link::{
    Command, EventId, LinkConfig, LinkError, MachineState, Power, Record as _, Status, Subscriber,
    Transport,
};
use glidepath_program::Event;

pub(super) struct Monitor<'t> {
    link: &'t LinkConfig,
    source: Box<dyn Subscriber<Status>>,
    status: Option<Status>,
    /// The epoch and frame of the program stop that was resumed last.
    resumed: Option<(u64, u64)>,
    /// The tool change that was answered last.
    changed: Option<EventId>,
}

impl<'t> Monitor<'t> {
    pub(super) fn new(transport: &dyn Transport, link: &'t LinkConfig) -> Result<Self, Failure> {
        let source = transport.status_source()?;
        Ok(Self {
            link,
            source,
            status: None,
            resumed: None,
            changed: None,
        })
    }

    /// Takes in the newest status.
    pub(super) fn observe(&mut self) -> Result<(), Failure> {
        while let Some(status) = self.source.take()? {
            status.check().map_err(LinkError::from)?;
            self.status = Some(status);
        }
        Ok(())
    }

    /// The newest status, `None` before the first.
    pub(super) const fn status(&self) -> Option<&Status> {
        self.status.as_ref()
    }

    fn state(&self) -> Option<MachineState> {
        self.status.as_ref().and_then(|status| status.state().ok())
    }

    /// True if the machine cannot move any more.
    pub(super) fn rests(&self) -> bool {
        matches!(
            self.state(),
            None | Some(
                MachineState::Idle
                    | MachineState::Preparing
                    | MachineState::Faulted
                    | MachineState::Off
                    | MachineState::NotHomed
            )
        )
    }

    /// Switches drives on that answer, and has them find their home. True when the machine is ready.
    pub(super) fn switch_on(&self) -> Result<bool, Failure> {
        let Some(status) = self.status else {
            return Ok(false);
        };
        let state = self.state();
        if matches!(state, Some(MachineState::Idle | MachineState::Preparing)) {
            return Ok(true);
        }
        let command = if state == Some(MachineState::Off) && status.power() == Ok(Power::Off) {
            Command::Enable
        } else if state == Some(MachineState::NotHomed) {
            Command::Home(status.joints)
        } else {
            return Ok(false);
        };
        // Refused while the drives have not yet said where they are: then the next one tells.
        operator::send(&operator::reach(self.link)?, self.link, command)?;
        Ok(false)
    }

    /// Goes on after a program stop; returns its line the first time it is seen.
    pub(super) fn resume_program_stop(&mut self) -> Result<Option<u32>, Failure> {
        let Some(status) = self
            .status
            .filter(|_| self.state() == Some(MachineState::ProgramStop))
        else {
            return Ok(None);
        };
        let at = (status.epoch, status.frames_executed);
        if self.resumed == Some(at) {
            return Ok(None);
        }
        let reply = operator::send(&operator::reach(self.link)?, self.link, Command::Resume)?;
        // Refused if the status was older than the state: then the next one tells.
        let accepted = reply.outcome().map_err(LinkError::from)?.is_ok();
        self.resumed = accepted.then_some(at);
        Ok(accepted.then_some(status.line))
    }

    /// Answers a tool change, which nobody does here; returns its line the first time it is seen.
    pub(super) fn pass_tool_change(&mut self) -> Result<Option<u32>, Failure> {
        let is_change = |status: &Status| {
            status.state() == Ok(MachineState::Awaiting)
                && matches!(status.awaited_event(), Ok(Some(Event::MCode(6))))
        };
        let Some(status) = self.status.filter(is_change) else {
            return Ok(None);
        };
        let event = EventId {
            boot_id: status.boot_id,
            epoch: status.epoch,
            sequence: status.awaited_sequence,
        };
        if self.changed == Some(event) {
            return Ok(None);
        }
        let command = Command::Acknowledge { event, done: true };
        let reply = operator::send(&operator::reach(self.link)?, self.link, command)?;
        // Refused if the status was older than the state: then the next one tells.
        let accepted = reply.outcome().map_err(LinkError::from)?.is_ok();
        self.changed = accepted.then_some(event);
        Ok(accepted.then_some(status.awaited_line))
    }

    /// Brings the machine to rest on the path, and drops the rest of the program.
    pub(super) fn abort(&self) -> Result<(), Failure> {
        // Refused if the machine rests already.
        operator::send(&operator::reach(self.link)?, self.link, Command::Abort).map(|_| ())
    }
}
