//! Formulas as text: `20*(1 + cos(t))`.
//!
//! ```text
//!   sum      =  product { (+|-) product }
//!   product  =  signed { (*|/) signed }
//!   signed   =  (+|-) signed | power
//!   power    =  atom [ ^ signed ]             -x^2 is -(x^2), 2^-x is allowed, 2^3^2 is 2^9
//!   atom     =  number | variable | constant | function ( sum {, sum} ) | ( sum )
//! ```
//!
//! Angles are in radians. Constants: `pi`, `tau`, `e`. Functions: `sin cos tan asin acos atan atan2
//! sinh cosh tanh exp ln log10 sqrt`. There is nothing in the language that is not smooth (`abs`,
//! `min`, `floor`, …), because every curve's derivatives are needed.
//!
//! A formula is evaluated over any [`Number`]: plain, with derivatives, over intervals. That, places in
//! error messages, and the usual meaning of `-x^2` are why this is not one of the expression libraries
//! on crates.io: `exmex`, the one that differentiates, lacks all three.

mod parse;

use core::ops::Range;
use glidepath_geometry::number::Number;
use thiserror::Error;

/// What is wrong with a formula.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: String,
    /// Where, in bytes of the text.
    pub at: Range<usize>,
}

/// A formula that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression(Node);

/// Functions of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Function {
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
enum Node {
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

impl Expression {
    /// Reads a formula in these variables.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, ExpressionError> {
        parse::parse(text, variables).map(Self)
    }

    /// The value for values of the variables, in the order in which they were named. Not finite where
    /// the formula is not defined.
    #[must_use]
    pub fn eval<T: Number>(&self, variables: &[T]) -> T {
        self.0.eval(variables)
    }
}

impl Node {
    fn eval<T: Number>(&self, v: &[T]) -> T {
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
    fn constant(&self) -> Option<f64> {
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
    const ALL: [(&'static str, Self); 13] = [
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

    fn named(name: &str) -> Option<Self> {
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
