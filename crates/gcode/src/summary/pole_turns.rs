//! The turns of C at the pole in the cut.

/// Turns of C at the pole while the tip of the tool rests in the cut: at rapid, between moves at feed to directions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoleTurns {
    /// How many there are.
    pub count: u32,
    /// Line of the widest one, the first of those; 0 without any.
    pub line: u32,
    /// By how much C turns there, degrees.
    pub angle_deg: f64,
}

impl PoleTurns {
    pub(crate) const fn add(&mut self, line: u32, angle_deg: f64) {
        self.count = self.count.saturating_add(1);
        if angle_deg > self.angle_deg {
            (self.line, self.angle_deg) = (line, angle_deg);
        }
    }
}
