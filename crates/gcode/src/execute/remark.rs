//! The remarks of a program to people: `(MSG, …)`, `(DEBUG, …)`, `(PRINT, …)`, and the comment of a
//! stop.

use std::io::BufRead;

use crate::execute::parameters::DEBUG;
use crate::execute::program::Program;
use crate::summary::remark::{Remark, RemarkKind};
use crate::syntax::cursor::Cursor;
use crate::syntax::expression::scope::Scope;
use crate::syntax::expression::value::value;

/// Remarks that are kept until they are taken.
pub(crate) const MOST_REMARKS: usize = 256;

impl<R: BufRead> Program<R> {
    /// The same program, which keeps its remarks until they are taken.
    #[must_use]
    pub const fn with_remarks(mut self) -> Self {
        self.keeps_remarks = true;
        self
    }

    /// The remarks since this was asked last.
    pub fn take_remarks(&mut self) -> Vec<Remark> {
        core::mem::take(&mut self.remarks)
    }

    /// Keeps what the comment of the block says, if it says anything.
    pub(crate) fn remark(&mut self, number: u32) {
        if !self.keeps_remarks || self.remarks.len() >= MOST_REMARKS {
            return;
        }
        let comment = self.block.comment.trim_ascii();
        let after = |word: &[u8]| {
            let (head, rest) = comment.split_at_checked(word.len())?;
            head.eq_ignore_ascii_case(word).then(|| rest.trim_ascii())
        };
        let said = if let Some(text) = after(b"MSG,") {
            Some((RemarkKind::Message, text_of(text)))
        } else if after(b"DEBUG,").is_some() && self.parameters.numbered(DEBUG) == 0.0 {
            None
        } else if let Some(text) = after(b"DEBUG,").or_else(|| after(b"PRINT,")) {
            Some((RemarkKind::Debug, with_values(text, &self.scope())))
        } else if self.block.codes.stop.is_some() && !comment.is_empty() {
            Some((RemarkKind::Stop, text_of(comment)))
        } else {
            None
        };
        if let Some((kind, text)) = said {
            let line = number;
            self.remarks.push(Remark { line, kind, text });
        }
    }
}

fn text_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Bytes of the parameter that a text begins with, its sign included.
fn length_of(text: &[u8]) -> usize {
    let behind = text.get(1..).unwrap_or_default();
    if behind.first() == Some(&b'<') {
        let end = behind.iter().position(|byte| *byte == b'>');
        return end.map_or(1, |end| end + 2);
    }
    1 + behind
        .iter()
        .take_while(|byte| byte.is_ascii_digit())
        .count()
}

/// A text with the value of every parameter in its place; what is none stays as it is.
fn with_values(text: &[u8], scope: &dyn Scope) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.iter().position(|byte| *byte == b'#') {
        let (before, parameter) = rest.split_at(at);
        out.push_str(&text_of(before));
        let (name, behind) = parameter.split_at(length_of(parameter));
        match value(&mut Cursor::new(name), 0, scope) {
            Ok(value) => out.push_str(&format!("{value:.6}")),
            Err(_) => out.push_str(&text_of(name)),
        }
        rest = behind;
    }
    out.push_str(&text_of(rest));
    out
}
