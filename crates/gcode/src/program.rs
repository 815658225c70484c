//! A program as an iterator of items, and what it amounts to.

use std::io::BufRead;

use glidepath_geometry::{AxisVector, LINEAR_XYZ, Segment, UVW};
use glidepath_motion::{Item, ItemKind, Rate};

use crate::block::{Block, LineKind};
use crate::diagnostic::{Diagnostic, Outcome};
use crate::interpreter::{Flow, Interpreter};
use crate::modal::Modal;
use crate::options::Options;
use crate::source::LineSource;

/// Counts and sums over everything read so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Lines read, the empty ones included.
    pub lines: u32,
    /// Straight feed moves (G1), without those of zero length.
    pub straight_feeds: u32,
    /// Arcs (G2, G3).
    pub arcs: u32,
    /// Rapid moves (G0, G28, G30), without those of zero length.
    pub rapids: u32,
    /// Feed moves that go nowhere. They are left out of the motion.
    pub zero_length_feeds: u32,
    /// Rapid moves that go nowhere. They are left out of the motion.
    pub zero_length_rapids: u32,
    /// Dwells (G4).
    pub dwells: u32,
    /// Events.
    pub events: u32,
    /// Path of the feed moves with linear axes, mm.
    pub feed_length_mm: f64,
    /// Path of the rapid moves with linear axes, mm.
    pub rapid_length_mm: f64,
    /// Path of the feed moves of rotary axes alone, degrees.
    pub feed_rotary_deg: f64,
    /// Path of the rapid moves of rotary axes alone, degrees.
    pub rapid_rotary_deg: f64,
    /// Time of the feed moves at their feedrate, as if there were no acceleration, s.
    pub feed_time_s: f64,
    /// Time of the dwells, s.
    pub dwell_s: f64,
    /// Smallest and largest machine coordinates of all moves, from the start of the first; `None`
    /// without moves.
    pub bounding_box: Option<(AxisVector, AxisVector)>,
}

impl Totals {
    fn add(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Move { segment, rate, .. } => self.add_move(segment, *rate),
            ItemKind::Dwell(seconds) => {
                self.dwells += 1;
                self.dwell_s += seconds;
            }
            ItemKind::Event(_) => self.events += 1,
        }
    }

    fn add_move(&mut self, segment: &Segment, rate: Rate) {
        let length = segment.length();
        let (linear, (low, high)) = match segment {
            Segment::Line(line) => {
                let d = line.displacement();
                let linear = LINEAR_XYZ.chain(UVW).any(|axis| d[axis] != 0.0);
                (
                    linear,
                    (line.start.inf(&line.end), line.start.sup(&line.end)),
                )
            }
            Segment::Arc(arc) => (true, arc.bounding_box()),
        };
        self.bounding_box = Some(match self.bounding_box {
            Some((l, h)) => (l.inf(&low), h.sup(&high)),
            None => (low, high),
        });
        match rate {
            Rate::Rapid => {
                self.rapids += 1;
                *(if linear {
                    &mut self.rapid_length_mm
                } else {
                    &mut self.rapid_rotary_deg
                }) += length;
            }
            Rate::Feed(feed_v) => {
                let arc = matches!(segment, Segment::Arc(_));
                *(if arc {
                    &mut self.arcs
                } else {
                    &mut self.straight_feeds
                }) += 1;
                *(if linear {
                    &mut self.feed_length_mm
                } else {
                    &mut self.feed_rotary_deg
                }) += length;
                self.feed_time_s += length / feed_v;
            }
        }
    }
}

/// A program being read: an iterator of [`Item`]s in constant memory.
///
/// It ends at M2, M30, the second percent line, the end of the input, or after the first finding.
#[derive(Debug)]
pub struct Program<R> {
    source: LineSource<R>,
    interpreter: Interpreter,
    block: Block,
    /// Items of the last block; the first `given` of them have been given out.
    items: Vec<Item>,
    given: usize,
    totals: Totals,
    /// A percent line was read.
    percent: bool,
    /// A block with words was read.
    begun: bool,
    ended: bool,
}

impl<R: BufRead> Program<R> {
    /// Starts to read a program. Nothing is read before the first item is asked for.
    pub fn new(reader: R, options: Options) -> Self {
        Self {
            source: LineSource::new(reader),
            interpreter: Interpreter::new(options),
            block: Block::default(),
            items: Vec::new(),
            given: 0,
            totals: Totals::default(),
            percent: false,
            begun: false,
            ended: false,
        }
    }

    /// Modal state after the last block read.
    #[must_use]
    pub const fn modal(&self) -> &Modal {
        &self.interpreter.state.modal
    }

    /// Machine position after the last block read.
    #[must_use]
    pub const fn position(&self) -> &AxisVector {
        &self.interpreter.state.position
    }

    /// Counts and sums over the blocks read so far.
    #[must_use]
    pub const fn totals(&self) -> &Totals {
        &self.totals
    }

    /// Reads the next line and executes it; its items replace those of the line before.
    ///
    /// `None` after the end. A line with a finding has no effect on the state; unless the finding
    /// is fatal, the next line can be read.
    pub(crate) fn next_line(&mut self) -> Option<Result<(), Diagnostic>> {
        self.items.clear();
        self.given = 0;
        if self.ended {
            return None;
        }
        match self.read_line() {
            Ok(true) => Some(Ok(())),
            Ok(false) => {
                self.ended = true;
                None
            }
            Err(fault) => {
                self.ended = fault.code.is_fatal();
                self.totals.lines = self.source.number();
                Some(Err(fault.at(self.source.number(), self.source.text())))
            }
        }
    }

    fn read_line(&mut self) -> Outcome<bool> {
        if !self.source.advance()? {
            return Ok(false);
        }
        let line = self.source.number();
        self.totals.lines = line;
        let parsed = self
            .block
            .parse(self.source.text(), self.interpreter.options.block_delete);
        self.begun |= self.block.any || parsed.is_err();
        parsed?;
        match self.block.kind {
            LineKind::Block if self.block.any => {}
            LineKind::Percent if self.percent || self.begun => return Ok(false),
            LineKind::Percent => {
                self.percent = true;
                return Ok(true);
            }
            LineKind::Block | LineKind::Deleted => return Ok(true),
        }
        let flow = self
            .interpreter
            .execute(&self.block, line, &mut self.items)?;
        for item in &self.items {
            self.totals.add(item);
        }
        self.totals.zero_length_feeds += self.interpreter.zero_length.feeds;
        self.totals.zero_length_rapids += self.interpreter.zero_length.rapids;
        // The items of the last block are still to be given out.
        self.ended = flow == Flow::End;
        Ok(true)
    }
}

impl<R: BufRead> Iterator for Program<R> {
    type Item = Result<Item, Diagnostic>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(item) = self.items.get(self.given) {
                self.given += 1;
                return Some(Ok(*item));
            }
            if let Err(diagnostic) = self.next_line()? {
                self.ended = true;
                return Some(Err(diagnostic));
            }
        }
    }
}
