//! The state that the straight moves of plain lines in a row have in common.

use glidepath_geometry::AxisVector;

/// What the straight moves of plain lines in a row have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course {
    /// The unit of length in mm.
    pub(crate) scale: f64,
    /// Machine coordinates of the program's zero.
    pub(crate) origin: AxisVector,
}

impl Course {
    pub(crate) fn new() -> Self {
        Self {
            scale: 1.0,
            origin: AxisVector::zeros(),
        }
    }
}
