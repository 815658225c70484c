//! Linux real time: what a thread needs that must act every period and never be late.
//!
//! The lowest layer of the pipeline: the interpolator's two threads stand on it, and the command
//! asks it whether a host is fit. It knows nothing of machines or motion. The parts, in the order a
//! program meets them:
//!
//! * [`enter`] makes the calling thread a real-time thread (scheduling class, processor, locked and
//!   prefaulted memory, processor idle states) and reads every setting back; [`Mode::Strict`]
//!   refuses to go on without any of it, [`Mode::BestEffort`] says what was granted;
//! * [`DeadlineTimer`] wakes the thread on an absolute grid that never moves;
//! * [`take_precedence`] puts a thread that plans before what need not be in time;
//! * [`doctor`] says beforehand whether the host is fit for that, and how to mend it;
//! * [`event_ring`] and [`Histogram`] carry what happened to a thread that may write logs;
//! * [`forbid_system_calls`] and [`CountingAllocator`] prove, in tests, that the thread makes no
//!   system call and no allocation.
//!
//! Invariants: after [`enter`] nothing here allocates, locks or makes a system call other than the
//! sleep and the reading of the clock; the grid of a timer never moves, however late a wake-up is;
//! all `unsafe` code is in the module `sys`.
//!
//! ```
//! use glidepath_realtime::{
//!     Clock as _, DeadlineTimer, Histogram, Mode, Monotonic, Request, enter,
//! };
//!
//! // A host that grants nothing is good enough for an example.
//! let entered = enter(&Request::default(), Mode::BestEffort)?;
//! assert_eq!(entered.grants.refusals().count(), 0, "nothing was asked for");
//!
//! let period_ns = 1_000_000;
//! let mut timer = DeadlineTimer::new(Monotonic, Monotonic.now_ns(), period_ns);
//! let mut lateness = Histogram::new();
//! let mut tick = 0;
//! while tick < 3 {
//!     let wake = timer.wait();
//!     // The ticks that were missed are counted, not made up for.
//!     assert_eq!(wake.tick, tick + 1 + wake.missed);
//!     lateness.record(wake.lateness_ns());
//!     tick = wake.tick;
//! }
//! assert!(lateness.quantiles().max_ns < period_ns);
//! # Ok::<(), glidepath_realtime::NotRealTime>(())
//! ```

mod clock;
mod deadline;
pub mod doctor;
mod event_ring;
mod histogram;
mod host;
mod precedence;
mod processor_time;
mod setup;
mod sys;

pub use clock::{Clock, Monotonic};
pub use deadline::{DeadlineTimer, Rise, Wake};
pub use event_ring::{EventReader, EventWriter, Events, event_ring};
pub use histogram::{Histogram, Quantiles};
pub use host::Host;
pub use precedence::{PLANNING_NICE, take_precedence};
pub use processor_time::ProcessorTime;
pub use setup::{Entered, Grants, Item, Mode, NotRealTime, Outcome, Refusal, Request, enter};
pub use sys::alloc::CountingAllocator;
pub use sys::seccomp::{SENTINEL_EXIT_CODE, SentinelError, forbid_system_calls};
