//! The block numbers of a pipeline: which block of the program its frames belong to.
//!
//! A line can be executed many times, in a loop or a subprogram, so it does not say where a
//! program is; the number of the item does. Items get it here, in the order in which they are
//! taken, and the motion planner hands it on to the frames of their motion together with the line.

use glidepath_program::{Frame, Item, ProgramLine};

/// The blocks between the planner's input and its output.
#[derive(Debug, Clone)]
pub(crate) struct Blocks {
    /// Number of the next item.
    next: u32,
    /// Block of the last frame.
    present: u32,
    /// The furthest line that a frame has been on. A rest inside a blend may belong to a later
    /// block than the frames behind it; the line that is told does not go back for that.
    furthest: ProgramLine,
}

impl Blocks {
    /// The blocks of a whole program.
    pub(crate) const fn whole() -> Self {
        Self {
            next: 1,
            present: 0,
            furthest: ProgramLine::NONE,
        }
    }

    /// The blocks of a program from `first` on, in which the machine stands.
    pub(crate) const fn from(first: u32) -> Self {
        Self {
            next: first,
            present: first,
            furthest: ProgramLine::NONE,
        }
    }

    /// Gives an item its number.
    pub(crate) fn number(&mut self, item: &mut Item) {
        item.block = self.next;
        self.next = self.next.saturating_add(1);
        if item.block <= self.present {
            // The machine stands in the first block of the rest of a program.
            self.furthest = item.program_line();
        }
    }

    /// Gives an item that is not of the program the number of the item before it.
    pub(crate) fn share(&mut self, item: &mut Item) {
        item.block = self.next.saturating_sub(1).max(self.present);
        if item.block <= self.present {
            self.furthest = item.program_line();
        }
    }

    /// An item has its number, and no motion.
    pub(crate) const fn pass(&mut self) {
        self.next = self.next.saturating_add(1);
    }

    /// Says in a frame at rest, which is of no block itself, which one it is in.
    pub(crate) fn complete(&mut self, frame: &mut Frame) {
        if frame.block > 0 {
            self.present = frame.block;
            if frame.block >= self.furthest.block {
                self.furthest = frame.program_line();
            }
        }
        frame.block = self.present;
        frame.line = self.furthest.number;
    }

    /// Block of the last frame.
    pub(crate) const fn present(&self) -> u32 {
        self.present
    }
}
