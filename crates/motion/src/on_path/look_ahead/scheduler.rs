//! Look-ahead: the speed at every junction between runs.
//!
//! Between two rests the path is a chain of runs. A backward pass over the chain finds, for each
//! junction, the highest speed from which the machine can still come to rest at the end of what is
//! known; a forward pass drives as fast as that and the speed reached so far allow. Both use the
//! closed forms of [`crate::scurve`].
//!
//! A chain may be longer than memory, so runs are settled from the front as soon as enough path is
//! known beyond them. When that is depends on the path alone: on its length against the distance
//! that slowing down can take, and on a fixed number of pieces. What comes later nearly always
//! raises the speeds of the backward pass, but not always: reach is not monotone, and from a speed
//! from which one could stop, one may be unable to slow down just a little. Then the motion follows
//! the plan that was made when its speed was settled, which ends at rest, until it meets the new
//! one.

use super::joined_runs::JoinedRuns;
use super::planned::PlannedMotion;
use super::settled::Settled;
use super::stop_at_each::drive_each;
use crate::on_path::pieces::{Element, Piece};
use crate::on_path::speed::Run;
use crate::rest::{Rest, RestKind};
use crate::scurve::{PathLimits, slowing_horizon};
use glidepath_program::Limits;
use std::collections::VecDeque;

/// Pieces waiting in a chain before some are settled whatever their length.
const MOST_WAITING: usize = 4096;

/// The start of a stretch is not settled before it has so many pieces, or takes so long, s: short
/// stretches are planned both ways.
const MOST_WHOLE: usize = 512;
const WHOLE_T: f64 = 1.0;

/// A speed above another by less than this factor is rounding.
const ROUNDING_R: f64 = 1.0 + 1e-9;

/// Gives speeds to pieces of path.
#[derive(Debug, Clone)]
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
    /// Speed at the start of the first waiting run.
    entry_v: f64,
    /// The speeds at the ends of the waiting runs as they were planned when the runs before them
    /// were settled.
    planned_v: Vec<f64>,
    /// The speed at the start leaves no way to slow down in time.
    infeasible: bool,
    limits: Limits,
    period_t: f64,
    /// The other way to drive the stretch at hand, and whether its stops need a setpoint.
    stops: Option<(Vec<Piece>, bool)>,
    /// Nothing of the stretch at hand was put out.
    is_whole: bool,
    /// What of it is settled: all of it up to a rest that is none of the program's.
    held: VecDeque<Settled>,
}

const NO_LIMITS: PathLimits = PathLimits {
    accel_a: f64::INFINITY,
    jerk_j: f64::INFINITY,
};

impl Scheduler {
    pub(crate) const fn new(limits: Limits, period_t: f64) -> Self {
        Self {
            limits,
            period_t,
            stops: None,
            is_whole: true,
            held: VecDeque::new(),
            open: None,
            waiting: VecDeque::new(),
            waiting_s: 0.0,
            waiting_pieces: 0,
            fastest_v: 0.0,
            weakest: NO_LIMITS,
            entry_v: 0.0,
            planned_v: Vec::new(),
            infeasible: false,
        }
    }

    /// A scheduler for path that is entered at a speed, with zero acceleration along it.
    pub(crate) fn entered_at(entry_v: f64, limits: Limits, period_t: f64) -> Self {
        Self {
            entry_v,
            is_whole: false,
            ..Self::new(limits, period_t)
        }
    }

    /// All that was not put out, in order.
    pub(crate) fn elements(&self) -> impl Iterator<Item = Element> {
        let waiting = self.waiting.iter().chain(&self.open);
        let waiting = waiting.flat_map(|run| run.pieces.iter().cloned());
        let held = self.held.iter().flat_map(Settled::elements);
        held.chain(waiting.map(Element::Piece))
    }

    /// Ends the open run, so that a junction comes next.
    pub(crate) fn close_run(&mut self) {
        if let Some(run) = self.open.take() {
            self.enqueue(run);
        }
    }

    /// Makes sure of a plan from the speed at hand to rest at the end of the waiting runs; false if
    /// there is none.
    pub(crate) fn is_feasible(&mut self) -> bool {
        if self.waiting.is_empty() {
            self.close_run();
        }
        let planned_v = self.forward_pass(&self.backward_pass());
        self.planned_v = planned_v;
        !self.infeasible
    }

