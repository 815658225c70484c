//! The rest of a program, as a source of its items.

use std::collections::VecDeque;

use glidepath_geometry::AxisVector;
use glidepath_link::Auxiliary;
use glidepath_motion::PlanError;
use glidepath_program::{Event, Item, ItemKind, PathMode};

use super::outputs::SaidOutputs;
use super::point::ResumePoint;
use super::remaining_segment::remaining_segment;
use super::search::MachineSearch;
use super::told_codes::ToldCodes;
use crate::run::error::RunError;
use crate::run::refusal::Refusal;
use crate::run::resume_error::ResumeError;
use crate::source::input_arbiter::InputResult;
use crate::source::item_source::{ItemSource, Settled, Supply};
use crate::source::restoring::awaiting;

/// The rest of a program: what follows the point at which it was left.
#[derive(Debug)]
pub struct Remainder<S> {
    pub(super) source: S,
    pub(super) point: ResumePoint,
    pub(super) first_block: u32,
    /// Items of the way to a line that come before the program's first block, and are of none.
    pub(super) aside: VecDeque<Item>,
    /// Items read in the search, the first one cut off.
    pub(super) ahead: VecDeque<Item>,
    /// What ended the search.
    pub(super) last: Option<Supply>,
    /// What was said of spindle, coolant and tool before that.
    pub(super) outputs: SaidOutputs,
    /// Where the first move begins, if it is not known yet and may begin elsewhere by itself.
    pub(super) stands: Option<AxisVector>,
    pub(super) codes: ToldCodes,
}

impl<S: ItemSource> Remainder<S> {
    /// Reads a program, opened for a machine at [`ResumePoint::program_start`], up to the point at
    /// which it was left. `tolerance_mm` is the configured one. For sources that are never pending.
    ///
    /// # Errors
    /// [`RunError::Resume`], or [`RunError::Refused`] if the program is refused before that point.
    pub fn find(mut source: S, point: ResumePoint, tolerance_mm: f64) -> Result<Self, RunError> {
        if source.fingerprint() != point.program || point.program == 0 {
            return Err(ResumeError::OtherProgram.into());
        }
        if point.block == 0 && point.line != 0 {
            return Err(ResumeError::OnTheWay { line: point.line }.into());
        }
        let mut before: Option<Item> = None;
        // Behind a probing move it is where that ended.
        let mut place = Some(point.program_start);
        let (mut outputs, mut codes) = (SaidOutputs::default(), ToldCodes::default());
        for _ in 1..point.block {
            match source.next_item() {
                Supply::Item(item) => {
                    outputs.take(&item);
                    match item.kind {
                        ItemKind::Move { segment, .. } => place = place.map(|_| segment.end()),
                        ItemKind::Event(Event::Probe { .. }) => place = None,
                        ItemKind::Event(_) | ItemKind::Dwell(_) => {}
                    }
                    codes.take(&item);
                    before = Some(item);
                }
                Supply::Refused(refusal) => return Err(refusal.into()),
                Supply::Pending | Supply::Probe => {
                    let line = before.map_or(0, |item| item.line);
                    return Err(Refusal::AnswerUnknown { line }.into());
                }
                Supply::End => return Err(point.off_path(0, None)),
            }
        }
        let mut search = MachineSearch::new(point, tolerance_mm);
        let mut rest = Self {
            source,
            point,
            first_block: point.block.max(1),
            aside: VecDeque::new(),
            ahead: VecDeque::new(),
            last: None,
            outputs,
            stands: None,
            codes,
        };
        if point.block == 0 {
            rest.meet_machine(place, tolerance_mm)?;
            return Ok(rest);
        }
        if let Some(event) = before.filter(is_probe) {
            rest.go_on_looking(event, tolerance_mm)?;
            return Ok(rest);
        }
        while search.goes_on() {
            match rest.source.next_item() {
                Supply::Item(item) => {
                    search.look_at(&item);
                    rest.ahead.push_back(item);
                }
                // What is asked behind an item is asked again.
                Supply::Pending => break,
                last @ (Supply::Probe | Supply::End | Supply::Refused(_)) => {
                    rest.last = Some(last);
                    break;
                }
            }
        }
        if let Some(first) = rest.ahead.front()
            && point.line != 0
            && first.line != point.line
        {
            return Err(ResumeError::OnTheWay { line: point.line }.into());
        }
        if let Some(event) = rest.ahead.front().copied().filter(is_probe) {
            rest.ahead.clear();
            rest.first_block += 1;
            rest.go_on_looking(event, tolerance_mm)?;
            return Ok(rest);
        }
        rest.cut(search, place)?;
        Ok(rest)
    }

