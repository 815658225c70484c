//! Whether a time parametrisation is worth its work.

use crate::on_path::pieces::{Piece, Shape};
use glidepath_geometry::Segment;
use glidepath_program::Limits;

/// S-curves that take no longer than this many times what the top speed of each piece allows are
/// good enough: mostly, they are at the programmed feed.
const GOOD_R: f64 = 1.1;

/// Pieces that take less time than this on average, s, stay with S-curves: how many blocks are
/// planned in a second goes before how long they take. Dense lines are not so short: a span of their
/// spline takes the place of several.
const LEAST_PIECE_T: f64 = 0.25e-3;
/// Blocks that take less time than this on average, s, are dense.
const DENSE_BLOCK_T: f64 = 0.2e-3;

/// True if there are many blocks for the time that they take.
pub(super) fn is_dense(pieces: &[Piece], duration_t: f64) -> bool {
    duration_t < DENSE_BLOCK_T * blocks_on(pieces) as f64
}

/// How many blocks some pieces are.
pub(super) fn blocks_on(pieces: &[Piece]) -> usize {
    pieces.iter().map(|piece| 1 + piece.lines.len()).sum()
}

/// True if S-curves that take so long may lose time along some pieces: there are curves on it, on which limits bind.
///
/// Along lines an S-curve is the motion of least time; of lines and the transitions between them,
/// S-curves are what the junctions were decided with.
pub(super) fn is_worthwhile((pieces, duration_t): (&[Piece], f64), limits: &Limits) -> bool {
    let is_curve = |piece: &Piece| match piece.shape {
        Shape::Segment(Segment::Line(_)) | Shape::Transition(_) => false,
        Shape::Segment(Segment::Arc(_) | Segment::Curve(_)) | Shape::Spline(_) => true,
    };
    if !pieces.iter().any(is_curve) {
        return false;
    }
    if duration_t < LEAST_PIECE_T * pieces.len() as f64 {
        return false;
    }
    // At the rate of the program already, as most of it is, nothing else has to be asked.
    let at_rate_t = |piece: &Piece| piece.length_s / piece.rule.rate_v(piece.planned);
    if duration_t <= GOOD_R * pieces.iter().map(at_rate_t).sum::<f64>() {
        return false;
    }
    let steady_t = |piece: &Piece| piece.length_s / piece.rule.steady_v(piece.planned, limits);
    let steady_t: f64 = pieces.iter().map(steady_t).sum();
    duration_t > GOOD_R * steady_t
}
