//! The origin of the line being executed: the program itself, or a kept line, for diagnostics.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::execute::flow::kept_lines::KeptLines;

/// A line that is kept for diagnostics.
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

    pub(crate) fn diagnostic(&self, fault: BlockDiagnostic) -> Diagnostic {
        Diagnostic {
            file: self.file.clone(),
            ..fault.at(self.number, &self.text)
        }
    }
}

/// Where the line being executed comes from.
#[derive(Debug)]
pub(crate) enum LineOrigin {
    /// The input.
    Stream,
    /// A subroutine or structure, and the index of the line.
    Kept(Arc<KeptLines>, usize),
    /// A line that is gone.
    Past(SourceLine),
    /// A line of the tape.
    Tape(SourceLine),
}
