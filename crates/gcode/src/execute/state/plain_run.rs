//! The run of plain lines: straight moves one after the other, for which unit and offsets were looked up once.

use glidepath_geometry::AxisVector;

/// What the straight moves of a run of plain lines have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlainRun {
    /// The unit of length in mm.
    pub(crate) scale: f64,
    /// Machine coordinates of the program's zero.
    pub(crate) origin: AxisVector,
}

impl PlainRun {
    pub(crate) fn new() -> Self {
        Self {
            scale: 1.0,
            origin: AxisVector::zeros(),
        }
    }
}
