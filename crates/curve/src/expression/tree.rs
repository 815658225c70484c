//! A formula as a tree, and its value.

use glidepath_geometry::number::Number;

/// Functions of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Log10,
    Sqrt,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Node {
    Constant(f64),
    /// By its place in the list of variables.
    Variable(usize),
    Negated(Box<Self>),
    Sum(Box<Self>, Box<Self>),
    Difference(Box<Self>, Box<Self>),
    Product(Box<Self>, Box<Self>),
    Quotient(Box<Self>, Box<Self>),
    /// With a whole exponent, which is defined for every base.
    WholePower(Box<Self>, i32),
    /// With any other exponent, for bases > 0.
    Power(Box<Self>, Box<Self>),
    Call(Function, Box<Self>),
    Atan2(Box<Self>, Box<Self>),
}

impl Node {
    pub(super) fn eval<T: Number>(&self, v: &[T]) -> T {
        match self {
            Self::Constant(value) => T::constant(*value),
            // Parsing made sure that there is one; a missing value is an undefined one.
            Self::Variable(i) => v.get(*i).copied().unwrap_or_else(|| T::constant(f64::NAN)),
            Self::Negated(a) => -a.eval(v),
            Self::Sum(a, b) => a.eval(v) + b.eval(v),
            Self::Difference(a, b) => a.eval(v) - b.eval(v),
            Self::Product(a, b) => match (a.as_ref(), b.as_ref()) {
                (Self::Constant(k), x) | (x, Self::Constant(k)) => x.eval(v).scale(*k),
                (a, b) => a.eval(v) * b.eval(v),
            },
            Self::Quotient(a, b) => a.eval(v) / b.eval(v),
            Self::WholePower(a, exponent) => a.eval(v).powi(*exponent),
            Self::Power(a, b) => (a.eval(v).ln() * b.eval(v)).exp(),
            Self::Call(function, a) => function.apply(a.eval(v)),
            Self::Atan2(y, x) => y.eval(v).atan2(x.eval(v)),
        }
    }

    /// The value if there are no variables in it.
    pub(super) fn constant(&self) -> Option<f64> {
        let is_constant = match self {
            Self::Constant(_) => true,
            Self::Variable(_) => false,
            Self::Negated(a) | Self::WholePower(a, _) | Self::Call(_, a) => a.constant().is_some(),
            Self::Sum(a, b)
            | Self::Difference(a, b)
            | Self::Product(a, b)
            | Self::Quotient(a, b)
            | Self::Power(a, b)
            | Self::Atan2(a, b) => a.constant().is_some() && b.constant().is_some(),
        };
        is_constant.then(|| self.eval::<f64>(&[]))
    }
}

impl Function {
    pub(super) const ALL: [(&'static str, Self); 13] = [
        ("sin", Self::Sin),
        ("cos", Self::Cos),
        ("tan", Self::Tan),
        ("asin", Self::Asin),
        ("acos", Self::Acos),
        ("atan", Self::Atan),
        ("sinh", Self::Sinh),
        ("cosh", Self::Cosh),
        ("tanh", Self::Tanh),
        ("exp", Self::Exp),
        ("ln", Self::Ln),
        ("log10", Self::Log10),
        ("sqrt", Self::Sqrt),
    ];

    pub(super) fn named(name: &str) -> Option<Self> {
        let found = Self::ALL.iter().find(|(known, _)| *known == name);
        found.map(|(_, function)| *function)
    }

    fn apply<T: Number>(self, x: T) -> T {
        let one = T::constant(1.0);
        match self {
            Self::Sin => x.sin_cos().0,
            Self::Cos => x.sin_cos().1,
            Self::Tan => {
                let (sin, cos) = x.sin_cos();
                sin / cos
            }
            Self::Asin => x.atan2((one - x.square()).sqrt()),
            Self::Acos => (one - x.square()).sqrt().atan2(x),
            Self::Atan => x.atan2(one),
            Self::Sinh => (x.exp() - (-x).exp()).scale(0.5),
            Self::Cosh => (x.exp() + (-x).exp()).scale(0.5),
            Self::Tanh => {
                let square = (x.scale(-2.0)).exp();
                (one - square) / (one + square)
            }
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Log10 => x.ln().scale(core::f64::consts::LOG10_E),
            Self::Sqrt => x.sqrt(),
        }
    }
}
