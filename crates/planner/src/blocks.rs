//! Blocks by number.
//!
//! A line can be executed many times, in a loop or a subprogram, so it does not say where a program
//! is; the number of the item does. The motion planner passes the line of an item on to the frames of
//! its motion and asks nothing of it. So items go in with their number instead, and the line is put
//! back into the frames that come out.

use std::collections::VecDeque;

use glidepath_motion::PlanError;
use glidepath_program::Frame;

/// The blocks between the planner's input and its output.
#[derive(Debug)]
pub(crate) struct Blocks {
    /// Number of the next item.
    next: u32,
    /// Of the last frame.
    present: u32,
    line: u32,
    /// Numbers and lines of items that frames may still come of, in order.
    under_way: VecDeque<(u32, u32)>,
}

impl Blocks {
    /// Those of a whole program.
    pub(crate) const fn whole() -> Self {
        Self {
            next: 1,
            present: 0,
            line: 0,
            under_way: VecDeque::new(),
        }
    }

    /// Those of a program from `first` on, in which the machine stands.
    pub(crate) const fn from(first: u32) -> Self {
        Self {
            next: first,
            present: first,
            line: 0,
            under_way: VecDeque::new(),
        }
    }

    /// Gives an item its number.
    pub(crate) fn enter(&mut self, line: u32) -> u32 {
        let block = self.next;
        self.next = self.next.saturating_add(1);
        self.under_way.push_back((block, line));
        block
    }

    /// Puts the line back into a frame, and remembers the block.
    pub(crate) fn leave(&mut self, frame: &mut Frame) {
        if frame.line > 0 {
            self.present = frame.line;
        }
        while let Some(&(block, line)) = self.under_way.front()
            && block <= self.present
        {
            self.line = line;
            self.under_way.pop_front();
        }
        frame.line = self.line;
    }

    /// Block of the last frame.
    pub(crate) const fn present(&self) -> u32 {
        self.present
    }

    /// Puts the line back into an error.
    pub(crate) fn name(&self, error: PlanError) -> PlanError {
        error.map_line(|block| {
            let of_it = |entry: &&(u32, u32)| entry.0 == block;
            self.under_way
                .iter()
                .find(of_it)
                .map_or(self.line, |(_, line)| *line)
        })
    }
}
