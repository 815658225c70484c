//! The start at a line in the middle of a program, as if all before it had been executed.
//!
//! The program is read from its beginning, without motion, up to the line. What spindle, coolant,
//! tool and outputs are to do there, and where the machine is to stand, follows from what was read;
//! what is otherwise now is made so first:
//!
//! ```text
//!  tool axis up ──► tool, spindle, coolant, outputs ──► the other axes ──► tool axis down, at the feed
//! ```

use std::collections::VecDeque;

use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_link::Auxiliary;
use glidepath_program::{CodeWord, Event, Item, ItemKind, PathMode, Rate};
use thiserror::Error;

use crate::run::refusal::Refusal;
use crate::source::input_arbiter::InputResult;
use crate::source::item_source::{ItemSource, Settled, Supply};
use crate::source::restoring::{awaiting, restoring};
use crate::source::resume::{Remainder, ResumePoint};

/// What is no way, mm or degrees.
const NO_WAY: f64 = 1e-6;
/// The way down where the program has no feed move, neither ahead nor before, mm/s.
const SLOW_V: f64 = 5.0;
/// Items looked ahead for the feed.
const LOOK_AHEAD: usize = 64;

/// The code that switches the adaptive feed by its P word.
const ADAPTIVE_FEED: u32 = 52;

/// A line, at one of the times that it is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StartLine {
    /// Its number.
    pub line: u32,
    /// Which time, from 1: it is executed again where it comes after another line.
    pub pass: u32,
}

/// The reason why a program cannot begin there.
#[derive(Debug, Error)]
pub enum StartLineError {
    /// The program is refused before that line.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// Nothing is executed there.
    #[error(
        "{}{}",
        match pass {
            0 | 1 => format!("nothing is executed in line {line}"),
            pass => format!("line {line} is executed fewer than {pass} times"),
        },
        match next {
            Some(next) => format!("; line {next} is the next one in which something is executed"),
            None => String::new(),
        }
    )]
    NoSuchLine {
        /// The line.
        line: u32,
        /// Which time.
        pass: u32,
        /// The next line that does something.
        next: Option<u32>,
    },
    /// The line is in the middle of something that has to be executed as a whole.
    #[error("line {line} is on a contour beside the tool (G41, G42); begin before it is entered")]
    OnContour {
        /// The line.
        line: u32,
    },
}

/// A program at a line it is to begin with.
#[derive(Debug)]
pub struct LineStart<S> {
    source: S,
    ahead: VecDeque<Item>,
    /// What comes behind those, if it is no item.
    last: Option<Supply>,
    /// Number of the first item.
    block: u32,
    expected: Auxiliary,
    begins_at: AxisVector,
    told: u32,
    /// The feed of the last feed move before the line, mm/s.
    before_v: Option<f64>,
    /// What M52 has last made of the adaptive feed, as its P word.
    adaptive: Option<f64>,
}

/// The approach of the machine to where a program is to begin.
#[derive(Debug, Clone, Copy)]
pub struct Approach {
    /// Where the machine stands.
    pub position: AxisVector,
    /// What spindle, coolant, tool and outputs do now.
    pub now: Auxiliary,
    /// The axis that goes up first and down last.
    pub tool_axis: Axis,
    /// Where it is up, in machine coordinates; `None`: at the higher one of both ends.
    pub top: Option<f64>,
}

impl Approach {
    /// How far up the tool axis goes on the way to a position, mm or degrees.
    #[must_use]
    pub fn up_to(&self, begins_at: &AxisVector) -> f64 {
        let axis = self.tool_axis.index();
        let top = self.top.unwrap_or(f64::NEG_INFINITY);
        self.position[axis].max(begins_at[axis]).max(top)
    }
}

impl<S: ItemSource> LineStart<S> {
    /// Reads a program, opened for the machine where it stands, up to a line. What the program says
    /// nothing of before that line stays as it is. For sources that are never pending.
    ///
    /// # Errors
    /// [`StartLineError`].
    pub fn find(
        mut source: S,
        start: StartLine,
        approach: &Approach,
    ) -> Result<Self, StartLineError> {
        let mut expected = approach.now;
        let (mut begins_at, mut before, mut passes, mut block) = (approach.position, 0, 0, 1);
        let (mut told, mut word, mut adaptive, mut before_v) = (0, None, None, None);
        let mut next = None;
        loop {
            let item = match source.next_item() {
                Supply::Item(item) => item,
                Supply::Refused(refusal) => return Err(refusal.into()),
                Supply::Pending | Supply::Probe => {
                    return Err(Refusal::AnswerUnknown { line: before }.into());
                }
                Supply::End => {
                    let StartLine { line, pass } = start;
                    return Err(StartLineError::NoSuchLine { line, pass, next });
                }
            };
            if item.line > start.line && next.is_none_or(|next| item.line < next) {
                next = Some(item.line);
            }
            passes += u32::from(item.line == start.line && before != start.line);
            before = item.line;
            if passes == start.pass && item.line == start.line {
                if source.is_on_contour() {
                    return Err(StartLineError::OnContour { line: start.line });
                }
                return Ok(Self {
                    source,
                    ahead: VecDeque::from([item]),
                    last: None,
                    block,
                    expected,
                    begins_at,
                    told,
                    before_v,
                    adaptive,
                });
            }
            match item.kind {
                ItemKind::Move { segment, rate, .. } => {
                    begins_at = segment.end();
                    before_v = rate.feed_v().or(before_v);
                }
                ItemKind::Event(event) => {
                    match event {
                        Event::CodeWord { value, .. } => word = Some(value),
                        Event::MCode(ADAPTIVE_FEED) => adaptive = word,
                        _ => {}
                    }
                    expected.take(event);
                }
                ItemKind::Dwell(_) => {}
            }
            if let Settled::Answered(answer) = source.settle(None)? {
                told += 1;
                if let InputResult::Probe(probed) = answer {
                    begins_at = probed.stands;
                }
            }
            block += 1;
        }
    }

