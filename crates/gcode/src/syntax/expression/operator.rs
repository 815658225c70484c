//! Operators of expressions.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::expression::finite::finite;

/// Differences below this are equality.
const EQUAL: f64 = 1e-6;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Operator {
    Power,
    Times,
    Over,
    Modulo,
    Plus,
    Minus,
    Equal,
    NotEqual,
    Greater,
    GreaterOrEqual,
    Less,
    LessOrEqual,
    And,
    Or,
    Xor,
}

/// Operators by name, longer names before their beginnings, with their strength.
pub(crate) const OPERATORS: [(&[u8], Operator, u8); 15] = [
    (b"**", Operator::Power, 5),
    (b"*", Operator::Times, 4),
    (b"/", Operator::Over, 4),
    (b"MOD", Operator::Modulo, 4),
    (b"+", Operator::Plus, 3),
    (b"-", Operator::Minus, 3),
    (b"EQ", Operator::Equal, 2),
    (b"NE", Operator::NotEqual, 2),
    (b"GT", Operator::Greater, 2),
    (b"GE", Operator::GreaterOrEqual, 2),
    (b"LT", Operator::Less, 2),
    (b"LE", Operator::LessOrEqual, 2),
    (b"AND", Operator::And, 1),
    (b"OR", Operator::Or, 1),
    (b"XOR", Operator::Xor, 1),
];

/// Value of an operation; its span is that of the operator and its right side.
pub(crate) fn apply(operator: Operator, left: f64, right: f64, span: SourceSpan) -> Outcome<f64> {
    let truth = |t: bool| f64::from(u8::from(t));
    let value = match operator {
        Operator::Power => left.powf(right),
        Operator::Times => left * right,
        Operator::Over | Operator::Modulo if right == 0.0 => {
            return Err(
                Fault::new(DiagnosticCode::Arithmetic, span, "a division by zero")
                    .because("the value on the right of the operator is zero")
                    .help("check the values it is computed from"),
            );
        }
        Operator::Over => left / right,
        Operator::Modulo => left.rem_euclid(right),
        Operator::Plus => left + right,
        Operator::Minus => left - right,
        Operator::Equal => truth((left - right).abs() < EQUAL),
        Operator::NotEqual => truth((left - right).abs() >= EQUAL),
        Operator::Greater => truth(left > right),
        Operator::GreaterOrEqual => truth(left >= right),
        Operator::Less => truth(left < right),
        Operator::LessOrEqual => truth(left <= right),
        Operator::And => truth(left != 0.0 && right != 0.0),
        Operator::Or => truth(left != 0.0 || right != 0.0),
        Operator::Xor => truth((left != 0.0) != (right != 0.0)),
    };
    finite(value, span)
}
