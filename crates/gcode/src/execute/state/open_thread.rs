//! The blocks of a thread, and those of one whose last block is not known.

use glidepath_geometry::AxisVector;

/// A straight part of a pass: where it ends, in machine coordinates, and how far it goes with each
/// revolution, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Groove {
    pub(crate) end: AxisVector,
    pub(crate) pitch_mm: f64,
    /// By how much corners of the pass may be rounded, mm, > 0 where it has some.
    pub(crate) corner_mm: f64,
    /// Its source line.
    pub(crate) line: u32,
}

/// The blocks so far.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct OpenThread {
    pub(crate) grooves: Vec<Groove>,
    /// At which angle of the spindle it begins, as in
    /// [`Event::Synchronise`](glidepath_program::Event::Synchronise).
    pub(crate) phase: u32,
}
