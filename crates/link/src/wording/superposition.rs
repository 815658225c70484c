//! What a superposition does, in words.

use crate::SuperpositionState;

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
            Self::Frozen => {
                "stands still: the motion is slow, at rest, rapid, or of a kind that nothing is added to, or the input \
                 that enables it is off"
            }
            Self::Returns => "returns to the program",
            Self::Silent => {
                "stands still, because nobody sends its input: start the servo stack that does"
            }
        }
    }
}
