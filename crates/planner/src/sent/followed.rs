//! How far lines are executed, as the publisher tells it.

/// How far the lines of a job are executed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Followed {
    /// Motion that is planned and not executed, s.
    pub ahead_t: f64,
    /// All that was given out is executed, and the machine rests until there is more.
    pub rests: bool,
    /// Number of the block being executed, 0 before the first.
    pub block: u32,
}
