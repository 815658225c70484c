//! States: their names, which scripts compare, and what the machine does in them.

use super::AtRest;
use crate::record::{EndOfEpoch, MachineState, MotionMode, Power, RecordError, Status};
use core::fmt;

/// The text of what ended a motion, or a job, where an operator took the power from the drives. The
/// status' last error has it for the motion that was ended so.
pub const SWITCHED_OFF: &str = "the drives were switched off";
/// The same where the interpolator was told to end.
pub const TOLD_TO_END: &str = "the interpolator was told to end";
/// The same where `disable` was given to a machine that has no power to lose.
pub const DISABLED: &str = "`disable` ended it";
/// The same where the command that asked for the motion was ended (Ctrl-C).
pub const CALLED_OFF: &str = "the command that asked for it was ended";

/// Whether a text is one of those, which tell what ended a motion, or a job.
#[must_use]
pub fn tells_end(text: &str) -> bool {
    [SWITCHED_OFF, TOLD_TO_END, DISABLED, CALLED_OFF].contains(&text)
}

impl MachineState {
    /// The name, as `status` and recordings have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Idle => "idle",
            Self::Running => "running",
            Self::Holding => "holding",
            Self::Held => "held",
            Self::Starving => "starving",
            Self::Starved => "starved",
            Self::ProgramStop => "program-stop",
            Self::Stopping => "stopping",
            Self::Faulted => "faulted",
            Self::Waiting => "waiting",
            Self::Awaiting => "awaiting",
            Self::Jogging => "jogging",
            Self::Homing => "homing",
            Self::Off => "off",
            Self::NotHomed => "not-homed",
            Self::Preparing => "preparing",
        }
    }

    /// The text of the state: what the machine does, and what goes on from there where somebody has
    /// to do it.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Idle => "at rest, ready for a program",
            Self::Running => "the program runs",
            Self::Holding => {
                "coming to rest on the path, for a hold, for an override of 0 %, or to turn round; a pass that \
                 follows the spindle (thread, tap) comes to its end first"
            }
            Self::Held => "held at rest on the path; `glidepath resume` goes on",
            Self::Starving => {
                "slowing down on the path, because the plan does not come fast enough"
            }
            Self::Starved => {
                "at rest on the path until the planner sends more; it goes on by itself when more comes"
            }
            Self::ProgramStop => {
                "at rest at a stop of the program, or at the end of a block; `glidepath resume` goes on"
            }
            Self::Stopping => {
                "coming to rest on the path; the rest of the program is dropped; after an abort a pass that follows \
                 the spindle (thread, tap) comes to its end first"
            }
            Self::Faulted => "at rest by a fault, which stays until `glidepath reset`",
            Self::Waiting => {
                "at rest where the program known so far ends; it goes on by itself when more comes"
            }
            Self::Awaiting => "at rest until what the program asked for is done",
            Self::Jogging => "moved by hand; `glidepath hold` ends it",
            Self::Homing => "joints are on their way home; `glidepath abort` ends it",
            Self::Off => "the drives have no power; `glidepath enable` gives it",
            Self::NotHomed => "joints are not homed; `glidepath home` has them find where they are",
            Self::Preparing => "at rest; a job has the machine, and is read, checked and planned",
        }
    }
}

impl Status {
    /// What the machine does, with what of it the state alone does not tell.
    ///
    /// # Errors
    ///
    /// A state that this version does not know.
    pub fn state_text(&self) -> Result<&'static str, RecordError> {
        let state = self.state()?;
        Ok(AtRest::of(state, self).map_or_else(|| state.text(), AtRest::text))
    }
}

impl Power {
    /// The name, as `status` has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Simulated => "simulated",
            Self::Off => "off",
            Self::Enabling => "enabling",
            Self::On => "on",
        }
    }
}

impl MotionMode {
    /// The name, as `status` has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Program => "program",
            Self::Jog => "jog",
            Self::Homing => "homing",
            Self::Return => "return",
            Self::Backwards => "backwards",
        }
    }
}

impl EndOfEpoch {
    /// The name, as `status` has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Open => "open",
            Self::Completed => "completed",
            Self::Aborted => "aborted",
            Self::Faulted => "faulted",
            Self::Tripped => "tripped",
        }
    }
}

/// A change of state, as the log tells it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StateChange {
    /// The state before.
    pub from: MachineState,
    /// The state since then.
    pub to: MachineState,
    /// Source line that was executed, 0 if there was none.
    pub line: u32,
}

impl StateChange {
    /// Whether a line of the log tells a change of state.
    #[must_use]
    pub fn is_told_in(text: &str) -> bool {
        text.contains(BEFORE)
    }
}

/// Between the state and the one before.
const BEFORE: &str = ", before that ";

impl fmt::Display for StateChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{BEFORE}{}", self.to.name(), self.from.name())?;
        if self.line > 0 {
            write!(f, ", line {}", self.line)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_have_names_and_texts_of_their_own() {
        for (i, state) in MachineState::ALL.iter().enumerate() {
            for other in &MachineState::ALL[..i] {
                assert_ne!(state.name(), other.name());
                assert_ne!(state.text(), other.text());
            }
        }
    }

    #[test]
    fn a_change_of_state_is_told_with_names_and_known_again() {
        let mut change = StateChange {
            from: MachineState::Starved,
            to: MachineState::Faulted,
            line: 12,
        };
        assert_eq!(change.to_string(), "faulted, before that starved, line 12");
        assert!(StateChange::is_told_in(&change.to_string()));
        change.line = 0;
        assert_eq!(change.to_string(), "faulted, before that starved");
        assert!(!StateChange::is_told_in("2 ticks were missed"));
    }
}
