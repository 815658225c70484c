//! Intervals that hold every result of a formula.
//!
//! Bounds are rounded outwards: by one unit in the last place after the four operations and the
//! square root, which IEEE 754 rounds correctly, and by [`LIBRARY_ULPS`] after functions of the
//! mathematics library, whose documented error is below one. An operation that is not defined for
//! all arguments gives [`Interval::ENTIRE`], which no bound accepts.

use super::Number;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Allowance for the mathematics library, units in the last place.
const LIBRARY_ULPS: u32 = 4;

/// All numbers from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// Every number: nothing is known.
    pub const ENTIRE: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// All numbers between two, in any order; [`Interval::ENTIRE`] if one of them is not a number.
    #[must_use]
    pub fn new(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() {
            return Self::ENTIRE;
        }
        Self {
            low: a.min(b),
            high: a.max(b),
        }
    }

    /// Lower end.
    #[must_use]
    pub const fn low(&self) -> f64 {
        self.low
    }

    /// Upper end.
    #[must_use]
    pub const fn high(&self) -> f64 {
        self.high
    }

    /// High minus low, ≥ 0.
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.high - self.low).next_up()
    }

    /// Largest absolute value.
    #[must_use]
    pub fn magnitude(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Smallest absolute value.
    #[must_use]
    pub fn mignitude(&self) -> f64 {
        if self.contains(0.0) {
            0.0
        } else {
            self.low.abs().min(self.high.abs())
        }
    }

    /// Whether a number lies in it.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The smallest interval that holds both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Rounded outwards.
    fn outward(low: f64, high: f64, ulps: u32) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ENTIRE;
        }
        let (mut low, mut high) = (low, high);
        for _ in 0..ulps {
            (low, high) = (low.next_down(), high.next_up());
        }
        Self { low, high }
    }

    /// The values of a function that never decreases.
    fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        Self::outward(f(self.low), f(self.high), LIBRARY_ULPS)
    }

    /// Whether `at + 2πk` lies in it for a whole k, or might.
    fn meets(self, at: f64) -> bool {
        let slack = 1e-15 * self.magnitude().max(1.0);
        let first = ((self.low - slack - at) / TAU).ceil();
        at + first * TAU <= self.high + slack
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.low + other.low, self.high + other.high, 1)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.low - other.high, self.high - other.low, 1)
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

/// The extremes of four products or quotients of ends. Zero times infinity is zero: an infinite end
/// stands for arbitrarily large numbers.
fn extremes(products: [f64; 4]) -> Interval {
    let ends = products.map(|p| if p.is_nan() { 0.0 } else { p });
    let low = ends.into_iter().fold(f64::INFINITY, f64::min);
    let high = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
    Interval::outward(low, high, 1)
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        extremes([
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ])
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) || !self.is_finite() || !other.is_finite() {
            return Self::ENTIRE;
        }
        extremes([
            self.low / other.low,
            self.low / other.high,
            self.high / other.low,
            self.high / other.high,
        ])
    }
}

impl Number for Interval {
    fn constant(value: f64) -> Self {
        Self::new(value, value)
    }

    fn square(self) -> Self {
        let (low, high) = (self.mignitude(), self.magnitude());
        let square = Self::outward(low * low, high * high, 1);
        Self {
            low: square.low.max(0.0),
            ..square
        }
    }

    fn sqrt(self) -> Self {
        // Rounding may have pushed a bound just below zero; a real negative part is undefined.
        if self.low < -1e-15 * self.high.abs() || self.low.is_nan() {
            return Self::ENTIRE;
        }
        let root = Self::outward(self.low.max(0.0).sqrt(), self.high.max(0.0).sqrt(), 1);
        Self {
            low: root.low.max(0.0),
            ..root
        }
    }

    fn sin_cos(self) -> (Self, Self) {
        let all = Self::new(-1.0, 1.0);
        // Beyond, a unit in the last place of the angle is no longer small against a turn.
        if !self.is_finite() || self.magnitude() > 1e8 || self.width() >= TAU {
            return (all, all);
        }
        let ((sin_a, cos_a), (sin_b, cos_b)) = (self.low.sin_cos(), self.high.sin_cos());
        let between = |a: f64, b: f64, top: f64, bottom: f64| {
            let ends = Self::outward(a.min(b), a.max(b), LIBRARY_ULPS);
            Self {
                low: if self.meets(bottom) {
                    -1.0
                } else {
                    ends.low.max(-1.0)
                },
                high: if self.meets(top) {
                    1.0
                } else {
                    ends.high.min(1.0)
                },
            }
        };
        (
            between(sin_a, sin_b, FRAC_PI_2, -FRAC_PI_2),
            between(cos_a, cos_b, 0.0, PI),
        )
    }

    fn exp(self) -> Self {
        let exp = self.rising(f64::exp);
        Self {
            low: exp.low.max(0.0),
            ..exp
        }
    }

    fn ln(self) -> Self {
        if self.low > 0.0 {
            self.rising(f64::ln)
        } else {
            Self::ENTIRE
        }
    }

    fn atan2(self, x: Self) -> Self {
        if !self.is_finite() || !x.is_finite() {
            return Self::ENTIRE;
        }
        // The value jumps over the cut: no interval describes a continuous function there.
        if x.low <= 0.0 && self.contains(0.0) {
            return Self::ENTIRE;
        }
        // Away from the origin and the cut the extremes are at corners of the box.
        let corners = [
            self.low.atan2(x.low),
            self.low.atan2(x.high),
            self.high.atan2(x.low),
            self.high.atan2(x.high),
        ];
        let low = corners.into_iter().fold(f64::INFINITY, f64::min);
        let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::outward(low, high, LIBRARY_ULPS)
    }

    fn nominal(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }
}
