//! Findings about a program: where, what, why, and how to mend it.

use std::sync::Arc;

pub use crate::finding_code::Code;

/// Longest excerpt of a source line kept in a [`Diagnostic`], characters.
const EXCERPT_CHARS: usize = 120;

/// Characters kept before the finding when a line is too long to show from its start.
const EXCERPT_LEAD: usize = 60;

/// Part of a source line, for display.
///
/// Control characters and bytes that are not UTF-8 are replaced, each by one character, so that
/// `caret` counts what is shown.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Excerpt {
    /// The text, at most 120 characters; `…` marks a cut.
    pub text: String,
    /// Characters of `text` before the finding.
    pub caret: usize,
    /// Characters of `text` to underline, at least 1.
    pub length: usize,
}

/// One finding about a program.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{line}:{column}: error[{code}]: {message}", of_file(.file.as_deref()))]
pub struct Diagnostic {
    /// The file of a subroutine it is in; `None`: the program itself.
    pub file: Option<Arc<str>>,
    /// Source line, from 1.
    pub line: u32,
    /// Byte of the line at which the finding starts, from 1.
    pub column: u32,
    /// Bytes the finding covers.
    pub length: u32,
    /// Its kind.
    pub code: Code,
    /// What is wrong, in a sentence without a full stop.
    pub message: String,
    /// Why that is wrong; may be empty.
    pub reason: String,
    /// How to mend it; may be empty.
    pub help: String,
    /// The source around it.
    pub excerpt: Excerpt,
}

impl Diagnostic {
    /// A finding at some bytes of a text that is not G-code: a curve file.
    #[must_use]
    pub fn in_text(
        text: &str,
        at: core::ops::Range<usize>,
        code: Code,
        message: String,
        help: String,
    ) -> Self {
        let before = text.get(..at.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let rest = text.get(line_start..).unwrap_or_default();
        let line_text = rest.lines().next().unwrap_or_default();
        let number = before.matches('\n').count() + 1;
        let start = before.len() - line_start;
        let end = at.end.saturating_sub(line_start).min(line_text.len());
        let fault = Fault {
            span: Span::new(start, end.max(start)),
            code,
            message,
            reason: String::new(),
            help,
        };
        fault.at(
            u32::try_from(number).unwrap_or(u32::MAX),
            line_text.as_bytes(),
        )
    }
}

/// What stands before the line of a finding in another file than the program.
fn of_file(file: Option<&str>) -> String {
    file.map_or_else(String::new, |file| format!("{file}:"))
}

/// A stretch of a line, in bytes from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Span {
    pub(crate) start: usize,
    pub(crate) length: usize,
}

impl Span {
    pub(crate) const fn new(start: usize, end: usize) -> Self {
        Self {
            start,
            length: end.saturating_sub(start),
        }
    }
}

/// A finding that does not know its line yet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    pub(crate) span: Span,
    pub(crate) code: Code,
    message: String,
    reason: String,
    help: String,
}

/// Result of everything that can find fault with a block. Boxed: the good case stays small.
pub(crate) type Outcome<T> = Result<T, Box<Fault>>;

impl Fault {
    pub(crate) fn new(code: Code, span: Span, message: impl Into<String>) -> Box<Self> {
        let message = message.into();
        Box::new(Self {
            span,
            code,
            message,
            reason: String::new(),
            help: String::new(),
        })
    }

    pub(crate) fn because(mut self: Box<Self>, reason: impl Into<String>) -> Box<Self> {
        self.reason = reason.into();
        self
    }

    pub(crate) fn help(mut self: Box<Self>, help: impl Into<String>) -> Box<Self> {
        self.help = help.into();
        self
    }

    /// Adds the place: line number from 1, and the line's text.
    pub(crate) fn at(self, line: u32, text: &[u8]) -> Diagnostic {
        let small = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Diagnostic {
            file: None,
            line,
            column: small(self.span.start.saturating_add(1)),
            length: small(self.span.length.max(1)),
            code: self.code,
            message: self.message,
            reason: self.reason,
            help: self.help,
            excerpt: excerpt(text, self.span),
        }
    }
}

/// Cuts a window out of a line that shows the span.
fn excerpt(text: &[u8], span: Span) -> Excerpt {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn diagnose(text: &[u8], start: usize, length: usize) -> Diagnostic {
        Fault::new(Code::BadCharacter, Span { start, length }, "bad").at(7, text)
    }

    #[test]
    fn shows_a_short_line_whole() {
        let d = diagnose(b"G1 X1 @", 6, 1);
        assert_eq!((d.line, d.column, d.length), (7, 7, 1));
        assert_eq!(
            d.excerpt,
            Excerpt {
                text: "G1 X1 @".into(),
                caret: 6,
                length: 1
            }
        );
        assert_eq!(d.to_string(), "7:7: error[bad-character]: bad");
    }

    #[test]
    fn counts_characters_where_bytes_differ() {
        let d = diagnose("(é) G1 X−5".as_bytes(), 9, 3);
        assert_eq!(d.excerpt.caret, 8);
        assert_eq!(d.excerpt.text.chars().nth(8), Some('−'));
    }

    #[test]
    fn cuts_a_long_line_around_the_finding() {
        let mut text = vec![b'X'; 70_000];
        text[50_000] = b'@';
        let d = diagnose(&text, 50_000, 1);
        assert!(d.excerpt.text.chars().count() <= EXCERPT_CHARS);
        assert_eq!(d.excerpt.text.chars().nth(d.excerpt.caret), Some('@'));
    }

    #[test]
    fn a_span_beyond_the_line_is_harmless() {
        let d = diagnose(b"G1", 500, 3);
        assert_eq!(d.column, 501);
        assert!(d.excerpt.caret <= 3);
    }
}
