//! One of the two segments that meet at a junction.

use glidepath_geometry::Segment;
use glidepath_program::PathMode;

/// One of the two segments of a junction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JunctionSide<'a> {
    pub segment: &'a Segment,
    pub mode: PathMode,
    pub length_s: f64,
    /// The most of it that the junction may take.
    pub share_s: f64,
    /// Wanted rate, overrides included.
    pub rate_v: f64,
    /// How far the segment is from the program already, mm.
    pub error_mm: f64,
    /// It follows the spindle.
    pub synchronised: bool,
}
