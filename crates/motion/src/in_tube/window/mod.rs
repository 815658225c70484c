//! One window: a motion of near least time through the tube, from the present state to rest.
//!
//! ```text
//!   attempt ──▶ optimiser ──▶ tube, cuts ──▶ solver        geometry and time law come out together
//!     │            ▲              rows        convex
//!     │            └── samples ◀──────────────┘ problem
//!     └──▶ verify: every motion, before it is given out
//! ```

#![allow(
    clippy::needless_range_loop,
    reason = "vectors and blocks of a few axes are clearest by index"
)]

mod attempt;
mod budget;
mod cuts;
mod guess;
mod opening;
mod optimiser;
mod rounds;
mod samples;
mod scene;
mod solver;
mod spline;
mod tube;

pub(crate) use attempt::{Motion, Optimisers, Setting, View};
pub(crate) use budget::FIRST_WORK;
pub(crate) use budget::PLAN_WORK;
pub(crate) use spline::Grid;
