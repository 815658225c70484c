//! The path front: items in, pieces of smooth path and rests out.

mod assembly;
mod dense_blocks;
mod kept_blocks;
mod path_front;
mod pending;

pub(crate) use assembly::chord_speed;
pub(crate) use path_front::PathFront;
