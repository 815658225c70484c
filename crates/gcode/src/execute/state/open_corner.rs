//! A move whose end is a corner that is broken, as long as the next move is not known.

use glidepath_geometry::AxisVector;

use crate::execute::state::modal::Feed;
use crate::syntax::block::CornerKind;

/// A straight move at feed to a corner that is to be broken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OpenCorner {
    /// Where the move begins and ends, machine coordinates.
    pub(crate) from: AxisVector,
    pub(crate) at: AxisVector,
    pub(crate) kind: CornerKind,
    /// Leg, length or radius, mm.
    pub(crate) size_mm: f64,
    pub(crate) feed: Option<Feed>,
    /// Source line of the move.
    pub(crate) line: u32,
    /// Broken only where two such moves meet (RNDM); else the next move has to be one.
    pub(crate) may_stay: bool,
}
