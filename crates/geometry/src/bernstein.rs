//! Polynomials in Bernstein form on [0, 1]: the coefficients enclose the values.

use crate::AxisVector;
use core::ops::{Add, Mul, Sub};

/// Differences of neighbouring coefficients: the derivative, but for the factor of the degree.
/// `R` = `N` − 1.
pub(crate) fn differences<T, const N: usize, const R: usize>(c: &[T; N]) -> [T; R]
where
    T: Copy + Sub<Output = T>,
{
    debug_assert_eq!(R + 1, N);
    core::array::from_fn(|i| c[i + 1] - c[i])
}

/// The coefficients on [0, ½] and on [½, 1].
pub(crate) fn halve<T, const N: usize>(c: &[T; N]) -> ([T; N], [T; N])
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    let mut left = *c;
    let mut right = *c;
    for (level, slot) in left.iter_mut().enumerate() {
        *slot = right[0];
        for i in 0..N - 1 - level {
            right[i] = (right[i] + right[i + 1]) * 0.5;
        }
    }
    (left, right)
}

/// Upper bound of the absolute value of every axis on [0, 1], from the hulls after some halvings.
pub(crate) fn max_abs<const N: usize>(c: &[AxisVector; N], levels: u32) -> AxisVector {
    if levels == 0 {
        return c
            .iter()
            .fold(AxisVector::zeros(), |bound, point| bound.sup(&point.abs()));
    }
    let (left, right) = halve(c);
    max_abs(&left, levels - 1).sup(&max_abs(&right, levels - 1))
}

/// Whether the values on [0, 1] are proven to lie between two, axis by axis, after some halvings at
/// most.
pub(crate) fn is_within<const N: usize>(
    c: &[AxisVector; N],
    ends: &[AxisVector; 2],
    levels: u32,
) -> bool {
    let [lowest, highest] = ends;
    let is_inside = |point: &AxisVector| {
        let mut axes = point.iter().zip(lowest.iter().zip(highest));
        axes.all(|(x, (low, high))| x >= low && x <= high)
    };
    if c.iter().all(is_inside) {
        return true;
    }
    // The first and the last coefficient are values.
    if levels == 0 || ![c.first(), c.last()].into_iter().flatten().all(is_inside) {
        return false;
    }
    let (left, right) = halve(c);
    is_within(&left, ends, levels - 1) && is_within(&right, ends, levels - 1)
}
