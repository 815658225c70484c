//! A chain of motions by S-curves, one after the other.

use crate::on_path::look_ahead::Settled;
use crate::on_path::pieces::Piece;
use crate::on_path::speed::Leg;

/// Times that differ by less are the same, s.
const ROUNDING_T: f64 = 1e-9;

/// Motions one after the other, as they were settled.
#[derive(Debug, Clone, Default)]
pub(super) struct MotionChain {
    pub(super) pieces: Vec<Piece>,
    pub(super) legs: Vec<Leg>,
    /// Where the motions end.
    ends: Vec<End>,
    length_s: f64,
    pub(super) duration_t: f64,
}

/// Where a motion ends, from the start of its chain.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    pieces: usize,
    legs: usize,
    length_s: f64,
    duration_t: f64,
    exit_v: f64,
}

impl MotionChain {
    pub(super) fn push(&mut self, pieces: Vec<Piece>, legs: &[Leg]) {
        for leg in legs {
            self.legs.push(Leg {
                from_s: self.length_s + leg.from_s,
                ..*leg
            });
            self.duration_t += leg.profile.duration_t();
        }
        self.length_s += pieces.iter().map(|piece| piece.length_s).sum::<f64>();
        self.pieces.extend(pieces);
        self.ends.push(End {
            pieces: self.pieces.len(),
            legs: self.legs.len(),
            length_s: self.length_s,
            duration_t: self.duration_t,
            exit_v: self.exit_v(),
        });
    }

    /// Sums up how long the legs take, once they take another time.
    pub(super) fn time(&mut self) {
        let (mut passed, mut duration_t) = (0, 0.0);
        for end in &mut self.ends {
            let own = self.legs.iter().take(end.legs).skip(passed);
            duration_t += own.map(|leg| leg.profile.duration_t()).sum::<f64>();
            (passed, end.duration_t) = (end.legs, duration_t);
        }
        self.duration_t = duration_t;
    }

    pub(super) fn exit_v(&self) -> f64 {
        self.legs.last().map_or(0.0, |leg| leg.profile.exit_v())
    }

    pub(super) fn entry_v(&self) -> f64 {
        self.legs.first().map_or(0.0, |leg| leg.profile.entry_v())
    }

    /// Takes away the last motion if it takes no longer than this, s; else nothing.
    pub(super) fn split_last(&mut self, most_t: f64) -> Self {
        let (before_t, before) = match self.ends.as_slice() {
            [.., before, _] => (before.duration_t, Some(*before)),
            _ => (0.0, None),
        };
        if self.duration_t - before_t > most_t {
            return Self::default();
        }
        match before {
            Some(before) => self.split_off(&before),
            None => core::mem::take(self),
        }
    }

    /// How long the S-curves keep the speed at which they begin, and that at which they end, s.
    pub(super) fn cruises_t(&self) -> [f64; 2] {
        let (mut first_t, mut last_t) = (0.0, 0.0);
        for leg in &self.legs {
            let (cruise, duration_t) = (leg.profile.cruise_t(), leg.profile.duration_t());
            if cruise.start > ROUNDING_T {
                break;
            }
            first_t += cruise.end;
            if cruise.end < duration_t - ROUNDING_T {
                break;
            }
        }
        for leg in self.legs.iter().rev() {
            let (cruise, duration_t) = (leg.profile.cruise_t(), leg.profile.duration_t());
            if cruise.end < duration_t - ROUNDING_T {
                break;
            }
            last_t += duration_t - cruise.start;
            if cruise.start > ROUNDING_T {
                break;
            }
        }
        [first_t, last_t]
    }

    /// The first end after a share of the time, if another follows.
    pub(super) fn first_after(&self, share_r: f64) -> Option<End> {
        let others = self.ends.split_last()?.1;
        let is_after = |end: &&End| end.duration_t >= share_r * self.duration_t;
        others.iter().find(is_after).copied()
    }

    /// The end at which the S-curves are slowest, between two shares of the time.
    pub(super) fn slowest(&self, share_r: [f64; 2]) -> Option<End> {
        let [from_t, to_t] = share_r.map(|share_r| share_r * self.duration_t);
        let within = |end: &&End| end.duration_t >= from_t && end.duration_t <= to_t;
        let ends = self.ends.iter().filter(within);
        ends.min_by(|a, b| a.exit_v.total_cmp(&b.exit_v)).copied()
    }

    /// Keeps what lies before the end of a motion; the rest.
    pub(super) fn split_off(&mut self, end: &End) -> Self {
        let mut legs = self.legs.split_off(end.legs);
        for leg in &mut legs {
            leg.from_s -= end.length_s;
        }
        let ends = self.ends.iter().filter(|other| other.pieces > end.pieces);
        let remainder = Self {
            pieces: self.pieces.split_off(end.pieces),
            legs,
            ends: ends
                .map(|other| End {
                    pieces: other.pieces - end.pieces,
                    legs: other.legs - end.legs,
                    length_s: other.length_s - end.length_s,
                    duration_t: other.duration_t - end.duration_t,
                    ..*other
                })
                .collect(),
            length_s: self.length_s - end.length_s,
            duration_t: self.duration_t - end.duration_t,
        };
        self.ends.retain(|other| other.pieces <= end.pieces);
        (self.length_s, self.duration_t) = (end.length_s, end.duration_t);
        remainder
    }

    /// The motions, each by itself again.
    pub(super) fn settled(self) -> impl Iterator<Item = Settled> {
        let (mut pieces, mut legs) = (self.pieces.into_iter(), self.legs.into_iter());
        let (mut before, mut start_s) = ((0, 0), 0.0);
        self.ends.into_iter().map(move |end| {
            let counts = (end.pieces - before.0, end.legs - before.1);
            let from_s = start_s;
            (before, start_s) = ((end.pieces, end.legs), end.length_s);
            let own = legs.by_ref().take(counts.1).map(|leg| Leg {
                from_s: leg.from_s - from_s,
                ..leg
            });
            Settled::Motion {
                legs: own.collect(),
                pieces: pieces.by_ref().take(counts.0).collect(),
            }
        })
    }
}
