//! One window: a motion of near least time through the tube, from the present state to rest.
//!
//! ```text
//!   attempt ──▶ optimiser ──▶ tube, planes ▶ solver        geometry and time come out together
//!     │            ▲              rows        convex
//!     │            └── samples ◀──────────────┘ problem
//!     └──▶ verify: every motion, before it is given out
//! ```
//!
//! A motion that is found is solved for once more to be smooth (`smoothing`); one that sees the end
//! of its path is made to rest exactly there (`finishing`). Where nothing but the feed binds, the
//! solve for smoothness is all there is (`at_feed`). Axes the path leaves alone are held fast by
//! `fixed_axes`.
//!
//! **The question.** Which motion gets furthest along the path in the time of the window, rests at its
//! end, keeps every limit and stays in the tube? Furthest in a given time, not soonest at a given place:
//! a duration that is sought would be multiplied with the positions in every limit, and a window in the
//! middle of a path has no place at which to be.
//!
//! | | | measured in |
//! |---|---|---|
//! | unknown | control points of a uniform cubic B-spline in time ([`spline`]) | tolerances |
//! | aim | mean progress, less a pull to the path and a price of jerk ([`tube`]) | periods at the feed |
//! | hard | velocity, acceleration, jerk of every axis ([`solver`]) | the limit |
//! | soft | tube and corners ([`tube`]); feed, travel, joints (`_rows`) | radius, feed, limit |
//! | not convex | which piece a sample belongs to ([`samples`]) | |
//!
//! **Words.** A *knot* is where jerk may change, an *interval* lies between two; several are a period, or
//! several periods are one ([`spline`]). A *sample* is the end of a period: what is handed out. A *round*
//! gives samples to pieces, solves and projects; *search* is rounds in which samples change pieces,
//! *polish* those in which they do not; an *attempt* is rounds from one guess. The *tail* is what is left
//! of the motion before, the *judge* the check of [`crate::in_tube::verify`]. Of a window that is taken, a
//! third is handed out before the next one begins (*commit*), more at the feed.
//!
//! **From the question to frames.** A view says which pieces are seen, and how many intervals there are
//! ([`attempt`]). The path is scaled to tolerances ([`scaled_path`]), samples are put where the guess is,
//! and rounds begin ([`optimiser`]). Of all motions that pass the judge the furthest is taken, is made
//! smooth, and goes back to millimetres. Its states at the ends of periods are the frames
//! ([`Grid::state`]).
//!
//! **What if none is found.** The next attempt begins from a slower guess, the last from stops at every
//! vertex. If none has found a motion, a window is tried that rests at the end of the piece at hand; if
//! that fails, too, or loses to what there is, the leg under way or the rest of the last window goes on,
//! and a window is tried from further on. Every window ends at rest, so there is always such a rest; from
//! rest, legs lead to the next vertices ([`crate::in_tube::planner`]). So a failure costs time, never a
//! limit.

#![allow(
    clippy::needless_range_loop,
    reason = "vectors and blocks of a few axes are clearest by index"
)]

mod at_feed;
mod attempt;
mod budget;
mod corner;
mod cutting_planes;
mod damping;
mod feed_rows;
mod finishing;
mod fixed_axes;
mod guess;
mod hold_back;
mod joint_rows;
mod one_sided;
mod optimiser;
mod rate_changes;
mod rounds;
mod run_corners;
mod sample_place;
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
mod straight;
mod travel_rows;
mod tube;
mod way;
mod window_start;

pub(crate) use attempt::{
    FEED_INTERVALS, LEAST_INTERVALS, Optimisers, View, WindowContext, WindowMotion, WindowSearch,
};
#[cfg(test)]
pub(crate) use budget::PLAN_WORK;
pub(crate) use budget::{first_work, left_work};
pub(crate) use search_bias::SearchBias;
pub(crate) use spline::Grid;
pub(crate) use way::at_feed_r;
