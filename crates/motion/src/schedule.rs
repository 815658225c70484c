//! Look-ahead: the speed at every junction between runs.
//!
//! Between two rests the path is a chain of runs. A backward pass over the chain finds, for each
//! junction, the highest speed from which the machine can still come to rest at the end of what is
//! known; a forward pass drives as fast as that and the speed reached so far allow. Both use the
//! closed forms of [`crate::scurve`].
//!
//! A chain may be longer than memory, so runs are settled from the front as soon as enough path is
//! known beyond them. When that is depends on the path alone: on its length against the distance
//! that slowing down can take, and on a fixed number of pieces. Whatever comes later can only raise
//! the speeds of the backward pass, so what is settled stays feasible.

use crate::path::{Element, Piece, Rest};
use crate::run::{Leg, Run};
use crate::scurve::{PathLimits, ramp_fits, reachable_speed, slowing_horizon};
use std::collections::VecDeque;

/// A part of the motion that nothing later changes.
#[derive(Debug, Clone)]
pub(crate) enum Settled {
    /// Drive these pieces with these S-curves.
    Motion { pieces: Vec<Piece>, legs: Vec<Leg> },
    /// Rest.
    Rest(Rest),
}

/// Pieces waiting in a chain before some are settled whatever their length.
const MOST_WAITING: usize = 4096;

/// Gives speeds to pieces of path.
#[derive(Debug)]
pub(crate) struct Scheduler {
    /// The run that may still grow.
    open: Option<Run>,
    waiting: VecDeque<Run>,
    /// Length on which the waiting runs can slow down.
    waiting_s: f64,
    waiting_pieces: usize,
    /// Highest top speed and weakest limits met in the chain.
    fastest_v: f64,
    weakest: PathLimits,
    entry_v: f64,
}

const NO_LIMITS: PathLimits = PathLimits {
    accel_a: f64::INFINITY,
    jerk_j: f64::INFINITY,
};

impl Scheduler {
    pub(crate) const fn new() -> Self {
        Self {
            open: None,
            waiting: VecDeque::new(),
            waiting_s: 0.0,
            waiting_pieces: 0,
            fastest_v: 0.0,
            weakest: NO_LIMITS,
            entry_v: 0.0,
        }
    }

    /// Takes the next element and appends what it settles.
    pub(crate) fn push(&mut self, element: Element, out: &mut VecDeque<Settled>) {
        match element {
            Element::Piece(piece) => {
                let next = Run::new(piece);
                let closed = match &mut self.open {
                    Some(open) => match open.absorb(next) {
                        Some(next) => self.open.replace(next),
                        None => None,
                    },
                    None => self.open.replace(next),
                };
                if let Some(run) = closed {
                    self.enqueue(run);
                    self.settle_front(out);
                }
            }
            Element::Rest(rest) => {
                if let Some(run) = self.open.take() {
                    self.enqueue(run);
                }
                self.settle(self.waiting.len(), out);
                self.fastest_v = 0.0;
                self.weakest = NO_LIMITS;
                self.entry_v = 0.0;
                out.push_back(Settled::Rest(rest));
            }
        }
    }

    fn enqueue(&mut self, run: Run) {
        self.waiting_s += run.slowing_room_s();
        self.waiting_pieces += run.pieces.len();
        self.fastest_v = self.fastest_v.max(run.high_v);
        if let Some(change) = run.change {
            self.weakest.accel_a = self.weakest.accel_a.min(change.accel_a);
            self.weakest.jerk_j = self.weakest.jerk_j.min(change.jerk_j);
        }
        self.waiting.push_back(run);
    }

    /// Settles what has enough path beyond it.
    fn settle_front(&mut self, out: &mut VecDeque<Settled>) {
        let horizon_s = slowing_horizon(self.fastest_v, self.weakest);
        if self.waiting_pieces >= MOST_WAITING {
            self.settle(self.waiting.len().div_ceil(2), out);
        } else if self.waiting_s >= 2.0 * horizon_s {
            let mut beyond_s = self.waiting_s;
            let count = self
                .waiting
                .iter()
                .take_while(|run| {
                    beyond_s -= run.slowing_room_s();
                    beyond_s >= horizon_s
                })
                .count();
            self.settle(count, out);
        }
    }

    fn settle(&mut self, count: usize, out: &mut VecDeque<Settled>) {
        if count == 0 {
            return;
        }
        let highest_v = self.backward_pass();
        for i in 0..count {
            let Some(run) = self.waiting.pop_front() else {
                return;
            };
            let exit_v = exit_speed(&run, self.entry_v, highest_v[i + 1]);
            let legs = run.drive(self.entry_v, exit_v);
            self.entry_v = exit_v;
            self.waiting_s -= run.slowing_room_s();
            self.waiting_pieces -= run.pieces.len();
            out.push_back(Settled::Motion {
                pieces: run.pieces,
                legs,
            });
        }
        if self.waiting.is_empty() {
            self.waiting_s = 0.0;
        }
    }

    /// The highest speed at the start of each waiting run, and at rest after the last one.
    fn backward_pass(&self) -> Vec<f64> {
        let mut highest_v = vec![0.0; self.waiting.len() + 1];
        for (i, run) in self.waiting.iter().enumerate().rev() {
            let before_v = match i.checked_sub(1).and_then(|before| self.waiting.get(before)) {
                Some(before) => before.low_v,
                None => f64::INFINITY,
            };
            highest_v[i] = run
                .low_v
                .min(before_v)
                .min(highest_entry(run, highest_v[i + 1]));
        }
        highest_v
    }
}

/// The highest speed at which a run can be entered if it may be left at up to `exit_v`.
///
/// Reach is not monotone: a full stop can need less room than slowing down to `exit_v`. It falls
/// and then rises with the final speed, so one of the two ends of the range is the best.
fn highest_entry(run: &Run, exit_v: f64) -> f64 {
    match run.change {
        None => exit_v,
        Some(limits) => reachable_speed(exit_v, run.length_s, limits).max(reachable_speed(
            0.0,
            run.length_s,
            limits,
        )),
    }
}

/// The speed at which to leave a run entered at `entry_v`, at most `highest_v`.
fn exit_speed(run: &Run, entry_v: f64, highest_v: f64) -> f64 {
    let Some(limits) = run.change else {
        return entry_v;
    };
    if entry_v <= highest_v {
        return highest_v.min(reachable_speed(entry_v, run.length_s, limits));
    }
    let fits = |exit_v: f64| ramp_fits(entry_v, exit_v, run.length_s, limits);
    if fits(highest_v) {
        return highest_v;
    }
    // Too short to slow down just to that; slowing down further needs less room. The length of a
    // ramp rises with the final speed up to the worst one, so search below that.
    let knee_v = limits.accel_a * limits.accel_a / limits.jerk_j;
    let worst_v = entry_v - (2.0 / 3.0 * entry_v).min(knee_v);
    let (mut fits_v, mut exceeds_v) = (0.0, worst_v.min(highest_v));
    for _ in 0..60 {
        let middle_v = 0.5 * (fits_v + exceeds_v);
        if fits(middle_v) {
            fits_v = middle_v;
        } else {
            exceeds_v = middle_v;
        }
    }
    fits_v
}
