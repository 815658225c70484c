//! The blocks of a short stretch, kept as they were programmed.
//!
//! A stretch of few blocks is planned a second time with a stop at the end of every block
//! ([`crate::on_path::look_ahead`]); of longer ones, the blocks are not kept.

use crate::on_path::pieces::{Piece, Shape};
use glidepath_geometry::{AxisVector, Segment};
use std::collections::VecDeque;

/// Most blocks of a stretch that is planned both ways.
const MOST_BLOCKS: usize = 64;

/// The blocks since the last rest, as pieces.
#[derive(Debug, Clone, Default)]
pub(crate) struct KeptBlocks {
    pieces: VecDeque<Piece>,
    /// Some were not kept.
    is_lost: bool,
}

impl KeptBlocks {
    pub(crate) const fn new() -> Self {
        Self {
            pieces: VecDeque::new(),
            is_lost: false,
        }
    }

    /// True if the next block would be kept.
    pub(crate) fn keeps(&mut self) -> bool {
        if self.pieces.len() >= MOST_BLOCKS {
            self.lose();
        }
        !self.is_lost
    }

    pub(crate) fn push(&mut self, piece: Piece) {
        self.pieces.push_back(piece);
    }

    /// Forgets what was kept, and keeps nothing up to the next rest behind which nothing waits.
    pub(crate) fn lose(&mut self) {
        self.pieces.clear();
        self.is_lost = true;
    }

    /// The same if there are any: from a rest on all are kept.
    pub(crate) fn lose_any(&mut self) {
        if !self.pieces.is_empty() {
            self.lose();
        }
    }

    /// The machine rests, and no block is kept elsewhere.
    pub(crate) fn restart(&mut self) {
        self.pieces.clear();
        self.is_lost = false;
    }

    /// The blocks up to a rest where one of them ends, if there are several. A path may pass the
    /// same point twice; then it is not known which of the blocks that end there is meant, and none
    /// is given.
    pub(crate) fn take(&mut self, rest: &AxisVector) -> Option<Vec<Piece>> {
        let mut ending = (0..self.pieces.len()).filter(|&i| ends_at(&self.pieces[i], rest));
        let (Some(last), None) = (ending.next(), ending.next()) else {
            self.lose();
            return None;
        };
        let taken: Vec<Piece> = self.pieces.drain(..=last).collect();
        (taken.len() > 1).then_some(taken)
    }

    /// All blocks, if there are several and the last of them ends at this rest.
    pub(crate) fn take_all(&mut self, rest: &AxisVector) -> Option<Vec<Piece>> {
        let is_end = self.pieces.back().is_some_and(|last| ends_at(last, rest));
        let taken: Vec<Piece> = self.pieces.drain(..).collect();
        (is_end && taken.len() > 1).then_some(taken)
    }
}

fn ends_at(piece: &Piece, point: &AxisVector) -> bool {
    match &piece.shape {
        Shape::Segment(Segment::Line(line)) => line.end == *point,
        Shape::Segment(Segment::Arc(arc)) => arc.end == *point,
        Shape::Segment(Segment::Curve(curve)) => curve.end == *point,
        Shape::Transition(_) | Shape::Spline(_) => false,
    }
}
