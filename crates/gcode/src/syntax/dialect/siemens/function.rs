//! Functions of SINUMERIK's expressions.

/// A function of expressions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan2,
    Sqrt,
    Abs,
    Square,
    Truncate,
    Round,
    RoundUp,
    Ln,
    Exp,
    Least,
    Greatest,
    Bound,
}

/// Functions by name, and how many arguments each takes.
pub(super) const FUNCTIONS: [(&[u8], Function, usize); 17] = [
    (b"SIN", Function::Sin, 1),
    (b"COS", Function::Cos, 1),
    (b"TAN", Function::Tan, 1),
    (b"ASIN", Function::Asin, 1),
    (b"ACOS", Function::Acos, 1),
    (b"ATAN2", Function::Atan2, 2),
    (b"SQRT", Function::Sqrt, 1),
    (b"ABS", Function::Abs, 1),
    (b"POT", Function::Square, 1),
    (b"TRUNC", Function::Truncate, 1),
    (b"ROUND", Function::Round, 1),
    (b"ROUNDUP", Function::RoundUp, 1),
    (b"LN", Function::Ln, 1),
    (b"EXP", Function::Exp, 1),
    (b"MINVAL", Function::Least, 2),
    (b"MAXVAL", Function::Greatest, 2),
    (b"BOUND", Function::Bound, 3),
];

impl Function {
    /// Its value, which may be none; angles are in degrees.
    pub(super) fn of(self, arguments: &[f64]) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|i| arguments.get(i).copied().unwrap_or(0.0));
        match self {
            Self::Sin => x.to_radians().sin(),
            Self::Cos => x.to_radians().cos(),
            Self::Tan => x.to_radians().tan(),
            Self::Asin => x.asin().to_degrees(),
            Self::Acos => x.acos().to_degrees(),
            Self::Atan2 => x.atan2(y).to_degrees(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            Self::Square => x * x,
            Self::Truncate => x.trunc(),
            Self::Round => x.round(),
            Self::RoundUp => x.ceil(),
            Self::Ln => x.ln(),
            Self::Exp => x.exp(),
            Self::Least => x.min(y),
            Self::Greatest => x.max(y),
            // Least, greatest, value.
            Self::Bound => z.max(x).min(y),
        }
    }
}
