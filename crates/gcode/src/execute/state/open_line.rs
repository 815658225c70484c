//! A straight move of which only the direction is known, as long as the next move is not known.

use crate::execute::state::modal::Feed;
use crate::syntax::block::Block;

/// A block with an angle and no end; the next block has an angle and the end of both moves.
#[derive(Debug, Clone)]
pub(crate) struct OpenLine {
    pub(crate) block: Block,
    /// Degrees from the first axis of the plane.
    pub(crate) degrees: f64,
    pub(crate) feed: Option<Feed>,
    /// Source line of the move.
    pub(crate) line: u32,
}
