//! The settings of the spindle's encoder at a terminal.

/// The spindle's encoder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EncoderSettings {
    /// Counts of a revolution, > 0: four times the lines.
    pub counts_per_rev: u32,
    /// Its index is wired to the terminal.
    pub has_index: bool,
    /// It counts down where the spindle turns clockwise (M3).
    pub is_inverted: bool,
    /// How near it has to be to its speed to be at it, a part of that.
    pub near_r: f64,
}
