//! The machine states of grbl, which senders know.

use core::fmt;

/// The state of the machine in a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum State {
    Idle,
    Run,
    /// At rest, or still moving.
    Hold {
        is_at_rest: bool,
    },
    Door {
        is_at_rest: bool,
    },
    Jog,
    Home,
    Alarm,
    Check,
    Sleep,
}

impl State {
    /// Whether the axes may move.
    pub(crate) const fn is_busy(self) -> bool {
        matches!(
            self,
            Self::Run | Self::Hold { .. } | Self::Door { .. } | Self::Jog | Self::Home
        )
    }

    /// At rest by a hold or the door.
    pub(crate) const fn is_held(self) -> bool {
        matches!(
            self,
            Self::Hold { is_at_rest: true } | Self::Door { is_at_rest: true }
        )
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Idle => "Idle",
            Self::Run => "Run",
            Self::Hold { is_at_rest: true } => "Hold:0",
            Self::Hold { is_at_rest: false } => "Hold:1",
            Self::Door { is_at_rest: true } => "Door:0",
            Self::Door { is_at_rest: false } => "Door:1",
            Self::Jog => "Jog",
            Self::Home => "Home",
            Self::Alarm => "Alarm",
            Self::Check => "Check",
            Self::Sleep => "Sleep",
        })
    }
}
