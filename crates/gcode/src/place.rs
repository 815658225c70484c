//! Where the line being executed comes from.

use std::sync::Arc;

use crate::diagnostic::{Diagnostic, Fault};
use crate::flow::Code;

/// A line that is kept for findings.
#[derive(Debug, Clone, Default)]
pub(crate) struct SourceLine {
    pub(crate) number: u32,
    pub(crate) text: Box<[u8]>,
    /// The file of a subroutine it is in; `None`: the program itself.
    pub(crate) file: Option<Arc<str>>,
}

impl SourceLine {
    /// A line of the program itself.
    pub(crate) fn new(number: u32, text: &[u8]) -> Self {
        Self {
            number,
            text: text.into(),
            file: None,
        }
    }

    pub(crate) fn finding(&self, fault: Fault) -> Diagnostic {
        Diagnostic {
            file: self.file.clone(),
            ..fault.at(self.number, &self.text)
        }
    }
}

/// Where the line being executed comes from.
#[derive(Debug)]
pub(crate) enum Place {
    /// The input.
    Stream,
    /// A subroutine or structure, and the index of the line.
    Kept(Arc<Code>, usize),
    /// A line that is gone.
    Past(SourceLine),
    /// A line of the tape.
    Tape(SourceLine),
}
