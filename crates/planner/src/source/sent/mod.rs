//! The lines that a sender sends one after the other, as one job: planned with look-ahead as they
//! come.
//!
//! ```text
//!  LinesRequest ──► LineInbox ──► SentLines ──► Pipeline ──► …        FramePublisher
//!  LinesReply ◄──── (what came    (what is read:                          │
//!                    of them)      items, and what is in force)           │
//!                        ▲                                                │
//!                        └────────── Followed: how far it is executed ◄───┘
//! ```
//!
//! * **What has come moves.** Where no more has come for 20 ms since the client was told that all of it is read, and
//!   no planned motion is left to be published, the motion is planned to rest at the end of what there is. A machine
//!   that stands and has several moves waits for 250 ms: a program begins. More lines go on from that rest.
//! * **What was read is told.** A line is read when there is room for its motion: while more of it is planned ahead
//!   than the client allows, lines wait. One behind which the machine rests (a dwell, a stop, a tool) counts as read
//!   when it was executed, and so does a probing move.
//! * **A job ends** where nothing more has come and all is executed, at M2 and M30, behind a line that stores something
//!   (G10, G28.1, G30.1), which counts as read when it is stored, in front of a line that is refused, or where its client
//!   closes it or falls silent: what was read is executed to its end. What comes then is the next job. Its modes and offsets are those that this one left.
//! * **What is in force is known at every block**, so that a job that is aborted leaves what its executed part has
//!   left.

pub(crate) mod facts;
mod followed;
pub(crate) mod inbox;
mod source;
mod storing;
#[cfg(test)]
mod tests;

pub use facts::LineFacts;
pub use followed::Followed;
pub use inbox::LineInbox;
pub(crate) use inbox::LinesEnd;
pub use source::SentLines;
