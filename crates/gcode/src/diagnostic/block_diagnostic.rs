//! The diagnostic of a block: one that does not know its line yet.

use crate::diagnostic::Diagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::excerpt::excerpt;
use crate::diagnostic::span::SourceSpan;

/// A diagnostic that does not know its line yet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BlockDiagnostic {
    pub(crate) span: SourceSpan,
    pub(crate) code: DiagnosticCode,
    message: String,
    reason: String,
    help: String,
}

/// Result of everything that can find fault with a block. Boxed: the good case stays small.
pub(crate) type Outcome<T> = Result<T, Box<BlockDiagnostic>>;

impl BlockDiagnostic {
    pub(crate) fn new(
        code: DiagnosticCode,
        span: SourceSpan,
        message: impl Into<String>,
    ) -> Box<Self> {
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

    /// Puts what is to be tried first in front of the help.
    pub(crate) fn first_try(&mut self, first: &str) {
        self.help = match self.help.as_str() {
            "" => first.to_owned(),
            help => format!("{first}; else {help}"),
        };
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

impl Diagnostic {
    /// A diagnostic at some bytes of a text that is not G-code: a curve file.
    #[must_use]
    pub fn in_text(
        text: &str,
        at: core::ops::Range<usize>,
        code: DiagnosticCode,
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
        let fault = BlockDiagnostic {
            span: SourceSpan::new(start, end.max(start)),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::excerpt::{EXCERPT_CHARS, Excerpt};

    fn diagnose(text: &[u8], start: usize, length: usize) -> Diagnostic {
        BlockDiagnostic::new(
            DiagnosticCode::BadCharacter,
            SourceSpan { start, length },
            "bad",
        )
        .at(7, text)
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
    fn cuts_a_long_line_around_the_diagnostic() {
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
