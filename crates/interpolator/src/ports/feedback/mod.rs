//! The feedback of the drives: gathered, judged, and handed to the real-time thread.
//!
//! ```text
//! servo stacks ─ Feedback ─► ownership ─► monitor ─┬─ Observation ─► real-time thread: power, hand-over
//!                                 ▲           ├─ Order ───────► faults of following
//!                   demands ──────┴ following ┘
//!            (setpoints published)
//! ```
//!
//! All of this is done by the ports thread. The real-time thread gets one observation a turn, in
//! which the joints are already axes.

mod adaptive;
mod analog_source;
mod commands;
mod demands;
mod drive_monitor;
mod drive_search;
mod following;
mod joint_ownership;
mod judging;
mod losses;
mod probe;
mod revolutions;
mod spindle;
mod superposition;

pub(crate) use drive_monitor::DriveMonitor;