    /// The state of spindle, coolant, tool and outputs that the program expects there.
    pub const fn expected(&self) -> &Auxiliary {
        &self.expected
    }

    /// The number of its first item.
    pub const fn block(&self) -> u32 {
        self.block
    }

    /// The position at which the machine is to stand there.
    pub const fn begins_at(&self) -> AxisVector {
        self.begins_at
    }

    /// The number of times that inputs and the probe were asked before; it is answered as it was
    /// then.
    pub const fn told(&self) -> u32 {
        self.told
    }

    /// The program from there on, with the way to its beginning in front.
    pub fn approached(mut self, approach: &Approach) -> Remainder<S> {
        let mut items = Vec::new();
        let axis = approach.tool_axis.index();
        let mut up = approach.position;
        up[axis] = approach.up_to(&self.begins_at);
        let mut over = self.begins_at;
        over[axis] = up[axis];
        push_move(&mut items, approach.position, up, Rate::Rapid);
        let mut events = restoring(&approach.now, &self.expected);
        let awaited = awaiting(&events);
        if let Some(value) = self.adaptive {
            let word = CodeWord::P;
            events.extend([Event::CodeWord { word, value }, Event::MCode(ADAPTIVE_FEED)]);
        }
        items.extend(events.into_iter().map(ItemKind::Event));
        push_move(&mut items, up, over, Rate::Rapid);
        items.extend(awaited.into_iter().map(ItemKind::Event));
        let feed_v = self.way_down_v();
        push_move(&mut items, over, self.begins_at, Rate::Feed(feed_v));
        let line = self.ahead.front().map_or(0, |item| item.line);
        let items = items.into_iter().map(|kind| Item {
            line,
            block: 0,
            kind,
        });
        // They have the numbers of the blocks in front of the line, as far as there are any: that of the line stays.
        let mut aside: VecDeque<Item> = items.collect();
        let in_front = usize::try_from(self.block - 1).unwrap_or(usize::MAX);
        let numbered = aside.split_off(aside.len().saturating_sub(in_front));
        let first_block = self.block - u32::try_from(numbered.len()).unwrap_or(0);
        for item in numbered.into_iter().rev() {
            self.ahead.push_front(item);
        }
        let point = ResumePoint {
            line: 0,
            position: approach.position,
            program_start: approach.position,
            program: self.source.fingerprint(),
            block: first_block,
            path_s: 0.0,
            block_path_s: 0.0,
            unanswered: false,
            found: None,
        };
        let begins = (first_block, aside);
        Remainder::beginning_with(self.source, point, begins, (self.ahead, self.last))
    }

    /// The speed at which the tool axis goes down, mm/s: at the feed of the first feed move ahead;
    /// where there is none, of the last one before.
    pub fn way_down_v(&mut self) -> f64 {
        let feed_of = |item: &Item| match item.kind {
            ItemKind::Move { rate, .. } => rate.feed_v(),
            _ => None,
        };
        if let Some(feed_v) = self.ahead.iter().find_map(feed_of) {
            return feed_v;
        }
        while self.ahead.len() < LOOK_AHEAD {
            let item = match self.source.next_item() {
                Supply::Item(item) => item,
                Supply::Pending => break,
                last => {
                    self.last = Some(last);
                    break;
                }
            };
            self.ahead.push_back(item);
            if let Some(feed_v) = feed_of(&item) {
                return feed_v;
            }
        }
        self.before_v.unwrap_or(SLOW_V)
    }
}

fn push_move(items: &mut Vec<ItemKind>, from: AxisVector, to: AxisVector, rate: Rate) {
    if (to - from).amax() > NO_WAY {
        items.push(ItemKind::Move {
            segment: Segment::line(from, to),
            rate,
            mode: PathMode::ExactStop,
        });
    }
}

#[cfg(test)]
mod tests;
