//! A system of two linear equations whose coefficients are intervals.

use glidepath_geometry::number::{Interval, Number};
use nalgebra::Matrix2;

/// A matrix, multiplied by the inverse of its middle: nearly the unit matrix, so that quotients are
/// nearly sharp.
pub(super) struct Across {
    inverse: Matrix2<f64>,
    rows: [[Interval; 2]; 2],
    determinant: Interval,
}

impl Across {
    /// `None` if a matrix inside is, or may be, singular.
    pub(super) fn new([f, g]: [[Interval; 2]; 2]) -> Option<Self> {
        let middle = |i: &Interval| 0.5 * (i.low() + i.high());
        let inverse = Matrix2::new(middle(&f[0]), middle(&f[1]), middle(&g[0]), middle(&g[1]))
            .try_inverse()
            .filter(|inverse| inverse.iter().all(|c| c.is_finite()))?;
        let rows =
            core::array::from_fn(|i| core::array::from_fn(|j| combine(&inverse, i, f[j], g[j])));
        let [[a, b], [c, d]]: [[Interval; 2]; 2] = rows;
        let determinant = a * d - b * c;
        (!determinant.contains(0.0)).then_some(Self {
            inverse,
            rows,
            determinant,
        })
    }

    /// (v, w) with J (v, w) = −right, by Cramer's rule.
    pub(super) fn solve(&self, right: [Interval; 2]) -> Option<[Interval; 2]> {
        let [p, q] = [0, 1].map(|i| combine(&self.inverse, i, right[0], right[1]));
        let [[a, b], [c, d]] = self.rows;
        let solved = [
            (b * q - d * p) / self.determinant,
            (c * p - a * q) / self.determinant,
        ];
        solved.iter().all(|s| s.is_finite()).then_some(solved)
    }
}

/// Row `i` of a matrix times a column.
fn combine(matrix: &Matrix2<f64>, i: usize, first: Interval, second: Interval) -> Interval {
    first * Interval::constant(matrix[(i, 0)]) + second * Interval::constant(matrix[(i, 1)])
}
