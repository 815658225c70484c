//! LinuxCNC's HAL as a servo stack.
//!
//! ```text
//! setpoints ─► (servo library) ─► Hal ─► halstreamer ─► streamer ─┐
//!                                  ▲                              ▼  a thread of HAL:
//!                 Feedback ◄───────┴──── halsampler ◄─── sampler ◄─┘  loops, drives, enable chain
//! ```
//!
//! HAL has a clock of its own: one line for each of its periods goes into a FIFO, some periods
//! ahead, and one row for each comes back, with the tick of the line that was played in it. HAL's
//! programs are processes of their own, which are spoken to through pipes in a text format that
//! LinuxCNC documents; nothing of LinuxCNC is linked, loaded or copied.
//!
//! * [`Layout`] says what the columns of both are;
//! * [`Hal`] is the bridge with its two processes: [`Hal::turn`] once a period or more often.
//!
//! Rows are stamped with the time that their line was for: the FIFO is a delay, and a constant delay
//! is no following error. What is too old it makes older, never younger.
//!
//! Invariant: nothing here waits. A HAL that takes no lines, or gives no rows, is an error.

mod bridge;
mod error;
mod layout;
mod programs;
mod stack;

pub use bridge::HalCounts;
pub use error::HalError;
pub use layout::{HAL_JOINTS, Layout};
pub use stack::{Hal, HalSettings};
