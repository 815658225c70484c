//! Motion planning: from programmed segments to the state of the machine at every period.
//!
//! Pure computation: no I/O, no clock, no shared memory. The same items give the same frames,
//! whatever the timing or the chunking of the input.
//!
//! Suffixes of local names, declared once for the crate:
//!
//! | suffix | meaning |
//! |---|---|
//! | `_mm` | length; degrees where the axis is rotary |
//! | `_v` `_a` `_j` | velocity, acceleration, jerk: mm/s, mm/s², mm/s³ (degrees for rotary axes) |
//! | `_s` | position along the path |
//! | `_t` | time in seconds |
//! | `_ns` | integer nanoseconds |
//! | `_u` | a curve's own parameter, 0…1 |
//! | `_k` | curvature, 1/mm |

mod error;
mod feed_axes;
mod grid;
mod guard;
mod in_tube;
mod intake;
mod on_path;
mod planner;
pub mod preview;
mod programmed_rate;
mod rest;
pub mod scurve;

pub use error::PlanError;
pub use planner::Planner;
