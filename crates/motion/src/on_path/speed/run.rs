//! Runs: stretches of path that one S-curve, or a few, drive through.
//!
//! Junctions between runs are passed with zero acceleration along the path. Where the path allows a
//! useful change of speed within one piece, the piece is a run by itself and nothing is lost. Where
//! pieces are so short that it does not, many form one run, and the speed inside is found valley
//! first ([`super::valley_first`]).

use super::piece_sequence::{Leg, PieceSequence};
use super::valley_first::{Limiting, SPEED_ROUNDING_R, Section, ValleyFirst};
use crate::on_path::pieces::{Piece, SpeedLimit};
use crate::scurve::{PathLimits, Profile, ramp_fits, reachable_speed, slowing_horizon};

/// A stretch of path with zero acceleration along it at both ends.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub pieces: Vec<Piece>,
    pub length_s: f64,
    /// Lowest and highest top speed of its pieces.
    pub low_v: f64,
    pub high_v: f64,
    /// The weakest limits of its pieces.
    pub change: PathLimits,
    /// Above this speed the speed has to be constant.
    pub constant_above_v: f64,
    /// Lowest top speed of its curved pieces.
    curved_v: f64,
}

/// Most pieces of one run: finding its speed may go through all of them for each S-curve.
const MOST_PIECES: usize = 512;
/// A run is not made longer than so many lengths in which its highest speed is brought down.
const MOST_HORIZONS: f64 = 4.0;
/// A run is short if it does not allow this share of the speed around it to be gained. With more, longer
/// pieces lose their own limits to the weakest of the run; with less, more junctions are passed without
/// acceleration.
const USEFUL_CHANGE_R: f64 = 0.1;
/// Curved pieces belong to one run while their top speeds differ by at most this factor. A run has the
/// weakest limits of its pieces, so a sharp one is kept out of a fast one. No measurement of it is kept.
const SIMILAR_SPEED_R: f64 = 2.5;

impl Run {
    pub(crate) fn new(piece: Piece) -> Self {
        let SpeedLimit {
            top_v,
            change,
            constant_above_v,
            ..
        } = piece.limit;
        Self {
            length_s: piece.length_s,
            low_v: top_v,
            high_v: top_v,
            change,
            constant_above_v,
            curved_v: if piece.is_straight() {
                f64::INFINITY
            } else {
                top_v
            },
            pieces: vec![piece],
        }
    }

    /// The length on which the speed may change.
    pub(crate) const fn slowing_room_s(&self) -> f64 {
        if self.constant_above_v < self.low_v {
            0.0
        } else {
            self.length_s
        }
    }

    /// Adds the pieces of the next run if both are driven better as one; gives it back if not.
    pub(crate) fn absorb(&mut self, next: Self) -> Option<Self> {
        let full = self.pieces.len() >= MOST_PIECES
            || self.length_s > MOST_HORIZONS * slowing_horizon(self.high_v, self.change);
        if full || !(self.continues_straight(&next) || self.is_short_beside(&next)) {
            return Some(next);
        }
        self.length_s += next.length_s;
        self.low_v = self.low_v.min(next.low_v);
        self.high_v = self.high_v.max(next.high_v);
        self.curved_v = self.curved_v.min(next.curved_v);
        self.change = self.change.weaker(next.change);
        self.pieces.extend(next.pieces);
        None
    }

    /// Two straight runs of one direction: nothing is lost by driving them as one.
    fn continues_straight(&self, next: &Self) -> bool {
        self.curved_v.is_infinite() && next.curved_v.is_infinite() && self.change == next.change
    }

    /// True if both runs are about as fast, and neither is long enough for a useful change of that
    /// speed.
    fn is_short_beside(&self, next: &Self) -> bool {
        let (mine_v, its_v) = (self.curved_v, next.curved_v);
        let slower_v = mine_v.min(its_v);
        let similar = mine_v.is_infinite()
            || its_v.is_infinite()
            || mine_v.max(its_v) <= SIMILAR_SPEED_R * slower_v;
        let may_change = |run: &Self| run.constant_above_v.is_infinite();
        // What has been put together before was short.
        let short = |run: &Self| {
            let is_made_up = run.pieces.len() > 1 && run.curved_v.is_finite();
            is_made_up
                || reachable_speed(slower_v, run.length_s, run.change)
                    < (1.0 + USEFUL_CHANGE_R) * slower_v
        };
        slower_v.is_finite()
            && similar
            && may_change(self)
            && may_change(next)
            && short(self)
            && short(next)
    }

    /// The highest speed at which the run can be entered if it is left at `exit_v`.
    pub(crate) fn highest_entry(&self, exit_v: f64) -> f64 {
        if exit_v >= self.constant_above_v {
            return exit_v;
        }
        reachable_speed(exit_v, self.length_s, self.change)
            .min(self.low_v)
            .min(self.constant_above_v)
    }

    /// The speed at which to leave the run if it is entered at `entry_v` and may be left at up to
    /// `highest_v`; `None` if it is too short to slow down to that.
    pub(crate) fn exit_speed(&self, entry_v: f64, highest_v: f64) -> Option<f64> {
        if entry_v >= self.constant_above_v {
            return (entry_v <= highest_v * (1.0 + SPEED_ROUNDING_R)).then_some(entry_v);
        }
        let highest_v = highest_v.min(self.constant_above_v);
        if entry_v <= highest_v {
            return Some(highest_v.min(reachable_speed(entry_v, self.length_s, self.change)));
        }
        ramp_fits(entry_v, highest_v, self.length_s, self.change).then_some(highest_v)
    }

    /// The S-curves through the run (`sequence` is that of its pieces), from `entry_v` to `exit_v`,
    /// both at most [`Run::low_v`] and feasible over its length.
    pub(crate) fn drive(
        &self,
        sequence: &PieceSequence<'_>,
        entry_v: f64,
        exit_v: f64,
    ) -> Vec<Leg> {
        let mut legs = Vec::new();
        if self.constant_above_v < self.low_v {
            let top_v = self.constant_above_v.max(entry_v);
            let profile = Profile::new(entry_v, exit_v, self.length_s, top_v, self.change);
            legs.extend(profile.map(|profile| Leg {
                from_s: 0.0,
                profile,
            }));
            return legs;
        }
        let section = Section {
            from_s: 0.0,
            to_s: sequence.length_s(),
            entry_v,
            exit_v,
        };
        let caps_v: Vec<f64> = self.pieces.iter().map(|piece| piece.limit.top_v).collect();
        let valley = ValleyFirst {
            sequence,
            caps_v: &caps_v,
            limiting: Limiting::Weakest(self.change),
        };
        valley.drive(section).unwrap_or_default()
    }
}
