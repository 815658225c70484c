//! Motion that follows the spindle: the passes of a thread.
//!
//! A pass is planned like any motion, for a speed of the spindle that it does not reach, and its
//! program time then goes on with the angle of the spindle instead of the clock. So where the axes
//! are depends on the angle alone, run-in and run-out included: at another speed of the spindle the
//! same way is gone more slowly, and all passes coincide.
//!
//! ```text
//!   s │            ╱            s = K (φ − φ_start): as if the axes had their speed at once
//!     │          ╱╱
//!     │        ╱╱ planned       K: way of a revolution, lag: revolutions lost in the run-in
//!     │     _-╱╱
//!     └──┬──┬─────────── φ      the pass begins at φ_start − lag
//!      begin φ_start
//! ```
//!
//! * [`lead`]: from the frames at hand, how fast the spindle turns for program time to pass at
//!   rate 1, and the lag of the run-in;
//! * [`pass`]: whether a pass may begin, where it is to be, and whether the spindle still makes sense;
//! * [`tap`]: into a hole and out of it, without a plan.
//!
//! Angle and speed of the spindle come with what is seen of the drives: see `ports::feedback::spindle`.
//!
//! The tick asks it for a rate, and takes that only if what follows keeps the limits, with a stop in
//! reserve: see [`crate::real_time::rate`].

mod lead;
mod pass;
mod seen;
mod simulated;
mod tap;

pub(crate) use lead::{Lead, LeadOutcome};
pub(crate) use pass::{Follow, Pass};
pub(crate) use seen::SpindleSeen;
pub(crate) use simulated::SimulatedSpindle;
pub(crate) use tap::{Hole, Tap};
