//! A thread of several blocks, as long as its last one is not known.

use crate::execute::motion::thread::Groove;

/// The blocks so far.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct OpenThread {
    pub(crate) grooves: Vec<Groove>,
    /// At which angle of the spindle it begins, as in
    /// [`Event::Synchronise`](glidepath_program::Event::Synchronise).
    pub(crate) phase: u32,
    /// The way of a revolution as the last block has it, in the units in force.
    pub(crate) pitch: f64,
}
