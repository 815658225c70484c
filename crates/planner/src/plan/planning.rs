//! The state of planning: all that the frames to come depend on, beside the items to come.

use glidepath_geometry::AxisVector;
use glidepath_motion::{Joints, PlanError, Planner};
use glidepath_program::{Frame, Item, Override, Settings};
use std::sync::Arc;

use crate::plan::blocks::Blocks;

/// Whether there will be more frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stage {
    /// More items may come.
    Open,
    /// No more items; frames may remain.
    Ended,
    /// Planning failed inside: there are no more frames.
    Broken,
}

/// An item that was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TakenItem {
    pub(crate) item: Item,
    /// It is not of the program.
    pub(crate) is_aside: bool,
}

/// Planner of motion and numbers of blocks, at one place of a program. A copy that is given the
/// same items makes the same frames.
#[derive(Debug, Clone)]
pub(crate) struct Planning {
    planner: Planner,
    joints: Option<Arc<dyn Joints>>,
    is_stream: bool,
    blocks: Blocks,
    stage: Stage,
    wanted: Override,
    /// Path position at the start, mm.
    start_s: f64,
    frames: u64,
    items: u64,
    /// Items taken since the last frame.
    items_since: u64,
}

impl Planning {
    /// From a machine at rest at `start`, `start_s` along the path of the program.
    pub(crate) fn new(settings: Settings, start: AxisVector, blocks: Blocks, start_s: f64) -> Self {
        Self {
            planner: Planner::new(settings.beginning_at(&start), start),
            joints: None,
            is_stream: false,
            blocks,
            stage: Stage::Open,
            wanted: Override::NONE,
            start_s,
            frames: 0,
            items: 0,
            items_since: 0,
        }
    }

    /// The same, before its first item, for a machine whose joints are not its axes.
    pub(crate) fn with_joints(self, joints: Option<Arc<dyn Joints>>) -> Self {
        let planner = match &joints {
            Some(joints) => self.planner.with_joints(Arc::clone(joints)),
            None => self.planner,
        };
        Self {
            planner,
            joints,
            ..self
        }
    }

    /// The same, before its first item, for items that come while the motion waits for them.
    pub(crate) fn of_stream(self) -> Self {
        Self {
            planner: self.planner.of_stream(),
            is_stream: true,
            ..self
        }
    }

    /// The same program behind what was planned of it, from a machine at rest elsewhere.
    pub(crate) fn behind(&self, settings: Settings, start: AxisVector, start_s: f64) -> Self {
        let planning = Self::new(settings, start, self.blocks.clone(), start_s)
            .with_joints(self.joints.clone());
        if self.is_stream {
            planning.of_stream()
        } else {
            planning
        }
    }

    /// Makes the next frame, if the motion is settled that far.
    pub(crate) fn make_frame(&mut self) -> Result<bool, PlanError> {
        if self.stage == Stage::Broken {
            return Ok(false);
        }
        match self.planner.make_frame() {
            Ok(true) => {
                let frame = self.planner.frame_mut();
                self.blocks.complete(frame);
                frame.path_s += self.start_s;
                self.frames += 1;
                self.items_since = 0;
                Ok(true)
            }
            Ok(false) => Ok(false),
            Err(error) => {
                self.stage = Stage::Broken;
                Err(error)
            }
        }
    }

    /// Takes the next item; returns it with the number of its block.
    pub(crate) fn take(&mut self, mut item: Item) -> Result<Item, PlanError> {
        self.blocks.number(&mut item);
        self.planner.push(&item)?;
        self.items += 1;
        self.items_since += 1;
        Ok(item)
    }

    /// Takes an item that is not of the program, in the block of the item before it.
    pub(crate) fn take_aside(&mut self, mut item: Item) -> Result<Item, PlanError> {
        self.blocks.share(&mut item);
        self.planner.push(&item)?;
        self.items += 1;
        self.items_since += 1;
        Ok(item)
    }

    /// Takes an item once more.
    pub(crate) fn take_again(&mut self, kept: TakenItem) -> Result<Item, PlanError> {
        if kept.is_aside {
            self.take_aside(kept.item)
        } else {
            self.take(kept.item)
        }
    }

    /// An item is left out: the probe has ended the motion before it.
    pub(crate) const fn pass(&mut self) {
        self.blocks.pass();
        self.items += 1;
    }

    /// Likewise one that is not of the program.
    pub(crate) const fn pass_aside(&mut self) {
        self.items += 1;
    }

    /// There are no more items.
    pub(crate) fn finish(&mut self) {
        self.planner.finish();
        self.stage = Stage::Ended;
    }

    /// Plans what no frame was made of with this override, if it is another than before.
    pub(crate) fn follow_override(&mut self, wanted: Override) {
        // A refusal cannot be: status records with overrides out of range are not accepted.
        if wanted != self.wanted && self.planner.set_override(wanted).is_ok() {
            self.wanted = wanted;
        }
    }

    pub(crate) const fn stage(&self) -> Stage {
        self.stage
    }

    /// The frame made last; before the first one at rest at the start.
    pub(crate) const fn frame(&self) -> &Frame {
        self.planner.frame()
    }

    /// Block of the last frame, 0 before the first.
    pub(crate) const fn block(&self) -> u32 {
        self.blocks.present()
    }

    /// Frames made.
    pub(crate) const fn frames(&self) -> u64 {
        self.frames
    }

    /// Items taken.
    pub(crate) const fn items(&self) -> u64 {
        self.items
    }

    /// Items taken since the last frame.
    pub(crate) const fn items_since_frame(&self) -> u64 {
        self.items_since
    }
}
