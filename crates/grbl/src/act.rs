//! The commands of a sender that the machine carries out at once.

use crate::AXES;

/// A command that the machine carries out at once.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Come to rest on the path.
    Hold,
    /// Go on.
    Resume,
    /// Go back to the path, after a jog in a hold.
    Return,
    /// Come to rest on the path, and end the motion.
    Abort,
    /// What the machine waits for was done.
    Acknowledge,
    /// Set the feed override, a ratio.
    FeedOverride(f64),
    /// Set the rapid override, a ratio.
    RapidOverride(f64),
    /// Set the spindle override, a ratio.
    SpindleOverride(f64),
    /// Rest at the end of every block, or do so no longer.
    ToggleSingleBlock,
    /// Clear a latched fault.
    Reset,
    /// Give the drives power.
    Enable,
    /// Take the power from the drives.
    Disable,
    /// Look for the home of the axis of this index, or of all.
    Home(Option<usize>),
    /// Move axes by hand, on from where the last of these ends.
    Jog {
        /// By how much, mm or degrees.
        by: [f64; AXES],
        /// How fast along the way, mm/s.
        most_v: f64,
    },
    /// Nothing is moved by hand any more.
    LetGo,
    /// Judge a line, without executing it: [`crate::Session::judged`].
    Judge(String),
}
