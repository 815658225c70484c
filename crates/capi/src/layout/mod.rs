//! The layout of the library's structures, byte by byte.
//!
//! Each list is held against its Rust type when the library is compiled: names, types, offsets and
//! the size, with no byte between two fields. What a record gains, loses or moves is an error here,
//! and calls for a new version of the ABI.

mod abi;
#[cfg(test)]
mod codes;
mod demands;
mod digest;
#[cfg(test)]
mod generate;
mod own;
mod records;
#[cfg(test)]
mod render;
mod structure;

pub(crate) use abi::{ABI, LAYOUT};
pub(crate) use own::{
    GpJoint, GpJump, GpJumpLimits, GpServoSettings, GpServoState, GpStopLimits, Stopped, TooMuch,
};
