//! The path of a stretch: straight pieces, each with a speed and a tolerance, which make the tube.

mod direction;
mod feed;
mod reference;
mod reference_path;
mod sense;

pub(crate) use direction::{Bounds, directional};
pub(crate) use feed::{counted_length, top_v};
pub(crate) use reference::{Reference, Straightness};
pub(crate) use reference_path::{Displacement, ReferencePath, SHARP, TubePiece};
pub(crate) use sense::{AxisDirection, Origin, WORTH_R};
