//! One of the branches that cross at a node.
//!
//! At a node N the surfaces touch, ∇f = μ ∇g, and f = g = 0 does not determine the curve: F = f −
//! μ g vanishes there with its gradient. Its lowest terms, a quadratic form on the common tangent
//! plane, are what tells the branches from each other. So the curve is sought along its own
//! tangent t,
//!
//! ```text
//!   r(s) = N + s d,   d = t + u m + w n        n across both surfaces, m across t in their plane;
//!                                              u and w are 0 at s = 0
//!   F(r(s)) / s² = 0,   g(r(s)) / s = 0        ("blowing up" the node)
//! ```
//!
//! and both quotients are functions as smooth as f and g: with the Taylor coefficients of f and g
//! along d, F / s² = F₂ + F₃ s + F₄ s² …, g / s = g₁ + g₂ s …. At s = 0 their Jacobian by u and w
//! is that of tᵀ (Hf − μ Hg) m and |∇g|, regular where the branches cross at an angle. Near a node
//! the curve is thus the solution of two well-conditioned equations for every s, through s = 0 and
//! on both sides.
//!
//! Over intervals of s and d the series are enclosed with Lagrange's remainder, its coefficient
//! taken over all points between N and the curve. That proves where the branch is (`passage.rs`).
//!
//! No computation can prove that two surfaces touch: the least change of one pulls the branches
//! apart. What is proven is said of the surfaces moved by the rounding of their formulas at N
//! (10⁻¹² mm, or a few units in the last place of the coordinates), so that N is a node.

use super::ImplicitCurve;
use super::node::{node, touching_point};
use glidepath_geometry::number::{Gradient, Number, Series};
use nalgebra::{Matrix2, Vector2, Vector3};

/// Taylor coefficients of the surfaces that are taken.
const TERMS: usize = 8;
/// How exactly places on the branch are found, mm.
const PRECISION_MM: f64 = 1e-12;
/// How far a point may be off the branch to be one of its own, mm.
const SAME_MM: f64 = 1e-7;
/// Steps of Newton's method at most.
const STEPS: u32 = 40;

/// A branch through a node, run through in the direction in which s grows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch {
    node: Vector3<f64>,
    mu: f64,
    /// Along the branch, across it in the plane of both surfaces, across both.
    frame: [Vector3<f64>; 3],
    /// Change of (u, w) with s at the node, 1/mm.
    rate: Vector2<f64>,
}

/// The quotients F / s² and g / s, and their gradients ∇F / s and ∇g.
pub(super) struct Quotients<T> {
    pub(super) values: [T; 2],
    pub(super) gradients: [[T; 3]; 2],
    /// The last terms of F / s²: how far the series is from its limit, roughly.
    tail: T,
}

impl Branch {
    /// Both branches through the node that is within `reach_mm` of a guess, turned `ahead`.
    pub(super) fn through(
        curve: &ImplicitCurve,
        guess: &Vector3<f64>,
        reach_mm: f64,
        ahead: &Vector3<f64>,
    ) -> Option<[Self; 2]> {
        let at = touching_point(curve, guess, reach_mm)?;
        let found = node(curve, &at)?;
        let normal = curve.contact(&at).normals[1].normalize();
        let [first, second] = found.tangents.map(|tangent| {
            let along = tangent * tangent.dot(ahead).signum();
            Self {
                node: at,
                mu: found.mu,
                frame: [along, normal.cross(&along), normal],
                rate: Vector2::zeros(),
            }
            .with_rate(curve)
        });
        Some([first?, second?])
    }

    fn with_rate(self, curve: &ImplicitCurve) -> Option<Self> {
        // By implicit differentiation, with what one more term of both series gives.
        let [f, g] = self.series(curve, self.node.into(), self.frame[0].into());
        let [_, _, _, change_f, ..] = *f.value.coefficients();
        let [_, _, change_g, ..] = *g.value.coefficients();
        let (_, across) = self.equations(curve, 0.0, self.frame[0]);
        let rate = -(across.try_inverse()? * Vector2::new(change_f, change_g));
        rate.iter()
            .all(|c| c.is_finite())
            .then_some(Self { rate, ..self })
    }

    pub(super) const fn node(&self) -> &Vector3<f64> {
        &self.node
    }

    /// Unit tangent at the node.
    pub(super) const fn along(&self) -> &Vector3<f64> {
        &self.frame[0]
    }

    pub(super) const fn frame(&self) -> &[Vector3<f64>; 3] {
        &self.frame
    }

    /// Curvature at the node, 1/mm: r = N + s t + s² (u′ m + w′ n) + …
    pub(super) fn curvature_k(&self) -> f64 {
        2.0 * self.rate.norm()
    }

