//! Polynomials in Bernstein form on [0, 1] with a degree known only at run time, and their roots.
//!
//! Roots are isolated by the variations of sign of the coefficients: a polynomial has at most as
//! many roots in (0, 1) as its coefficients change sign, and exactly one if they change once.
//! Halving the interval brings every simple root into a part of the second kind. Nothing is
//! missed: the count is never below the number of roots.

use core::ops::{Add, Mul};

/// Highest degree that occurs: 11·7 − 17, critical curvature of a space curve of degree 7.
pub(super) const HIGHEST: usize = 60;

const ROWS: usize = HIGHEST + 1;

/// Halvings after which what is left of an interval counts as one root.
const MAX_HALVINGS: u32 = 44;

/// Binomial coefficients, exact as far as 53 bits go.
static BINOMIAL: [[f64; ROWS]; ROWS] = binomials();

#[allow(clippy::large_stack_arrays, reason = "computed at compile time")]
const fn binomials() -> [[f64; ROWS]; ROWS] {
    let mut rows = [[0.0; ROWS]; ROWS];
    let mut n = 0;
    while n < ROWS {
        rows[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    rows
}

/// n over k, for n up to [`HIGHEST`].
pub(super) fn binomial(n: usize, k: usize) -> f64 {
    BINOMIAL[n][k]
}

/// A polynomial Σ cᵢ·C(n,i)·tⁱ(1−t)ⁿ⁻ⁱ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Polynomial {
    degree: usize,
    coefficients: [f64; ROWS],
}

impl Polynomial {
    /// The polynomial of a degree with the coefficients a function gives.
    pub(super) fn from_fn(degree: usize, coefficient: impl Fn(usize) -> f64) -> Self {
        let mut coefficients = [0.0; ROWS];
        for (i, slot) in coefficients.iter_mut().enumerate().take(degree + 1) {
            *slot = coefficient(i);
        }
        Self {
            degree,
            coefficients,
        }
    }

    pub(super) const fn degree(&self) -> usize {
        self.degree
    }

    pub(super) fn coefficients(&self) -> &[f64] {
        &self.coefficients[..=self.degree]
    }

    pub(super) fn max(&self) -> f64 {
        self.coefficients().iter().copied().fold(f64::MIN, f64::max)
    }

    pub(super) fn min(&self) -> f64 {
        self.coefficients().iter().copied().fold(f64::MAX, f64::min)
    }

    pub(super) fn max_abs(&self) -> f64 {
        self.coefficients()
            .iter()
            .fold(0.0, |largest: f64, c| largest.max(c.abs()))
    }

    /// The derivative by t; of a constant, zero of degree 0.
    pub(super) fn derivative(&self) -> Self {
        if self.degree == 0 {
            return Self::from_fn(0, |_| 0.0);
        }
        let n = self.degree as f64;
        Self::from_fn(self.degree - 1, |i| {
            n * (self.coefficients[i + 1] - self.coefficients[i])
        })
    }

    /// Times a number.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        self.coefficients.iter_mut().for_each(|c| *c *= factor);
        self
    }

    /// The same polynomial written with a degree at least as high.
    pub(super) fn raised(self, degree: usize) -> Self {
        match degree.saturating_sub(self.degree) {
            0 => self,
            by => self * Self::from_fn(by, |_| 1.0),
        }
    }

    /// Value at t.
    pub(super) fn at(&self, t: f64) -> f64 {
        let (n, s) = (self.degree, 1.0 - t);
        if n == 0 {
            return self.coefficients[0];
        }
        let row = &BINOMIAL[n];
        let mut power = 1.0;
        let mut sum = self.coefficients[0] * s;
        for (c, binomial) in self.coefficients[1..n].iter().zip(&row[1..n]) {
            power *= t;
            sum = (sum + power * binomial * c) * s;
        }
        sum + power * t * self.coefficients[n]
    }

    fn halves(&self) -> (Self, Self) {
        let (mut left, mut right) = (*self, *self);
        let n = self.degree;
        for level in 0..=n {
            left.coefficients[level] = right.coefficients[0];
            for i in 0..n - level {
                right.coefficients[i] = 0.5 * (right.coefficients[i] + right.coefficients[i + 1]);
            }
        }
        (left, right)
    }

    fn sign_variations(&self) -> usize {
        let mut signs = self.coefficients().iter().filter(|c| **c != 0.0);
        let Some(mut last) = signs.next() else {
            return 0;
        };
        let mut count = 0;
        for c in signs {
            if (*c > 0.0) != (*last > 0.0) {
                count += 1;
            }
            last = c;
        }
        count
    }

    /// Gives every root in (0, 1), ascending; a root of even multiplicity may come out as none,
    /// one or two points, all within 1e-12 of it. Points that are no roots never matter to the
    /// callers.
    pub(super) fn roots(&self, found: &mut impl FnMut(f64)) {
        self.roots_between(0.0, 1.0, MAX_HALVINGS, found);
    }

    fn roots_between(&self, from: f64, to: f64, halvings: u32, found: &mut impl FnMut(f64)) {
        match self.sign_variations() {
            0 => {}
            1 => found(from + (to - from) * self.single_root()),
            _ if halvings == 0 => found(0.5 * (from + to)),
            _ => {
                let (left, right) = self.halves();
                let middle = 0.5 * (from + to);
                left.roots_between(from, middle, halvings - 1, found);
                // A root on the very middle is none of either half.
                if right.coefficients[0] == 0.0 {
                    found(middle);
                }
                right.roots_between(middle, to, halvings - 1, found);
            }
        }
    }

    /// The root of a polynomial with one variation of sign: false position with halved stale ends
    /// (Illinois), and bisection wherever that does not at least halve the bracket in three steps.
    fn single_root(&self) -> f64 {
        let first = self.coefficients().iter().find(|c| **c != 0.0);
        let rising = first.is_some_and(|c| *c < 0.0);
        let (mut a, mut b) = (0.0_f64, 1.0_f64);
        let (mut fa, mut fb) = (self.coefficients[0], self.coefficients[self.degree]);
        let mut checkpoint = 2.0;
        let mut moved_b = None;
        for step in 0..80 {
            if b - a <= f64::EPSILON * b {
                break;
            }
            let mut t = (a * fb - b * fa) / (fb - fa);
            if step % 3 == 0 {
                if b - a > 0.5 * checkpoint || fa == 0.0 || fb == 0.0 {
                    t = f64::NAN;
                }
                checkpoint = b - a;
            }
            if !(t > a && t < b) {
                t = 0.5 * (a + b);
            }
            let f = self.at(t);
            if f == 0.0 {
                return t;
            }
            if (f > 0.0) == rising {
                (b, fb) = (t, f);
                if moved_b == Some(true) {
                    fa *= 0.5;
                }
                moved_b = Some(true);
            } else {
                (a, fa) = (t, f);
                if moved_b == Some(false) {
                    fb *= 0.5;
                }
                moved_b = Some(false);
            }
        }
        0.5 * (a + b)
    }
}

