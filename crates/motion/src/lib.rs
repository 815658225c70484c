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

mod assembly;
mod compress;
mod course;
mod dense_run;
mod element;
mod error;
mod fast;
mod feed_axes;
mod grid;
mod group;
mod guard;
mod haste;
mod intake;
mod joint;
mod kept_blocks;
mod law;
mod merge;
mod optimal;
mod path;
mod pending;
mod piece;
mod planner;
pub mod preview;
mod programmed_rate;
mod rest;
mod run;
mod sample;
mod schedule;
pub mod scurve;
mod settled;
mod slowing;
mod speed_limit;
mod stop_at_each;
mod stop_or_pass;

mod tolerance_split;
mod valley;
mod window;

pub use error::PlanError;
pub use planner::Planner;
pub use tolerance_split::{
    CornerLimits, ToleranceSplit, chord_acceleration, chord_error, chord_speed,
};
