//! The pipeline from items to frames, pulled by whoever needs the next frame.
//!
//! ```text
//!   source ──next_item──▶ planner.push ──▶ (look-ahead) ──pop_frame──▶ caller
//! ```
//!
//! Nothing runs ahead of the caller: an item is taken from the source only when the planner has no
//! frame left to give, so the memory in use is the planner's look-ahead, whatever the length of the
//! program. A caller that works ahead itself (the module `ahead`) lets the pipeline keep a history,
//! and can then have it go back to an earlier frame.
//!
//! If the source fails midway (an error in a pipe, a client that died) the planner is told that the
//! program ends at the last good item. The motion then comes to rest there, on the path, and the
//! reason comes out after the last frame.

mod building;
mod probing;
mod replanning;

use std::collections::VecDeque;
use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_program::{Frame, Item, ItemKind, Override, Settings};

use crate::plan::blocks::Blocks;
use crate::plan::history::History;
use crate::plan::planning::{Planning, Stage, TakenItem};
use crate::plan::step::{Output, Step};
use crate::run::refusal::Refusal;
use crate::run::statistics::Statistics;
use crate::source::item_source::{ItemSource, Supply};
use crate::source::resume::Remainder;

/// Source and planner, joined.
#[derive(Debug)]
pub struct Pipeline<S> {
    source: S,
    planning: Planning,
    /// The item taken last.
    item: Item,
    /// The source gives no more items.
    is_exhausted: bool,
    /// It gives more when it is known how the probing move ended that it gave last.
    is_at_probe: bool,
    /// The motion would go on, in whatever comes next: it does not rest behind the item taken last.
    goes_on: bool,
    /// It may be brought to rest for a source that is silent.
    may_rest: bool,
    /// Items to come before the first one, which are not of the program.
    before: VecDeque<Item>,
    /// Frames of the epochs before.
    frames_before: u64,
    /// Why the program ended early, until that is told.
    refusal: Option<Refusal>,
    statistics: Statistics,
    clock: Option<fn() -> Duration>,
    settings: Settings,
    /// For going back to an earlier frame.
    history: Option<History>,
}

impl<S: ItemSource> Pipeline<Remainder<S>> {
    /// A pipeline for the rest of a program, from where the machine stands.
    #[must_use]
    pub fn resuming(mut rest: Remainder<S>, settings: Settings) -> Self {
        let before = rest.take_aside();
        let blocks = if before.is_empty() {
            Blocks::from(rest.first_block())
        } else {
            Blocks::whole()
        };
        let point = *rest.point();
        let planning = Planning::new(settings, point.position, blocks, point.path_s);
        Self {
            before,
            ..Self::from(rest, settings, planning)
        }
    }
}

impl<S: ItemSource> Pipeline<S> {
    /// A pipeline for a machine at rest at `start` (mm, degrees).
    #[must_use]
    pub fn new(source: S, settings: Settings, start: AxisVector) -> Self {
        let planning = Planning::new(settings, start, Blocks::whole(), 0.0);
        Self::from(source, settings, planning)
    }

    const fn from(source: S, settings: Settings, planning: Planning) -> Self {
        Self {
            source,
            planning,
            item: Item {
                block: 0,
                line: 0,
                kind: ItemKind::Dwell(0.0),
            },
            is_exhausted: false,
            is_at_probe: false,
            goes_on: false,
            may_rest: false,
            before: VecDeque::new(),
            frames_before: 0,
            refusal: None,
            statistics: Statistics {
                lines: 0,
                segments: 0,
                others: 0,
                frames: 0,
                planning: Duration::ZERO,
            },
            clock: None,
            settings,
            history: None,
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
        self.timed(Self::go_on)
    }

    /// Counts the time of some work as planning.
    fn timed<R>(&mut self, work: impl FnOnce(&mut Self) -> R) -> R {
        let Some(clock) = self.clock else {
            return work(self);
        };
        let before = clock();
        let result = work(self);
        self.statistics.planning += clock().saturating_sub(before);
        result
    }

    /// The item that the planner took last; before the first an empty dwell.
    #[must_use]
    pub const fn item(&self) -> &Item {
        &self.item
    }

    /// The frame made last; before the first one at rest at the start.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        self.planning.frame()
    }

