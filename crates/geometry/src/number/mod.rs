//! Numbers that carry more than a value: derivatives or an enclosure.
//!
//! A formula that is written once for any [`Number`] can be evaluated as
//!
//! | number | gives |
//! |---|---|
//! | `f64` | the value |
//! | [`Series`] | the value and its derivatives along one parameter, exact to rounding |
//! | [`Gradient`] | the value and its partial derivatives by some variables |
//! | [`Interval`] | an interval that holds every value for arguments in intervals |
//!
//! and as any of the first three over the others: a [`Series`] of [`Interval`]s encloses
//! derivatives over a whole range of the parameter, which is what makes an error bound a proof.

mod gradient;
mod interval;
mod series;

pub use gradient::Gradient;
pub use interval::Interval;
pub use series::Series;

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Arithmetic and the smooth elementary functions. Where a function is not defined the result is
/// not finite ([`Number::is_finite`]), never a panic.
pub trait Number:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A number that does not depend on anything.
    fn constant(value: f64) -> Self;

    /// Product with a constant.
    #[must_use]
    fn scale(self, factor: f64) -> Self {
        self * Self::constant(factor)
    }

    /// Square; an interval's is never negative.
    #[must_use]
    fn square(self) -> Self {
        self * self
    }

    /// Square root of a number > 0; of 0 only the value is defined.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle in radians.
    #[must_use]
    fn sin_cos(self) -> (Self, Self);

    /// Exponential function.
    #[must_use]
    fn exp(self) -> Self;

    /// Natural logarithm of a number > 0.
    #[must_use]
    fn ln(self) -> Self;

    /// Angle of the point (`x`, `self`) in radians, -π to π; not defined at the origin. Derivatives
    /// are continuous where the value jumps.
    #[must_use]
    fn atan2(self, x: Self) -> Self;

    /// The number itself, without what comes with it; of an interval the middle. For what has no
    /// derivative: which branch of a function is meant.
    fn nominal(self) -> f64;

    /// Whether the value and everything that comes with it is finite.
    fn is_finite(self) -> bool;

    /// A power with a whole exponent.
    #[must_use]
    fn powi(self, exponent: i32) -> Self {
        let mut product = Self::constant(1.0);
        let (mut base, mut left) = (self, exponent.unsigned_abs());
        while left > 0 {
            if left % 2 == 1 {
                product = product * base;
            }
            left /= 2;
            if left > 0 {
                base = base.square();
            }
        }
        if exponent < 0 {
            Self::constant(1.0) / product
        } else {
            product
        }
    }
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn scale(self, factor: f64) -> Self {
        self * factor
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }

    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }

    fn exp(self) -> Self {
        self.exp()
    }

    fn ln(self) -> Self {
        self.ln()
    }

    fn atan2(self, x: Self) -> Self {
        self.atan2(x)
    }

    fn nominal(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }
}
