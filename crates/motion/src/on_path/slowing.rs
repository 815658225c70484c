//! The path on which a lower override takes effect.

use super::pieces::Piece;
use crate::scurve::{PathLimits, slowing_horizon};
use glidepath_program::Override;

/// The path on which a speed is brought down to a lower override: there the old one still holds.
pub(crate) struct Slowing {
    from_v: f64,
    to: Override,
    passed_s: f64,
    weakest: Option<PathLimits>,
    pub(crate) over: bool,
}

impl Slowing {
    pub(crate) const fn new(from_v: f64, to: Override) -> Self {
        Self {
            from_v,
            to,
            passed_s: 0.0,
            weakest: None,
            over: false,
        }
    }

    /// What of the next piece is still needed for it, and what is not.
    pub(crate) fn split(&mut self, piece: Piece) -> (Option<Piece>, Option<Piece>) {
        let Override { feed_r, rapid_r } = piece.planned;
        let is_lower = self.to.feed_r < feed_r || self.to.rapid_r < rapid_r;
        if self.over || !is_lower {
            return (None, Some(piece));
        }
        let change = piece.limit.change;
        let weakest = self.weakest.map_or(change, |weakest| PathLimits {
            accel_a: weakest.accel_a.min(change.accel_a),
            jerk_j: weakest.jerk_j.min(change.jerk_j),
        });
        let needed_s = slowing_horizon(self.from_v, weakest) - self.passed_s;
        self.weakest = Some(weakest);
        self.passed_s += piece.length_s;
        let may_change = piece.limit.constant_above_v.is_infinite();
        if needed_s <= 0.0 {
            (None, Some(piece))
        } else if may_change && needed_s < 0.99 * piece.length_s {
            (
                Some(piece.clone().before(needed_s)),
                Some(piece.after(needed_s)),
            )
        } else {
            (Some(piece), None)
        }
    }
}