impl Mul for Polynomial {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (m, n) = (self.degree, other.degree);
        let (rows, columns) = (&BINOMIAL[m], &BINOMIAL[n]);
        let mut product = Self::from_fn(m + n, |_| 0.0);
        for (i, a) in self.coefficients().iter().enumerate() {
            let a = a * rows[i];
            for (j, b) in other.coefficients().iter().enumerate() {
                product.coefficients[i + j] += a * (b * columns[j]);
            }
        }
        for (k, c) in product.coefficients.iter_mut().enumerate().take(m + n + 1) {
            *c /= BINOMIAL[m + n][k];
        }
        product
    }
}

/// Both must have the same degree; see [`Polynomial::raised`].
impl Add for Polynomial {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        debug_assert_eq!(self.degree, other.degree);
        for (a, b) in self.coefficients.iter_mut().zip(other.coefficients) {
            *a += b;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Π (t − root), linear factors multiplied.
    fn with_roots(roots: &[f64]) -> Polynomial {
        roots
            .iter()
            .fold(Polynomial::from_fn(0, |_| 1.0), |product, root| {
                product * Polynomial::from_fn(1, |i| i as f64 - root)
            })
    }

    fn roots_of(polynomial: &Polynomial) -> Vec<f64> {
        let mut found = Vec::new();
        polynomial.roots(&mut |t| found.push(t));
        found
    }

    #[test]
    fn every_root_inside_is_found() {
        let inside = [0.05, 0.25, 0.2501, 0.5, 0.75, 0.999];
        let mut all = inside.to_vec();
        all.extend([-0.3, 1.2, 2.0]);
        let found = roots_of(&with_roots(&all));
        assert_eq!(found.len(), inside.len(), "{found:?}");
        for (found, root) in found.iter().zip(inside) {
            assert!((found - root).abs() < 1e-8, "{found} for {root}");
        }
    }

    #[test]
    fn a_triple_root_is_found_and_a_constant_has_none() {
        let found = roots_of(&with_roots(&[0.3, 0.3, 0.3]));
        assert!(!found.is_empty());
        assert!(found.iter().all(|t| (t - 0.3).abs() < 1e-4), "{found:?}");
        assert!(roots_of(&with_roots(&[])).is_empty());
        assert!(roots_of(&Polynomial::from_fn(9, |_| 0.0)).is_empty());
    }

    #[test]
    fn value_derivative_and_degree_raised_agree() {
        let p = with_roots(&[0.2, 0.4, -1.0]);
        for t in [0.0, 0.1, 0.37, 1.0] {
            let value = (t - 0.2) * (t - 0.4) * (t + 1.0);
            let slope = (t - 0.4) * (t + 1.0) + (t - 0.2) * (t + 1.0) + (t - 0.2) * (t - 0.4);
            assert!((p.at(t) - value).abs() < 1e-15);
            assert!((p.raised(20).at(t) - value).abs() < 1e-14);
            assert!((p.derivative().at(t) - slope).abs() < 1e-15);
        }
    }
}
