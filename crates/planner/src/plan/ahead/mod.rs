//! Planning ahead of publishing: a thread of its own, and its queue of frames.
//!
//! ```text
//!  planning thread                          publishing thread
//!  Pipeline ──frames──▶ FrameQueue ──frames──▶ FramePublisher ──▶ interpolator
//!     ▲                  (bounded)                │
//!     └── go back to the frame given out last ◀── override changed
//! ```
//!
//! What is published is a fraction of a second ahead of the machine, since it cannot be planned
//! otherwise any more. Planning is further ahead than that, so that a host that is busy for a while,
//! or a stretch that takes long to plan, is not felt by the motion.
//!
//! * **The same frames.** A change of override drops the frames that wait and goes back to the one
//!   given out last: what follows is what a planner would give that had not worked ahead at all.
//!   How full the queue is, and when either thread runs, does not show in the frames.
//! * **Bounded memory.** The queue has a capacity, and so have the items kept for going back
//!   ([`crate::history`]).
//! * **Errors in their place.** What ends the program is told after the last frame before it.

mod queue;
#[cfg(test)]
mod tests;
mod thread;

pub(crate) use queue::{FrameQueue, Next};
pub(crate) use thread::planned_ahead;
