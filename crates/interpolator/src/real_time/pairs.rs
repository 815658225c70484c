//! Pairs of axes, two by two, as the processor computes them.
//!
//! What is kept for every axis is kept pair by pair, so that all that is needed of a pair is in
//! neighbouring cache lines. After the sleep of a period it is these lines that take the time, and
//! those of the code: hence loops over pairs, not one long run over all axes. A machine with fewer
//! axes has fewer pairs to look at.

use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::Limits;

/// Pairs of all axes; the last has no second one.
pub(crate) const PAIRS: usize = AXES.div_ceil(2);

/// A number for each of two axes.
pub(crate) type Pair = [f64; 2];

/// One of all axes, pair by pair.
pub(crate) fn pairs(axes: &[f64]) -> impl Iterator<Item = Pair> {
    axes.chunks(2).map(|pair| match *pair {
        [first, second] => [first, second],
        [first] => [first, 0.0],
        _ => [0.0; 2],
    })
}

/// All axes of a number by pairs.
pub(crate) fn axes(pairs: &[Pair; PAIRS]) -> AxisVector {
    let mut axes = AxisVector::zeros();
    for (slot, value) in axes.iter_mut().zip(pairs.as_flattened()) {
        *slot = *value;
    }
    axes
}

/// How many pairs have an axis with limits: those that the machine has.
pub(crate) fn in_use(limits: &Limits) -> usize {
    let is_limited = |axis: usize| {
        [limits.velocity, limits.acceleration, limits.jerk]
            .iter()
            .any(|limit| limit.get(axis).is_some_and(|l| *l < Limits::UNLIMITED))
    };
    let axes = (0..AXES).rev().find(|axis| is_limited(*axis));
    axes.map_or(0, |last| last / 2 + 1)
}

/// Applies a function to both numbers of a pair.
pub(crate) fn map(one: Pair, f: impl Fn(f64) -> f64) -> Pair {
    let [a, b] = one;
    [f(a), f(b)]
}

/// Applies a function to the first numbers of two pairs, and to the second ones.
pub(crate) fn zip(one: Pair, other: Pair, f: impl Fn(f64, f64) -> f64) -> Pair {
    let ([a, b], [c, d]) = (one, other);
    [f(a, c), f(b, d)]
}

pub(crate) fn sub(one: Pair, other: Pair) -> Pair {
    zip(one, other, |a, b| a - b)
}

/// The larger of two numbers, the second if one is none: an instruction, which `f64::max` is not.
pub(crate) const fn larger(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

/// The smaller one in the same way.
pub(crate) fn smaller(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}
