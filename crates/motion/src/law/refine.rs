//! Where a law takes the place of S-curves.

use super::Law;
use super::track::Track;
use crate::Limits;
use crate::piece::{Element, Piece};
use crate::schedule::Settled;
use crate::valley::{Course, Leg};
use std::collections::VecDeque;

/// Motion that is optimised together, s, as the S-curves drive it, and its most pieces: little enough
/// for the work to be done while what was published before is executed.
const WINDOW_T: f64 = 12.0;
/// A window ends where the S-curves are slowest, after this share of it: there little is lost.
const SHORTEST_R: f64 = 0.4;
const MOST_PIECES: usize = 4096;
/// How much slower than the S-curves a law starts, and passes from one window to the next.
const RATE_R: f64 = 0.85;
/// From rest to rest, other rates to start from.
const RATES: [f64; 4] = [RATE_R, 0.7, 0.55, 0.4];

/// Takes what is settled and gives it on, some of it driven faster.
#[derive(Debug)]
pub(crate) struct Refiner {
    limits: Limits,
    /// A curve has come: what is still to be driven gets laws, from the next rest on.
    is_wanted: bool,
    /// Nothing that goes on without a law was given on since the last rest.
    is_from_rest: bool,
    /// The motion goes on at [`RATE_R`] of the speed that the S-curves have.
    is_slowed: bool,
    pieces: Vec<Piece>,
    legs: Vec<Leg>,
    /// Where the motions end that these were settled as.
    ends: Vec<End>,
    length_s: f64,
    duration_t: f64,
}

/// Where a motion ends, from the start of what waits.
#[derive(Debug, Clone, Copy)]
struct End {
    pieces: usize,
    legs: usize,
    length_s: f64,
    duration_t: f64,
    exit_v: f64,
}

impl Refiner {
    pub(crate) const fn new(limits: Limits) -> Self {
        Self {
            limits,
            is_wanted: false,
            is_from_rest: true,
            is_slowed: false,
            pieces: Vec::new(),
            legs: Vec::new(),
            ends: Vec::new(),
            length_s: 0.0,
            duration_t: 0.0,
        }
    }

    /// A curve is among what comes.
    pub(crate) const fn want(&mut self) {
        self.is_wanted = true;
    }

    /// What waits here, in order.
    pub(crate) fn elements(&self) -> impl Iterator<Item = Element> {
        self.pieces.iter().cloned().map(Element::Piece)
    }

    /// What waits here, and what was given on, is planned anew from a speed.
    pub(crate) fn restart(&mut self, entry_v: f64) {
        *self = Self {
            is_wanted: self.is_wanted,
            is_from_rest: entry_v <= 0.0,
            ..Self::new(self.limits)
        };
    }

    /// Takes what was settled next.
    pub(crate) fn push(&mut self, settled: Settled, out: &mut VecDeque<Settled>) {
        match settled {
            Settled::Motion { pieces, legs } if self.is_wanted && self.is_from_rest => {
                self.take(pieces, &legs);
                if self.duration_t >= WINDOW_T || self.pieces.len() >= MOST_PIECES {
                    self.put_window(out);
                }
            }
            Settled::Motion { .. } | Settled::Lawful { .. } => {
                self.is_from_rest = false;
                out.push_back(settled);
            }
            Settled::Rest(_) => {
                self.put(out);
                self.is_from_rest = true;
                self.is_slowed = false;
                out.push_back(settled);
            }
        }
    }

    fn take(&mut self, pieces: Vec<Piece>, legs: &[Leg]) {
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
            exit_v: self.legs.last().map_or(0.0, |leg| leg.profile.exit_v()),
        });
    }

    /// Gives on what waits up to the slowest end in its later part.
    fn put_window(&mut self, out: &mut VecDeque<Settled>) {
        let shortest_t = SHORTEST_R * self.duration_t;
        let later = self.ends.iter().filter(|end| end.duration_t >= shortest_t);
        let slowest = later.min_by(|a, b| a.exit_v.total_cmp(&b.exit_v)).copied();
        let Some(end) = slowest else { return };
        let pieces = self.pieces.split_off(end.pieces);
        let mut legs = self.legs.split_off(end.legs);
        let (length_s, duration_t) = (self.length_s, self.duration_t);
        let ends = core::mem::take(&mut self.ends);
        self.duration_t = end.duration_t;
        self.put(out);
        for leg in &mut legs {
            leg.from_s -= end.length_s;
        }
        self.ends = ends
            .into_iter()
            .filter(|other| other.pieces > end.pieces)
            .map(|other| End {
                pieces: other.pieces - end.pieces,
                legs: other.legs - end.legs,
                length_s: other.length_s - end.length_s,
                duration_t: other.duration_t - end.duration_t,
                ..other
            })
            .collect();
        (self.pieces, self.legs) = (pieces, legs);
        self.length_s = length_s - end.length_s;
        self.duration_t = duration_t - end.duration_t;
    }

    fn put(&mut self, out: &mut VecDeque<Settled>) {
        let pieces = core::mem::take(&mut self.pieces);
        let legs = core::mem::take(&mut self.legs);
        let duration_t = core::mem::take(&mut self.duration_t);
        self.ends.clear();
        self.length_s = 0.0;
        let Some(exit_v) = legs.last().map(|leg| leg.profile.exit_v()) else {
            return;
        };
        let is_free = exit_v <= 0.0 && !self.is_slowed;
        self.is_slowed = exit_v > 0.0;
        let law = {
            let course = Course::new(&pieces);
            Track::new(&course, &legs, &self.limits).and_then(|track| {
                let rates = if is_free { &RATES[..] } else { &RATES[..1] };
                rates
                    .iter()
                    .find_map(|rate_r| track.optimise(&course, &self.limits, *rate_r))
            })
        };
        let law = if is_free {
            law.filter(|law| law.duration_t() < duration_t)
        } else {
            law.or_else(|| Law::slowed(&legs, RATE_R))
        };
        out.push_back(match law {
            Some(law) => Settled::Lawful { pieces, law },
            None => Settled::Motion { pieces, legs },
        });
    }
}