    /// Takes the next element and appends what it settles.
    pub(crate) fn push(&mut self, element: Element, out: &mut VecDeque<PlannedMotion>) {
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
            Element::Stops { pieces, exact } => self.stops = Some((pieces, exact)),
            Element::Rest(rest) => {
                self.close_run();
                match self.stops.take().filter(|_| self.is_whole) {
                    Some((pieces, exact)) => self.settle_stretch(pieces, exact, out),
                    None => {
                        self.settle(self.waiting.len());
                        self.put_held(out);
                    }
                }
                self.is_whole = true;
                self.start_from_rest();
                out.push_back(PlannedMotion::One(Settled::Rest(rest)));
            }
            Element::InnerRest(rest) => {
                self.close_run();
                self.settle(self.waiting.len());
                self.held.push_back(Settled::Rest(rest));
                if !self.is_whole {
                    self.put_held(out);
                }
                self.start_from_rest();
            }
        }
    }

    fn start_from_rest(&mut self) {
        self.fastest_v = 0.0;
        self.weakest = NO_LIMITS;
        self.entry_v = 0.0;
        self.planned_v.clear();
    }

    /// Settles some runs while the stretch goes on.
    fn settle_some(&mut self, count: usize, out: &mut VecDeque<PlannedMotion>) {
        if count > 0 {
            self.is_whole = false;
            self.settle(count);
            self.put_held(out);
        }
    }

    /// Gives on what is settled.
    fn put_held(&mut self, out: &mut VecDeque<PlannedMotion>) {
        out.extend(self.held.drain(..).map(PlannedMotion::One));
    }

    fn enqueue(&mut self, run: Run) {
        self.waiting_s += run.slowing_room_s();
        self.waiting_pieces += run.pieces.len();
        self.fastest_v = self.fastest_v.max(run.high_v);
        if run.slowing_room_s() > 0.0 {
            self.weakest.accel_a = self.weakest.accel_a.min(run.change.accel_a);
            self.weakest.jerk_j = self.weakest.jerk_j.min(run.change.jerk_j);
        }
        self.waiting.push_back(run);
    }

    /// Settles what has enough path beyond it.
    fn settle_front(&mut self, out: &mut VecDeque<PlannedMotion>) {
        let horizon_s = slowing_horizon(self.fastest_v, self.weakest);
        let whole_s = 2.0 * horizon_s + self.fastest_v * WHOLE_T;
        if self.is_whole && self.waiting_pieces < MOST_WHOLE && self.waiting_s < whole_s {
            return;
        }
        if self.waiting_pieces >= MOST_WAITING {
            self.settle_some(self.waiting.len().div_ceil(2), out);
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
            self.settle_some(count, out);
        }
    }

    /// Settles a whole stretch between two rests: as planned, or at rest after each piece.
    fn settle_stretch(
        &mut self,
        pieces: Vec<Piece>,
        exact: bool,
        out: &mut VecDeque<PlannedMotion>,
    ) {
        self.settle(self.waiting.len());
        let Some(legs) = drive_each(&pieces) else {
            return self.put_held(out);
        };
        let kind = if exact {
            RestKind::ExactStop
        } else {
            RestKind::Corner
        };
        let rests_t = if exact {
            self.period_t * legs.len() as f64
        } else {
            0.0
        };
        let last = legs.len() - 1;
        let mut stopping = Vec::with_capacity(2 * legs.len());
        for (i, (piece, leg)) in pieces.into_iter().zip(legs).enumerate() {
            let line = piece.line;
            let (pieces, legs) = (vec![piece], vec![leg]);
            stopping.push(Settled::Motion { pieces, legs });
            if i < last {
                stopping.push(Settled::Rest(Rest { kind, line }));
            }
        }
        out.push_back(PlannedMotion::Either {
            passing: self.held.drain(..).collect(),
            stopping,
            rests_t,
        });
    }

    /// Settles some runs.
    fn settle(&mut self, count: usize) {
        if count == 0 {
            return;
        }
        let planned_v = self.forward_pass(&self.backward_pass());
        let mut joined: Option<JoinedRuns> = None;
        for &exit_v in planned_v.iter().take(count) {
            let Some(run) = self.waiting.pop_front() else {
                break;
            };
            self.waiting_s -= run.slowing_room_s();
            self.waiting_pieces -= run.pieces.len();
            let next = JoinedRuns::new(run, (self.entry_v, exit_v), &self.limits);
            self.entry_v = exit_v;
            let done = match &mut joined {
                Some(joined) => joined
                    .join(next, &self.limits)
                    .map(|next| core::mem::replace(joined, next)),
                None => joined.replace(next),
            };
            self.held.extend(done.map(JoinedRuns::settled));
        }
        self.held.extend(joined.map(JoinedRuns::settled));
        self.planned_v.clear();
        self.planned_v.extend(planned_v.into_iter().skip(count));
        if self.waiting.is_empty() {
            self.waiting_s = 0.0;
        }
    }

    /// The speed at the end of each waiting run.
    fn forward_pass(&mut self, highest_v: &[f64]) -> Vec<f64> {
        let mut entry_v = self.entry_v;
        let mut on_plan = true;
        let mut planned_v = Vec::with_capacity(self.waiting.len());
        for (i, run) in self.waiting.iter().enumerate() {
            let before_v = self.planned_v.get(i).copied().filter(|_| on_plan);
            let exit_v = match (run.exit_speed(entry_v, highest_v[i + 1]), before_v) {
                (Some(exit_v), _) if entry_v <= highest_v[i] * ROUNDING_R => {
                    on_plan &= before_v == Some(exit_v);
                    exit_v
                }
                (_, Some(exit_v)) => exit_v,
                (exit_v, None) => {
                    self.infeasible = true;
                    exit_v.unwrap_or(0.0)
                }
            };
            planned_v.push(exit_v);
            entry_v = exit_v;
        }
        planned_v
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
                .min(run.highest_entry(highest_v[i + 1]));
        }
        highest_v
    }
}
