//! The report of a search by bacterial foraging.

/// The effort of a search by bacterial foraging, and its start beside least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foraging {
    /// Iterations of all its runs.
    pub iterations: u64,
    /// Evaluations of the value.
    pub evaluations: u64,
    /// Sum of the squared distances at the parameters, at the start, mm².
    pub start_mm2: f64,
    /// Sum of the squared distances for least squares over the same knots, mm².
    pub least_squares_mm2: f64,
    /// Largest distance for least squares over the same knots, mm.
    pub least_squares_max_mm: f64,
}
