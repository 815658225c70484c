//! Operators and comparisons of SINUMERIK's expressions.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// Values that differ by less than this part of the greater are equal.
const EQUAL: f64 = 1e-12;

/// An operator of two values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Times,
    Over,
    Divide,
    Modulo,
    Plus,
    Minus,
    BitAnd,
    BitExclusiveOr,
    BitOr,
    And,
    ExclusiveOr,
    Or,
}

/// Operators by name, with their strength.
pub(super) const OPERATORS: [(&[u8], Operator, u8); 12] = [
    (b"*", Operator::Times, 8),
    (b"/", Operator::Over, 8),
    (b"DIV", Operator::Divide, 8),
    (b"MOD", Operator::Modulo, 8),
    (b"+", Operator::Plus, 7),
    (b"-", Operator::Minus, 7),
    (b"B_AND", Operator::BitAnd, 6),
    (b"B_XOR", Operator::BitExclusiveOr, 5),
    (b"B_OR", Operator::BitOr, 4),
    (b"AND", Operator::And, LOGIC),
    (b"XOR", Operator::ExclusiveOr, 2),
    (b"OR", Operator::Or, 1),
];

/// Operators of this strength and weaker ones are of truth values.
pub(super) const LOGIC: u8 = 3;

/// A comparison of two values.
pub(super) type Compare = fn(f64, f64) -> bool;

/// The comparison that two bytes write, and how many of them.
pub(super) fn comparison(first: u8, second: Option<u8>) -> Option<(Compare, usize)> {
    Some(match (first, second) {
        (b'=', Some(b'=')) => (equal, 2),
        (b'<', Some(b'>')) => (|a, b| !equal(a, b), 2),
        (b'<', Some(b'=')) => (|a, b| a < b || equal(a, b), 2),
        (b'>', Some(b'=')) => (|a, b| a > b || equal(a, b), 2),
        (b'<', _) => (|a, b| a < b && !equal(a, b), 1),
        (b'>', _) => (|a, b| a > b && !equal(a, b), 1),
        _ => return None,
    })
}

fn equal(a: f64, b: f64) -> bool {
    (a - b).abs() <= EQUAL * a.abs().max(b.abs())
}

pub(super) fn apply(operator: Operator, left: f64, right: f64, span: SourceSpan) -> Outcome<f64> {
    let truth = |t: bool| f64::from(u8::from(t));
    let (a, b) = (left != 0.0, right != 0.0);
    let value = match operator {
        Operator::Times => left * right,
        Operator::Over | Operator::Divide | Operator::Modulo if right == 0.0 => {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Arithmetic,
                span,
                "a division by zero",
            )
            .because("the value on the right of the operator is zero")
            .help("check the values it is computed from"));
        }
        Operator::Over => left / right,
        Operator::Divide => (left / right).trunc(),
        Operator::Modulo => left % right,
        Operator::Plus => left + right,
        Operator::Minus => left - right,
        Operator::BitAnd => f64::from(bits(left, span)? & bits(right, span)?),
        Operator::BitExclusiveOr => f64::from(bits(left, span)? ^ bits(right, span)?),
        Operator::BitOr => f64::from(bits(left, span)? | bits(right, span)?),
        Operator::And => truth(a && b),
        Operator::ExclusiveOr => truth(a != b),
        Operator::Or => truth(a || b),
    };
    finite(value, span)
}

/// The bits of a whole number, as the control keeps it.
pub(super) fn bits(value: f64, span: SourceSpan) -> Outcome<i32> {
    let is_kept = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value);
    if value.fract() != 0.0 || !is_kept {
        let message = format!("{value} has no bits");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::Arithmetic, span, message)
                .because("B_AND, B_OR, B_XOR and B_NOT are of whole numbers of 32 bits")
                .help("write TRUNC( ) or ROUND( ) around the value"),
        );
    }
    #[expect(clippy::cast_possible_truncation, reason = "range checked")]
    Ok(value as i32)
}

pub(super) fn finite(value: f64, span: SourceSpan) -> Outcome<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    let message = "the result is not a number";
    Err(
        BlockDiagnostic::new(DiagnosticCode::Arithmetic, span, message)
            .because("the operation has no value for these operands, or one that is too large")
            .help("check the values it is computed from"),
    )
}
