//! The moves of a block: where its axis words lead, along which segments, and how fast.

mod arc;
pub(crate) mod arc_ends;
pub(crate) mod axis_words;
mod corner;
mod curve;
mod feedrate;
mod limits;
mod nurbs;
mod plain_move;
pub(crate) mod planned_tap;
mod polar;
mod probe;
pub(crate) mod rigid_tap;
pub(crate) mod settled;
pub(crate) mod speed;
mod spindle_axis;
mod spline;
mod straight;
mod surface;
mod target;
pub(crate) mod thread;
