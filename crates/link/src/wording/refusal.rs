//! Refusals: one sentence that says why, and what to do.

use crate::record::{CommandKind, CommandRefusal, CommandReply, SegmentRefusal};

/// The sentence of a refusal.
#[must_use]
pub fn refused(command: &str, why: &str) -> String {
    format!("{command} refused: {why}")
}

impl CommandKind {
    /// The name, as it is typed.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ping => "ping",
            Self::Hold => "hold",
            Self::Resume => "resume",
            Self::FeedOverride
            | Self::RapidOverride
            | Self::JogOverride
            | Self::SpindleOverride => "override",
            Self::Abort => "abort",
            Self::StopAtEndOfBlock => "stop-at-block-end",
            Self::SingleBlock => "single-block",
            Self::Reset => "reset",
            Self::Step => "step",
            Self::Enable => "enable",
            Self::Disable => "disable",
            Self::SetPosition => "set-position",
            Self::Home => "home",
            Self::Unhome => "unhome",
            Self::Return => "return",
            Self::Acknowledge => "acknowledge",
            Self::Tell => "tell",
            Self::Reverse => "reverse",
            Self::Forward => "forward",
            Self::Job => "job",
        }
    }
}

impl CommandRefusal {
    /// Why, where nothing more is known.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Malformed => "the command is malformed",
            Self::Unsupported => "this version cannot do that",
            Self::WrongState => "it is not possible as things are",
            Self::Busy => "too many commands came at once; ask again",
            Self::ShuttingDown => "the interpolator is ending",
        }
    }
}

impl CommandReply {
    /// The reason why the command was refused, as text.
    #[must_use]
    pub fn why(&self, refusal: CommandRefusal) -> String {
        let said = self.message.as_str();
        match refusal {
            CommandRefusal::WrongState if !said.is_empty() => said.to_owned(),
            CommandRefusal::Malformed if !said.is_empty() => {
                format!("{}: {said}", refusal.text())
            }
            CommandRefusal::WrongState
            | CommandRefusal::Malformed
            | CommandRefusal::Unsupported
            | CommandRefusal::Busy
            | CommandRefusal::ShuttingDown => refusal.text().to_owned(),
        }
    }
}

impl SegmentRefusal {
    /// Why, where nothing more is known.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Busy => "another client's stream is executed",
            Self::NotOpen => "the stream is not open",
            Self::OutOfOrder => "a request before it is missing",
            Self::NoCredit => "the planner has no room; ask again",
            Self::Malformed => "the request is malformed",
            Self::Discontinuous => "it does not begin where the one before it ends",
            Self::SoftLimit => "it leaves the soft limits",
            Self::Unplannable => "it cannot be planned",
            Self::Stopped => "the machine stopped",
            Self::ShuttingDown => "the planner is ending",
            Self::Aborted => "the machine was stopped after the stream was asked for; start again",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::MachineState;
    use crate::wording::UnmetPrecondition;

    fn reply(refusal: CommandRefusal, message: &str) -> CommandReply {
        CommandReply::new(1, 1, Err(refusal), MachineState::Idle, message)
    }

    #[test]
    fn a_refusal_is_one_sentence() {
        let why = UnmetPrecondition::NoPathBack.text();
        let reply = reply(CommandRefusal::WrongState, why);
        let told = refused(
            CommandKind::Reverse.name(),
            &reply.why(CommandRefusal::WrongState),
        );
        assert_eq!(
            told,
            "reverse refused: no program runs, so there is no path to go back along"
        );
    }

    #[test]
    fn what_is_known_by_its_code_alone_has_a_text() {
        for refusal in CommandRefusal::ALL {
            assert_eq!(reply(*refusal, "").why(*refusal), refusal.text());
        }
        let busy = reply(CommandRefusal::Busy, CommandRefusal::Busy.text());
        assert_eq!(
            busy.why(CommandRefusal::Busy),
            CommandRefusal::Busy.text(),
            "nothing is told twice"
        );
    }
}
