//! From items to frames, pulled by whoever needs the next frame.
//!
//! ```text
//!   source ──next_item──▶ planner.push ──▶ (look-ahead) ──pop_frame──▶ caller
//! ```
//!
//! Nothing runs ahead of the caller: an item is taken from the source only when the planner has no
//! frame left to give, so the memory in use is the planner's look-ahead, whatever the length of the
//! program.
//!
//! If the source fails midway (an error in a pipe, a client that died) the planner is told that the
//! program ends at the last good item. The motion then comes to rest there, on the path, and the
//! reason comes out after the last frame.

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_kinematics::PathCaps;
use glidepath_motion::Planner;
use glidepath_program::{Frame, Item, ItemKind, Override, Settings};

use crate::blocks::Blocks;
use crate::joint_speed::JointSpeed;
use crate::{ItemSource, Refusal, Remainder, Supply};

/// One step of a pipeline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Output {
    /// The planner took this item. An auditor listens to these.
    Item(Item),
    /// The next frame.
    Frame(Frame),
    /// The source has nothing yet and the planner cannot go on without.
    Pending,
    /// All frames are out.
    End,
}

/// What a step came to. What it made is shown by the pipeline: items and frames are large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// The planner took an item: [`Pipeline::item`].
    Item,
    /// A frame was made: [`Pipeline::frame`].
    Frame,
    /// See [`Output::Pending`].
    Pending,
    /// All frames are out.
    End,
}

/// What a pipeline has done so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Lines of program text read (items, where there is no text).
    pub lines: u64,
    /// Segments planned.
    pub segments: u64,
    /// Dwells and events planned.
    pub others: u64,
    /// Frames given out.
    pub frames: u64,
    /// Time spent in reading and planning, if the pipeline was given a clock.
    pub planning: Duration,
}

/// Whether the program can still grow.
#[derive(Debug)]
enum Program {
    Open,
    /// No more items; frames may remain. Holds the reason if the program ended early.
    Ended(Option<Refusal>),
    /// Planning failed inside: there are no more frames.
    Broken,
}

/// Source and planner, joined.
#[derive(Debug)]
pub struct Pipeline<S> {
    source: S,
    planner: Planner,
    /// The item taken last.
    item: Item,
    program: Program,
    statistics: Statistics,
    clock: Option<fn() -> Duration>,
    wanted: Override,
    blocks: Blocks,
    /// Path position at the start, mm.
    start_s: f64,
    settings: Settings,
    /// What keeps joints inside their limits.
    joints: Option<JointSpeed>,
}

impl<S: ItemSource> Pipeline<Remainder<S>> {
    /// A pipeline for the rest of a program, from where the machine stands.
    #[must_use]
    pub fn resuming(rest: Remainder<S>, settings: Settings) -> Self {
        let (point, first) = (*rest.point(), rest.first_block());
        Self {
            blocks: Blocks::from(first),
            start_s: point.path_s,
            ..Self::new(rest, settings, point.position)
        }
    }
}

impl<S: ItemSource> Pipeline<S> {
    /// A pipeline for a machine at rest at `start` (mm, degrees).
    #[must_use]
    pub fn new(source: S, settings: Settings, start: AxisVector) -> Self {
        let planner = Planner::new(settings, start);
        Self {
            source,
            planner,
            item: Item {
                block: 0,
                line: 0,
                kind: ItemKind::Dwell(0.0),
            },
            program: Program::Open,
            statistics: Statistics::default(),
            clock: None,
            wanted: Override::NONE,
            blocks: Blocks::whole(),
            start_s: 0.0,
            settings,
            joints: None,
        }
    }

    /// The same pipeline for a machine whose joints are not its axes: speeds are kept where joints
    /// can follow.
    #[must_use]
    pub fn with_joints(self, caps: Option<PathCaps>) -> Self {
        Self {
            joints: caps.map(|caps| JointSpeed::new(caps, self.settings)),
            ..self
        }
    }

    /// The same pipeline, with the time of its steps counted by a clock: time since any fixed
    /// instant.
    #[must_use]
    pub fn with_clock(self, clock: fn() -> Duration) -> Self {
        Self {
            clock: Some(clock),
            ..self
        }
    }

