//! Junctions: how two segments are joined where they meet.

mod decision;
mod stop_or_pass;

pub(crate) use decision::{Junction, JunctionSide, chord_error_mm, is_exact_corner, join};
