//! A tap on its way into a hole (SINUMERIK's G331), as long as the way out (G332) is not known.

use glidepath_geometry::AxisVector;

/// A tap of which only the way in is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OpenTap {
    /// The bottom, machine coordinates.
    pub(crate) bottom: AxisVector,
    /// Way of a revolution, mm; below zero of a left-hand thread.
    pub(crate) pitch_mm: f64,
    /// Source line of the way in.
    pub(crate) line: u32,
}
