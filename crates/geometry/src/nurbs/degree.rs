//! How high the degree of a curve may be.

/// The highest degree.
pub const MAX_DEGREE: usize = 7;
