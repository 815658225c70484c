//! A move whose end is a corner that is broken, as long as the next move is not known.

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::execute::state::modal::{Feed, Modal};
use crate::syntax::block::CornerKind;

/// A straight move at feed, or an arc, to a corner that is to be broken.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OpenCorner {
    /// Where the move begins and ends, machine coordinates.
    pub(crate) from: AxisVector,
    pub(crate) at: AxisVector,
    /// Centre and sweep of an arc, in the two axes of the plane.
    pub(crate) arc: Option<([f64; 2], f64)>,
    pub(crate) kind: CornerKind,
    /// Leg, length or radius, mm.
    pub(crate) size_mm: f64,
    /// The modes of the move, its feed among them: the next block may have others.
    pub(crate) modal: Modal,
    /// The feed of what breaks the corner; `None`: that of the move behind it.
    pub(crate) corner_feed: Option<Feed>,
    /// Source line of the move.
    pub(crate) line: u32,
    /// Broken only where two such moves meet (RNDM); else the next move has to be one.
    pub(crate) may_stay: bool,
    /// Blocks behind the move that move nothing.
    pub(crate) between: u8,
    /// What the next blocks give out before they move: it comes behind the held move.
    pub(crate) behind: Vec<Item>,
}
