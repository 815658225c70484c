//! A largest distance, and the line where it is met.

/// A distance and the source line where it is met; 0 where there is none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Met {
    /// mm, or degrees of a rotary axis.
    pub distance_mm: f64,
    /// Source line of the motion there.
    pub line: u32,
}

impl Met {
    /// Takes another distance, if it is larger.
    pub(super) fn see(&mut self, distance_mm: f64, line: u32) {
        if distance_mm > self.distance_mm {
            (self.distance_mm, self.line) = (distance_mm, line);
        }
    }
}