    /// The rest of a program from these items on, with which it is to begin, behind those that are of no block.
    pub(crate) fn beginning_with(
        source: S,
        point: ResumePoint,
        (first_block, aside): (u32, VecDeque<Item>),
        (ahead, last): (VecDeque<Item>, Option<Supply>),
    ) -> Self {
        Self {
            source,
            point,
            first_block,
            aside,
            ahead,
            last,
            outputs: SaidOutputs::default(),
            stands: None,
            codes: ToldCodes::default(),
        }
    }

    /// The source of the items.
    #[must_use]
    pub const fn source(&self) -> &S {
        &self.source
    }

    /// The events that make spindle and coolant what the program had made them, from what they are
    /// `now`, and wait for that: an abort and a fault stop them. The tool that the program has selected last is selected again.
    ///
    /// # Errors
    /// [`ResumeError::OtherTool`].
    pub fn restoring(&self, now: &Auxiliary) -> Result<Vec<Event>, ResumeError> {
        match self.outputs.tool() {
            Some(expected) if expected != now.tool => Err(ResumeError::OtherTool {
                tool: now.tool,
                expected,
            }),
            _ => {
                let mut events = self.outputs.restoring(now);
                // The rest may begin in the middle of a cut.
                events.extend(awaiting(&events));
                Ok(events)
            }
        }
    }

    /// The line that the rest of the program begins with, 0 if that is not known.
    #[must_use]
    pub fn line(&self) -> u32 {
        self.ahead.front().map_or(0, |item| item.line)
    }

    /// Where the program was left.
    pub(crate) const fn point(&self) -> &ResumePoint {
        &self.point
    }

    /// What comes before the first block, and is of none.
    pub(crate) fn take_aside(&mut self) -> VecDeque<Item> {
        std::mem::take(&mut self.aside)
    }

    /// Number of the first block of the rest.
    pub(crate) const fn first_block(&self) -> u32 {
        self.first_block
    }
}

/// Whether an item begins a search by the probe.
const fn is_probe(item: &Item) -> bool {
    matches!(item.kind, ItemKind::Event(Event::Probe { .. }))
}

impl<S: ItemSource> ItemSource for Remainder<S> {
    fn next_item(&mut self) -> Supply {
        let known = self.ahead.pop_front().map(Supply::Item);
        let known = known.or_else(|| self.last.take());
        let mut supply = known.unwrap_or_else(|| self.source.next_item());
        if let Supply::Item(Item {
            kind: ItemKind::Move { segment, mode, .. },
            ..
        }) = &mut supply
            && let Some(stands) = self.stands.take()
        {
            *segment = remaining_segment(segment, &stands, 0.0);
            *mode = PathMode::ExactStop;
        }
        supply
    }

    fn settle(&mut self, known: Option<InputResult>) -> Result<Settled, Refusal> {
        self.source.settle(known)
    }

    fn unplannable(&mut self, error: &PlanError) {
        self.source.unplannable(error);
    }

    fn lines_read(&self) -> u64 {
        self.source.lines_read()
    }

    fn fingerprint(&self) -> u64 {
        self.source.fingerprint()
    }
}
