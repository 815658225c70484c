//! Functions of expressions.

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::Dialect;
use crate::syntax::expression::finite::finite;
use crate::syntax::expression::vacant::or_zero;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Abs,
    Acos,
    Asin,
    Atan,
    /// BIN: the number that groups of four bits write as decimal digits.
    FromDecimal,
    /// BCD: the way back.
    ToDecimal,
    Cos,
    Exists,
    Exp,
    Fix,
    Fup,
    Ln,
    Pow,
    Round,
    /// Towards zero.
    Truncate,
    /// Away from zero.
    AwayFromZero,
    Same,
    Sin,
    Sqrt,
    Tan,
}

const FUNCTIONS: [(&[u8], Function); 14] = [
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

/// FANUC's functions, longer names before their beginnings.
const FANUC: [(&[u8], Function); 19] = [
    (b"ABS", Function::Abs),
    (b"ACOS", Function::Acos),
    (b"ADP", Function::Same),
    (b"ASIN", Function::Asin),
    (b"ATAN", Function::Atan),
    (b"BCD", Function::ToDecimal),
    (b"BIN", Function::FromDecimal),
    (b"COS", Function::Cos),
    (b"EXP", Function::Exp),
    (b"FIX", Function::Truncate),
    (b"FUP", Function::AwayFromZero),
    (b"LN", Function::Ln),
    (b"POW", Function::Pow),
    (b"ROUND", Function::Round),
    (b"RND", Function::Round),
    (b"SIN", Function::Sin),
    (b"SQRT", Function::Sqrt),
    (b"SQR", Function::Sqrt),
    (b"TAN", Function::Tan),
];

/// Value of a function; `second` is the second argument of ATAN and POW, and ROUND rounds to whole
/// `steps`. EXISTS is not computed here.
pub(crate) fn evaluate(
    function: Function,
    x: f64,
    second: Option<f64>,
    steps: f64,
    span: SourceSpan,
) -> Outcome<f64> {
    let (x, second) = (or_zero(x), second.map(or_zero));
    let value = match function {
        Function::Abs => x.abs(),
        Function::Acos => x.acos().to_degrees(),
        Function::Asin => x.asin().to_degrees(),
        Function::Atan => x.atan2(second.unwrap_or(1.0)).to_degrees(),
        Function::FromDecimal => in_base(x, 16, 10).unwrap_or(f64::NAN),
        Function::ToDecimal => in_base(x, 10, 16).unwrap_or(f64::NAN),
        Function::Cos => x.to_radians().cos(),
        Function::Exists => x,
        Function::Exp => x.exp(),
        Function::Fix => x.floor(),
        Function::Fup => x.ceil(),
        Function::Ln => x.ln(),
        Function::Pow => x.powf(second.unwrap_or(1.0)),
        Function::Round if steps < 1.0 => (x / steps).round() * steps,
        Function::Round => x.round(),
        Function::Truncate => x.trunc(),
        Function::AwayFromZero => x.abs().ceil().copysign(x),
        Function::Same => x,
        Function::Sin => x.to_radians().sin(),
        Function::Sqrt => x.sqrt(),
        Function::Tan => x.to_radians().tan(),
    };
    finite(value, span)
}

/// A whole number whose digits in one base are taken for digits of another one; `None` where they are
/// none there, or the number is none that such digits are of.
fn in_base(x: f64, of: u32, to: u32) -> Option<f64> {
    let whole = x.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&x);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    let (mut left, mut place, mut made) = whole.then_some((x as u32, 1.0, 0.0))?;
    while left > 0 {
        let digit = left % of;
        if digit >= to {
            return None;
        }
        made += f64::from(digit) * place;
        place *= f64::from(to);
        left /= of;
    }
    Some(made)
}

/// Skips a function name, if its bracket follows.
pub(crate) fn function(cursor: &mut Cursor<'_>, dialect: Dialect) -> Option<Function> {
    let functions: &[(&[u8], Function)] = match dialect {
        Dialect::Fanuc => &FANUC,
        _ => &FUNCTIONS,
    };
    functions.iter().find_map(|&(name, function)| {
        let mut ahead = *cursor;
        (ahead.eat_word(name) && ahead.next_visible() == Some(b'[')).then(|| {
            *cursor = ahead;
            function
        })
    })
}