    fn go_on(&mut self) -> Result<Step, Refusal> {
        if self.planning.make_frame()? {
            self.remember();
            return Ok(Step::Frame);
        }
        match self.planning.stage() {
            Stage::Broken => Ok(Step::End),
            Stage::Open => self.take_item(),
            Stage::Ended => self.refusal.take().map_or(Ok(Step::End), Err),
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
        self.planning.follow_override(wanted);
    }

    /// Whether the motion may be brought to rest for a source that is silent: nothing that was planned
    /// is left to be published. Nobody knows that but who publishes.
    pub(crate) const fn let_rest(&mut self, may_rest: bool) {
        self.may_rest = may_rest;
    }

    /// Whether the motion would go on, in whatever comes next, behind the item taken last: it may not be planned yet.
    pub(crate) const fn goes_on(&self) -> bool {
        self.goes_on
    }

    /// Block of the program that the last frame belongs to ([`Frame::block`]), 0 before the first.
    #[must_use]
    pub const fn block(&self) -> u32 {
        self.planning.block()
    }

    /// The source of the items.
    #[must_use]
    pub const fn source(&self) -> &S {
        &self.source
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
            frames: self.frames_before + self.planning.frames(),
            ..self.statistics
        }
    }

    fn take_item(&mut self) -> Result<Step, Refusal> {
        let known = self.history.as_ref();
        if let Some(kept) = known.and_then(|known| known.item_after(self.planning.items())) {
            self.item = self.planning.take_again(kept)?;
            self.remember();
            return Ok(Step::Item);
        }
        if let Some(event) = self.before.pop_front() {
            return self.plan_aside(event);
        }
        if self.is_exhausted {
            return self.end();
        }
        match self.source.next_item() {
            Supply::Item(item) => self.plan(item),
            Supply::Pending if self.may_rest && self.goes_on && self.source.is_silent() => {
                self.goes_on = false;
                self.plan_aside(Item {
                    block: 0,
                    line: self.item.line,
                    kind: ItemKind::Dwell(0.0),
                })
            }
            Supply::Pending => Ok(Step::Pending),
            Supply::End => self.end(),
            Supply::Probe => {
                self.is_at_probe = true;
                self.end()
            }
            Supply::Refused(refusal) => {
                self.refusal = Some(refusal);
                self.end()
            }
        }
    }

    fn plan(&mut self, item: Item) -> Result<Step, Refusal> {
        match self.planning.take(item) {
            Ok(numbered) => self.item = numbered,
            Err(error) => {
                self.source.unplannable(&error);
                self.refusal = Some(error.into());
                return self.end();
            }
        }
        match item.kind {
            ItemKind::Move { .. } => self.statistics.segments += 1,
            ItemKind::Dwell(_) | ItemKind::Event(_) => self.statistics.others += 1,
        }
        self.goes_on = goes_on(&item.kind);
        self.keep(item, false);
        Ok(Step::Item)
    }

    /// Plans an item that is not of the program.
    fn plan_aside(&mut self, item: Item) -> Result<Step, Refusal> {
        self.item = self.planning.take_aside(item)?;
        self.keep(item, true);
        Ok(Step::Item)
    }

    fn keep(&mut self, item: Item, is_aside: bool) {
        if let Some(history) = &mut self.history {
            history.keep(TakenItem { item, is_aside });
        }
        self.remember();
    }

    fn remember(&mut self) {
        if let Some(history) = &mut self.history {
            history.follow(&self.planning);
        }
    }

    /// Closes the program at the last good item, and goes on with what is left of its motion.
    fn end(&mut self) -> Result<Step, Refusal> {
        self.is_exhausted = true;
        self.planning.finish();
        self.go_on()
    }
}

/// Whether the motion goes on behind an item, if nothing else is known. In a thread and at a tap it
/// is not stopped: they wait for their end.
const fn goes_on(kind: &ItemKind) -> bool {
    match kind {
        ItemKind::Move { rate, .. } => !rate.is_synchronised(),
        ItemKind::Dwell(_) => false,
        ItemKind::Event(event) => !event.is_at_rest(),
    }
}
