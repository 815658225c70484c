//! Joined runs: their junctions are given up where that is faster.

use super::settled::Settled;
use crate::on_path::pieces::{Piece, Shape};
use crate::on_path::speed::{Leg, PieceSequence, Run, boost_limits, drive_together};
use glidepath_program::Limits;

/// Runs that are driven together, and how.
pub(crate) struct JoinedRuns {
    pieces: Vec<Piece>,
    legs: Vec<Leg>,
}

/// Most pieces that are driven together.
const MOST_TOGETHER: usize = 512;

impl JoinedRuns {
    pub(crate) fn new(run: Run, (entry_v, exit_v): (f64, f64), limits: &Limits) -> Self {
        let sequence = PieceSequence::new(&run.pieces);
        let mut legs = run.drive(&sequence, entry_v, exit_v);
        boost_limits(&mut legs, &sequence, limits);
        Self {
            pieces: run.pieces,
            legs,
        }
    }

    /// Takes in the next runs if the last leg of this and the first of that are driven faster
    /// together; gives them back if not.
    pub(crate) fn join(&mut self, mut next: Self, limits: &Limits) -> Option<Self> {
        let count = self.pieces.len();
        let is_bent = |piece: &Piece| matches!(piece.shape, Shape::Spline(_));
        let has_curve =
            self.pieces.last().is_some_and(is_bent) || next.pieces.first().is_some_and(is_bent);
        if count + next.pieces.len() > MOST_TOGETHER || !has_curve {
            return Some(next);
        }
        self.pieces.append(&mut next.pieces);
        let sequence = PieceSequence::new(&self.pieces);
        let offset_s = sequence.starts_s[count];
        let mut others = next.legs.iter().map(|leg| Leg {
            from_s: leg.from_s + offset_s,
            ..*leg
        });
        let together = match (self.legs.last(), others.next()) {
            (Some(before), Some(after)) => drive_together((before, &after), &sequence, limits),
            _ => None,
        };
        if let Some(mut legs) = together {
            boost_limits(&mut legs, &sequence, limits);
            self.legs.pop();
            self.legs.extend(legs);
            self.legs.extend(others);
            return None;
        }
        next.pieces = self.pieces.split_off(count);
        Some(next)
    }

    pub(crate) fn settled(self) -> Settled {
        Settled::Motion {
            pieces: self.pieces,
            legs: self.legs,
        }
    }
}
