//! Operators and functions of expressions.

use crate::diagnostic::{Code, Fault, Outcome, Span};

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

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Abs,
    Acos,
    Asin,
    Atan,
    Cos,
    Exists,
    Exp,
    Fix,
    Fup,
    Ln,
    Round,
    Sin,
    Sqrt,
    Tan,
}

pub(crate) const FUNCTIONS: [(&[u8], Function); 14] = [
    (b"ABS", Function::Abs),
    (b"ACOS", Function::Acos),
    (b"ASIN", Function::Asin),
    (b"ATAN", Function::Atan),
    (b"COS", Function::Cos),
    (b"EXISTS", Function::Exists),
    (b"EXP", Function::Exp),
    (b"FIX", Function::Fix),
    (b"FUP", Function::Fup),
    (b"LN", Function::Ln),
    (b"ROUND", Function::Round),
    (b"SIN", Function::Sin),
    (b"SQRT", Function::Sqrt),
    (b"TAN", Function::Tan),
];

/// Value of an operation; its span is that of the operator and its right side.
pub(crate) fn apply(operator: Operator, left: f64, right: f64, span: Span) -> Outcome<f64> {
    let truth = |t: bool| f64::from(u8::from(t));
    let value = match operator {
        Operator::Power => left.powf(right),
        Operator::Times => left * right,
        Operator::Over | Operator::Modulo if right == 0.0 => {
            return Err(Fault::new(Code::Arithmetic, span, "a division by zero")
                .because("the value on the right of the operator is zero")
                .help("check the values it is computed from"));
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

/// Value of a function; `second` is the second argument of ATAN. EXISTS is not computed here.
pub(crate) fn evaluate(
    function: Function,
    x: f64,
    second: Option<f64>,
    span: Span,
) -> Outcome<f64> {
    let value = match function {
        Function::Abs => x.abs(),
        Function::Acos => x.acos().to_degrees(),
        Function::Asin => x.asin().to_degrees(),
        Function::Atan => x.atan2(second.unwrap_or(1.0)).to_degrees(),
        Function::Cos => x.to_radians().cos(),
        Function::Exists => x,
        Function::Exp => x.exp(),
        Function::Fix => x.floor(),
        Function::Fup => x.ceil(),
        Function::Ln => x.ln(),
        Function::Round => x.round(),
        Function::Sin => x.to_radians().sin(),
        Function::Sqrt => x.sqrt(),
        Function::Tan => x.to_radians().tan(),
    };
    finite(value, span)
}

fn finite(value: f64, span: Span) -> Outcome<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(
        Fault::new(Code::Arithmetic, span, "the result is not a number")
            .because("the operation has no value for these operands, or one that is too large")
            .help("check the values it is computed from"),
    )
}
