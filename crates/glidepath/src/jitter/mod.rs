//! The measurement of how late the real-time loop wakes on this host.
//!
//! ```text
//! real-time thread   sleep, tick, spin · sleep, tick, …   SCHED_FIFO, pinned, memory locked
//!                          │ one beat per period, through a ring
//! calling thread     ──────▼───────────┬──────────────┬───
//!                         window 1 s   │   window 1 s │    steal of /proc/stat at each end
//! ```
//!
//! The loop is that of the interpolator: the same timer with the same lead, the same set-up, and,
//! if asked for, the same work. The latency of waking is what cyclictest measures: from the time
//! the thread was to wake at, a lead before the deadline, to its waking. The lateness of a tick is
//! what is left of it at the deadline. Both count from the deadline the thread waited for, so a
//! wake-up that misses periods counts with all of its delay.
//!
//! On a virtual machine the hypervisor takes the processor away now and then, which no program can
//! do anything about. Seconds in which the kernel counted such *steal* are left out of a second
//! set of figures. The kernel counts steal in ticks of 10 ms, so the set may keep a short theft
//! and lose a good second; both sets are reported.

mod beat;
mod bins;
mod cyclictest;
mod error;
mod measure;
mod motion;
mod report;
mod section;
mod setup;
mod windows;

pub use beat::LoopBeat;
pub use bins::{Bin, COARSE, FINE, rebin};
pub use cyclictest::{CyclictestError, Latencies};
pub use error::JitterError;
pub use measure::{Measurement, measure};
pub use motion::LoadMotion;
pub use report::JitterReport;
pub use setup::Setup;
pub use windows::Windows;
