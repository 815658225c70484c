//! The log of a program's remarks to people, each told when its block is executed: programs are
//! read long before.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glidepath_gcode::Remark;

/// The remarks of a program that were read and not yet executed. Clones are the same log: one end is
/// with the source of items, the other with whoever tells people.
#[derive(Debug, Clone, Default)]
pub struct RemarkLog {
    /// Each behind a block.
    remarks: Arc<Mutex<VecDeque<(u32, Remark)>>>,
}

impl RemarkLog {
    pub(crate) fn note(&self, behind: u32, remark: Remark) {
        self.remarks().push_back((behind, remark));
    }

    /// Drops the remarks of a program that begins with a block: but for those right in front of it.
    pub fn begin_with(&self, block: u32) {
        let _before = self.executed(block.saturating_sub(1));
    }

    /// The remarks in front of a block that is being executed.
    pub(crate) fn executed(&self, block: u32) -> Vec<Remark> {
        let mut remarks = self.remarks();
        let count = remarks.iter().take_while(|(behind, _)| *behind < block);
        let count = count.count();
        remarks.drain(..count).map(|(_, remark)| remark).collect()
    }

    fn remarks(&self) -> MutexGuard<'_, VecDeque<(u32, Remark)>> {
        self.remarks.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
