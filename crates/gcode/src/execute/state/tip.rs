//! The meaning of X, Y and Z in a program for a machine with five axes.

use serde::{Deserialize, Serialize};

/// What the coordinates X, Y and Z are of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tip {
    /// Of the tip of the tool, on the work: the machine follows its rotary axes (G43.4, TRAORI, a tilted
    /// plane; LinuxCNC's programs at all times). The tool is that much longer, mm, than the one the
    /// kinematics know.
    Follows {
        /// How much longer, mm.
        longer_mm: f64,
    },
    /// Of the machine's linear axes, counted so that they are those of the tip while the rotary axes
    /// stand at zero.
    Stands,
}

impl Default for Tip {
    fn default() -> Self {
        Self::PLAIN
    }
}

impl Tip {
    /// The tip of the tool that the kinematics know.
    pub(crate) const PLAIN: Self = Self::Follows { longer_mm: 0.0 };

    /// True where the coordinates are the axes themselves.
    #[must_use]
    pub const fn is_plain(self) -> bool {
        matches!(self, Self::Follows { longer_mm: 0.0 })
    }

    /// True where the machine follows its rotary axes.
    pub(crate) const fn follows(self) -> bool {
        matches!(self, Self::Follows { .. })
    }
}

/// A plane that the program has tilted (G68.2, CYCLE800).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tilt {
    /// The tool does not stand along its normal yet (before G53.1).
    Waits,
    /// The tool stands along it.
    Stands,
}
