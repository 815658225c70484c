//! The work queue: items of a stretch in, checked; what there is to do out, in order: moves, exact
//! moves, rests.

use crate::PlanError;
use crate::intake::Intake;
use crate::rest::{Rest, RestKind};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Event, Item, ItemKind, PathMode, ProgramLine, Rate, Settings};
use std::collections::VecDeque;

/// One thing to do.
#[derive(Debug, Clone)]
pub(crate) enum WorkItem {
    /// Follow a segment within a tolerance.
    Move(Move),
    /// An item of a stretch to be passed exactly.
    Exact(Item),
    /// Such a stretch ends here; a rest follows.
    ExactEnd,
    Rest(Rest),
}

/// A segment to be followed within a tolerance.
#[derive(Debug, Clone)]
pub(crate) struct Move {
    pub(crate) segment: Segment,
    pub(crate) rate: Rate,
    pub(crate) tolerance_mm: f64,
    pub(crate) line: ProgramLine,
    /// Events that happen when it is entered.
    pub(crate) events: Vec<Event>,
}

/// Takes items and keeps what they ask for until it is done.
#[derive(Debug, Clone)]
pub(crate) struct WorkQueue {
    settings: Settings,
    work_queue: VecDeque<WorkItem>,
    intake: Intake,
    /// Events that wait for the move they happen on.
    events: Vec<(ProgramLine, Event)>,
    stretch: StretchKind,
    /// The last items of work, not to be done before it is known whether a curve follows: so many, of so
    /// much time at their feedrates.
    held: Option<(usize, f64)>,
    /// Moves since the last curve.
    straight: usize,
    last: (ProgramLine, Rate),
    finished: bool,
}

/// A stretch with a curve among its first moves is driven as if it began with that: so many moves,
/// and of so much time, s, that no one waits long for the first of them: who sends a few moves
/// through a pipe expects them to begin.
const MOST_HELD: usize = 4;
const MOST_HELD_T: f64 = 3.0;
/// After so many other moves a curve is forgotten, and its stretch ends with a stop.
const STRAIGHT: usize = 64;

/// What the moves since the last rest are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum StretchKind {
    None,
    Free,
    Exact,
    /// Begun with a curve, or nearly: driven along it, not along chords, and so is what follows.
    Curved,
}

