//! Junctions: how two segments are joined where they meet.

mod beside_corner;
mod corner;
mod decision;
mod side;
mod stop_or_pass;

pub(crate) use corner::chord_error_mm;
pub(crate) use decision::{Junction, is_exact_corner, join};
pub(crate) use side::JunctionSide;
