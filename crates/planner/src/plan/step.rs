//! The steps of a pipeline.

use glidepath_program::{Frame, Item};

/// The output of one step of a pipeline.
#[allow(
    clippy::large_enum_variant,
    reason = "there is one at a time, and nearly all of them are frames"
)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Output {
    /// The planner took this item. An auditor listens to these.
    Item(Item),
    /// The next frame.
    Frame(Frame),
    /// The source has nothing yet and the planner cannot go on without.
    Pending,
    /// All frames are out.
    End,
}

/// The outcome of a step. What it made is shown by the pipeline: items and frames are large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// The planner took an item: [`crate::Pipeline::item`].
    Item,
    /// A frame was made: [`crate::Pipeline::frame`].
    Frame,
    /// See [`Output::Pending`].
    Pending,
    /// All frames are out.
    End,
}
