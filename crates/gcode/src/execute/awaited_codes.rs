//! M codes that are told where they stand, and waited for later: in front of the next feed move, or
//! at the end of their block.
//!
//! ```text
//!   M3 S800      told                  M110 G1 X10     told │ the move │ awaited
//!   G0 X50       goes on meanwhile
//!   G1 Z-1 F200  awaited │ the move
//! ```

use std::sync::Arc;

use glidepath_program::{Event, Item, ItemKind};

use crate::setup::m_codes::{MCodes, WaitsAt};

/// The codes that were told and not awaited yet.
#[derive(Debug, Default)]
pub(crate) struct AwaitedCodes {
    codes: Arc<MCodes>,
    /// Whether there are any such codes at all.
    any: bool,
    at_feed: Vec<u32>,
    at_block_end: Vec<u32>,
    /// The line of the block they stand in.
    line: u32,
}

impl AwaitedCodes {
    pub(crate) fn new(codes: &Arc<MCodes>) -> Self {
        Self {
            codes: Arc::clone(codes),
            any: codes.wait_elsewhere(),
            ..Self::default()
        }
    }

    /// What comes in front of an item; the item is noted when there is nothing more.
    #[inline]
    pub(crate) fn before(&mut self, item: &Item) -> Option<Item> {
        if self.any { self.look(item) } else { None }
    }

    fn look(&mut self, item: &Item) -> Option<Item> {
        self.line = item.line;
        match item.kind {
            ItemKind::Move { rate, .. } if rate.is_rapid() => None,
            ItemKind::Move { .. }
            | ItemKind::Event(Event::Probe { .. } | Event::Synchronise { .. }) => {
                self.at_feed.pop().map(|code| self.awaited(code))
            }
            ItemKind::Event(Event::MCode(code) | Event::PassingCode(code)) => {
                self.tell(code);
                None
            }
            ItemKind::Dwell(_) | ItemKind::Event(_) => None,
        }
    }

    /// What comes behind the last item of a block.
    #[inline]
    pub(crate) fn behind_block(&mut self) -> Option<Item> {
        let code = self.at_block_end.pop()?;
        Some(self.awaited(code))
    }

    /// What comes behind an input that ended without the end of a program.
    #[cold]
    pub(crate) fn behind_input(&mut self) -> Option<Item> {
        let code = self.at_feed.pop()?;
        Some(self.awaited(code))
    }

    fn tell(&mut self, code: u32) {
        // What is told anew makes void what was told before.
        let voids = |other: &u32| match code {
            3..=5 | 19 => matches!(other, 3..=5 | 19),
            6 => matches!(other, 3..=4),
            9 => matches!(other, 7..=9),
            7 | 8 => *other == 9 || *other == code,
            _ => *other == code,
        };
        self.at_feed.retain(|other| !voids(other));
        match self.codes.waits_at(code) {
            WaitsAt::Code => {}
            WaitsAt::NextFeed => self.at_feed.push(code),
            WaitsAt::BlockEnd => self.at_block_end.push(code),
        }
    }

    const fn awaited(&self, code: u32) -> Item {
        Item {
            block: 0,
            line: self.line,
            kind: ItemKind::Event(Event::Await(code)),
        }
    }
}
