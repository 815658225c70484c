//! The feedback of the drives: gathered, judged, and handed to the real-time thread.
//!
//! ```text
//! servo stacks ── Feedback ─► claims ─► book ─┬─ Observation ─► real-time thread: power, hand-over
//!                                 ▲           ├─ Order ───────► faults of following
//!                   demands ──────┴ following ┘
//!            (setpoints published)
//! ```
//!
//! All of this is done by the ports thread. The real-time thread gets one observation a turn, in
//! which the joints are already axes.

mod adaptive;
mod book;
mod claims;
mod commands;
mod demands;
mod drive_search;
mod following;
mod judging;
mod observation;
mod probe;
mod revolutions;
mod settings;
mod spindle;

pub(crate) use book::DriveBook;
pub(crate) use observation::{Observation, Turn};
pub use settings::{AdaptiveFeed, FeedbackSettings, JointFeedback, ProbeInput};

#[cfg(test)]
mod tests;
