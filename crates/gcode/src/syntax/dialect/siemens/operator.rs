//! Operators and comparisons of SINUMERIK's expressions.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
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
    And,
    ExclusiveOr,
    Or,
}

/// Operators by name, with their strength.
pub(super) const OPERATORS: [(&[u8], Operator, u8); 9] = [
    (b"*", Operator::Times, 5),
    (b"/", Operator::Over, 5),
    (b"DIV", Operator::Divide, 5),
    (b"MOD", Operator::Modulo, 5),
    (b"+", Operator::Plus, 4),
    (b"-", Operator::Minus, 4),
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
            return Err(
                Fault::new(DiagnosticCode::Arithmetic, span, "a division by zero")
                    .because("the value on the right of the operator is zero")
                    .help("check the values it is computed from"),
            );
        }
        Operator::Over => left / right,
        Operator::Divide => (left / right).trunc(),
        Operator::Modulo => left % right,
        Operator::Plus => left + right,
        Operator::Minus => left - right,
        Operator::And => truth(a && b),
        Operator::ExclusiveOr => truth(a != b),
        Operator::Or => truth(a || b),
    };
    finite(value, span)
}

pub(super) fn finite(value: f64, span: SourceSpan) -> Outcome<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    let message = "the result is not a number";
    Err(Fault::new(DiagnosticCode::Arithmetic, span, message)
        .because("the operation has no value for these operands, or one that is too large")
        .help("check the values it is computed from"))
}
