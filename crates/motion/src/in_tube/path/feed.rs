//! The feed of a piece along a displacement that is not quite along the piece.

use super::reference_path::TubePiece;
use crate::feed_axes::counted_axes;
use glidepath_geometry::AxisVector;

/// Speed the feed of a piece allows along a displacement of a feed length. What the piece's feed
/// counts may be another group of axes than what the displacement's does: beside a rotary move, a
/// way of a micrometre back to the path is all that XYZ move.
pub(crate) fn top_v(piece: &TubePiece, displacement: &AxisVector, length_s: f64) -> f64 {
    let counted_s = counted_length(piece, displacement);
    if counted_s > length_s {
        piece.top_v * length_s / counted_s
    } else {
        piece.top_v
    }
}

/// Length of a displacement in the axes that the feed of a piece counts.
pub(crate) fn counted_length(piece: &TubePiece, displacement: &AxisVector) -> f64 {
    let counted = counted_axes(&(piece.end - piece.start));
    let square: f64 = counted.map(|i| displacement[i] * displacement[i]).sum();
    square.sqrt()
}
