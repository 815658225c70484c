//! The values of a word, of an assignment and of a condition, as they are read.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::cursor::{Cursor, MAX_NUMBER};
use crate::syntax::dialect::Dialect;
use crate::syntax::expression::function::function;
use crate::syntax::expression::reader::Reader;
use crate::syntax::expression::scope::{Parameter, Scope};

/// Reads the value of the word whose letter is at `word`.
pub(crate) fn value(cursor: &mut Cursor<'_>, word: usize, scope: &dyn Scope) -> Outcome<f64> {
    word_value(cursor, word, false, scope)
}

/// As [`value`], of a word that may be a length: ROUND then rounds to the least increment.
pub(crate) fn word_value(
    cursor: &mut Cursor<'_>,
    word: usize,
    is_length: bool,
    scope: &dyn Scope,
) -> Outcome<f64> {
    if matches!(cursor.next_visible(), Some(b'0'..=b'9' | b'.')) {
        return cursor.number(word);
    }
    if !starts_computed(*cursor, scope.dialect()) {
        return cursor.number(word);
    }
    let start = cursor.at();
    let value = Reader {
        cursor,
        scope,
        depth: 0,
        rounds_to: if is_length {
            scope.least_increment()
        } else {
            1.0
        },
    }
    .primary(word)?;
    in_range(value, start, cursor)
}

/// Reads an expression without brackets around it.
pub(crate) fn open_expression(cursor: &mut Cursor<'_>, scope: &dyn Scope) -> Outcome<f64> {
    cursor.next_visible();
    let start = cursor.at();
    let value = Reader {
        cursor,
        scope,
        depth: 0,
        rounds_to: 1.0,
    }
    .level(1)?;
    in_range(value, start, cursor)
}

fn in_range(value: f64, start: usize, cursor: &Cursor<'_>) -> Outcome<f64> {
    if value.abs() > MAX_NUMBER {
        let span = SourceSpan::new(start, cursor.end_of_word());
        let message = format!("the value is {value}, which is too large");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::NumberOutOfRange, span, message)
                .because(format!(
                    "no word or parameter takes a value beyond ±{}",
                    MAX_NUMBER
                ))
                .help("check the values it is computed from"),
        );
    }
    Ok(value)
}

/// True if what comes next, a sign apart, is a parameter, a bracket or a function.
fn starts_computed(mut cursor: Cursor<'_>, dialect: Dialect) -> bool {
    while matches!(cursor.next_visible(), Some(b'+' | b'-')) {
        cursor.advance();
    }
    match cursor.next_visible() {
        Some(b'#' | b'[') => true,
        Some(letter) if letter.is_ascii_alphabetic() => function(&mut cursor, dialect).is_some(),
        _ => false,
    }
}

/// Reads a parameter whose `#` comes next.
pub(crate) fn parameter(cursor: &mut Cursor<'_>, scope: &dyn Scope) -> Outcome<Parameter> {
    Reader {
        cursor,
        scope,
        depth: 0,
        rounds_to: 1.0,
    }
    .parameter()
}
