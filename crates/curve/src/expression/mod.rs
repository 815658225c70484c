//! Formulas as text, such as `20*(1 + cos(t))`.
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
//! A formula is evaluated over any [`Number`]: plain, with derivatives, over intervals. That,
//! places in error messages, and the usual meaning of `-x^2` are why this is not one of the
//! expression libraries on crates.io: `exmex`, the one that differentiates, lacks all three.

mod error;
mod parse;
mod tree;

pub use error::ExpressionError;

use glidepath_geometry::number::Number;
use tree::Node;

/// A formula that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression(Node);

impl Expression {
    /// Reads a formula in these variables.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, ExpressionError> {
        parse::parse(text, variables).map(Self)
    }

    /// The value for values of the variables, in the order in which they were named. Not finite
    /// where the formula is not defined.
    #[must_use]
    pub fn eval<T: Number>(&self, variables: &[T]) -> T {
        self.0.eval(variables)
    }
}
