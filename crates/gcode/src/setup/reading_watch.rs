//! The watch on the reading of a program, from another thread: how far it has come, and that it is
//! to end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Watches the reading of a program from another thread. Clones watch the same.
///
/// Loops of a program may go on for many seconds without an item. Whoever reads it in a thread of its
/// own sees here how far it has come, and can end it at the next line.
#[derive(Debug, Clone, Default)]
pub struct ReadingWatch(Arc<Shared>);

#[derive(Debug, Default)]
struct Shared {
    line: AtomicU32,
    is_to_end: AtomicBool,
}

/// It does not change what a program means.
impl PartialEq for ReadingWatch {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}

impl ReadingWatch {
    /// Line of the program that is being read or executed, 0 before the first.
    #[must_use]
    pub fn line(&self) -> u32 {
        self.0.line.load(Ordering::Relaxed)
    }

    /// The reading is to end: the next line is refused.
    pub fn end(&self) {
        self.0.is_to_end.store(true, Ordering::Relaxed);
    }

    /// Whether it is to end.
    #[must_use]
    pub fn is_to_end(&self) -> bool {
        self.0.is_to_end.load(Ordering::Relaxed)
    }

    pub(crate) fn come_to(&self, line: u32) {
        self.0.line.store(line, Ordering::Relaxed);
    }
}
