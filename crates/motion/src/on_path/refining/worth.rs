//! The judgement of whether a time parametrisation is worth its work.

use crate::joints::MachineLimits;
use crate::on_path::pieces::{Piece, Shape};
use glidepath_geometry::{Segment, limit_along};
use glidepath_program::Limits;

/// S-curves that take no longer than this many times what the top speed of each piece allows are
/// good enough: mostly, they are at the programmed feed. No more than a tenth can be gained then.
const GOOD_R: f64 = 1.1;

/// Pieces that take less time than this on average, s, stay with S-curves: how many blocks are
/// planned in a second goes before how long they take. Dense lines are not so short: a span of their
/// spline takes the place of several.
const LEAST_PIECE_T: f64 = 0.25e-3;
/// Blocks that take less time than this on average, s, are dense.
const DENSE_BLOCK_T: f64 = 0.2e-3;

/// S-curves have one top speed along a piece. Where axes allow so many times more in the mean over
/// its directions, they are not good enough: on an arc that may be driven faster than an axis they were
/// up to 8 % slower than stops.
const FREE_R: f64 = 1.02;

/// Places at which the direction of an arc or a NURBS is asked for: an odd number, so that they are
/// not the same ones of every quarter.
const SAMPLES: u32 = 9;

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
/// S-curves are what the junctions were decided with. Joints that are not axes are limits that change along
/// any of them.
pub(super) fn is_worthwhile((pieces, duration_t): (&[Piece], f64), limits: &MachineLimits) -> bool {
    let is_curve = |piece: &Piece| match piece.shape {
        Shape::Segment(Segment::Line(_)) | Shape::Transition(_) => false,
        Shape::Segment(Segment::Arc(_) | Segment::Curve(_)) | Shape::Spline(_) => true,
    };
    // Where joints are not axes, a line is a curve to them.
    if limits.joints.is_none() && !pieces.iter().any(is_curve) {
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
    if limits.joints.is_some() {
        return true;
    }
    let (mut steady_t, mut varying_t) = (0.0, 0.0);
    for piece in pieces {
        let (steady, varying) = top_speed_t(piece, &limits.axes);
        steady_t += steady;
        varying_t += varying;
    }
    duration_t > GOOD_R * steady_t || steady_t > FREE_R * varying_t
}

/// How long a piece takes at its top speed, s: at the one that holds all along it, and as fast as it
/// goes where it goes. On an arc between two axes that is 1.4 times as fast as along one of them.
fn top_speed_t(piece: &Piece, limits: &Limits) -> (f64, f64) {
    let count = match piece.shape {
        Shape::Segment(Segment::Arc(_) | Segment::Curve(_)) => SAMPLES,
        Shape::Segment(Segment::Line(_)) | Shape::Transition(_) | Shape::Spline(_) => 1,
    };
    let following_v = piece.rule.following_v(piece.planned, limits);
    let step_s = piece.length_s / f64::from(count);
    let (mut steady_v, mut varying_t) = (following_v, 0.0);
    for k in 0..count {
        let direction = piece.jet(step_s * (f64::from(k) + 0.5)).d1;
        let top_v = following_v.min(limit_along(&direction, &limits.velocity));
        steady_v = steady_v.min(top_v);
        varying_t += step_s / top_v;
    }
    (piece.length_s / steady_v, varying_t)
}
