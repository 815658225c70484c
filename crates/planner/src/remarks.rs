//! What a program says to people, and when: programs are read long before they are executed.

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

    /// The remarks in front of a block that is being executed.
    #[must_use]
    pub fn executed(&self, block: u32) -> Vec<Remark> {
        let mut remarks = self.remarks();
        let count = remarks.iter().take_while(|(behind, _)| *behind < block);
        let count = count.count();
        remarks.drain(..count).map(|(_, remark)| remark).collect()
    }

    /// All that is left, when all of the program is executed.
    #[must_use]
    pub fn all_executed(&self) -> Vec<Remark> {
        self.executed(u32::MAX)
    }

    fn remarks(&self) -> MutexGuard<'_, VecDeque<(u32, Remark)>> {
        self.remarks.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
