//! A value and its partial derivatives by some variables.

use super::Number;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its partial derivatives by `D` variables, x, y and z if nothing else is said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gradient<T = f64, const D: usize = 3> {
    /// The value.
    pub value: T,
    /// By each of the variables.
    pub partial: [T; D],
}

impl<T: Number, const D: usize> Gradient<T, D> {
    /// The variables themselves, at a point.
    #[must_use]
    pub fn variables(point: [T; D]) -> [Self; D] {
        core::array::from_fn(|i| Self {
            value: point[i],
            partial: core::array::from_fn(|j| T::constant(if i == j { 1.0 } else { 0.0 })),
        })
    }

    /// A function of this number, from its value and slope there.
    fn through(self, value: T, slope: T) -> Self {
        Self {
            value,
            partial: self.partial.map(|p| p * slope),
        }
    }
}

impl<T: Number, const D: usize> Add for Gradient<T, D> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            partial: core::array::from_fn(|i| self.partial[i] + other.partial[i]),
        }
    }
}

impl<T: Number, const D: usize> Sub for Gradient<T, D> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            partial: core::array::from_fn(|i| self.partial[i] - other.partial[i]),
        }
    }
}

impl<T: Number, const D: usize> Neg for Gradient<T, D> {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            partial: self.partial.map(Neg::neg),
        }
    }
}

#[allow(
    clippy::suspicious_arithmetic_impl,
    reason = "the rules of differentiation mix operations"
)]
impl<T: Number, const D: usize> Mul for Gradient<T, D> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            partial: core::array::from_fn(|i| {
                self.partial[i] * other.value + self.value * other.partial[i]
            }),
        }
    }
}

#[allow(
    clippy::suspicious_arithmetic_impl,
    reason = "the rules of differentiation mix operations"
)]
impl<T: Number, const D: usize> Div for Gradient<T, D> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            partial: core::array::from_fn(|i| {
                (self.partial[i] - value * other.partial[i]) / other.value
            }),
        }
    }
}

impl<T: Number, const D: usize> Number for Gradient<T, D> {
    fn constant(value: f64) -> Self {
        Self {
            value: T::constant(value),
            partial: [T::constant(0.0); D],
        }
    }

    fn square(self) -> Self {
        self.through(self.value.square(), self.value.scale(2.0))
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, T::constant(0.5) / root)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.through(sin, cos), self.through(cos, -sin))
    }

    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.through(exp, exp)
    }

    fn ln(self) -> Self {
        self.through(self.value.ln(), T::constant(1.0) / self.value)
    }

    fn atan2(self, x: Self) -> Self {
        let norm = x.value.square() + self.value.square();
        let (by_y, by_x) = (x.value / norm, self.value / norm);
        Self {
            value: self.value.atan2(x.value),
            partial: core::array::from_fn(|i| self.partial[i] * by_y - x.partial[i] * by_x),
        }
    }

    fn nominal(self) -> f64 {
        self.value.nominal()
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.partial.into_iter().all(T::is_finite)
    }
}
