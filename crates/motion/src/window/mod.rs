//! The near time-optimal planner of a stretch of motion between two rests.
//!
//! It is given the path as straight pieces with a tolerance and a speed each, and gives the state of
//! every axis at every period. Geometry and time law come out together: the motion may be anywhere
//! inside the tolerance.
//!
//! ```text
//!   push ──► Track ──► optimised window, verified ──► periods ──► next_period
//!            ring of   otherwise: rest of the last
//!            pieces    window, which ends at rest;
//!                      at rest: straight legs to the
//!                      next vertices (StopLeg)
//! ```
//!
//! Whatever leaves this module has passed the check of `follow` (both ways, in order, within tolerance), keeps
//! every limit, and is continued by a motion that ends at rest.
//!
//! The motion depends on the sequence of calls that change the path or its speed and on how many
//! periods were taken before a change of speed, on nothing else: a plan is made when a definite
//! amount of path is known, and of no more than that.

#![allow(
    clippy::needless_range_loop,
    reason = "vectors and blocks of a few axes are clearest by index"
)]

mod attempt;
mod bend;
mod beside;
mod budget;
mod cuts;
mod direction;
mod feed;
mod follow;
mod guess;
mod judge;
mod lead;
mod legs;
mod opening;
mod optimiser;
mod parameter_range;
mod period;
mod planner;
mod planning;
mod reference;
mod rounds;
mod samples;
mod scene;
mod solver;
mod spline;
mod state;
mod stop_leg;
#[cfg(test)]
mod tests;
mod track;
mod tube;

pub(crate) use period::Period;
pub(crate) use planner::WindowPlanner;
pub(crate) use reference::Reference;
