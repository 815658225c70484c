//! The engine of one stretch: what moves the machine at present, and what comes next.

use super::flattening::{Flattener, Product};
use super::ledger::{Ledger, LedgerEntry};
use super::path::Reference;
use super::period::Period;
use super::planner::TubePlanner;
use super::window::SearchBias;
use super::work_queue::WorkQueue;
use crate::PlanError;
use crate::grid::{FrameGrid, Moving};
use crate::joints::SharedJoints;
use crate::on_path::OnPathEngine;
use crate::rest::Rest;
use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, FrameFlags, Item, Override, Settings};

/// The in-tube engine, for one stretch between two rests of the program.
#[derive(Debug, Clone)]
pub(crate) struct InTubeEngine {
    settings: Settings,
    joints: SharedJoints,
    wanted: Override,
    bias: SearchBias,
    work_queue: WorkQueue,
    flattener: Flattener,
    grid: FrameGrid,
    drive: Drive,
    /// Multiplications of the solvers for what was driven before the drive at hand.
    work: usize,
    /// Where the last stretch ended.
    position: AxisVector,
    path_s: f64,
}

/// What moves the machine.
#[derive(Debug, Clone)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one, and it is replaced at a rest only"
)]
enum Drive {
    /// At rest.
    None,
    Window(Stretch),
    Exact(ExactPath),
}

impl Drive {
    fn work(&self) -> usize {
        match self {
            Self::Window(stretch) => stretch.planner.work(),
            Self::None | Self::Exact(_) => 0,
        }
    }
}

/// What is driven in the tube, from a rest to the next.
#[derive(Debug, Clone)]
struct Stretch {
    planner: TubePlanner,
    ledger: Ledger,
    length_s: f64,
    end: AxisVector,
    /// The rest at its end, once that is known.
    then: Option<Rest>,
}

/// A stretch to be passed exactly.
#[derive(Debug, Clone)]
struct ExactPath {
    engine: OnPathEngine,
    /// Where its last frame is, once that is taken.
    end: Option<(AxisVector, f64)>,
}

impl InTubeEngine {
    /// An engine for a machine at rest at `start`, under an override from the first move on.
    pub(crate) fn new(
        settings: Settings,
        start: AxisVector,
        wanted: Override,
        bias: SearchBias,
    ) -> Self {
        Self {
            settings,
            joints: None,
            wanted,
            bias,
            work_queue: WorkQueue::new(settings, start),
            flattener: Flattener::new(settings),
            grid: FrameGrid::new(settings.period_t, start),
            drive: Drive::None,
            work: 0,
            position: start,
            path_s: 0.0,
        }
    }

    /// The same engine, before its first item, for joints that are not the axes.
    pub(crate) fn with_joints(self, joints: SharedJoints) -> Self {
        Self { joints, ..self }
    }

