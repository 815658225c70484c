//! Polynomial spans of degree three, driven by path position.
//!
//! A span is given by four Bézier points over its own parameter u. The feed is measured in some of
//! the axes (XYZ, or UVW, or ABC), and with w = |C′|² over these, path position is s = ∫√w du.
//! Derivatives by s follow without any root but one:
//!
//! ```text
//! q′ = C′/√w      q″ = P/w²,  P = C″·w − ½C′·w′      q‴ = Q/(w³·√w),  Q = P′·w − 2P·w′
//! ```
//!
//! P and Q are polynomials (degrees 5 and 8), so their Bernstein coefficients, with those of w,
//! bound q″ and q‴ everywhere on the span, not just at sampled places.

use crate::bernstein;
use crate::quadrature::gauss_12;
use crate::{AxisVector, DerivativeBounds, Jet};
use core::ops::Range;

/// A cubic span. Path position runs from 0 to [`Cubic::length`].
#[derive(Debug, Clone, PartialEq)]
pub struct Cubic {
    /// Where it starts; the Bézier points are relative to it, so that a small span far from the
    /// origin keeps its digits.
    origin: AxisVector,
    control: [AxisVector; 4],
    /// The axes that measure the feed.
    feed_axes: Range<usize>,
    /// w by powers of u.
    square: [f64; 5],
    length: f64,
}

/// A place on a span: derivatives by its parameter there.
struct ParameterJet {
    u: f64,
    steps: [AxisVector; 3],
    c1: AxisVector,
    c2: AxisVector,
    w: f64,
    w1: f64,
    root: f64,
}

impl ParameterJet {
    #[inline]
    fn new(span: &Cubic, u: f64) -> Self {
        let v = 1.0 - u;
        let steps: [AxisVector; 3] = bernstein::differences(&span.control);
        let [e0, e1, e2] = &steps;
        let c1 = (e0 * (v * v) + e1 * (2.0 * u * v) + e2 * (u * u)) * 3.0;
        let c2 = ((e1 - e0) * v + (e2 - e1) * u) * 6.0;
        let w = span.dot(&c1, &c1);
        let w1 = 2.0 * span.dot(&c1, &c2);
        let root = w.sqrt();
        Self {
            u,
            steps,
            c1,
            c2,
            w,
            w1,
            root,
        }
    }

    #[inline]
    fn position(&self, span: &Cubic) -> AxisVector {
        let (u, v) = (self.u, 1.0 - self.u);
        let [_, b1, b2, b3] = &span.control;
        // From the nearer end, so that neighbouring spans meet exactly.
        if u <= 0.5 {
            let offset = b1 * (3.0 * v * v) + b2 * (3.0 * v * u) + b3 * (u * u);
            span.origin + offset * u
        } else {
            let back = (b3 - b2) * (3.0 * u * u) + (b3 - b1) * (3.0 * u * v) + b3 * (v * v);
            span.origin + b3 - back * v
        }
    }

    #[inline]
    fn d1(&self) -> AxisVector {
        self.c1 / self.root
    }

    #[inline]
    fn p(&self) -> AxisVector {
        self.c2 * self.w - self.c1 * (0.5 * self.w1)
    }

    #[inline]
    fn d2(&self) -> AxisVector {
        self.p() / (self.w * self.w)
    }
}

/// The slowest a span may be along its mean direction, as a share of the mean speed by its
/// parameter. Slower ones come near a cusp, where path position is no good parameter.
const SLOWEST_R: f64 = 0.1;
/// w may vary by this factor before a part is halved for its bounds, and so often at most.
const EVEN_R: f64 = 1.05;
const HALVINGS: u32 = 3;
/// Steps of Newton's method for the parameter.
const NEWTON_STEPS: u32 = 12;

