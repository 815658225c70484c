//! The refiner: it takes settled motion and gives it on, with time parametrisations on what is
//! curved.
//!
//! Motion is taken in windows. A window on which S-curves are good enough stays with them; any other
//! is driven by a parametrisation, which starts from the S-curves slowed down. Where one window
//! meets the next the motion has no acceleration.
//!
//! A parametrisation can begin and end at the speed of the S-curves where these cruise: there is
//! room to slow the start down and to speed it up. So it takes over from S-curves, and they from it.
//! The last motion of a window that stays with S-curves is held back for that: mostly it is a line
//! that leads up to the curve.
//! Elsewhere it passes on slowed down to another parametrisation.

use super::motion_chain::MotionChain;
use super::worth::{blocks_on, is_dense, is_worthwhile};
use crate::joints::MachineLimits;
use crate::on_path::look_ahead::{PlannedMotion, Settled};
use crate::on_path::pieces::{Element, Piece};
use crate::on_path::speed::{Leg, PieceSequence, boost_leg};
use crate::on_path::topp::{KnotPath, Parametrisation, SolverTolerances, keeps_limits, optimise};
use std::collections::VecDeque;

/// Motion that is optimised together, s, as the S-curves drive it, and its most pieces: little
/// enough for the work to be done while what was published before is executed.
const WINDOW_T: f64 = 2.0;
const WINDOW_OF_NURBS_T: f64 = 12.0;
const MOST_PIECES: usize = 4096;
/// Blocks that wait at most where S-curves are good enough: there may be any number of them in a second.
const MOST_BLOCKS: usize = 4096;
/// A window ends where the S-curves are slowest, after this share of it: there little is lost.
const SHORTEST_R: f64 = 0.4;
/// How much slower than the S-curves a time parametrisation starts, and passes from one window to
/// the next. A start needs room in every limit ([`crate::on_path::topp`]): this leaves .15 of the speed, .28
/// of acceleration, .39 of jerk. No measurement of it is kept.
pub(crate) const RATE_R: f64 = 0.85;
/// Where no parametrisation is found, the window is parted in this share of it, so often at most.
const MIDDLE_R: [f64; 2] = [0.2, 0.8];
const HALVINGS: u32 = 6;
/// The last motion of a window that stays with S-curves is held back if it takes no longer, s: a
/// parametrisation of what follows can take over on it.
const HELD_T: f64 = 4.0;
/// Where S-curves cruise so long, s, a time parametrisation can take over from them at their speed. No
/// measurement of it is kept.
const CRUISE_T: f64 = 0.05;
/// Where S-curves cannot be left at their own speed, they are left after this share of the time,
/// tried so often.
const LATER_R: f64 = 0.1;
const MOST_STARTS: u32 = 8;
/// From rest to rest, other rates to start from, where the first leaves no room. No measurement of them is
/// kept.
const RATES: [f64; 4] = [RATE_R, 0.7, 0.55, 0.4];
/// Stops are not refined unless the S-curves between them take less than this many times what the
/// other way takes: no parametrisation gains so much. On circles that jerk binds S-curves
/// took up to twice the time of the steady speed.
const HOPELESS_R: f64 = 2.0;

/// Takes what is settled and gives it on, some of it driven faster.
#[derive(Debug, Clone)]
pub(crate) struct Refiner {
    limits: MachineLimits,
    /// A NURBS has come: what is still to be driven gets parametrisations, from the next rest on.
    is_wanted: bool,
    /// The motion was planned anew from a speed: it keeps to S-curves up to the next rest.
    is_fixed: bool,
    /// The motion goes on at [`RATE_R`] of the speed that the S-curves have.
    is_slowed: bool,
    waiting: MotionChain,
    /// Of what waits, pieces on which S-curves are good enough, and how long these take, s.
    held: (usize, f64),
    /// Blocks that wait beside those.
    blocks: usize,
}

impl Refiner {
    pub(crate) fn new(limits: MachineLimits) -> Self {
        Self {
            limits,
            is_wanted: false,
            is_fixed: false,
            is_slowed: false,
            waiting: MotionChain::default(),
            held: (0, 0.0),
            blocks: 0,
        }
    }

    /// A NURBS is among what comes.
    pub(crate) const fn want(&mut self) {
        self.is_wanted = true;
    }

