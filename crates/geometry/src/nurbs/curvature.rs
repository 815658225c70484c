//! Curvature of a rational Bézier span as polynomials: where it is extreme, and how large it can
//! be.
//!
//! With homogeneous points (wᵢPᵢ, wᵢ), A = Σwᵢ·Pᵢ·Bᵢ and w = Σwᵢ·Bᵢ, all by the local parameter t:
//!
//! ```text
//! N = A'w − Aw'          degree 2p−2    C' = N/w²
//! B                      degree 3p−6    C'×C'' = B/w³
//! S = |N|²               degree 4p−4
//! κ = |B|·w³ / |N|³
//! ```
//!
//! All are made of differences of control points, so that a curve far from zero loses nothing:
//!
//! ```text
//! N: coefficient k   = Σ (j−i)·C(p,i)C(p,j)·wᵢwⱼ·(Pⱼ−Pᵢ) / C(2p−2,k)                  i<j, i+j = k+1
//! B: coefficient m   = Σ (j−i)(l−i)(l−j)·C(p,i)C(p,j)C(p,l)·wᵢwⱼwₗ·(Pⱼ−Pᵢ)×(Pₗ−Pᵢ) / C(3p−6,m)
//!                                                                           i<j<l, i+j+l = m+3
//! ```
//!
//! The curvature is extreme where its logarithmic derivative changes sign, the polynomial
//! E = 2B'wS + 6Bw'S − 3BwS' for a curve in a plane (B a number with a sign, κ a curvature with a
//! sign), and the same with |B|² in place of B and 1 in place of 2 in space. Between two
//! neighbouring roots of E the curvature is monotone.
//!
//! *Bound.* On the whole span κ ≤ max|B_k|·(max w)³ / (min n·N_k)³ for any unit vector n, here
//! that of ΣN_k; no bound if the minimum is not positive.
//!
//! Source of the rational hodograph: Saito, Wang, Sederberg, *Hodographs and normals of rational
//! curves and surfaces*, 1995.

use super::Span;
use super::polynomial::{Polynomial, binomial};
use super::span::Feed4;
use nalgebra::Vector3;

/// A first derivative this small, relative to the largest of the span, is none: the curve stands
/// still there (a cusp, or control points that coincide).
const STANDSTILL: f64 = 1e-6;

/// Relative change of κ over a span below which the span counts as a circular arc.
const CONSTANT: f64 = 1e-10;

/// The curvature of one span, in the axes that measure the feed.
#[derive(Debug, Clone)]
pub struct SpanCurvature {
    from_u: f64,
    to_u: f64,
    weight: Polynomial,
    /// N.
    hodograph: [Polynomial; 3],
    /// B.
    turning: Turning,
    /// max |N_k|
    largest: f64,
}

#[derive(Debug, Clone)]
#[allow(
    clippy::large_enum_variant,
    reason = "a box would allocate; one is alive at a time"
)]
enum Turning {
    /// A straight span of degree 1.
    None,
    /// The one component that a curve in a coordinate plane has.
    Planar(Polynomial),
    Spatial([Polynomial; 3]),
}

impl SpanCurvature {
    /// The polynomials of a span: a few hundred multiplications, no allocation.
    #[must_use]
    pub fn new(span: &Span) -> Self {
        let points = span.feed_points();
        let p = span.degree;
        let offset = |i: usize| points[i].xyz() / points[i].w;
        let flat = (0..3).find(|&axis| is_constant(points, axis));
        let hodograph = hodograph(p, points, offset);
        let turning = if p < 2 {
            Turning::None
        } else {
            let [x, y, z] = turning(p, points, offset);
            match flat {
                Some(0) => Turning::Planar(x),
                Some(1) => Turning::Planar(y),
                Some(_) => Turning::Planar(z),
                None => Turning::Spatial([x, y, z]),
            }
        };
        let largest = norms(&hodograph).fold(0.0, f64::max);
        Self {
            from_u: span.from_u,
            to_u: span.to_u,
            weight: Polynomial::from_fn(p, |i| points[i].w),
            hodograph,
            turning,
            largest,
        }
    }

    /// The curvature at `u`, which is clamped to the span, 1/mm. For a curve in a coordinate plane
    /// it has a sign that tells left from right, else it is ≥ 0. Infinite where the curve stands
    /// still.
    #[must_use]
    pub fn at(&self, u: f64) -> f64 {
        let t = ((u - self.from_u) / (self.to_u - self.from_u)).clamp(0.0, 1.0);
        let turning = match &self.turning {
            Turning::None => 0.0,
            Turning::Planar(b) => b.at(t),
            Turning::Spatial(b) => Vector3::from_fn(|i, _| b[i].at(t)).norm(),
        };
        let speed = Vector3::from_fn(|i, _| self.hodograph[i].at(t)).norm();
        if speed <= STANDSTILL * self.largest {
            f64::INFINITY
        } else {
            turning * (self.weight.at(t) / speed).powi(3)
        }
    }

    /// An upper bound of the curvature of the span, 1/mm: never below any of its values, infinite
    /// where nothing can be said.
    #[must_use]
    pub fn bound_k(&self) -> f64 {
        let largest_turning = match &self.turning {
            Turning::None => 0.0,
            Turning::Planar(b) => b.max_abs(),
            Turning::Spatial(b) => norms(b).fold(0.0, f64::max),
        };
        let coefficients = self.hodograph.each_ref().map(Polynomial::coefficients);
        let vector = |k: usize| Vector3::from_fn(|i, _| coefficients[i][k]);
        let count = coefficients[0].len();
        let sum = (0..count).fold(Vector3::zeros(), |sum, k| sum + vector(k));
        let length = sum.norm();
        if length <= 0.0 {
            return f64::INFINITY;
        }
        let least = (0..count)
            .map(|k| vector(k).dot(&sum) / length)
            .fold(f64::INFINITY, f64::min);
        // A straight span that does not turn back, however slowly it starts.
        if least >= 0.0 && largest_turning <= 1e-13 * self.largest * self.largest {
            return 0.0;
        }
        if least <= 0.0 {
            return f64::INFINITY;
        }
        largest_turning * (self.weight.max() / least).powi(3)
    }

