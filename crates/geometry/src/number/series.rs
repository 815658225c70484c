//! Truncated Taylor series: exact derivatives along one parameter.

use super::Number;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// The first `N` Taylor coefficients of a function of one parameter: `coefficient k` is the k-th
/// derivative divided by k!. `N` is at least 1.
///
/// Arithmetic uses the recurrences every power series obeys: products convolve, quotients, roots
/// and elementary functions solve their defining (differential) equation coefficient by
/// coefficient. Nothing is approximated, the result is the series of the result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Series<const N: usize, T = f64>([T; N]);

impl<const N: usize, T: Number> Series<N, T> {
    /// From Taylor coefficients.
    #[must_use]
    pub const fn new(coefficients: [T; N]) -> Self {
        Self(coefficients)
    }

    /// The Taylor coefficients.
    #[must_use]
    pub const fn coefficients(&self) -> &[T; N] {
        &self.0
    }

    /// The parameter itself, at `value`.
    #[must_use]
    pub fn variable(value: T) -> Self {
        Self(core::array::from_fn(|k| match k {
            0 => value,
            1 => T::constant(1.0),
            _ => T::constant(0.0),
        }))
    }

    /// From a value and its derivatives; those that are not given are zero.
    #[must_use]
    pub fn from_derivatives(derivatives: &[T]) -> Self {
        let mut reciprocal = 1.0;
        Self(core::array::from_fn(|k| {
            if k > 0 {
                reciprocal /= small(k);
            }
            derivatives
                .get(k)
                .map_or_else(|| T::constant(0.0), |d| d.scale(reciprocal))
        }))
    }

    /// The value.
    #[must_use]
    pub const fn value(&self) -> T {
        self.0[0]
    }

    /// The k-th derivative, zero from the `N`-th on.
    #[must_use]
    pub fn derivative(&self, k: usize) -> T {
        let factorial: f64 = (1..=k).map(small).product();
        self.0
            .get(k)
            .map_or_else(|| T::constant(0.0), |c| c.scale(factorial))
    }

    /// Coefficient by coefficient, each from those before it.
    fn build(mut next: impl FnMut(usize, &[T; N]) -> T) -> Self {
        let mut built = [T::constant(0.0); N];
        for k in 0..N {
            built[k] = next(k, &built);
        }
        Self(built)
    }

    /// Coefficient `k` of the series whose derivative is `rate · self′`, for k > 0.
    fn chain(&self, rate: &[T; N], k: usize) -> T {
        let mut sum = T::constant(0.0);
        for j in 1..=k {
            sum = sum + (self.0[j] * rate[k - j]).scale(small(j));
        }
        sum.scale(small(k).recip())
    }
}

/// A small index as a number.
#[allow(
    clippy::cast_precision_loss,
    reason = "an index of a handful of coefficients"
)]
const fn small(k: usize) -> f64 {
    k as f64
}

impl<const N: usize, T: Number> Add for Series<N, T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<const N: usize, T: Number> Sub for Series<N, T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<const N: usize, T: Number> Neg for Series<N, T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(Neg::neg))
    }
}

impl<const N: usize, T: Number> Mul for Series<N, T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| {
            let mut sum = self.0[0] * other.0[k];
            for j in 1..=k {
                sum = sum + self.0[j] * other.0[k - j];
            }
            sum
        }))
    }
}

impl<const N: usize, T: Number> Div for Series<N, T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::build(|k, built| {
            let mut rest = self.0[k];
            for (j, earlier) in built.iter().enumerate().take(k) {
                rest = rest - *earlier * other.0[k - j];
            }
            rest / other.0[0]
        })
    }
}

impl<const N: usize, T: Number> Number for Series<N, T> {
    fn constant(value: f64) -> Self {
        Self(core::array::from_fn(|k| {
            T::constant(if k == 0 { value } else { 0.0 })
        }))
    }

    fn scale(self, factor: f64) -> Self {
        Self(self.0.map(|c| c.scale(factor)))
    }

    fn square(self) -> Self {
        let mut product = self * self;
        product.0[0] = self.0[0].square();
        product
    }

    fn sqrt(self) -> Self {
        // r² = self, solved for the newest coefficient of r.
        let root = self.0[0].sqrt();
        let half = T::constant(0.5) / root;
        Self::build(|k, built| {
            if k == 0 {
                return root;
            }
            let mut rest = self.0[k];
            for j in 1..k {
                rest = rest - built[j] * built[k - j];
            }
            rest * half
        })
    }

    fn sin_cos(self) -> (Self, Self) {
        let mut sin = [T::constant(0.0); N];
        let mut cos = sin;
        (sin[0], cos[0]) = self.0[0].sin_cos();
        for k in 1..N {
            sin[k] = self.chain(&cos, k);
            cos[k] = -self.chain(&sin, k);
        }
        (Self(sin), Self(cos))
    }

    fn exp(self) -> Self {
        Self::build(|k, built| {
            if k == 0 {
                self.0[0].exp()
            } else {
                self.chain(built, k)
            }
        })
    }

    fn ln(self) -> Self {
        let rate = (Self::constant(1.0) / self).0;
        Self::build(|k, _| {
            if k == 0 {
                self.0[0].ln()
            } else {
                self.chain(&rate, k)
            }
        })
    }

    fn atan2(self, x: Self) -> Self {
        // θ′ = (x y′ − y x′) / (x² + y²)
        let scale = Self::constant(1.0) / (x.square() + self.square());
        let (by_y, by_x) = ((x * scale).0, (self * scale).0);
        Self::build(|k, _| {
            if k == 0 {
                self.0[0].atan2(x.0[0])
            } else {
                self.chain(&by_y, k) - x.chain(&by_x, k)
            }
        })
    }

    fn nominal(self) -> f64 {
        self.0[0].nominal()
    }

    fn is_finite(self) -> bool {
        self.0.into_iter().all(T::is_finite)
    }
}
