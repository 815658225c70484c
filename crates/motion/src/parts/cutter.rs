//! The cutter of a program into parts.

use crate::PlanError;
use crate::engine_kind::EngineKind;
use crate::intake::{Intake, check_dwell};
use glidepath_geometry::{AxisVector, LINEAR_XYZ, Segment};
use glidepath_program::{Item, ItemKind, PathMode, Settings};

/// Fewest items of a part that another one follows: fewer are not worth a planner of their own.
const LEAST_ITEMS: usize = 16;

/// Most events kept between a rest and a move.
const MOST_HELD: usize = 16;

/// Cuts a program into parts.
#[derive(Debug)]
pub struct Cutter {
    engine: EngineKind,
    intake: Intake,
    /// Items of the part at hand.
    items: usize,
    /// The machine rests behind the items taken, whatever follows.
    rests: bool,
    /// The last move led to where the program is, and no engine ends it elsewhere by rounding.
    is_whole: bool,
    /// There was a curve: in the tube since the last rest, on the path ever.
    has_curve: bool,
    /// The engine on the path has met other axes than X, Y, Z at a feedrate.
    has_others: bool,
    /// Events since the rest, which happen on the next move and go with it.
    held: Vec<Item>,
}

/// An item, and where it belongs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// The item.
    pub item: Item,
    /// A part begins with it: where (mm, degrees). The first part begins without.
    pub begins: Option<AxisVector>,
}

impl Cutter {
    /// For a program from `start` (mm, degrees) on.
    #[must_use]
    pub fn new(settings: &Settings, start: AxisVector) -> Self {
        Self {
            engine: EngineKind::of(settings),
            intake: Intake::new(start),
            items: 0,
            rests: false,
            is_whole: false,
            has_curve: false,
            has_others: false,
            held: Vec::new(),
        }
    }

    /// Takes the next item, and gives out those whose part is known.
    ///
    /// # Errors
    /// As [`crate::Planner::push`]; then nothing is changed.
    pub fn take(&mut self, item: Item, out: &mut Vec<Placed>) -> Result<(), PlanError> {
        match item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                self.intake.check_move(item.line, &segment, rate, mode)?;
                let start = *self.intake.position();
                let is_made = self.intake.take(segment).is_some();
                let begins = (is_made && self.may_cut()).then_some(start);
                self.give(begins, out);
                let begins = begins.filter(|_| self.items == 0);
                self.put(item, begins, out);
                self.pass(&segment, rate.feed_v().is_some(), mode, is_made);
            }
            ItemKind::Dwell(dwell_t) => {
                check_dwell(item.line, dwell_t)?;
                self.rest(item, out);
            }
            ItemKind::Event(event) if event.is_at_rest() => self.rest(item, out),
            ItemKind::Event(_) if self.rests && self.held.len() < MOST_HELD => {
                self.held.push(item);
            }
            ItemKind::Event(_) => {
                self.rests = false;
                self.make_up();
                self.give(None, out);
                self.put(item, None, out);
            }
        }
        Ok(())
    }

    /// There are no more items: gives out the rest of them.
    pub fn finish(&mut self, out: &mut Vec<Placed>) {
        self.give(None, out);
    }

    fn may_cut(&self) -> bool {
        let is_fresh = match self.engine {
            EngineKind::OnPath => !self.has_curve && !self.has_others,
            EngineKind::InTube => true,
        };
        self.rests && is_fresh && self.items >= LEAST_ITEMS
    }

    /// Gives out the events held; a part may begin with them.
    fn give(&mut self, mut begins: Option<AxisVector>, out: &mut Vec<Placed>) {
        if begins.is_some() {
            self.items = 0;
        }
        for item in core::mem::take(&mut self.held) {
            self.put(item, begins.take(), out);
        }
    }

    fn put(&mut self, item: Item, begins: Option<AxisVector>, out: &mut Vec<Placed>) {
        self.items += 1;
        out.push(Placed { item, begins });
    }

    /// What a move leaves behind.
    fn pass(&mut self, segment: &Segment, is_feed: bool, mode: PathMode, is_made: bool) {
        self.has_curve |= matches!(segment, Segment::Curve(_));
        match self.engine {
            EngineKind::OnPath => {
                let moved = segment.end() - segment.start();
                let others = moved.iter().skip(LINEAR_XYZ.end).any(|x| *x != 0.0);
                self.has_others |= others && is_feed;
                self.is_whole = is_made;
                self.rests = false;
            }
            EngineKind::InTube => {
                // Where the program is followed exactly, the frames end where the path is evaluated.
                self.is_whole = is_made && !self.has_curve && mode != PathMode::ExactPath;
                self.rests = self.is_whole && mode == PathMode::ExactStop;
            }
        }
    }

    fn rest(&mut self, item: Item, out: &mut Vec<Placed>) {
        self.make_up();
        self.give(None, out);
        self.put(item, None, out);
        self.rests = self.is_whole;
        if self.engine == EngineKind::InTube {
            self.has_curve = false;
        }
    }

    fn make_up(&mut self) {
        if self.intake.remainder().length() > 0.0 {
            self.intake.make_up();
        }
    }
}
