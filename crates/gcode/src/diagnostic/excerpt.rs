//! The part of a source line that a diagnostic shows.

use crate::diagnostic::span::SourceSpan;

/// Longest excerpt of a source line kept in a [`Diagnostic`](crate::Diagnostic), characters.
pub(crate) const EXCERPT_CHARS: usize = 120;
/// Characters kept before the diagnostic when a line is too long to show from its start.
const EXCERPT_LEAD: usize = 60;

/// Part of a source line, for display.
///
/// Control characters and bytes that are not UTF-8 are replaced, each by one character, so that
/// `caret` counts what is shown.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Excerpt {
    /// The text, at most 120 characters; `…` marks a cut.
    pub text: String,
    /// Characters of `text` before the diagnostic.
    pub caret: usize,
    /// Characters of `text` to underline, at least 1.
    pub length: usize,
}

/// Cuts a window out of a line that shows the span.
pub(crate) fn excerpt(text: &[u8], span: SourceSpan) -> Excerpt {
    // Only a stretch around the span is decoded: the line may be long.
    let lead = span.start.min(text.len()).saturating_sub(4 * EXCERPT_LEAD);
    let from = if lead == 0 { 0 } else { lead };
    let to = text.len().min(span.start.saturating_add(4 * EXCERPT_CHARS));
    let middle = span.start.clamp(from, to);
    let end = span
        .start
        .saturating_add(span.length.max(1))
        .clamp(middle, to);

    let mut before = printable(text.get(from..middle).unwrap_or_default());
    let marked = printable(text.get(middle..end).unwrap_or_default());
    let after = printable(text.get(end..to).unwrap_or_default());

    let cut_left = from > 0 || before.len() > EXCERPT_CHARS - EXCERPT_LEAD / 2;
    if cut_left {
        let drop = before.len().saturating_sub(EXCERPT_LEAD);
        before.drain(..drop);
        before.insert(0, '…');
    }
    let caret = before.len();
    let length = marked
        .len()
        .clamp(1, EXCERPT_CHARS.saturating_sub(caret).max(1));
    let mut shown: Vec<char> = before.into_iter().chain(marked).chain(after).collect();
    if shown.len() > EXCERPT_CHARS || to < text.len() {
        shown.truncate(EXCERPT_CHARS - 1);
        shown.push('…');
    }
    Excerpt {
        text: shown.into_iter().collect(),
        caret,
        length,
    }
}

/// Decodes UTF-8 leniently and makes every character take one place.
fn printable(bytes: &[u8]) -> Vec<char> {
    let blank = |c: char| {
        if c == '\t' {
            ' '
        } else if c.is_control() {
            '\u{fffd}'
        } else {
            c
        }
    };
    String::from_utf8_lossy(bytes).chars().map(blank).collect()
}
