//! The answer to a command, from the interpolator to who asked.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{MachineState, Record, Text};
use iceoryx2::prelude::ZeroCopySend;

coded! {
    /// The reason why a command was refused.
    pub enum CommandRefusal {
        /// Unknown command or argument out of range; the text says which.
        Malformed = 1,
        /// Known, but not built in this version.
        Unsupported = 2,
        /// Not possible in the present state.
        WrongState = 3,
        /// Too many commands at once; ask again.
        Busy = 4,
        /// The interpolator is ending.
        ShuttingDown = 5,
    }
}

/// The answer to a command.
pub type CommandOutcome = Result<(), CommandRefusal>;

/// The answer on its way back.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.CommandReply.v3")]
pub struct CommandReply {
    /// The life of the interpolator that answers.
    pub boot_id: u64,
    /// The number of the request.
    pub number: u64,
    /// Code of a [`CommandRefusal`], 0 if the command was accepted.
    pub refusal: u32,
    /// Code of the [`MachineState`] when the answer was given.
    pub state: u32,
    /// More about a refusal, for people.
    pub message: Text,
}

impl CommandReply {
    /// The record of an answer.
    #[must_use]
    pub fn new(
        boot_id: u64,
        number: u64,
        outcome: CommandOutcome,
        state: MachineState,
        message: &str,
    ) -> Self {
        Self {
            boot_id,
            number,
            refusal: outcome.err().map_or(0, CommandRefusal::code),
            state: state.code(),
            message: Text::new(message),
        }
    }

    /// The answer.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn outcome(&self) -> Result<CommandOutcome, RecordError> {
        match self.refusal {
            0 => Ok(Ok(())),
            code => Fields(Self::NAME).code("refusal", code).map(Err),
        }
    }

    /// The state when the answer was given.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn state(&self) -> Result<MachineState, RecordError> {
        Fields(Self::NAME).code("state", self.state)
    }
}

impl Record for CommandReply {
    const NAME: &'static str = "glidepath.CommandReply.v3";

    fn check(&self) -> Result<(), RecordError> {
        self.outcome()?.ok();
        self.state()?;
        self.message.check(Self::NAME, "message")
    }
}
