//! Numbers of the items of a stretch, in the place of what the program calls its blocks: with them
//! every frame tells which item it is on, also where blocks are not counted.

use glidepath_program::{Frame, Item};
use std::collections::VecDeque;

/// The blocks of the items that frames may still tell.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    /// Number of the first of them.
    first: u32,
    blocks: VecDeque<u32>,
}

impl Numbers {
    pub(super) const fn new() -> Self {
        Self {
            first: 1,
            blocks: VecDeque::new(),
        }
    }

    /// An item with its number.
    pub(super) fn number(&mut self, item: &Item) -> Item {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "a stretch of so many items is not planned in a lifetime"
        )]
        let block = self.first + self.blocks.len() as u32;
        self.blocks.push_back(item.block);
        Item { block, ..*item }
    }

    /// A frame with the block of the program. Frames come in the order of the items.
    pub(super) fn restore(&mut self, frame: &mut Frame) {
        while self.first < frame.block && self.blocks.len() > 1 {
            self.blocks.pop_front();
            self.first += 1;
        }
        frame.block = match self.blocks.front() {
            Some(block) if frame.block == self.first => *block,
            _ => 0,
        };
    }
}
