//! The progress of lines in execution, as the publisher tells it.

/// The progress of a job's lines in execution.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Followed {
    /// Motion that is planned and not executed, s.
    pub ahead_t: f64,
    /// All that was given out is executed, and the machine rests until there is more.
    pub rests: bool,
    /// Number of the block being executed, 0 before the first.
    pub block: u32,
}
