//! The effects of a block beside its motion: feed, spindle, tools, overrides, inputs and outputs,
//! offsets.

mod coordinate_system;
mod feed;
mod gear;
mod input_output;
pub(crate) mod input_wait;
mod non_modal;
pub(crate) mod order;
pub(crate) mod orientation;
mod overrides;
mod saved_state;
mod spindle;
mod tool;
