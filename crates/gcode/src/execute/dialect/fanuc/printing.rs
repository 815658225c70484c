//! DPRNT, which prints variables, and SETVN, which names them.
//!
//! ```text
//! DPRNT[X#100[53]*Y#101[53]]    `*` is a blank, [53] five digits in front of the point and three behind
//! SETVN 510[DEPTH,WIDTH]        #510 is [#DEPTH], #511 [#WIDTH]
//! ```
//!
//! What is printed is a remark of the program; POPEN, PCLOS and BPRNT are read over.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::variables::is_common;
use crate::execute::parameters::place_of_name;
use crate::execute::program::Program;
use crate::execute::remark::MOST_REMARKS;
use crate::summary::remark::{Remark, RemarkKind};
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::Statement;
use crate::syntax::expression::scope::Parameter;
use crate::syntax::expression::vacant::or_zero;
use crate::syntax::expression::value::value;

/// Most digits on one side of the point.
const MOST_DIGITS: usize = 15;
/// Longest name of a variable, bytes.
const MOST_NAME: usize = 8;

impl<R: BufRead> Program<R> {
    /// DPRNT, SETVN, and what is for devices that are not here; `at` is behind the keyword.
    pub(super) fn fanuc_device(
        &mut self,
        statement: Statement,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        check_alone(text, at)?;
        match statement {
            Statement::Print => self.fanuc_print(text, at),
            Statement::Names => self.fanuc_names(text, at),
            _ => Ok(()),
        }
    }

    /// DPRNT, from its bracket on.
    fn fanuc_print(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let printed = self.printed(text, at)?;
        if self.keeps_remarks && self.remarks.len() < MOST_REMARKS {
            self.remarks.push(Remark {
                line: self.line_of_program(),
                kind: RemarkKind::Debug,
                text: printed,
            });
        }
        Ok(())
    }

    fn printed(&self, text: &[u8], at: usize) -> Outcome<String> {
        let scope = self.scope();
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        if cursor.next_visible() != Some(b'[') {
            return Err(not_closed(at, text.len()));
        }
        cursor.advance();
        let mut printed = String::new();
        loop {
            match cursor.peek() {
                None => return Err(not_closed(at, text.len())),
                Some(b']') => return Ok(printed),
                Some(b'*') => {
                    printed.push(' ');
                    cursor.advance();
                }
                Some(b'#') => {
                    let start = cursor.at();
                    let number = or_zero(value(&mut cursor, start, &scope)?);
                    let [before, behind] = digits(&mut cursor).ok_or_else(|| {
                        let span = SourceSpan::new(start, cursor.at().max(start + 1));
                        let message = "a variable without its digits";
                        BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                            .because("behind it stand two digits in brackets: how many are printed in front of the point, and behind it")
                            .help("write #100[53], for example")
                    })?;
                    printed.push_str(&formatted(number, before, behind));
                }
                Some(byte) => {
                    printed.push(char::from(byte));
                    cursor.advance();
                }
            }
        }
    }

    /// SETVN, from the number of the first variable on.
    fn fanuc_names(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let first = self.fanuc_number(text, at, false)?;
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        value(&mut cursor, at, &self.scope())?;
        let start = cursor.at();
        let rest = text.get(start..).unwrap_or_default();
        let open = rest.iter().position(|byte| *byte == b'[');
        let close = rest.iter().position(|byte| *byte == b']');
        let (Some(open), Some(close)) = (open, close) else {
            return Err(not_closed(start, text.len()));
        };
        let list = rest.get(open + 1..close).unwrap_or_default();
        let span = SourceSpan::new(start + open, start + close + 1);
        // None of them is given where one is refused.
        let mut given = Vec::new();
        for (number, name) in (first..).zip(list.split(|byte| *byte == b',')) {
            let name = name.trim_ascii();
            if name.is_empty() {
                continue;
            }
            let is_name = name.len() <= MOST_NAME
                && name[0].is_ascii_alphabetic()
                && name
                    .iter()
                    .all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
            if !is_name || !is_common(number) {
                let shown = String::from_utf8_lossy(name).into_owned();
                let message = format!("`{shown}` as a name of #{number}");
                return Err(BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                    .because("names begin with a letter, have 8 characters at most, and are of #100 to #199 and #500 to #999")
                    .help("write another name, or another variable"));
            }
            given.push((place_of_name(&String::from_utf8_lossy(name)), number));
        }
        for (place, number) in given {
            self.parameters
                .assign(&Parameter::Named(place), f64::from(number));
        }
        Ok(())
    }
}

/// The two digits in brackets behind a variable.
fn digits(cursor: &mut Cursor<'_>) -> Option<[usize; 2]> {
    let digit = |byte: u8| {
        byte.is_ascii_digit()
            .then(|| usize::from(byte - b'0'))
            .filter(|digit| *digit <= MOST_DIGITS)
    };
    match cursor.rest() {
        [b'[', before, behind, b']', ..] => {
            let found = [digit(*before)?, digit(*behind)?];
            cursor.seek(cursor.at() + 4);
            Some(found)
        }
        _ => None,
    }
}

/// A number with so many digits, blanks in the place of those in front that it does not have; without
/// a point where none is asked for behind it.
fn formatted(number: f64, before: usize, behind: usize) -> String {
    let sign = if number < 0.0 { '-' } else { ' ' };
    let digits = format!("{:.behind$}", number.abs());
    let width = before + if behind > 0 { behind + 1 } else { 0 };
    format!("{sign}{digits:>width$}")
}

#[cold]
fn not_closed(from: usize, to: usize) -> Box<BlockDiagnostic> {
    let span = SourceSpan::new(from, to.max(from + 1));
    BlockDiagnostic::new(
        DiagnosticCode::Expression,
        span,
        "the brackets are not complete",
    )
    .because("what is printed, and names of variables, stand in brackets")
    .help("write DPRNT[X#100[53]], or SETVN 510[NAME]")
}

/// Refuses what stands behind a statement for devices or names, which would be left out; `at` is behind its
/// keyword.
fn check_alone(text: &[u8], at: usize) -> Outcome<()> {
    let rest = text.get(at..).unwrap_or_default();
    let open = rest
        .iter()
        .position(|byte| !byte.is_ascii_whitespace() && !byte.is_ascii_digit())
        .filter(|open| rest[*open] == b'[');
    let mut depth = 0_u32;
    let closed = |byte: &u8| {
        match byte {
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0
    };
    let end = open.map_or(0, |open| {
        let length = rest[open..].iter().position(closed);
        length.map_or(rest.len(), |length| open + length + 1)
    });
    let behind = rest.get(end..).unwrap_or_default();
    match behind.iter().position(|byte| !byte.is_ascii_whitespace()) {
        Some(start) if !b"(;".contains(&behind[start]) => {
            let span = SourceSpan::new(at + end + start, text.len());
            Err(BlockDiagnostic::new(
                DiagnosticCode::FlowStructure,
                span,
                "text behind the statement",
            )
            .because("it has a line of its own, and what stands behind it would not be executed")
            .help("give it a line of its own"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits() {
        assert_eq!(formatted(-1.5, 3, 2), "-  1.50");
        assert_eq!(formatted(128.4736, 5, 3), "   128.474");
        assert_eq!(formatted(7.0, 2, 0), "  7");
    }
}
