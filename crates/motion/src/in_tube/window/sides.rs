//! The sides of a piece on which a motion is to stay, and where an axis stops next to it.
//!
//! ```text
//!   before ●━━━━━━━━━━━●  at rest         An axis stops where it comes to a rest, sets out from one, or
//!         ╱   borders   ╲                 turns round at a corner. There its coordinate has a border,
//!        ╱               ╲  after         of a rest at the stop that is nearer.
//! ```

use super::corner::{RunCorners, is_middle};
use crate::in_tube::path::TubePiece;

/// How far from a place at which an axis turns round it may go either way, in radii.
pub(super) const TURNING_R: f64 = 4.0;

/// Where a motion is to be straight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Straight {
    /// From which progress to which.
    pub(super) between: [f64; 2],
    /// How far it may be beside the line there, in units of the window.
    pub(super) within: f64,
}

impl Straight {
    /// That of a piece of so much `length` from `s` on, in a window with a unit of so many mm.
    pub(super) fn of(piece: &TubePiece, (s, length): (f64, f64), unit_mm: f64) -> Option<Self> {
        piece.straight.map(|straight| Self {
            between: straight.between_u.map(|share| s + share * length),
            within: straight.within_mm / unit_mm,
        })
    }
}

/// Where an axis stops, next to a piece.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stop {
    /// The sign with which it comes to it, or sets out from it; 0 if there is none.
    pub(super) sign: f64,
    /// Coordinate.
    pub(super) at: f64,
    /// Progress.
    pub(super) s: f64,
    /// It turns round there.
    pub(super) is_turn: bool,
}

/// An axis along a piece.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AxisSides {
    /// The sign of its motion; 0 at rest, and where it goes there and back.
    pub(super) way: f64,
    pub(super) is_rest: bool,
    /// Coordinates at which its run of pieces with the same way begins, and ends as far as is seen.
    pub(super) from: f64,
    pub(super) to: f64,
    /// The stops before and after.
    pub(super) before: Stop,
    pub(super) after: Stop,
}

/// The sides of a piece.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sides<const D: usize> {
    pub(super) axes: [AxisSides; D],
    /// Of the run that it is of.
    pub(super) corners: RunCorners<D>,
}

impl<const D: usize> Sides<D> {
    pub(crate) fn none() -> Self {
        Self {
            axes: [AxisSides::default(); D],
            corners: RunCorners::NONE,
        }
    }
}

/// `normal · p ≥ least`
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace<const D: usize> {
    pub(crate) normal: [f64; D],
    pub(crate) least: f64,
    /// The axis whose coordinate alone counts.
    pub(crate) axis: Option<usize>,
}

impl AxisSides {
    /// True if it goes on the same way along the next piece.
    pub(super) fn goes_on_as(&self, next: &Self) -> bool {
        let is_bent = !self.is_rest && self.way.abs() <= 0.0;
        !is_bent && self.is_rest == next.is_rest && self.way.total_cmp(&next.way).is_eq()
    }

    /// The sides of a coordinate at a progress: the sign of what is inside, and the border.
    pub(super) fn borders(&self, progress: f64) -> [Option<(f64, f64)>; 2] {
        let (before, after) = (self.before, self.after);
        if !self.is_rest {
            let from = (before.sign != 0.0).then_some((self.way, before.at));
            let until = (after.sign != 0.0).then_some((-self.way, after.at));
            return [from, until];
        }
        let crosses = self.before.sign * self.after.sign > 0.0;
        if crosses && is_middle(progress, [self.before.s, self.after.s]) {
            return [None; 2];
        }
        match self.nearer_stop(progress) {
            Some((stop, sign)) => [Some((sign * stop.sign, self.from)), None],
            None => [None; 2],
        }
    }

    /// Of a rest: the stop that is nearer, and on which side of it the motion is, seen along its sign.
    fn nearer_stop(&self, progress: f64) -> Option<(Stop, f64)> {
        let (before, after) = (self.before, self.after);
        let is_before =
            before.sign != 0.0 && (after.sign == 0.0 || progress - before.s <= after.s - progress);
        if is_before {
            Some((before, -1.0))
        } else if after.sign != 0.0 {
            Some((after, 1.0))
        } else {
            None
        }
    }

    /// The direction in which it may go at a progress, with so much way in a knot interval; 0 if it may
    /// go either way.
    pub(super) fn sense(&self, progress: f64, radius: f64, way: f64) -> f64 {
        if self.is_rest {
            return self
                .nearer_stop(progress)
                .map_or(0.0, |(stop, _)| stop.sign);
        }
        let is_turning = |stop: &Stop| {
            stop.sign != 0.0
                && stop.is_turn
                && (progress - stop.s).abs() < (TURNING_R * radius).max(way)
        };
        if is_turning(&self.before) || is_turning(&self.after) {
            0.0
        } else {
            self.way
        }
    }
}