impl Cubic {
    /// The span of four Bézier points, its feed measured in some of the axes; `None` if it comes
    /// near a cusp in these, or does not move in them.
    #[must_use]
    pub fn new(control: [AxisVector; 4], feed_axes: Range<usize>) -> Option<Self> {
        let origin = control[0];
        let control = control.map(|point| point - origin);
        let mut span = Self {
            origin,
            control,
            feed_axes,
            square: [0.0; 5],
            length: 0.0,
        };
        let mean = span.control[3] / 3.0;
        let least = span.dot(&mean, &mean) * SLOWEST_R;
        let steps: [AxisVector; 3] = bernstein::differences(&span.control);
        let is_regular = least > 0.0 && steps.iter().all(|step| span.dot(step, &mean) >= least);
        if !is_regular {
            return None;
        }
        let c1 = steps[0] * 3.0;
        let c2 = (steps[1] - steps[0]) * 6.0;
        let c3 = (steps[2] - steps[1] * 2.0 + steps[0]) * 3.0;
        span.square = [
            span.dot(&c1, &c1),
            2.0 * span.dot(&c1, &c2),
            span.dot(&c2, &c2) + 2.0 * span.dot(&c1, &c3),
            2.0 * span.dot(&c2, &c3),
            span.dot(&c3, &c3),
        ];
        span.length = span.position_at(1.0);
        span.length.is_finite().then_some(span)
    }

    /// Path position at the end, mm.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// Path position at a parameter in 0…1.
    #[must_use]
    pub fn position_at(&self, u: f64) -> f64 {
        gauss_12(0.0, u, |u| self.speed(u))
    }

    /// The parameter at a path position, 0…1.
    #[must_use]
    pub fn parameter_at(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        if s >= self.length {
            return 1.0;
        }
        let (mut low_u, mut high_u) = (0.0, 1.0);
        let mut u = s / self.length;
        for _ in 0..NEWTON_STEPS {
            let excess_s = self.position_at(u) - s;
            if excess_s > 0.0 {
                high_u = u;
            } else {
                low_u = u;
            }
            let step_u = excess_s / self.speed(u);
            let next_u = if (low_u..=high_u).contains(&(u - step_u)) {
                u - step_u
            } else {
                0.5 * (low_u + high_u)
            };
            let is_there = (next_u - u).abs() <= 1e-14;
            u = next_u;
            // The error after a step is about the square of the step.
            if is_there || step_u.abs() <= 1e-8 {
                break;
            }
        }
        u
    }