impl WorkQueue {
    pub(crate) const fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            settings,
            work_queue: VecDeque::new(),
            intake: Intake::new(start),
            events: Vec::new(),
            stretch: StretchKind::None,
            held: None,
            straight: 0,
            last: (ProgramLine::NONE, Rate::Rapid),
            finished: false,
        }
    }

    /// The next thing to do, if it is known.
    pub(crate) fn next(&mut self) -> Option<WorkItem> {
        let held = self.held.map_or(0, |(count, _)| count);
        if self.work_queue.len() <= held {
            return None;
        }
        self.work_queue.pop_front()
    }

    /// Takes an item; changes nothing if it is refused.
    pub(crate) fn push(&mut self, item: &Item) -> Result<(), PlanError> {
        let line = item.program_line();
        match item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                self.intake.check_move(line.number, &segment, rate, mode)?;
                self.push_move(line, segment, rate, mode);
                self.last.1 = rate;
            }
            // Whatever else there is between moves of a stretch does not stop the motion.
            ItemKind::Event(event) => self.events.push((line, event)),
            ItemKind::Dwell(_) => {}
        }
        self.last.0 = line;
        Ok(())
    }

    /// No more items: the path ends at rest.
    pub(crate) fn finish(&mut self) {
        if !core::mem::replace(&mut self.finished, true) {
            self.end_stretch();
            self.put_rest(RestKind::End, self.last.0);
        }
    }

    fn push_move(&mut self, line: ProgramLine, segment: Segment, rate: Rate, mode: PathMode) {
        let stretch = match mode {
            PathMode::ExactPath => StretchKind::Exact,
            _ if self.is_curved(&segment) => StretchKind::Curved,
            PathMode::ExactStop | PathMode::Continuous { .. } => StretchKind::Free,
        };
        if stretch == StretchKind::Curved {
            self.follow_held();
        }
        if self.stretch != StretchKind::None && self.stretch != stretch {
            self.end_stretch();
            self.put_rest(RestKind::ExactStop, self.last.0);
        }
        let Some(segment) = self.intake.take(segment) else {
            return;
        };
        if self.stretch == StretchKind::None && stretch == StretchKind::Free {
            self.held = Some((0, 0.0));
        }
        self.stretch = stretch;
        let events = core::mem::take(&mut self.events);
        if stretch != StretchKind::Free {
            let events = events
                .into_iter()
                .map(|(line, event)| line.item(ItemKind::Event(event)));
            self.work_queue.extend(events.map(WorkItem::Exact));
            self.work_queue
                .push_back(WorkItem::Exact(line.item(ItemKind::Move {
                    segment,
                    rate,
                    mode,
                })));
            return;
        }
        self.work_queue.push_back(WorkItem::Move(Move {
            segment,
            rate,
            tolerance_mm: mode.tolerance_mm(self.settings.tolerance_mm),
            line,
            events: events.into_iter().map(|(_, event)| event).collect(),
        }));
        self.hold(segment.length() / rate.feed_v().unwrap_or(f64::INFINITY));
    }

    /// True in a stretch that begins with a curve, or nearly, and where one would.
    fn is_curved(&mut self, segment: &Segment) -> bool {
        if !matches!(segment, Segment::Curve(_)) {
            self.straight += 1;
            return self.stretch == StretchKind::Curved && self.straight <= STRAIGHT;
        }
        self.straight = 0;
        self.stretch != StretchKind::Free || self.held.is_some()
    }

    /// Keeps the last move, if a curve may follow it soon.
    fn hold(&mut self, move_t: f64) {
        self.held = self
            .held
            .map(|(count, t)| (count + 1, t + move_t))
            .filter(|&(count, t)| count < MOST_HELD && t < MOST_HELD_T);
    }

    /// The moves kept are to be passed as the curve that follows them.
    fn follow_held(&mut self) {
        let Some((count, _)) = self.held.take() else {
            return;
        };
        let held = self.work_queue.split_off(self.work_queue.len() - count);
        for work in held {
            let WorkItem::Move(of) = work else { continue };
            let line = of.line;
            let events = of.events.into_iter().map(ItemKind::Event);
            let kind = ItemKind::Move {
                segment: of.segment,
                rate: of.rate,
                mode: PathMode::Continuous {
                    tolerance_mm: Some(of.tolerance_mm),
                },
            };
            let kinds = events.chain([kind]);
            self.work_queue
                .extend(kinds.map(|kind| WorkItem::Exact(line.item(kind))));
        }
        self.stretch = StretchKind::Curved;
    }

    fn put_rest(&mut self, kind: RestKind, line: ProgramLine) {
        self.work_queue
            .push_back(WorkItem::Rest(Rest { kind, line }));
    }

    fn end_stretch(&mut self) {
        self.held = None;
        let segment = self.intake.remainder();
        let (line, rate) = self.last;
        // Moves that were too short to be made by themselves.
        let is_left = segment.length() > 0.0;
        if matches!(self.stretch, StretchKind::Exact | StretchKind::Curved) {
            if is_left {
                let mode = PathMode::ExactPath;
                let kind = ItemKind::Move {
                    segment,
                    rate,
                    mode,
                };
                self.work_queue.push_back(WorkItem::Exact(line.item(kind)));
            }
            self.work_queue.push_back(WorkItem::ExactEnd);
        } else if is_left {
            self.work_queue.push_back(WorkItem::Move(Move {
                segment,
                rate,
                tolerance_mm: self.settings.tolerance_mm,
                line,
                events: Vec::new(),
            }));
        }
        self.intake.make_up();
        self.stretch = StretchKind::None;
    }
}
