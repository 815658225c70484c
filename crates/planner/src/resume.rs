//! The resumption of a program in the middle: after its planner died, or after an abort.
//!
//! The interpolator knows where it stands: the block, how far it has come on it, and the position.
//! The program is read from its beginning again, without motion, up to that block; the path that
//! it programs from there on is searched for the point where the machine stands; and what follows
//! that point is handed on.
//!
//! ```text
//!            block 7                 8           9
//!   ─────────┬───────────────●───────┬───────────┬──────
//!            │◄── travelled ►│ machine
//!            read, not run   └─ what is run: the rest of 7, 8, 9, …
//! ```
//!
//! The machine need not stand on the programmed path: on a curve that replaces a corner, or on a
//! chord that replaces several, it is off by up to the tolerance. From there it goes straight to
//! the end of the block, and comes to rest there, so that no second curve adds to that distance.
//!
//! A path may pass a point more than once (a full circle begins where it ends). Of the points near
//! enough, the one is taken that is as far from the beginning of the block as the machine has
//! travelled on it, or next to that.
//!
//! The interpolator tells a block up to a period late, so that a machine whose block is an event or a dwell may be on
//! the move behind it already. Whatever the block is, the first move begins where the machine stands.
//!
//! What waits is not done before it is answered: an M code, or a program stop, at which the program was
//! left without its answer is told again, and waited for again.
//!
//! What the program asked of inputs and of the probe up to there is answered as it was answered then
//! ([`ItemSource::settle`]); a probing move that was left on its way goes on looking.

mod error;
mod nearness;
mod outputs;
mod point;
mod search;
mod told_codes;

pub use error::ResumeError;
pub use point::ResumePoint;

use std::collections::VecDeque;
use std::f64::consts::TAU;

use glidepath_gcode::Probed;
use glidepath_geometry::{Arc, AxisVector, Segment};
use glidepath_link::Auxiliary;
use glidepath_motion::PlanError;
use glidepath_program::{Event, Item, ItemKind, PathMode};

use crate::{InputResult, ItemSource, Refusal, RunError, Settled, Supply};
use nearness::{ROUNDING_MM, distance};
use outputs::SaidOutputs;
use search::{MachineSearch, Standpoint};
use told_codes::ToldCodes;

/// The rest of a program: what follows the point at which it was left.
#[derive(Debug)]
pub struct Remainder<S> {
    source: S,
    point: ResumePoint,
    first_block: u32,
    /// Items read in the search, the first one cut off.
    ahead: VecDeque<Item>,
    /// What ended the search.
    last: Option<Supply>,
    /// What was said of spindle, coolant and tool before that.
    outputs: SaidOutputs,
    /// Where the first move begins, if it is not known yet and may begin elsewhere by itself.
    stands: Option<AxisVector>,
    codes: ToldCodes,
}