    /// The quotients at s and d, with the last coefficients of the series `around` other points
    /// than N.
    pub(super) fn quotients<T: Number>(
        &self,
        curve: &ImplicitCurve,
        s: T,
        d: [T; 3],
        around: [T; 3],
    ) -> Quotients<T> {
        let near = self.series(curve, self.node.data.0[0].map(T::constant), d);
        let last = self.series(curve, around, d);
        let sum = |near: &Series<TERMS, T>, last: &Series<TERMS, T>, lowest: usize| {
            let top = last.coefficients()[TERMS - 1];
            let lower = near.coefficients()[lowest..TERMS - 1].iter().rev();
            lower.fold(top, |sum, c| sum * s + *c)
        };
        // The lowest terms, which vanish at a node: two of F, one of g and of ∇F, none of ∇g.
        let value = |k: usize| sum(&near[k].value, &last[k].value, 2 - k);
        let gradient = |k: usize| {
            core::array::from_fn(|i| sum(&near[k].partial[i], &last[k].partial[i], 1 - k))
        };
        let [.., before, _] = *near[0].value.coefficients();
        let [.., top] = *last[0].value.coefficients();
        Quotients {
            values: [0, 1].map(value),
            gradients: [0, 1].map(gradient),
            tail: (top * s + before) * s.square().square(),
        }
    }

    /// F and g with their gradients along a line through a point.
    fn series<T: Number>(
        &self,
        curve: &ImplicitCurve,
        from: [T; 3],
        d: [T; 3],
    ) -> [Gradient<Series<TERMS, T>>; 2] {
        let moving = core::array::from_fn(|i| {
            Series::new(core::array::from_fn(|k| match k {
                0 => from[i],
                1 => d[i],
                _ => T::constant(0.0),
            }))
        });
        let [f, g] = curve.gradients(moving);
        let f = Gradient {
            value: f.value - g.value.scale(self.mu),
            partial: core::array::from_fn(|i| f.partial[i] - g.partial[i].scale(self.mu)),
        };
        [f, g]
    }

    /// The equations for (u, w) at s and their Jacobian.
    fn equations(
        &self,
        curve: &ImplicitCurve,
        s: f64,
        d: Vector3<f64>,
    ) -> (Vector2<f64>, Matrix2<f64>) {
        let series = self.quotients(curve, s, d.into(), self.node.into());
        let gradients = series.gradients.map(Vector3::from);
        let is_exact = (series.tail * s).abs() <= PRECISION_MM * gradients[0].norm();
        if is_exact {
            return (series.values.into(), self.across(gradients));
        }
        // So far from the node that nothing is lost by division.
        let contact = curve.contact(&(self.node + d * s));
        let ([f, g], [nf, ng]) = (contact.values, contact.normals);
        let values = Vector2::new((f - self.mu * g) / (s * s), g / s);
        (values, self.across([(nf - ng * self.mu) / s, ng]))
    }

    /// Derivatives by u and w, from gradients.
    fn across(&self, gradients: [Vector3<f64>; 2]) -> Matrix2<f64> {
        let [_, m, n] = &self.frame;
        let [f, g] = &gradients;
        Matrix2::new(f.dot(m), f.dot(n), g.dot(m), g.dot(n))
    }

    /// (u, w) at s; `None` if they are not found.
    pub(super) fn solve(&self, curve: &ImplicitCurve, s: f64) -> Option<Vector2<f64>> {
        let mut solution = self.rate * s;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let (values, across) = self.equations(curve, s, self.direction(&solution));
            let step = across.try_inverse()? * values;
            let size = step.amax();
            if !size.is_finite() {
                return None;
            }
            solution -= step;
            // Until rounding ends it, next to where it should.
            let is_exact = size * s.abs().max(PRECISION_MM) <= 10.0 * PRECISION_MM;
            if is_exact && (size <= 1e-15 || size >= 0.25 * last) {
                return Some(solution);
            }
            last = size;
        }
        None
    }

    fn direction(&self, solution: &Vector2<f64>) -> Vector3<f64> {
        let [t, m, n] = &self.frame;
        t + m * solution.x + n * solution.y
    }

    /// The point of the branch at s.
    pub(super) fn point(&self, curve: &ImplicitCurve, s: f64) -> Option<Vector3<f64>> {
        let solution = self.solve(curve, s)?;
        Some(self.node + self.direction(&solution) * s)
    }

    /// Where a point of the branch is on it; `None` if it is not on this branch.
    pub(super) fn place(&self, curve: &ImplicitCurve, point: &Vector3<f64>) -> Option<f64> {
        let s = (point - self.node).dot(&self.frame[0]);
        let off = (self.point(curve, s)? - point).norm();
        (off <= SAME_MM).then_some(s)
    }

    /// The end of a chord of a length from the point at `from_s`: the next after it at that
    /// distance, and s there.
    pub(super) fn step(
        &self,
        curve: &ImplicitCurve,
        from_s: f64,
        from: &Vector3<f64>,
        chord_mm: f64,
    ) -> Option<(f64, Vector3<f64>)> {
        let mut s = from_s + chord_mm;
        let (mut before, mut slope) = (None, 1.0);
        for _ in 0..STEPS {
            let point = self.point(curve, s)?;
            let excess = (point - from).norm() - chord_mm;
            if excess.abs() <= PRECISION_MM {
                return Some((s, point));
            }
            if let Some((last_s, last)) = before {
                slope = (excess - last) / (s - last_s);
            }
            before = Some((s, excess));
            s -= excess / slope;
        }
        None
    }
}