    /// What waits here, in order.
    pub(crate) fn elements(&self) -> impl Iterator<Item = Element> {
        self.waiting.pieces.iter().cloned().map(Element::Piece)
    }

    /// What waits here, and what was given on, is planned anew from a speed: that of the S-curves, or
    /// [`RATE_R`] of it, so that parametrisations go on.
    pub(crate) fn restart(&mut self, entry_v: f64, is_slowed: bool) {
        *self = Self {
            is_wanted: self.is_wanted,
            is_fixed: entry_v > 0.0 && !is_slowed,
            is_slowed,
            ..Self::new(self.limits.clone())
        };
    }

    /// Takes what was planned next.
    pub(crate) fn push(&mut self, planned: PlannedMotion, out: &mut VecDeque<Settled>) {
        match planned {
            PlannedMotion::One(settled) => self.push_settled(settled, out),
            PlannedMotion::Either {
                passing,
                stopping,
                rests_t,
            } => {
                let stopping_t = rests_t + duration_t(&stopping);
                let is_hopeless = stopping_t > HOPELESS_R * duration_t(&passing);
                let passing = self.alone(passing);
                let faster = if is_hopeless {
                    None
                } else {
                    let stopping = self.alone(stopping);
                    let gained_t = duration_t(&passing) - duration_t(&stopping) - rests_t;
                    (gained_t > 0.0).then_some(stopping)
                };
                out.extend(faster.unwrap_or(passing));
            }
        }
    }

    /// A stretch from rest to rest, refined.
    fn alone(&self, stretch: Vec<Settled>) -> VecDeque<Settled> {
        let mut refiner = Self {
            is_wanted: self.is_wanted,
            ..Self::new(self.limits.clone())
        };
        let mut out = VecDeque::new();
        for settled in stretch {
            refiner.push_settled(settled, &mut out);
        }
        refiner.put(&mut out);
        out
    }

    fn push_settled(&mut self, settled: Settled, out: &mut VecDeque<Settled>) {
        match settled {
            Settled::Motion { pieces, legs } if !self.is_fixed => {
                let looks = self.blocks / MOST_BLOCKS;
                self.blocks += blocks_on(&pieces);
                let is_due = self.blocks / MOST_BLOCKS > looks;
                self.waiting.push(pieces, &legs);
                let window_t = if self.is_wanted {
                    WINDOW_OF_NURBS_T
                } else {
                    WINDOW_T
                };
                let duration_t = self.waiting.duration_t - self.held.1;
                let pieces = self.waiting.pieces.len();
                if duration_t >= window_t || pieces >= MOST_PIECES || (is_due && self.is_good()) {
                    self.put_window(out);
                }
            }
            Settled::Motion { .. } | Settled::Parametrised { .. } => out.push_back(settled),
            Settled::Rest(_) => {
                self.put(out);
                self.is_fixed = false;
                self.is_slowed = false;
                out.push_back(settled);
            }
        }
    }

    /// Gives on what waits up to the slowest end in its later part; all but the last motion if the
    /// S-curves are good enough.
    fn put_window(&mut self, out: &mut VecDeque<Settled>) {
        if self.is_good() {
            let last = if self.blocks >= MOST_BLOCKS {
                MotionChain::default()
            } else {
                self.waiting.split_last(HELD_T)
            };
            self.blocks = 0;
            self.held = (last.pieces.len(), last.duration_t);
            out.extend(core::mem::replace(&mut self.waiting, last).settled());
            return;
        }
        self.held = (0, 0.0);
        self.blocks = 0;
        let Some(end) = self.waiting.slowest([SHORTEST_R, 1.0]) else {
            return;
        };
        let remainder = self.waiting.split_off(&end);
        let goes_on =
            self.waiting.cruises_t()[1] >= CRUISE_T && remainder.cruises_t()[0] >= CRUISE_T;
        self.refine(goes_on, out);
        self.waiting = remainder;
    }

    /// Gives on what waits.
    fn put(&mut self, out: &mut VecDeque<Settled>) {
        let is_good = self.is_good();
        self.held = (0, 0.0);
        self.blocks = 0;
        if is_good {
            out.extend(core::mem::take(&mut self.waiting).settled());
        } else {
            self.refine(false, out);
        }
    }

    /// True if what waits may stay as it is, and is better left so.
    fn is_good(&self) -> bool {
        let (pieces, duration_t) = self.held;
        let fresh = (
            self.waiting.pieces.get(pieces..).unwrap_or_default(),
            self.waiting.duration_t - duration_t,
        );
        !self.is_wanted && !self.is_slowed && !is_worthwhile(fresh, &self.limits)
    }

