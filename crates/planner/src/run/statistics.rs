//! The counts over all steps of a pipeline.

use std::time::Duration;

/// The counts of what a pipeline has done so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Lines of program text read (items, where there is no text).
    pub lines: u64,
    /// Segments planned.
    pub segments: u64,
    /// Dwells and events planned.
    pub others: u64,
    /// Frames given out.
    pub frames: u64,
    /// Time spent in reading and planning, if the pipeline was given a clock.
    pub planning: Duration,
}
