//! The near time-optimal planner of a stretch of motion between two rests.
//!
//! It is given the path as straight pieces with a tolerance and a speed each, and gives the state
//! of every axis at every period. Geometry and time come out together: the motion may be anywhere
//! inside the tolerance.
//!
//! ```text
//!   push ──► ReferencePath ──► optimised window, verified ──► periods ──► next_period
//!            ring of   otherwise: rest of the last
//!            pieces    window, which ends at rest;
//!                      at rest: straight legs to the
//!                      next vertices (StopLeg)
//! ```
//!
//! Whatever leaves this module has passed the check of [`crate::in_tube::verify`] (both ways, in
//! order, within tolerance), keeps every limit, and is continued by a motion that ends at rest.
//!
//! The motion depends on the sequence of calls that change the path or its speed and on how many
//! periods were taken before a change of speed, on nothing else: a plan is made when a definite
//! amount of path is known, and of no more than that.

mod legs;
mod planning;
mod state;
#[cfg(test)]
mod tests;
mod tube_planner;
mod worth;

pub(crate) use tube_planner::TubePlanner;
