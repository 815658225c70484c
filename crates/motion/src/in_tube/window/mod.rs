//! One window: a motion of near least time through the tube, from the present state to rest.
//!
//! ```text
//!   attempt ──▶ optimiser ──▶ tube, cuts ──▶ solver        geometry and time come out together
//!     │            ▲              rows        convex
//!     │            └── samples ◀──────────────┘ problem
//!     └──▶ verify: every motion, before it is given out
//! ```
//!
//! A motion that is found is solved for once more to be smooth (`smoothing`); one that sees the end
//! of its path is made to rest exactly there (`finishing`). Where nothing but the feed binds, the
//! solve for smoothness is all there is (`at_feed`). Axes the path leaves alone are held fast by
//! `pins`.

#![allow(
    clippy::needless_range_loop,
    reason = "vectors and blocks of a few axes are clearest by index"
)]

mod at_feed;
mod attempt;
mod budget;
mod cuts;
mod damping;
mod feed_rows;
mod finishing;
mod guess;
mod hold_back;
mod joint_rows;
mod one_sided;
mod optimiser;
mod pins;
mod place;
mod rate_changes;
mod rounds;
mod samples;
mod scaled_path;
mod search_bias;
mod sense_rows;
mod shortcuts;
mod sides;
mod smoothing;
mod solver;
mod speed;
mod spline;
mod travel_rows;
mod tube;
mod way;
mod window_start;

pub(crate) use attempt::{
    FEED_INTERVALS, LEAST_INTERVALS, Optimisers, Search, View, WindowContext, WindowMotion,
};
pub(crate) use budget::FIRST_WORK;
pub(crate) use budget::PLAN_WORK;
pub(crate) use search_bias::SearchBias;
pub(crate) use spline::Grid;
pub(crate) use way::at_feed_r;