    /// Takes the next item of the stretch: a move, or an event that does not stop the motion.
    pub(crate) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        self.work_queue.push(item)
    }

    /// The stretch ends with what has been pushed.
    pub(crate) fn finish(&mut self) {
        self.work_queue.finish();
    }

    /// Multiplications of the solvers so far.
    pub(crate) fn work(&self) -> usize {
        self.work + self.drive.work()
    }

    /// Plans what follows with another override, from the state given out last.
    pub(crate) fn set_override(&mut self, wanted: Override) {
        self.wanted = wanted;
        match &mut self.drive {
            Drive::None => {}
            Drive::Window(Stretch {
                planner, ledger, ..
            }) => {
                ledger.set_override(wanted);
                planner.set_rates(|tag| ledger.rate(tag));
            }
            Drive::Exact(exact) => exact.engine.set_override(wanted),
        }
    }

    /// The next frame; see [`crate::Planner::pop_frame`].
    pub(crate) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        loop {
            if let Some(frame) = self.grid.rest_frame() {
                return Ok(Some(frame));
            }
            let moved = match &mut self.drive {
                Drive::None => None,
                Drive::Window(stretch) => stretch.planner.next_period().map(Moved::Period),
                Drive::Exact(exact) => exact.engine.pop_frame()?.map(Moved::Exact),
            };
            let frame = match moved {
                Some(Moved::Period(period)) => self.tell(&period),
                Some(Moved::Exact(frame)) => self.relay(frame),
                None if self.arrive() => None,
                None if self.is_stuck() => {
                    let line = self.grid.line().number;
                    return Err(PlanError::NoMotion { line });
                }
                None if self.supply()? => None,
                None => return Ok(None),
            };
            if frame.is_some() {
                return Ok(frame);
            }
        }
    }

    /// Gives the drive at hand its next piece, or sets up a rest; false if the program is not known
    /// further.
    fn supply(&mut self) -> Result<bool, PlanError> {
        let Some(product) = self.flattener.next(&mut self.work_queue) else {
            return Ok(false);
        };
        match product {
            Product::Piece(entry, reference) => self.extend(entry, reference),
            Product::Exact(item) => {
                if !matches!(self.drive, Drive::Exact(_)) {
                    let engine = OnPathEngine::new(self.settings, self.position, self.wanted)
                        .with_joints(self.joints.clone());
                    self.drive = Drive::Exact(ExactPath { engine, end: None });
                }
                if let Drive::Exact(exact) = &mut self.drive {
                    exact.engine.push(&item)?;
                }
            }
            Product::ExactEnd => {
                if let Drive::Exact(exact) = &mut self.drive {
                    exact.engine.finish();
                }
            }
            Product::Rest(rest) => match &mut self.drive {
                Drive::Window(stretch) => {
                    stretch.planner.finish();
                    stretch.then = Some(rest);
                }
                Drive::None | Drive::Exact(_) => {
                    self.grid.enter_rest(rest);
                }
            },
        }
        Ok(true)
    }

    fn extend(&mut self, entry: LedgerEntry, mut reference: Reference) {
        if !matches!(self.drive, Drive::Window(_)) {
            let Settings {
                limits,
                period_t,
                corners,
                ..
            } = &self.settings;
            self.drive = Drive::Window(Stretch {
                planner: TubePlanner::new(limits, *period_t, self.position, self.bias)
                    .with_joints(self.joints.clone())
                    .with_corners(*corners),
                ledger: Ledger::new(self.wanted),
                length_s: 0.0,
                end: self.position,
                then: None,
            });
        }
        if let Drive::Window(stretch) = &mut self.drive {
            stretch.length_s += entry.length_s;
            stretch.end = reference.end;
            reference.tag = stretch.ledger.push(entry);
            reference.rate = stretch.ledger.rate(reference.tag);
            stretch.planner.push(reference);
        }
    }

    /// The frame of a period, if it is not the one at which a rest begins.
    fn tell(&mut self, period: &Period) -> Option<Frame> {
        let Drive::Window(stretch) = &mut self.drive else {
            return None;
        };
        let (grid, start_s) = (&mut self.grid, self.path_s);
        let here = (period.tag, period.path_s);
        stretch.ledger.come_to(here, |events, from_s, beside| {
            grid.announce(events, start_s + from_s, beside);
        });
        if period.rest_at_end {
            grid.pass(stretch.ledger.passing(period.path_s));
            return None;
        }
        grid.pass(stretch.ledger.passing_at(period.path_s, period.path_v));
        Some(grid.motion_frame(&Moving {
            path_v: period.path_v,
            path_s: self.path_s + period.path_s,
            position: period.position,
            velocity: period.velocity,
            acceleration: period.acceleration,
        }))
    }

    /// True if a stretch whose end is known gives no motion: there is nothing to wait for.
    const fn is_stuck(&self) -> bool {
        matches!(&self.drive, Drive::Window(stretch) if stretch.then.is_some())
    }

    /// Ends a drive that has reached its end; false if there is none.
    fn arrive(&mut self) -> bool {
        let (end, end_s, then) = match &mut self.drive {
            Drive::Window(stretch) if stretch.planner.is_over() && stretch.then.is_some() => {
                let (grid, start_s) = (&mut self.grid, self.path_s);
                let ledger = &mut stretch.ledger;
                ledger.come_to((u64::MAX, f64::INFINITY), |events, from_s, beside| {
                    grid.announce(events, start_s + from_s, beside);
                });
                grid.pass(ledger.passing(f64::INFINITY));
                let end_s = self.path_s + stretch.length_s;
                (stretch.end, end_s, stretch.then)
            }
            Drive::Exact(ExactPath {
                end: Some((end, end_s)),
                ..
            }) => (*end, *end_s, None),
            _ => return false,
        };
        self.position = end;
        self.path_s = end_s;
        self.grid.leave(end, end_s);
        self.work += self.drive.work();
        self.drive = Drive::None;
        if let Some(rest) = then {
            self.grid.enter_rest(rest);
        }
        true
    }

    /// A frame of the on-path engine as one of this motion. Its first is the one given out last,
    /// and at its last the rest begins.
    fn relay(&mut self, mut frame: Frame) -> Option<Frame> {
        frame.path_s += self.path_s;
        if frame.flags.contains(FrameFlags::LAST)
            && let Drive::Exact(exact) = &mut self.drive
        {
            exact.end = Some((frame.position, frame.path_s));
            return None;
        }
        if frame.flags.contains(FrameFlags::FIRST) {
            None
        } else {
            Some(self.grid.relay(frame))
        }
    }
}

/// What a drive gives for a period.
#[allow(clippy::large_enum_variant, reason = "on the stack, one at a time")]
enum Moved {
    Period(Period),
    Exact(Frame),
}
