//! The log of changes that a program makes to the machine's set-up, each with the block behind
//! which it holds.
//!
//! Programs are read long before they are executed. What they change (coordinate systems, reference
//! positions, the offset of G92, tools and which of their lengths is in force, kept parameters) is therefore noted with the number of items in front of it,
//! which is the number of the block that has to be executed before it holds.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glidepath_gcode::{KeptVariables, PositionOffsets, ToolTable, WorkOffsets};

/// The set-up of the machine from some block on.
#[derive(Debug, Clone, PartialEq)]
pub struct SetUp {
    /// Coordinate systems, reference positions, the offset of G92.
    pub offsets: WorkOffsets,
    /// The tool table, with what G10 has made of it.
    pub tools: Option<Arc<ToolTable>>,
    /// Tool in the spindle; 0: none.
    pub tool: u32,
    /// Parameters that outlast a restart.
    pub variables: KeptVariables,
}

/// The changes of the machine's set-up.
pub type ChangeLog = BlockLog<SetUp>;

/// The changes of the offsets in force that positions of the part are without.
pub type PositionOffsetsLog = BlockLog<PositionOffsets>;

/// The changes of a program that were read and not yet executed. Clones are the same log: one end
/// is with the source of items, the other with whoever keeps or shows what was executed.
#[derive(Debug)]
pub struct BlockLog<T> {
    /// Each behind a block. As many as blocks are read ahead, at most.
    changes: Arc<Mutex<VecDeque<(u32, T)>>>,
}

impl<T> Default for BlockLog<T> {
    fn default() -> Self {
        Self {
            changes: Arc::default(),
        }
    }
}

impl<T> Clone for BlockLog<T> {
    fn clone(&self) -> Self {
        Self {
            changes: Arc::clone(&self.changes),
        }
    }
}

impl<T> BlockLog<T> {
    /// Notes what holds behind a block.
    pub(crate) fn note(&self, behind: u32, now: T) {
        let mut changes = self.changes();
        if changes.back().is_some_and(|(block, _)| *block == behind) {
            changes.pop_back();
        }
        changes.push_back((behind, now));
    }

    /// What holds while a block is executed: what was changed behind the blocks in front of it. `None`: as
    /// before.
    #[must_use]
    pub fn executed(&self, block: u32) -> Option<T> {
        let mut changes = self.changes();
        let count = changes.iter().take_while(|(behind, _)| *behind < block);
        let count = count.count();
        changes.drain(..count).next_back().map(|(_, now)| now)
    }

    /// What holds when all of the program is executed. `None`: as before.
    #[must_use]
    pub fn all_executed(&self) -> Option<T> {
        self.changes().drain(..).next_back().map(|(_, now)| now)
    }

    fn changes(&self) -> MutexGuard<'_, VecDeque<(u32, T)>> {
        self.changes.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::item_source::{ItemSource as _, Supply};
    use crate::source::program::ProgramSource;
    use crate::source::run_channels::RunChannels;
    use glidepath_gcode::Options;

    #[test]
    fn a_change_is_executed_when_what_stands_before_it_is() {
        let text = "G0 X1\nG0 X2\nG10 L2 P2 X5\nG10 L2 P2 X6\nG0 X3\nT7 M6\nG0 X4\nM2\n";
        let log = ChangeLog::default();
        let mut source =
            ProgramSource::new(text.as_bytes(), Options::default()).attended(RunChannels {
                changes: Some(log.clone()),
                ..RunChannels::default()
            });
        let mut items = 0;
        while let Supply::Item(_) = source.next_item() {
            items += 1;
        }
        assert_eq!(
            items, 6,
            "four moves, the selection and the change of the tool"
        );
        let of = |set_up: Option<SetUp>| set_up.map(|s| (s.offsets.systems[1].origin[0], s.tool));
        assert_eq!(of(log.executed(2)), None, "the second move is under way");
        assert_eq!(of(log.executed(3)), Some((6.0, 0)));
        assert_eq!(of(log.executed(5)), None, "the tool is being changed");
        assert_eq!(of(log.executed(6)), Some((6.0, 7)));
        assert_eq!(of(log.all_executed()), None);
    }

    #[test]
    fn a_length_of_a_tool_holds_from_the_move_behind_it_and_not_while_the_tool_is_changed() {
        let text = "G0 Z1\nG43.1 Z2\nG0 Z2\nS9 T7 M6 G43.1 Z5\nG0 Z3\nG49\nM2\n";
        let log = PositionOffsetsLog::default();
        let mut source =
            ProgramSource::new(text.as_bytes(), Options::default()).attended(RunChannels {
                position_offsets: Some(log.clone()),
                ..RunChannels::default()
            });
        while let Supply::Item(_) = source.next_item() {}
        let of = |length: Option<PositionOffsets>| length.map(|length| length.tool[2]);
        assert_eq!(of(log.executed(1)), Some(0.0), "what it begins with");
        assert_eq!(of(log.executed(2)), Some(2.0));
        for of_the_change in 3..=5 {
            assert_eq!(of(log.executed(of_the_change)), None);
        }
        assert_eq!(of(log.executed(6)), Some(5.0), "the move behind it");
        assert_eq!(
            of(log.all_executed()),
            Some(0.0),
            "G49, behind which nothing moves"
        );
    }
}
