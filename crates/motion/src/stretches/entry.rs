//! The entry of a stretch: what it is planned with, and a run that is given its items one by one.

use super::engine_run::{EngineRun, InitialState, Strategy};
use crate::PlanError;
use glidepath_program::{Frame, Item};
use std::sync::Arc;

/// What a stretch is planned with, from its first item on.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) initial_state: InitialState,
    pub(crate) items: Arc<[Item]>,
    /// Time of its moves at their rates, s.
    pub(crate) at_rates_t: f64,
}

impl Entry {
    /// The whole stretch, to be driven by some strategy.
    pub(crate) fn run(self, strategy: Strategy) -> Result<EngineRun, PlanError> {
        SuppliedRun::new(strategy, self).whole()
    }
}

/// A run along a stretch that is given its items as it needs them, so that it holds no more of them
/// than it looks ahead.
#[derive(Debug, Clone)]
pub(crate) struct SuppliedRun {
    run: EngineRun,
    items: Arc<[Item]>,
    pushed: usize,
}

impl SuppliedRun {
    pub(crate) fn new(strategy: Strategy, entry: Entry) -> Self {
        Self {
            run: EngineRun::new(strategy, entry.initial_state),
            items: entry.items,
            pushed: 0,
        }
    }

    /// The next frame; `None` behind the last one.
    pub(crate) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        loop {
            let frame = self.run.pop_frame()?;
            if frame.is_some() || self.run.is_finished() {
                return Ok(frame);
            }
            self.push_next()?;
        }
    }

    /// How long it is, mm, once all frames are taken.
    pub(crate) fn length_s(&self) -> Result<f64, PlanError> {
        let line = self.items.last().map_or(0, |item| item.line);
        self.run.length_s().ok_or(PlanError::NoMotion { line })
    }

    /// Multiplications of the solvers so far.
    pub(crate) fn work(&self) -> usize {
        self.run.work()
    }

    /// The run, given all the rest.
    pub(crate) fn whole(mut self) -> Result<EngineRun, PlanError> {
        while !self.run.is_finished() {
            self.push_next()?;
        }
        Ok(self.run)
    }

    fn push_next(&mut self) -> Result<(), PlanError> {
        if let Some(item) = self.items.get(self.pushed) {
            self.pushed += 1;
            self.run.push(item)
        } else {
            self.run.finish();
            Ok(())
        }
    }
}
