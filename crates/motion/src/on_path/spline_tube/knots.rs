//! Cubic B-splines on knots of any spacing.
//!
//! `knots` holds the knots t₋₃ … t of the last span and three more; span k, between `knots[k + 3]`
//! and `knots[k + 4]`, is driven by the control points k to k + 3.

use super::vector::{add_scaled, minus};

/// Degree of the splines.
pub(super) const DEGREE: usize = 3;

/// Values and first derivatives of the four basis functions of a span at a parameter.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Basis {
    pub(super) value: [f64; 4],
    pub(super) slope: [f64; 4],
}

impl Basis {
    /// Recurrence of Cox and de Boor.
    #[inline]
    pub(super) fn at(knots: &[f64], span: usize, t: f64) -> Self {
        let Some(k) = local(knots, span) else {
            return Self::default();
        };
        let right = [k[3] - t, k[4] - t, k[5] - t];
        let left = [t - k[2], t - k[1], t - k[0]];
        let linear_r = 1.0 / (k[3] - k[2]);
        let linear = [right[0] * linear_r, left[0] * linear_r];
        let quadratic_r = [linear[0] / (k[3] - k[1]), linear[1] / (k[4] - k[2])];
        let quadratic = [
            right[0] * quadratic_r[0],
            left[1] * quadratic_r[0] + right[1] * quadratic_r[1],
            left[0] * quadratic_r[1],
        ];
        let r = [
            quadratic[0] / (k[3] - k[0]),
            quadratic[1] / (k[4] - k[1]),
            quadratic[2] / (k[5] - k[2]),
        ];
        Self {
            value: [
                right[0] * r[0],
                left[2] * r[0] + right[1] * r[1],
                left[1] * r[1] + right[2] * r[2],
                left[0] * r[2],
            ],
            slope: [
                -3.0 * r[0],
                3.0 * (r[0] - r[1]),
                3.0 * (r[1] - r[2]),
                3.0 * r[2],
            ],
        }
    }

    /// Point and first derivative of a spline, `control` starting with the span's first point.
    #[inline]
    pub(super) fn apply<const D: usize>(&self, control: &[[f64; D]]) -> ([f64; D], [f64; D]) {
        let (mut point, mut slope) = ([0.0; D], [0.0; D]);
        for (i, c) in control.iter().take(4).enumerate() {
            point = add_scaled(&point, self.value[i], c);
            slope = add_scaled(&slope, self.slope[i], c);
        }
        (point, slope)
    }
}

/// The six knots that a span's basis depends on.
#[inline]
fn local(knots: &[f64], span: usize) -> Option<&[f64; 6]> {
    knots.get(span + 1..span + 7)?.try_into().ok()
}

/// The third derivative on a span, as factors of its four control points.
#[inline]
pub(super) fn third_derivative(knots: &[f64], span: usize) -> [f64; 4] {
    let Some(k) = local(knots, span) else {
        return [0.0; 4];
    };
    let first = [k[3] - k[0], k[4] - k[1], k[5] - k[2]].map(|d| 3.0 / d);
    let second = [k[3] - k[1], k[4] - k[2]].map(|d| 2.0 / d);
    let third = 1.0 / (k[3] - k[2]);
    let (a, b) = (third * second[0], third * second[1]);
    [
        -a * first[0],
        a * (first[0] + first[1]) + b * first[1],
        -b * (first[1] + first[2]) - a * first[1],
        b * first[2],
    ]
}

/// The second derivative at a parameter of a span, `control` starting with the span's first point.
#[inline]
pub(super) fn second_derivative<const D: usize>(
    knots: &[f64],
    control: &[[f64; D]],
    (span, t): (usize, f64),
) -> [f64; D] {
    let (Some(k), [a, b, c, d, ..]) = (local(knots, span), control) else {
        return [0.0; D];
    };
    let [ab, bc, cd] = [
        (k[3] - k[0], a, b),
        (k[4] - k[1], b, c),
        (k[5] - k[2], c, d),
    ]
    .map(|(width_t, from, to)| minus(to, from).map(|x| 3.0 / width_t * x));
    let start = minus(&bc, &ab).map(|x| 2.0 / (k[3] - k[1]) * x);
    let end = minus(&cd, &bc).map(|x| 2.0 / (k[4] - k[2]) * x);
    add_scaled(&start, (t - k[2]) / (k[3] - k[2]), &minus(&end, &start))
}

/// The mean of the three knots that a control point stands for.
#[inline]
pub(super) fn greville(knots: &[f64], control: usize) -> f64 {
    knots
        .get(control + 1..control + 4)
        .map_or(0.0, |k| (k[0] + k[1] + k[2]) / 3.0)
}

/// The Bézier points of a span.
pub(super) fn bezier<const D: usize>(
    knots: &[f64],
    control: &[[f64; D]],
    span: usize,
) -> Option<[[f64; D]; 4]> {
    let control = control.get(span..span + 4)?;
    let (from_t, to_t) = (*knots.get(span + 3)?, *knots.get(span + 4)?);
    let start = Basis::at(knots, span, from_t).apply(control);
    let end = Basis::at(knots, span, to_t).apply(control);
    Some(hermite_points(&start, &end, to_t - from_t))
}

/// Bézier points of a part of a span from the points and slopes at its ends.
#[inline]
pub(super) fn hermite_points<const D: usize>(
    (start, start_d1): &([f64; D], [f64; D]),
    (end, end_d1): &([f64; D], [f64; D]),
    length_t: f64,
) -> [[f64; D]; 4] {
    let third = length_t / 3.0;
    [
        *start,
        add_scaled(start, third, start_d1),
        add_scaled(end, -third, end_d1),
        *end,
    ]
}

/// The differences along a chain of Bézier points.
#[inline]
pub(super) fn steps<const D: usize>(points: &[[f64; D]; 4]) -> [[f64; D]; 3] {
    core::array::from_fn(|i| minus(&points[i + 1], &points[i]))
}
