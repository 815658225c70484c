//! The interpolator process: frames to setpoints, one per period.
//!
//! ```text
//! planner ─ frames ─► ports thread ─ admission ─► ring ─► real-time thread
//! servo  ◄ setpoints ─┘   ▲ commands                       │ tick: one setpoint a period
//! anybody ◄ status ───────┴───────────── ring ◄────────────┘
//! ```
//!
//! * [`run`] starts both threads;
//! * `tick` is one period of the real-time thread, done just before the deadline but for the time
//!   stamp, and reads like a table of contents: what it owns
//!   is a `track` (the frames ahead), a `rate` (of program time: the essay on hold, resume and
//!   override is there), a `supply` (are there frames enough?) and a `will` (what stops the motion);
//! * `joints` turns its axes into those of the mechanism;
//! * what it owns lies together, axes in `pairs`, and is not moved: after a period of sleep the caches
//!   are cold, and a tick takes as long as the lines of memory and of code it touches;
//! * `admission` judges every frame before the real-time thread sees it;
//! * `ports` is one turn of the ports thread.
//!
//! Invariants: the real-time thread makes no system call but the sleep and the reading of the clock,
//! and no allocation; published positions keep every axis inside its limits by finite differences;
//! at rate 1 the setpoints are the frames, bit for bit; whatever fails, the motion comes to rest on
//! the path.

#![cfg_attr(glidepath_rtsan, feature(sanitize))]

mod admission;
mod block_end;
mod block_stop;
mod commands;
mod config;
mod counters;
mod differences;
mod frame_summary;
mod joints;
mod loops;
mod message;
mod pairs;
mod ports;
mod program_time;
mod quintic;
mod ramp;
mod rate;
mod rest;
mod run;
mod setpoint;
mod status;
mod stepped;
mod stop_requests;
mod stop_time;
mod supply;
#[cfg(test)]
mod testing;
mod tick;
mod track;

/// Unit tests prove that the real-time thread does not allocate.
#[cfg(test)]
#[global_allocator]
static ALLOCATOR: glidepath_realtime::CountingAllocator = glidepath_realtime::CountingAllocator;

pub use config::{Config, RealTime, SoftLimits};
pub use loops::{RunError, lead_ns};
pub use run::run;
pub use stepped::{Stepped, stepped};
