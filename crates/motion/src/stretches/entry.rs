//! The entry of a stretch: what it is planned with, and a way that is given its items one by one.

use super::way::{Manner, Outset, Way};
use crate::PlanError;
use glidepath_program::{Frame, Item};
use std::sync::Arc;

/// What a stretch is planned with, from its first item on.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) outset: Outset,
    pub(crate) items: Arc<[Item]>,
    /// Time of its moves at their rates, s.
    pub(crate) at_rates_t: f64,
}

impl Entry {
    /// The whole stretch, to be driven in some manner.
    pub(crate) fn way(self, manner: Manner) -> Result<Way, PlanError> {
        SuppliedWay::new(manner, self).whole()
    }
}

/// A way along a stretch that is given its items as it needs them, so that it holds no more of them
/// than it looks ahead.
#[derive(Debug, Clone)]
pub(crate) struct SuppliedWay {
    way: Way,
    items: Arc<[Item]>,
    pushed: usize,
}

impl SuppliedWay {
    pub(crate) fn new(manner: Manner, entry: Entry) -> Self {
        Self {
            way: Way::new(manner, entry.outset),
            items: entry.items,
            pushed: 0,
        }
    }

    /// The next frame; `None` behind the last one.
    pub(crate) fn pop_frame(&mut self) -> Result<Option<Frame>, PlanError> {
        loop {
            let frame = self.way.pop_frame()?;
            if frame.is_some() || self.way.is_finished() {
                return Ok(frame);
            }
            self.push_next()?;
        }
    }

    /// How long it is, mm, once all frames are taken.
    pub(crate) fn length_s(&self) -> Result<f64, PlanError> {
        let line = self.items.last().map_or(0, |item| item.line);
        self.way.length_s().ok_or(PlanError::NoMotion { line })
    }

    /// Multiplications of the solvers so far.
    pub(crate) fn work(&self) -> usize {
        self.way.work()
    }

    /// The way, given all the rest.
    pub(crate) fn whole(mut self) -> Result<Way, PlanError> {
        while !self.way.is_finished() {
            self.push_next()?;
        }
        Ok(self.way)
    }

    fn push_next(&mut self) -> Result<(), PlanError> {
        if let Some(item) = self.items.get(self.pushed) {
            self.pushed += 1;
            self.way.push(item)
        } else {
            self.way.finish();
            Ok(())
        }
    }
}
