//! What a superposition does, in words.

use crate::{FreezeReason, SuperpositionState};

impl SuperpositionState {
    /// The name, as `status` has it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Off => "off",
            Self::Follows => "follows",
            Self::Frozen => "frozen",
            Self::Returns => "returns",
            Self::Silent => "silent",
        }
    }

    /// What it does; empty on a machine without one.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Off => "nothing is added to the motion of the program",
            Self::Follows => "follows its input or wheel",
            Self::Frozen => "stands still",
            Self::Returns => "returns to the program",
            Self::Silent => {
                "stands still, because nobody sends its input: start the servo stack that does"
            }
        }
    }
}

impl FreezeReason {
    /// Why it stands still; empty where it does not.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::None => "",
            Self::NotOnward => "the motion does not go forward along its path",
            Self::Probing => "nothing is added to a probing move",
            Self::FollowsSpindle => "nothing is added to threads and taps",
            Self::Rapid => "nothing is added to rapids",
            Self::Slow => "the motion is slower than its feed",
            Self::NotEnabled => "the input that enables it is off",
            Self::SwitchedOff => "the program has switched it off, and it keeps its offset",
        }
    }
}
