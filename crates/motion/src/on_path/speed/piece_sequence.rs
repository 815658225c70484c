//! A sequence of pieces of path, one after the other, and the S-curves that drive them.

use crate::on_path::pieces::Piece;
use crate::scurve::Profile;

/// One S-curve, and where on the path it starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Leg {
    pub from_s: f64,
    pub profile: Profile,
}

/// Pieces of path one after the other.
#[derive(Debug)]
pub(crate) struct PieceSequence<'a> {
    pub pieces: &'a [Piece],
    /// Where each piece starts, and where the last one ends.
    pub starts_s: Vec<f64>,
}

impl<'a> PieceSequence<'a> {
    pub(crate) fn new(pieces: &'a [Piece]) -> Self {
        let mut starts_s = Vec::with_capacity(pieces.len() + 1);
        let mut s = 0.0;
        for piece in pieces {
            starts_s.push(s);
            s += piece.length_s;
        }
        starts_s.push(s);
        Self { pieces, starts_s }
    }

    pub(crate) fn length_s(&self) -> f64 {
        self.starts_s[self.pieces.len()]
    }

    /// The pieces on a part of the path.
    pub(crate) fn touched(&self, from_s: f64, to_s: f64) -> core::ops::Range<usize> {
        let starts_s = &self.starts_s[..self.pieces.len()];
        let first = starts_s.partition_point(|&s| s <= from_s).saturating_sub(1);
        let last = starts_s.partition_point(|&s| s < to_s).max(first + 1);
        first..last
    }
}
