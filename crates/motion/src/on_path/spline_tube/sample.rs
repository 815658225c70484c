//! The points that a spline is laid along.

/// A point that the curve has to come near.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample<const D: usize> {
    pub(super) point: [f64; D],
    /// Where it is along the merged chords.
    pub(super) along_t: f64,
    /// Distance from the sample before.
    pub(super) spacing_t: f64,
    /// Parameter of the curve's point that it is matched with.
    pub(super) foot_t: f64,
    pub(super) weight: f64,
    /// How fast it is passed at the feed, by `along_t`.
    pub(super) feed_v: f64,
    /// Its distance from that point, mm.
    pub(super) error_mm: f64,
}