    /// Gives, ascending, every `u` inside the span where the curvature is extreme (with its sign,
    /// if it has one), and perhaps points where it is not. Between two neighbours of them, and
    /// between them and the ends of the span, the curvature is monotone. A circular arc gives
    /// none.
    pub fn critical(&self, mut found: impl FnMut(f64)) {
        let (from_u, h) = (self.from_u, self.to_u - self.from_u);
        let still = self.standstills();
        let mut still = still.iter().copied().flatten().peekable();
        if let Some(extreme) = self.extreme() {
            extreme.roots(&mut |t| {
                while let Some(cusp) = still.next_if(|cusp| *cusp <= t) {
                    found(from_u + h * cusp);
                }
                found(from_u + h * t);
            });
        }
        still.for_each(|cusp| found(from_u + h * cusp));
    }

    /// Where the curve stands still inside the span, ascending. There E has a root as well, but a
    /// multiple one, which comes out with few digits; of |N|² it is a minimum, found with all.
    fn standstills(&self) -> [Option<f64>; super::degree::MAX_DEGREE] {
        let mut still = [None; super::degree::MAX_DEGREE];
        let square = squared(&self.hodograph);
        let least = (STANDSTILL * self.largest).powi(2);
        if square.min() > least {
            return still;
        }
        let mut slots = still.iter_mut();
        square.derivative().roots(&mut |t| {
            if square.at(t) <= least
                && let Some(slot) = slots.next()
            {
                *slot = Some(t);
            }
        });
        still
    }

    /// E, or none if the curvature is constant.
    fn extreme(&self) -> Option<Polynomial> {
        let (b, doubled) = match &self.turning {
            Turning::None => return None,
            Turning::Planar(b) => (*b, 2.0),
            Turning::Spatial(b) => (squared(b), 1.0),
        };
        let w = self.weight;
        let s = squared(&self.hodograph);
        let (b1, w1, s1) = (b.derivative(), w.derivative(), s.derivative());
        let first = (b1 * w * s).scaled(doubled);
        let rest = b * ((w1 * s).scaled(6.0) + (w * s1).scaled(-3.0));
        let degree = rest.degree().max(first.degree());
        let extreme = first.raised(degree) + rest.raised(degree);
        // |d ln κ/dt| = |E|/(2BwS) in the plane, half of it in space; the hulls bound it.
        let least_b = if b.min() > 0.0 { b.min() } else { -b.max() };
        let least = least_b * w.min() * s.min();
        if least > 0.0 && extreme.max_abs() <= CONSTANT * least {
            return None;
        }
        Some(extreme)
    }
}

/// True if the coordinate is the same for all points, to rounding.
fn is_constant(points: &[Feed4], axis: usize) -> bool {
    // The points are relative to the first.
    let largest = |axis: usize| {
        points
            .iter()
            .fold(0.0_f64, |largest, p| largest.max((p[axis] / p.w).abs()))
    };
    largest(axis) <= 1e-13 * largest(0).max(largest(1)).max(largest(2))
}

fn hodograph(
    p: usize,
    points: &[Feed4],
    offset: impl Fn(usize) -> Vector3<f64>,
) -> [Polynomial; 3] {
    let degree = 2 * p - 2;
    let mut sums = [Vector3::zeros(); 2 * super::degree::MAX_DEGREE - 1];
    for i in 0..p {
        for j in i + 1..=p {
            let factor = (j - i) as f64 * binomial(p, i) * binomial(p, j);
            let weights = points[i].w * points[j].w;
            sums[i + j - 1] += (offset(j) - offset(i)) * (factor * weights);
        }
    }
    core::array::from_fn(|axis| {
        Polynomial::from_fn(degree, |k| sums[k][axis] / binomial(degree, k))
    })
}

fn turning(p: usize, points: &[Feed4], offset: impl Fn(usize) -> Vector3<f64>) -> [Polynomial; 3] {
    let degree = 3 * p - 6;
    let mut sums = [Vector3::zeros(); 3 * super::degree::MAX_DEGREE - 5];
    for i in 0..p - 1 {
        for j in i + 1..p {
            for l in j + 1..=p {
                let factor = ((j - i) * (l - i) * (l - j)) as f64
                    * (binomial(p, i) * binomial(p, j) * binomial(p, l));
                let weights = points[i].w * points[j].w * points[l].w;
                let cross = (offset(j) - offset(i)).cross(&(offset(l) - offset(i)));
                sums[i + j + l - 3] += cross * (factor * weights);
            }
        }
    }
    core::array::from_fn(|axis| {
        Polynomial::from_fn(degree, |k| sums[k][axis] / binomial(degree, k))
    })
}

fn squared(vector: &[Polynomial; 3]) -> Polynomial {
    vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]
}

/// Length of each vector of coefficients.
fn norms(vector: &[Polynomial; 3]) -> impl Iterator<Item = f64> + '_ {
    (0..vector[0].coefficients().len())
        .map(|k| Vector3::from_fn(|i, _| vector[i].coefficients()[k]).norm())
}
