//! Weighted sums of control points. The first three are given, and the last three are one unknown.

use super::problem::{Problem, SPAN, WideRow};

/// Takes a pull on a weighted sum of consecutive points from their steps.
#[inline]
pub(super) fn take_away<const D: usize, const N: usize>(
    step: &mut [[f64; D]],
    first: usize,
    weights: &[f64; N],
    pull: &[f64; D],
) {
    for (point, weight) in step[first..].iter_mut().zip(weights) {
        for a in 0..D {
            point[a] -= weight * pull[a];
        }
    }
}

/// The last control points are one unknown, x_M = x_{M+1} = x_{M+2}, which is what rest at the end is to
/// a cubic spline: its coefficients add up. Kept as equations, the matrix would not be positive.
pub(super) fn fold<const D: usize, const N: usize>(
    first: usize,
    mut weights: [f64; N],
    problem: &Problem<D>,
) -> [f64; N] {
    let last = problem.intervals;
    if first <= last && first + N > last + 1 {
        for i in last - first + 1..N {
            weights[last - first] += weights[i];
            weights[i] = 0.0;
        }
    }
    weights
}

/// The same for a row in which every control point has a direction of its own.
pub(super) fn fold_parts<const D: usize>(
    row: &WideRow<D>,
    problem: &Problem<D>,
) -> [[f64; D]; SPAN] {
    let (last, mut parts) = (problem.intervals, row.parts);
    if row.first <= last && row.first + SPAN > last + 1 {
        let at = last - row.first;
        for i in at + 1..SPAN {
            let part = core::mem::replace(&mut parts[i], [0.0; D]);
            for a in 0..D {
                parts[at][a] += part[a];
            }
        }
    }
    parts
}

pub(super) fn tie_rest<const D: usize>(problem: &Problem<D>, x: &mut [[f64; D]]) {
    if !problem.is_end_fixed {
        let last = problem.intervals;
        x[last + 1] = x[last];
        x[last + 2] = x[last];
    }
}
