//! Where a time parametrisation takes the place of S-curves.

use super::look_ahead::Settled;
use super::pieces::{Element, Piece};
use super::speed::{Course, Leg};
use super::topp::{KnotPath, Parametrisation, optimise};
use glidepath_program::Limits;
use std::collections::VecDeque;

/// Motion that is optimised together, s, as the S-curves drive it, and its most pieces: little
/// enough for the work to be done while what was published before is executed.
const WINDOW_T: f64 = 12.0;
/// A window ends where the S-curves are slowest, after this share of it: there little is lost.
const SHORTEST_R: f64 = 0.4;
const MOST_PIECES: usize = 4096;
/// How much slower than the S-curves a time parametrisation starts, and passes from one window to
/// the next.
const RATE_R: f64 = 0.85;
/// Where no parametrisation is found, the window is parted in this share of it, so often at most.
const MIDDLE_R: [f64; 2] = [0.2, 0.8];
const HALVINGS: u32 = 6;
/// From rest to rest, other rates to start from.
const RATES: [f64; 4] = [RATE_R, 0.7, 0.55, 0.4];

/// Takes what is settled and gives it on, some of it driven faster.
#[derive(Debug, Clone)]
pub(crate) struct Refiner {
    limits: Limits,
    /// A curve has come: what is still to be driven gets parametrisations, from the next rest on.
    is_wanted: bool,
    /// Nothing that goes on without a time parametrisation was given on since the last rest.
    is_from_rest: bool,
    /// The motion goes on at [`RATE_R`] of the speed that the S-curves have.
    is_slowed: bool,
    waiting: MotionChain,
}

/// Motions one after the other, as they were settled.
#[derive(Debug, Clone, Default)]
struct MotionChain {
    pieces: Vec<Piece>,
    legs: Vec<Leg>,
    /// Where the motions end.
    ends: Vec<End>,
    length_s: f64,
    duration_t: f64,
}

/// Where a motion ends, from the start of its chain.
#[derive(Debug, Clone, Copy)]
struct End {
    pieces: usize,
    legs: usize,
    length_s: f64,
    duration_t: f64,
    exit_v: f64,
}

impl MotionChain {
    fn push(&mut self, pieces: Vec<Piece>, legs: &[Leg]) {
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

    fn exit_v(&self) -> f64 {
        self.legs.last().map_or(0.0, |leg| leg.profile.exit_v())
    }

    /// The end at which the S-curves are slowest, between two shares of the time.
    fn slowest(&self, share_r: [f64; 2]) -> Option<End> {
        let [from_t, to_t] = share_r.map(|share_r| share_r * self.duration_t);
        let within = |end: &&End| end.duration_t >= from_t && end.duration_t <= to_t;
        let ends = self.ends.iter().filter(within);
        ends.min_by(|a, b| a.exit_v.total_cmp(&b.exit_v)).copied()
    }

    /// Keeps what lies before the end of a motion; the rest.
    fn split_off(&mut self, end: &End) -> Self {
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
}

impl Refiner {
    pub(crate) fn new(limits: Limits) -> Self {
        Self {
            limits,
            is_wanted: false,
            is_from_rest: true,
            is_slowed: false,
            waiting: MotionChain::default(),
        }
    }

    /// A curve is among what comes.
    pub(crate) const fn want(&mut self) {
        self.is_wanted = true;
    }

    /// What waits here, in order.
    pub(crate) fn elements(&self) -> impl Iterator<Item = Element> {
        self.waiting.pieces.iter().cloned().map(Element::Piece)
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
                self.waiting.push(pieces, &legs);
                let MotionChain {
                    duration_t, pieces, ..
                } = &self.waiting;
                if *duration_t >= WINDOW_T || pieces.len() >= MOST_PIECES {
                    self.put_window(out);
                }
            }
            Settled::Motion { .. } | Settled::Parametrised { .. } => {
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

    /// Gives on what waits up to the slowest end in its later part.
    fn put_window(&mut self, out: &mut VecDeque<Settled>) {
        let Some(end) = self.waiting.slowest([SHORTEST_R, 1.0]) else {
            return;
        };
        let remainder = self.waiting.split_off(&end);
        self.put(out);
        self.waiting = remainder;
    }

    fn put(&mut self, out: &mut VecDeque<Settled>) {
        let chain = core::mem::take(&mut self.waiting);
        if chain.legs.is_empty() {
            return;
        }
        let is_free = chain.exit_v() <= 0.0 && !self.is_slowed;
        self.is_slowed = chain.exit_v() > 0.0;
        if !is_free {
            return self.put_slowed(chain, HALVINGS, out);
        }
        let MotionChain {
            pieces,
            legs,
            duration_t,
            ..
        } = chain;
        let parametrisation = self.parametrisation(&pieces, &legs, &RATES);
        out.push_back(
            match parametrisation
                .filter(|parametrisation| parametrisation.duration_t() < duration_t)
            {
                Some(parametrisation) => Settled::Parametrised {
                    pieces,
                    parametrisation,
                },
                None => Settled::Motion { pieces, legs },
            },
        );
    }

    /// With a time parametrisation that begins and ends at [`RATE_R`] of the speed of the S-curves.
    /// If none is found for all of it, one is for most of its parts: only where there is none, the
    /// S-curves are driven slower.
    fn put_slowed(&self, mut chain: MotionChain, halvings: u32, out: &mut VecDeque<Settled>) {
        let parametrisation = self.parametrisation(&chain.pieces, &chain.legs, &[RATE_R]);
        if parametrisation.is_none()
            && let Some(fewer) = halvings.checked_sub(1)
            && let Some(middle) = chain.slowest(MIDDLE_R)
        {
            let remainder = chain.split_off(&middle);
            self.put_slowed(chain, fewer, out);
            self.put_slowed(remainder, fewer, out);
            return;
        }
        let MotionChain { pieces, legs, .. } = chain;
        out.push_back(
            match parametrisation.or_else(|| Parametrisation::slowed(&legs, RATE_R)) {
                Some(parametrisation) => Settled::Parametrised {
                    pieces,
                    parametrisation,
                },
                None => Settled::Motion { pieces, legs },
            },
        );
    }

    /// A time parametrisation from the first of some rates from which one is found.
    fn parametrisation(
        &self,
        pieces: &[Piece],
        legs: &[Leg],
        rates: &[f64],
    ) -> Option<Parametrisation> {
        let course = Course::new(pieces);
        let knot_path = KnotPath::new(&course, legs, &self.limits)?;
        rates
            .iter()
            .find_map(|rate_r| optimise(&knot_path, &course, &self.limits, *rate_r))
    }
}
