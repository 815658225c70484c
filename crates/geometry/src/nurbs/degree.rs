//! The highest degree that a NURBS may have.

/// The highest degree of a curve.
pub const MAX_DEGREE: usize = 7;
