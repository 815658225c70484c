//! Operators of expressions.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::Dialect;
use crate::syntax::expression::finite::finite;
use crate::syntax::expression::vacant::{is_vacant, or_zero};

/// Differences below this are equality to LinuxCNC's EQ and NE.
const EQUAL: f64 = 1e-4;
/// The same on a FANUC: of computed values less is rounding.
const SAME: f64 = 1e-6;

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
    /// FANUC's: of whole numbers, bit by bit.
    BitAnd,
    BitOr,
    BitXor,
    /// FANUC's: of whole numbers, with the sign of the first.
    Remainder,
    /// FANUC's: what nothing was assigned to is not zero.
    Same,
    Differs,
}

/// The strength of comparisons.
pub(crate) const COMPARISON: u8 = 2;

/// Operators by name, longer names before their beginnings, with their strength.
const OPERATORS: [(&[u8], Operator, u8); 15] = [
    (b"**", Operator::Power, 5),
    (b"*", Operator::Times, 4),
    (b"/", Operator::Over, 4),
    (b"MOD", Operator::Modulo, 4),
    (b"+", Operator::Plus, 3),
    (b"-", Operator::Minus, 3),
    (b"EQ", Operator::Equal, COMPARISON),
    (b"NE", Operator::NotEqual, COMPARISON),
    (b"GT", Operator::Greater, COMPARISON),
    (b"GE", Operator::GreaterOrEqual, COMPARISON),
    (b"LT", Operator::Less, COMPARISON),
    (b"LE", Operator::LessOrEqual, COMPARISON),
    (b"AND", Operator::And, 1),
    (b"OR", Operator::Or, 1),
    (b"XOR", Operator::Xor, 1),
];

/// FANUC's operators.
const FANUC: [(&[u8], Operator, u8); 14] = [
    (b"*", Operator::Times, 4),
    (b"/", Operator::Over, 4),
    (b"MOD", Operator::Remainder, 4),
    (b"AND", Operator::BitAnd, 4),
    (b"+", Operator::Plus, 3),
    (b"-", Operator::Minus, 3),
    (b"XOR", Operator::BitXor, 3),
    (b"OR", Operator::BitOr, 3),
    (b"EQ", Operator::Same, COMPARISON),
    (b"NE", Operator::Differs, COMPARISON),
    (b"GT", Operator::Greater, COMPARISON),
    (b"GE", Operator::GreaterOrEqual, COMPARISON),
    (b"LT", Operator::Less, COMPARISON),
    (b"LE", Operator::LessOrEqual, COMPARISON),
];

/// The operators of a dialect, by name, longer names before their beginnings, with their strength.
pub(crate) const fn operators(dialect: Dialect) -> &'static [(&'static [u8], Operator, u8)] {
    match dialect {
        Dialect::Fanuc => &FANUC,
        _ => &OPERATORS,
    }
}

/// Largest whole number of FANUC's operations on bits.
const MOST_BITS: f64 = 2_147_483_647.0;

/// The bits of a number.
fn bits(value: f64, span: SourceSpan) -> Outcome<i64> {
    let nearest = value.round();
    if nearest.abs() > MOST_BITS {
        let message = format!("{value} has too many bits");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::Arithmetic, span, message)
                .because("AND, OR and XOR are of whole numbers with 31 bits")
                .help("check the values it is computed from"),
        );
    }
    #[expect(clippy::cast_possible_truncation, reason = "range checked")]
    Ok(nearest as i64)
}

#[expect(clippy::cast_precision_loss, reason = "32 bits")]
fn bitwise(left: f64, right: f64, span: SourceSpan, of: impl Fn(i64, i64) -> i64) -> Outcome<f64> {
    Ok(of(bits(left, span)?, bits(right, span)?) as f64)
}

/// Value of an operation; its span is that of the operator and its right side.
pub(crate) fn apply(operator: Operator, left: f64, right: f64, span: SourceSpan) -> Outcome<f64> {
    let truth = |t: bool| f64::from(u8::from(t));
    let is_same =
        is_vacant(left) == is_vacant(right) && (or_zero(left) - or_zero(right)).abs() < SAME;
    let (left, right) = (or_zero(left), or_zero(right));
    let value = match operator {
        Operator::Same => truth(is_same),
        Operator::Differs => truth(!is_same),
        Operator::BitAnd => bitwise(left, right, span, |a, b| a & b)?,
        Operator::BitOr => bitwise(left, right, span, |a, b| a | b)?,
        Operator::BitXor => bitwise(left, right, span, |a, b| a ^ b)?,
        Operator::Power => left.powf(right),
        Operator::Times => left * right,
        Operator::Over | Operator::Modulo | Operator::Remainder
            if right == 0.0 || operator == Operator::Remainder && right.round() == 0.0 =>
        {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Arithmetic,
                span,
                "a division by zero",
            )
            .because("the value on the right of the operator is zero")
            .help("check the values it is computed from"));
        }
        Operator::Over => left / right,
        Operator::Modulo => left.rem_euclid(right),
        Operator::Remainder => left.round() % right.round(),
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
