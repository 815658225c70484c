//! A rewritten line that knows where its bytes came from.

use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::text_variables::TextAssignment;

/// A line in RS274/NGC words, and where each byte of it came from.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rewritten {
    pub(crate) text: Vec<u8>,
    origin: Vec<usize>,
    /// It ends the subprogram it is of.
    pub(crate) ends_subprogram: bool,
    /// The texts that it assigns, in their order.
    pub(crate) texts: Vec<TextAssignment>,
}

impl Rewritten {
    pub(super) fn push(&mut self, bytes: &[u8], origin: usize) {
        self.text.extend_from_slice(bytes);
        self.origin.extend(bytes.iter().map(|_| origin));
    }

    /// The same span in the line as it was written.
    pub(crate) fn origin(&self, span: SourceSpan) -> SourceSpan {
        let at = |index: usize| self.origin.get(index).copied();
        let last = self.origin.last().map_or(0, |last| last + 1);
        let start = at(span.start).unwrap_or(last);
        let end = at(span.start + span.length.saturating_sub(1)).map_or(last, |end| end + 1);
        SourceSpan::new(start, end.max(start + usize::from(span.length > 0)))
    }
}