/// Items in front of the first move that are looked at.
const LOOK_AHEAD: usize = 64;

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
                Supply::End => return Err(off_path(&point, 0, None)),
            }
        }
        let mut search = MachineSearch::new(point, tolerance_mm);
        let mut rest = Self {
            source,
            point,
            first_block: point.block.max(1),
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

    /// The rest of a program from these items on, with which it is to begin.
    pub(crate) fn beginning_with(
        source: S,
        point: ResumePoint,
        first_block: u32,
        (ahead, last): (VecDeque<Item>, Option<Supply>),
    ) -> Self {
        Self {
            source,
            point,
            first_block,
            ahead,
            last,
            outputs: SaidOutputs::default(),
            stands: None,
            codes: ToldCodes::default(),
        }
    }

    /// Drops what lies before the point.
    fn cut(&mut self, search: MachineSearch, place: Option<AxisVector>) -> Result<(), RunError> {
        let tolerance_mm = search.tolerance_mm();
        let line = self.ahead.front().map_or(0, |item| item.line);
        match self.ahead.front().map(|item| item.kind) {
            // A dwell begins again; an event has happened, unless it is not answered yet.
            Some(ItemKind::Dwell(_)) => return self.meet_machine(place, tolerance_mm),
            Some(ItemKind::Event(event)) => {
                if self.is_open(event)? {
                    self.tell_again(event);
                    return self.meet_machine(place, tolerance_mm);
                }
                let told = self.ahead.pop_front();
                told.iter().for_each(|item| self.outputs.take(item));
                self.first_block += 1;
                self.meet_machine(place, tolerance_mm)?;
                return self.refuse_thread();
            }
            Some(ItemKind::Move { .. }) | None => {}
        }
        let Some(found) = search.best else {
            return Err(off_path(&self.point, line, search.away()));
        };
        self.pass(found.item);
        if self.begin_move(0, &found) {
            self.pass(1);
        }
        self.refuse_thread()
    }

    /// Leaves out so many items that are executed already.
    fn pass(&mut self, count: usize) {
        for passed in self.ahead.drain(..count) {
            self.outputs.take(&passed);
        }
        self.first_block += u32::try_from(count).unwrap_or(u32::MAX);
    }

    /// Has a move begin where the machine stands on it. Returns whether nothing is left of it.
    fn begin_move(&mut self, index: usize, found: &Standpoint) -> bool {
        let Some(ItemKind::Move { segment, mode, .. }) =
            self.ahead.get_mut(index).map(|item| &mut item.kind)
        else {
            return false;
        };
        *segment = rest_of(segment, &self.point.position, found.part);
        if found.distance_mm > ROUNDING_MM {
            *mode = PathMode::ExactStop;
        }
        distance(&(segment.end() - segment.start())) <= 0.0 && found.part > 0.5
    }

    /// Has the first move behind events and dwells begin where the machine stands. One that is on that move already has
    /// passed them. `place` is where the program is in front of them, if that is known.
    fn meet_machine(
        &mut self,
        place: Option<AxisVector>,
        tolerance_mm: f64,
    ) -> Result<(), RunError> {
        let stands = self.point.position;
        let Some((index, way)) = self.first_move() else {
            let away = place.map_or_else(AxisVector::zeros, |place| stands - place);
            if distance(&away) > tolerance_mm + ROUNDING_MM {
                return Err(off_path(&self.point, 0, Some(away)));
            }
            self.stands = (away.amax() > 0.0).then_some(stands);
            return Ok(());
        };
        let ItemKind::Move { segment, rate, .. } = way.kind else {
            return Ok(());
        };
        if segment.start() == stands {
            return Ok(());
        }
        if rate.is_synchronised() {
            return Err(ResumeError::InThread { line: way.line }.into());
        }
        let mut search = MachineSearch::new(self.point, tolerance_mm);
        search.look_at(&way);
        let Some(found) = search.best else {
            return Err(off_path(&self.point, way.line, search.away()));
        };
        // At an event at rest it would have stood, and told so: rounding alone puts it behind one that is to come.
        let is_at_rest =
            |item: &Item| matches!(item.kind, ItemKind::Event(event) if event.is_at_rest());
        let stands_before = self.ahead.iter().take(index).any(is_at_rest);
        if found.part > 0.0 && !stands_before {
            self.pass(index);
            if self.begin_move(0, &found) {
                self.pass(1);
            }
        } else {
            self.begin_move(index, &found);
        }
        Ok(())
    }

    /// The first move that is known, and its place in what was read. What is asked in front of it is asked again first.
    fn first_move(&mut self) -> Option<(usize, Item)> {
        let is_move = |item: &Item| matches!(item.kind, ItemKind::Move { .. });
        loop {
            if let Some(index) = self.ahead.iter().position(is_move) {
                return Some((index, self.ahead[index]));
            }
            if self.last.is_some() || self.ahead.len() >= LOOK_AHEAD {
                return None;
            }
            match self.source.next_item() {
                Supply::Item(item) => self.ahead.push_back(item),
                Supply::Pending => return None,
                last @ (Supply::Probe | Supply::End | Supply::Refused(_)) => self.last = Some(last),
            }
        }
    }

    /// Whether an event, at which the program was left, is not done. A wait for an input is, as soon as the
    /// program has its answer.
    fn is_open(&mut self, event: Event) -> Result<bool, RunError> {
        Ok(match event {
            Event::MCode(66) => self.source.settle(None)? == Settled::Open,
            _ => self.point.unanswered,
        })
    }

    /// Puts in front of an event, with which the rest begins, what belongs to it.
    fn tell_again(&mut self, event: Event) {
        let mut items = self.codes.again(event);
        let count = u32::try_from(items.len()).unwrap_or(u32::MAX);
        self.first_block = self.first_block.saturating_sub(count).max(1);
        items.append(&mut self.ahead);
        self.ahead = items;
    }

    /// Nothing goes on in the middle of a pass: the angle at which it began is not known any more.
    fn refuse_thread(&self) -> Result<(), RunError> {
        match self.ahead.front() {
            Some(Item {
                kind: ItemKind::Move { rate, .. },
                line,
                ..
            }) if rate.is_synchronised() => Err(ResumeError::InThread { line: *line }.into()),
            _ => Ok(()),
        }
    }

    /// Goes on behind the event that begins a search, with what is left of its move, or behind it.
    fn go_on_looking(&mut self, event: Item, tolerance_mm: f64) -> Result<(), RunError> {
        let way = match self.source.next_item() {
            Supply::Item(item) => item,
            Supply::Refused(refusal) => return Err(refusal.into()),
            Supply::Pending | Supply::Probe | Supply::End => {
                return Err(off_path(&self.point, event.line, None));
            }
        };
        let mut search = MachineSearch::new(self.point, tolerance_mm);
        search.look_at(&way);
        let (ItemKind::Move { segment, rate, .. }, Some(found)) = (way.kind, search.best) else {
            return Err(off_path(&self.point, way.line, search.away()));
        };
        let to = |segment| Item {
            kind: ItemKind::Move {
                segment,
                rate,
                mode: PathMode::ExactStop,
            },
            ..way
        };
        let stands = self.point.position;
        let is_at_end = distance(&(segment.end() - stands)) <= ROUNDING_MM;
        // It was found, or everything was looked through, before the program was told.
        let nothing = is_at_end.then_some(Probed {
            contact: None,
            was_so: false,
            stands,
        });
        let known = self.point.found.or(nothing).map(InputResult::Probe);
        match self.source.settle(known)? {
            Settled::Answered(InputResult::Probe(Probed { stands: then, .. })) => {
                let away = stands - then;
                let away_mm = distance(&away);
                if away_mm > tolerance_mm + ROUNDING_MM {
                    return Err(off_path(&self.point, way.line, Some(away)));
                }
                if away_mm > 0.0 {
                    self.ahead = VecDeque::from([to(Segment::line(stands, then))]);
                } else {
                    self.first_block += 1;
                }
            }
            _ => {
                let rest = rest_of(&segment, &stands, found.part);
                self.ahead = VecDeque::from([event, to(rest)]);
                self.first_block = self.first_block.saturating_sub(1).max(1);
            }
        }
        Ok(())
    }

    /// The source of the items.
    #[must_use]
    pub const fn source(&self) -> &S {
        &self.source
    }

    /// The events that make spindle and coolant what the program had made them, from what they are
    /// `now`: an abort and a fault stop them. The tool that the program has selected last is selected again.
    ///
    /// # Errors
    /// [`ResumeError::OtherTool`].
    pub fn restoring(&self, now: &Auxiliary) -> Result<Vec<Event>, ResumeError> {
        match self.outputs.tool() {
            Some(expected) if expected != now.tool => Err(ResumeError::OtherTool {
                tool: now.tool,
                expected,
            }),
            _ => Ok(self.outputs.restoring(now)),
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

    /// Number of the first block of the rest.
    pub(crate) const fn first_block(&self) -> u32 {
        self.first_block
    }
}

/// Whether an item begins a search by the probe.
const fn is_probe(item: &Item) -> bool {
    matches!(item.kind, ItemKind::Event(Event::Probe { .. }))
}

const fn off_path(point: &ResumePoint, line: u32, away: Option<AxisVector>) -> RunError {
    RunError::Resume(ResumeError::OffPath {
        block: point.block,
        line,
        away,
    })
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
            *segment = rest_of(segment, &stands, 0.0);
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

/// What is left of a segment after a part of it, from where the machine stands.
fn rest_of(segment: &Segment, position: &AxisVector, part: f64) -> Segment {
    match segment {
        Segment::Line(line) => Segment::line(*position, line.end),
        Segment::Arc(arc) if part >= 1.0 => Segment::line(*position, arc.end),
        Segment::Arc(arc) => {
            let mut rest = Arc {
                start: *position,
                ..*arc
            };
            // What the angles of both ends say, on the turn that the part says.
            let (first, second) = arc.plane.axes();
            let angle = |p: &AxisVector| {
                (p[second.index()] - arc.center[1]).atan2(p[first.index()] - arc.center[0])
            };
            let turned = angle(&arc.end) - angle(position);
            let about = arc.sweep_rad * (1.0 - part);
            rest.sweep_rad = turned + TAU * ((about - turned) / TAU).round();
            Segment::Arc(rest)
        }
        Segment::Curve(curve) if part >= 1.0 => Segment::line(*position, curve.end),
        Segment::Curve(curve) => Segment::Curve(curve.after(part * curve.length, *position)),
    }
}

#[cfg(test)]
mod tests;
