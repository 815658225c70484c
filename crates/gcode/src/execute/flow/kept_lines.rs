//! The kept lines of a part of a program that may be executed more than once.

use std::sync::Arc;

use crate::syntax::o_word::{Keyword, OWord};

/// A kept line.
#[derive(Debug)]
pub(crate) struct KeptLine {
    pub(crate) number: u32,
    pub(crate) text: Box<[u8]>,
    pub(crate) o_word: Option<OWord>,
    /// First line of the loop this line belongs to or leaves.
    pub(crate) start: usize,
    /// Last line of the structure this line belongs to or leaves.
    pub(crate) end: usize,
    /// The next branch, for `if` and `elseif`.
    pub(crate) next: usize,
}

impl KeptLine {
    pub(crate) fn keyword(&self) -> Option<Keyword> {
        self.o_word.as_ref().and_then(|o_word| o_word.keyword)
    }
}

/// A part of the program that was kept.
#[derive(Debug, Default)]
pub(crate) struct KeptLines {
    pub(crate) lines: Vec<KeptLine>,
    /// The file of a subroutine they are in; `None`: the program itself.
    pub(crate) file: Option<Arc<str>>,
}
