//! The parallel pipeline: the plan of a program, put together from what the workers give.

use std::io;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

use glidepath_geometry::AxisVector;
use glidepath_kinematics::LimitedMechanism;
use glidepath_motion::parts::Joiner;
use glidepath_program::{Frame, Item, ItemKind, Settings};

use super::bounds::Bounds;
use super::message::{PlanPiece, PlanStep};
use super::threads::Threads;
use crate::plan::blocks::Blocks;
use crate::plan::step::Step;
use crate::run::refusal::Refusal;
use crate::run::statistics::Statistics;
use crate::source::item_source::ItemSource;

/// As a [`crate::Pipeline`] of a whole program, planned by several threads: the same items and
/// frames, in the same order, to the bit.
///
/// It works ahead of its caller, up to a bound, and ends its threads when it is dropped.
#[derive(Debug)]
pub struct ParallelPipeline {
    joiner: Joiner,
    blocks: Blocks,
    /// The plans of the parts to come, in order; `None` when all were taken.
    parts: Option<Receiver<Receiver<PlanPiece>>>,
    /// The plan of the part at hand.
    part: Option<Receiver<PlanPiece>>,
    /// What was taken of it last.
    steps: std::vec::IntoIter<PlanStep>,
    /// The item taken last.
    item: Item,
    /// Why the program ended early, until that is told.
    refusal: Option<Refusal>,
    statistics: Statistics,
    bounds: Arc<Bounds>,
    threads: Threads,
}

impl ParallelPipeline {
    /// Starts to plan a program for a machine at rest at `start` (mm, degrees), with so many
    /// threads; `joints` for a machine whose joints are not its axes.
    ///
    /// # Errors
    /// A thread cannot be started.
    pub fn start<S: ItemSource + Send + 'static>(
        source: S,
        settings: Settings,
        start: AxisVector,
        joints: Option<LimitedMechanism>,
        workers: NonZeroUsize,
    ) -> io::Result<Self> {
        let settings = settings.beginning_at(&start);
        let bounds = Arc::new(Bounds::new());
        let (threads, parts) = Threads::start(source, (settings, start), joints, workers, &bounds)?;
        Ok(Self {
            joiner: Joiner::new(settings, start),
            blocks: Blocks::whole(),
            parts: Some(parts),
            part: None,
            steps: Vec::new().into_iter(),
            item: Item {
                block: 0,
                line: 0,
                kind: ItemKind::Dwell(0.0),
            },
            refusal: None,
            statistics: Statistics::default(),
            bounds,
            threads,
        })
    }

    /// Takes one step, as [`crate::Pipeline::step`]; never [`Step::Pending`].
    ///
    /// # Errors
    /// As [`crate::Pipeline::advance`].
    pub fn step(&mut self) -> Result<Step, Refusal> {
        loop {
            match self.joiner.make_frame() {
                Ok(true) => {
                    self.blocks.complete(self.joiner.frame_mut());
                    self.statistics.frames += 1;
                    return Ok(Step::Frame);
                }
                Ok(false) => {}
                Err(error) if self.parts.is_some() => {
                    self.stop();
                    return Err(error.into());
                }
                Err(_) => return Ok(Step::End),
            }
            match self.steps.next() {
                Some(PlanStep::Motion(step)) => self.joiner.add(step),
                Some(PlanStep::Item(item)) => {
                    self.count(&item);
                    self.item = item;
                    return Ok(Step::Item);
                }
                None if self.parts.is_none() => {
                    return self.refusal.take().map_or(Ok(Step::End), Err);
                }
                None => self.receive(),
            }
        }
    }

    /// The next frame; `None` at the end.
    ///
    /// # Errors
    /// As [`ParallelPipeline::step`].
    pub fn next_frame(&mut self) -> Result<Option<Frame>, Refusal> {
        loop {
            match self.step()? {
                Step::Frame => return Ok(Some(*self.frame())),
                Step::End => return Ok(None),
                Step::Item | Step::Pending => {}
            }
        }
    }

    /// The item that was taken last; before the first an empty dwell.
    #[must_use]
    pub const fn item(&self) -> &Item {
        &self.item
    }

    /// The frame made last; before the first one at rest at the start.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        self.joiner.frame()
    }

    /// Counts of what was taken so far.
    #[must_use]
    pub const fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn count(&mut self, item: &Item) {
        match item.kind {
            ItemKind::Move { .. } => self.statistics.segments += 1,
            ItemKind::Dwell(_) | ItemKind::Event(_) => self.statistics.others += 1,
        }
    }

    /// Waits for more of the plan, or its end.
    fn receive(&mut self) {
        let Some(parts) = &self.parts else { return };
        let Some(part) = &self.part else {
            match parts.recv() {
                Ok(part) => self.part = Some(part),
                Err(_) => self.end(),
            }
            return;
        };
        match part.recv() {
            Ok(PlanPiece::Steps {
                steps,
                weight,
                lines,
            }) => {
                self.bounds.plans.take(weight);
                self.statistics.lines = lines;
                self.steps = steps.into_iter();
            }
            Ok(PlanPiece::End) => {
                self.part = None;
                self.bounds.plans.go_on();
            }
            // A worker died; why is told by its panic.
            Err(_) => self.end(),
        }
    }

    /// All parts were taken.
    fn end(&mut self) {
        (self.parts, self.part) = (None, None);
        self.bounds.close();
        let end = self.threads.join().unwrap_or_default();
        self.refusal = end.refusal;
        self.statistics.lines = end.lines;
    }

    /// Nothing more is wanted.
    fn stop(&mut self) {
        (self.parts, self.part) = (None, None);
        self.bounds.close();
        self.threads.end();
    }
}

impl Drop for ParallelPipeline {
    fn drop(&mut self) {
        self.stop();
    }
}