    /// Position and derivatives at path position `s`, which is clamped to the span. Never
    /// allocates.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        self.jet_at_parameter(self.parameter_at(s))
    }

    /// The same at a parameter in 0…1, which has not to be sought.
    #[must_use]
    #[inline]
    pub fn jet_at_parameter(&self, u: f64) -> Jet {
        let at = ParameterJet::new(self, u);
        let [e0, e1, e2] = at.steps;
        let c3 = (e2 - e1 * 2.0 + e0) * 6.0;
        let w2 = 2.0 * (self.dot(&at.c2, &at.c2) + self.dot(&at.c1, &c3));
        let p1 = c3 * at.w + at.c2 * (0.5 * at.w1) - at.c1 * (0.5 * w2);
        Jet {
            position: at.position(self),
            d1: at.d1(),
            d2: at.d2(),
            d3: (p1 * at.w - at.p() * (2.0 * at.w1)) / (at.w * at.w * at.w * at.root),
        }
    }

    /// As [`Cubic::jet`], without the third derivative, which is zero instead.
    #[must_use]
    pub fn state(&self, s: f64) -> Jet {
        let at = ParameterJet::new(self, self.parameter_at(s));
        Jet {
            position: at.position(self),
            d1: at.d1(),
            d2: at.d2(),
            d3: AxisVector::zeros(),
        }
    }

    /// Largest derivatives per axis.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        let zero = AxisVector::zeros();
        let mut bounds = DerivativeBounds {
            d1: zero,
            d2: zero,
            d3: zero,
        };
        self.bound(&self.control, HALVINGS, &mut bounds);
        bounds
    }

    /// Raises the bounds to those of a part of the span. They do not depend on the parameter, so
    /// the part is taken over 0…1.
    fn bound(&self, control: &[AxisVector; 4], halvings: u32, bounds: &mut DerivativeBounds) {
        let steps: [AxisVector; 3] = bernstein::differences(control);
        let bends: [AxisVector; 2] = bernstein::differences(&steps);
        let mut w = [0.0; 5];
        for axis in self.feed_axes.clone() {
            let c1 = [
                3.0 * steps[0][axis],
                6.0 * steps[1][axis],
                3.0 * steps[2][axis],
            ];
            add_product(&mut w, &c1, &c1);
        }
        let (least, greatest) = range(&w);
        if halvings > 0 && (least <= 0.0 || greatest > EVEN_R * least) {
            let (left, right) = bernstein::halve(control);
            self.bound(&left, halvings - 1, bounds);
            self.bound(&right, halvings - 1, bounds);
            return;
        }
        let root = least.max(0.0).sqrt();
        let w1: [f64; 4] = derivative(&w);
        let half_w1 = w1.map(|c| 0.5 * c);
        for axis in 0..control[0].len() {
            let c1 = [
                3.0 * steps[0][axis],
                6.0 * steps[1][axis],
                3.0 * steps[2][axis],
            ];
            if c1.iter().all(|&c| c == 0.0) {
                continue;
            }
            let c2 = [6.0 * bends[0][axis], 6.0 * bends[1][axis]];
            let mut p = [0.0; 6];
            add_product(&mut p, &c2, &w);
            add_product(&mut p, &c1.map(|c| -c), &half_w1);
            let p1: [f64; 5] = derivative(&p);
            let mut q = [0.0; 9];
            add_product(&mut q, &p1, &w);
            add_product(&mut q, &p.map(|c| -2.0 * c), &w1);
            bounds.d1[axis] = bounds.d1[axis].max(magnitude(&c1) / root);
            bounds.d2[axis] = bounds.d2[axis].max(magnitude(&p) / (least * least));
            bounds.d3[axis] = bounds.d3[axis].max(magnitude(&q) / (least.powi(3) * root));
        }
    }

    /// Speed by the parameter, √w.
    fn speed(&self, u: f64) -> f64 {
        let [w0, w1, w2, w3, w4] = self.square;
        (w0 + u * (w1 + u * (w2 + u * (w3 + u * w4))))
            .max(0.0)
            .sqrt()
    }

    fn dot(&self, a: &AxisVector, b: &AxisVector) -> f64 {
        self.feed_axes.clone().map(|i| a[i] * b[i]).sum()
    }
}

/// Binomial coefficients up to degree 8.
const BINOMIAL: [[f64; 9]; 9] = {
    let mut rows = [[0.0; 9]; 9];
    let mut n = 0;
    while n < 9 {
        rows[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            rows[n][k] = rows[n - 1][k - 1] + if k < n { rows[n - 1][k] } else { 0.0 };
            k += 1;
        }
        n += 1;
    }
    rows
};

/// Adds the product of two polynomials to a third; all three in Bernstein form with the binomial
/// coefficients multiplied in, where a product is a convolution.
fn add_product<const A: usize, const B: usize, const N: usize>(
    sum: &mut [f64; N],
    a: &[f64; A],
    b: &[f64; B],
) {
    debug_assert_eq!(N + 1, A + B);
    for (i, x) in a.iter().enumerate() {
        for (slot, y) in sum[i..].iter_mut().zip(b) {
            *slot += x * y;
        }
    }
}

/// The derivative of a polynomial, both with the binomial coefficients multiplied in.
fn derivative<const N: usize, const R: usize>(c: &[f64; N]) -> [f64; R] {
    debug_assert_eq!(R + 1, N);
    let plain = |i: usize| c[i] / BINOMIAL[R][i];
    core::array::from_fn(|i| (plain(i + 1) - plain(i)) * R as f64 * BINOMIAL[R - 1][i])
}

/// Largest magnitude on 0…1.
fn magnitude<const N: usize>(c: &[f64; N]) -> f64 {
    let plain = c.iter().zip(&BINOMIAL[N - 1]).map(|(c, b)| (c / b).abs());
    plain.fold(0.0, f64::max)
}

/// Bounds of the values on 0…1.
fn range<const N: usize>(c: &[f64; N]) -> (f64, f64) {
    let plain = c.iter().zip(&BINOMIAL[N - 1]).map(|(c, b)| c / b);
    plain.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
        (low.min(c), high.max(c))
    })
}
