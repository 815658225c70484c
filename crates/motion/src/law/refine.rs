//! Where a law takes the place of S-curves.

use super::Law;
use super::rows::Problem;
use super::track::Track;
use crate::Limits;
use crate::piece::{Element, Piece};
use crate::schedule::Settled;
use crate::valley::Leg;
use std::collections::VecDeque;

/// Motion that is optimised together, s, and its most pieces.
const WINDOW_T: f64 = 30.0;
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
    length_s: f64,
    duration_t: f64,
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
                    self.put(out);
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
    }

    fn put(&mut self, out: &mut VecDeque<Settled>) {
        let pieces = core::mem::take(&mut self.pieces);
        let legs = core::mem::take(&mut self.legs);
        let duration_t = core::mem::take(&mut self.duration_t);
        self.length_s = 0.0;
        let Some(exit_v) = legs.last().map(|leg| leg.profile.exit_v()) else {
            return;
        };
        let is_free = exit_v <= 0.0 && !self.is_slowed;
        self.is_slowed = exit_v > 0.0;
        let law = Track::new(&pieces, &legs, &self.limits).and_then(|track| {
            let problem = Problem::new(&track, &self.limits);
            let rates = if is_free { &RATES[..] } else { &RATES[..1] };
            rates
                .iter()
                .find_map(|rate_r| track.optimise(&problem, *rate_r))
        });
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
