//! A position in the text of one line: blanks and comments; numbers are in [`super::number`].
//!
//! RS274/NGC lets blanks stand anywhere outside comments, inside numbers too: `X 1 0 . 5` is
//! X10.5.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// Largest magnitude of a number in a program. Far beyond any machine, and small enough for sums
/// and products of a few of them to keep micrometres apart.
pub const MAX_NUMBER: f64 = 1e9;

/// Reads one line from left to right.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cursor<'a> {
    pub(super) text: &'a [u8],
    pub(super) at: usize,
    /// Between the arguments of a function a comma ends a number.
    pub(super) is_in_list: bool,
    /// E next to a number is a word, as on printers, whose programs may have no blanks.
    pub(super) has_e_words: bool,
}

impl<'a> Cursor<'a> {
    pub(crate) const fn new(text: &'a [u8]) -> Self {
        Self {
            text,
            at: 0,
            is_in_list: false,
            has_e_words: false,
        }
    }

    /// The same text, where E next to a number is a word.
    pub(crate) const fn with_e_words(mut self, has_e_words: bool) -> Self {
        self.has_e_words = has_e_words;
        self
    }

    /// Byte offset of what comes next.
    pub(crate) const fn at(&self) -> usize {
        self.at
    }

    /// The byte that comes next.
    pub(crate) fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    /// All that comes next.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Goes to a byte offset.
    pub(crate) const fn seek(&mut self, at: usize) {
        self.at = at;
    }

    /// Says whether commas stand between values; what was so before.
    pub(crate) const fn set_list(&mut self, is_in_list: bool) -> bool {
        core::mem::replace(&mut self.is_in_list, is_in_list)
    }

    pub(crate) const fn advance(&mut self) {
        self.at += 1;
    }

    /// Skips spaces and tabs, then tells what comes next.
    pub(crate) fn next_visible(&mut self) -> Option<u8> {
        loop {
            match self.peek() {
                Some(b' ' | b'\t') => self.at += 1,
                other => return other,
            }
        }
    }

    /// End of what was read last, blanks behind it left out.
    pub(crate) fn end_of_word(&self) -> usize {
        let before = self.text.get(..self.at).unwrap_or_default();
        self.at
            - before
                .iter()
                .rev()
                .take_while(|b| matches!(b, b' ' | b'\t'))
                .count()
    }

    /// Skips a word that comes next, in either case; false if it does not.
    pub(crate) fn eat_word(&mut self, word: &[u8]) -> bool {
        let next = self.text.get(self.at..self.at + word.len());
        let found = next.is_some_and(|next| next.eq_ignore_ascii_case(word));
        if found {
            self.at += word.len();
        }
        found
    }

    /// Skips a comment whose `(` comes next.
    pub(crate) fn skip_comment(&mut self) -> Outcome<()> {
        let start = self.at;
        for (offset, &byte) in self.text.iter().enumerate().skip(start + 1) {
            match byte {
                b')' => {
                    self.at = offset + 1;
                    return Ok(());
                }
                b'(' => {
                    let span = SourceSpan::new(offset, offset + 1);
                    return Err(BlockDiagnostic::new(
                        DiagnosticCode::NestedComment,
                        span,
                        "a comment in a comment",
                    )
                    .because("the first `)` would end the outer comment too early")
                    .help("use [ ] inside the comment, or a `;` comment"));
                }
                _ => {}
            }
        }
        let span = SourceSpan::new(start, self.text.len());
        Err(BlockDiagnostic::new(
            DiagnosticCode::UnclosedComment,
            span,
            "the comment is not closed",
        )
        .because("a `(` comment must end in its own line")
        .help("add `)`, or start the comment with `;`"))
    }

    /// The bytes of the span, as text for a message.
    pub(crate) fn quote(&self, span: SourceSpan) -> String {
        let bytes = self
            .text
            .get(span.start..span.start + span.length)
            .unwrap_or_default();
        String::from_utf8_lossy(bytes).into_owned()
    }
}
