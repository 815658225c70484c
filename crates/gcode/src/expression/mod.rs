//! Values: numbers, parameters and bracketed expressions.
//!
//! ```text
//! value     = [sign] ( number | parameter | "[" expression "]" | function )
//! parameter = "#" ( value | "<" name ">" )
//! function  = NAME "[" expression "]" | "ATAN[" expression "]/[" expression "]"
//!           | "EXISTS[#<" name ">]"
//! ```
//!
//! Operators, strongest first, each level from the left: `**`; `*` `/` `MOD`; `+` `-`; `EQ` `NE`
//! `GT` `GE` `LT` `LE`; `AND` `OR` `XOR`. Angles are in degrees. A comparison gives 1 or 0, and
//! two values are equal if they differ by less than 1e-6. A result that is no finite number is an
//! error at the operator that made it.

use crate::cursor::Cursor;
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::operation::{FUNCTIONS, Function};
use reader::Reader;

mod reader;
#[cfg(test)]
mod tests;

/// Longest name of a parameter or subroutine, bytes.
pub(crate) const MAX_NAME: usize = 128;

/// Where the values of parameters come from.
pub(crate) trait Scope {
    /// Value of a numbered parameter; `None`: there is no such number.
    fn numbered(&self, number: u32) -> Option<f64>;
    /// Value of a named parameter; `None`: it has none.
    fn named(&self, name: &str) -> Option<f64>;
}

/// Which parameter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Parameter {
    Numbered(u32),
    Named(String),
}

/// Reads the value of the word whose letter is at `word`.
pub(crate) fn value(cursor: &mut Cursor<'_>, word: usize, scope: &dyn Scope) -> Outcome<f64> {
    if matches!(cursor.next_visible(), Some(b'0'..=b'9' | b'.')) {
        return cursor.number(word);
    }
    if !starts_computed(*cursor) {
        return cursor.number(word);
    }
    let start = cursor.at();
    let value = Reader {
        cursor,
        scope,
        depth: 0,
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
    }
    .level(1)?;
    in_range(value, start, cursor)
}

fn in_range(value: f64, start: usize, cursor: &Cursor<'_>) -> Outcome<f64> {
    if value.abs() > crate::MAX_NUMBER {
        let span = Span::new(start, cursor.end_of_word());
        let message = format!("the value is {value}, which is too large");
        return Err(Fault::new(Code::NumberOutOfRange, span, message)
            .because(format!(
                "no word or parameter takes a value beyond ±{}",
                crate::MAX_NUMBER
            ))
            .help("check the values it is computed from"));
    }
    Ok(value)
}

/// True if what comes next, a sign apart, is a parameter, a bracket or a function.
fn starts_computed(mut cursor: Cursor<'_>) -> bool {
    while matches!(cursor.next_visible(), Some(b'+' | b'-')) {
        cursor.advance();
    }
    match cursor.next_visible() {
        Some(b'#' | b'[') => true,
        Some(letter) if letter.is_ascii_alphabetic() => function(&mut cursor).is_some(),
        _ => false,
    }
}

/// Skips a function name, if its bracket follows.
fn function(cursor: &mut Cursor<'_>) -> Option<Function> {
    FUNCTIONS.into_iter().find_map(|(name, function)| {
        let mut ahead = *cursor;
        (ahead.eat_word(name) && ahead.next_visible() == Some(b'[')).then(|| {
            *cursor = ahead;
            function
        })
    })
}

/// Reads a parameter whose `#` comes next.
pub(crate) fn parameter(cursor: &mut Cursor<'_>, scope: &dyn Scope) -> Outcome<Parameter> {
    Reader {
        cursor,
        scope,
        depth: 0,
    }
    .parameter()
}

/// Reads a name whose `<` comes next: lower case, without blanks.
pub(crate) fn name(cursor: &mut Cursor<'_>) -> Outcome<String> {
    let start = cursor.at();
    cursor.advance();
    let mut name = String::new();
    loop {
        match cursor.next_visible() {
            Some(b'>') => {
                cursor.advance();
                return Ok(name);
            }
            Some(byte @ (b'!'..=b'~')) if byte != b'(' && name.len() < MAX_NAME => {
                name.push(char::from(byte.to_ascii_lowercase()));
                cursor.advance();
            }
            _ => {
                let span = Span::new(start, cursor.at());
                return Err(Fault::new(Code::Expression, span, "the name is not closed")
                    .because(format!(
                        "a name is ASCII text of up to {MAX_NAME} bytes in < >"
                    ))
                    .help("add `>`"));
            }
        }
    }
}

#[cold]
pub(crate) fn no_parameter(span: Span, number: f64) -> Box<Fault> {
    Fault::new(
        Code::Parameter,
        span,
        format!("there is no parameter #{number}"),
    )
    .because("parameters have the whole numbers from 1 to 5602")
    .help("use a number from 1 to 5000, or a name: #<name>")
}