    /// Takes one step: gives a frame if the planner has one, else feeds it one item.
    ///
    /// # Errors
    /// The reason why the program ended early, once, after the last frame of the motion that stops
    /// at the last good item. If planning failed inside ([`Refusal::leaves_motion_open`]), it
    /// comes at once, and the frames given out do not end at rest. From then on the pipeline is at
    /// its end.
    pub fn advance(&mut self) -> Result<Output, Refusal> {
        Ok(match self.step()? {
            Step::Item => Output::Item(self.item),
            Step::Frame => Output::Frame(*self.frame()),
            Step::Pending => Output::Pending,
            Step::End => Output::End,
        })
    }

    /// As [`Pipeline::advance`], without a copy of what was made.
    ///
    /// # Errors
    /// As [`Pipeline::advance`].
    pub fn step(&mut self) -> Result<Step, Refusal> {
        let Some(clock) = self.clock else {
            return self.go_on();
        };
        let before = clock();
        let step = self.go_on();
        self.statistics.planning += clock().saturating_sub(before);
        step
    }

    /// The item that the planner took last; before the first an empty dwell.
    #[must_use]
    pub const fn item(&self) -> &Item {
        &self.item
    }

    /// The frame made last; before the first one at rest at the start.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        self.planner.frame()
    }

    fn go_on(&mut self) -> Result<Step, Refusal> {
        if matches!(self.program, Program::Broken) {
            return Ok(Step::End);
        }
        match self.planner.make_frame() {
            Ok(true) => {
                let frame = self.planner.frame_mut();
                self.statistics.frames += 1;
                self.blocks.complete(frame);
                frame.path_s += self.start_s;
                return Ok(Step::Frame);
            }
            Ok(false) => {}
            Err(error) => {
                self.program = Program::Broken;
                return Err(error.into());
            }
        }
        match &mut self.program {
            Program::Broken => Ok(Step::End),
            Program::Open => Ok(self.take_item()),
            Program::Ended(refusal) => refusal.take().map_or(Ok(Step::End), Err),
        }
    }

    /// The next frame; `None` at the end.
    ///
    /// For sources that never are pending (files); with others it spins.
    ///
    /// # Errors
    /// As [`Pipeline::advance`].
    pub fn next_frame(&mut self) -> Result<Option<Frame>, Refusal> {
        loop {
            match self.step()? {
                Step::Frame => return Ok(Some(*self.frame())),
                Step::End => return Ok(None),
                Step::Item | Step::Pending => {}
            }
        }
    }

    /// Plans what no frame was given out of with this override, if it is another than before.
    pub fn follow_override(&mut self, wanted: Override) {
        // A refusal cannot be: status records with overrides out of range are not accepted.
        if wanted != self.wanted && self.planner.set_override(wanted).is_ok() {
            self.wanted = wanted;
        }
    }

    /// The source, where the pipeline is no longer wanted.
    #[must_use]
    pub fn into_source(self) -> S {
        self.source
    }

    /// The source.
    pub(crate) fn source(&mut self) -> &mut S {
        &mut self.source
    }

    /// Block of the program that the last frame belongs to ([`Frame::block`]), 0 before the first.
    #[must_use]
    pub const fn block(&self) -> u32 {
        self.blocks.present()
    }

    /// Which program it is: see [`ItemSource::fingerprint`].
    pub(crate) fn fingerprint(&self) -> u64 {
        self.source.fingerprint()
    }

    /// Counts so far.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        Statistics {
            lines: self.source.lines_read(),
            ..self.statistics
        }
    }

    fn take_item(&mut self) -> Step {
        match self.source.next_item() {
            Supply::Item(item) => self.plan(item),
            Supply::Pending => Step::Pending,
            Supply::End => self.end(None),
            Supply::Refused(refusal) => self.end(Some(refusal)),
        }
    }

    fn plan(&mut self, item: Item) -> Step {
        let mut item = match &mut self.joints {
            Some(joints) => joints.keep(item),
            None => item,
        };
        self.blocks.number(&mut item);
        if let Err(error) = self.planner.push(&item) {
            self.source.unplannable(&error);
            return self.end(Some(error.into()));
        }
        match item.kind {
            ItemKind::Move { .. } => self.statistics.segments += 1,
            ItemKind::Dwell(_) | ItemKind::Event(_) => self.statistics.others += 1,
        }
        self.item = item;
        Step::Item
    }

    /// Closes the program at the last good item.
    fn end(&mut self, refusal: Option<Refusal>) -> Step {
        self.planner.finish();
        self.program = Program::Ended(refusal);
        Step::Pending
    }
}