    /// A time parametrisation in place of the S-curves that wait. `at_speed`: they cruise at their
    /// end, which it may reach at their speed.
    fn refine(&mut self, at_speed: bool, out: &mut VecDeque<Settled>) {
        let mut chain = core::mem::take(&mut self.waiting);
        self.boost(&mut chain);
        for _ in 0..MOST_STARTS {
            if chain.legs.is_empty() {
                return;
            }
            if let Some(parametrisation) = self.whole(&chain, at_speed) {
                self.is_slowed = chain.exit_v() > 0.0 && !at_speed;
                let MotionChain { pieces, .. } = chain;
                out.push_back(Settled::Parametrised {
                    pieces,
                    parametrisation,
                });
                return;
            }
            if self.is_slowed || (chain.entry_v() <= 0.0 && chain.exit_v() > 0.0) {
                self.is_slowed = chain.exit_v() > 0.0;
                return self.put_slowed(chain, HALVINGS, out);
            }
            // The S-curves are left a little later.
            let Some(end) = chain.first_after(LATER_R).filter(|_| chain.entry_v() > 0.0) else {
                break;
            };
            let remainder = chain.split_off(&end);
            out.extend(core::mem::replace(&mut chain, remainder).settled());
        }
        out.extend(chain.settled());
    }

    /// Faster S-curves where joints are not the axes: those at hand keep to what joints leave wherever they
    /// are on a piece.
    fn boost(&self, chain: &mut MotionChain) {
        if self.limits.joints.is_none() {
            return;
        }
        let sequence = PieceSequence::new(&chain.pieces);
        for leg in &mut chain.legs {
            boost_leg(leg, &sequence, |faster| {
                keeps_limits(faster, &sequence, &self.limits)
            });
        }
        chain.time();
    }

    /// A time parametrisation along a chain that takes less time than S-curves, as fast as these at
    /// its start unless it is slowed, and `at_speed` at its end.
    fn whole(&self, chain: &MotionChain, at_speed: bool) -> Option<Parametrisation> {
        let ends_v = [chain.entry_v(), chain.exit_v()];
        let is_at_speed = [
            ends_v[0] > 0.0 && !self.is_slowed,
            ends_v[1] > 0.0 && at_speed,
        ];
        let ends_r = is_at_speed.map(|is_at_speed| is_at_speed.then_some(1.0));
        let rates: &[f64] = if ends_v.iter().all(|v| *v <= 0.0) {
            &RATES
        } else {
            &[RATE_R]
        };
        self.parametrisation(&chain.pieces, &chain.legs, rates, ends_r)
            .filter(|found| self.is_slowed || found.duration_t() < chain.duration_t)
    }

    /// With a time parametrisation that begins and ends at [`RATE_R`] of the speed of the S-curves.
    /// If none is found for all of it, one is for most of its parts: only where there is none, the
    /// S-curves are driven slower.
    fn put_slowed(&self, mut chain: MotionChain, halvings: u32, out: &mut VecDeque<Settled>) {
        let parametrisation =
            self.parametrisation(&chain.pieces, &chain.legs, &[RATE_R], [None; 2]);
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

    /// A time parametrisation that starts from the S-curves at the first of some rates that will do.
    fn parametrisation(
        &self,
        pieces: &[Piece],
        legs: &[Leg],
        rates: &[f64],
        ends_r: [Option<f64>; 2],
    ) -> Option<Parametrisation> {
        let sequence = PieceSequence::new(pieces);
        let tolerances = if self.is_wanted {
            SolverTolerances::CLOSE
        } else if is_dense(
            pieces,
            legs.iter().map(|leg| leg.profile.duration_t()).sum(),
        ) {
            SolverTolerances::COARSE
        } else if self.limits.joints.is_some() {
            SolverTolerances::OF_JOINTS
        } else {
            SolverTolerances::QUICK
        };
        let knot_path = KnotPath::new(&sequence, legs, &self.limits, &tolerances, ends_r)?;
        optimise(knot_path, &sequence, &self.limits, (rates, &tolerances))
    }
}

fn duration_t<'a>(stretch: impl IntoIterator<Item = &'a Settled>) -> f64 {
    stretch.into_iter().map(Settled::duration_t).sum()
}
