//! One knot span of a NURBS as a rational Bézier curve.

use super::degree::MAX_DEGREE;
use super::jet::NurbsJet;
use crate::{AXES, AxisVector};
use nalgebra::SVector;

/// Control points of the highest degree.
pub(super) const POINTS: usize = MAX_DEGREE + 1;

/// Homogeneous coordinates in the three axes that measure the feed: (w·p, w).
pub(super) type Feed4 = SVector<f64, 4>;
/// Homogeneous coordinates in all axes.
type Axes10 = SVector<f64, 10>;

/// A piece of a NURBS between two neighbouring knots: rational, and infinitely smooth inside.
///
/// Its points are kept relative to the first of them, so that a curve far from zero loses no digits
/// in its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    pub(super) from_u: f64,
    pub(super) to_u: f64,
    pub(super) degree: usize,
    origin: AxisVector,
    /// (w·(P − origin), w), all axes.
    axes: [Axes10; POINTS],
    /// The same in the axes that measure the feed.
    feed: [Feed4; POINTS],
}

impl Span {
    /// A span from homogeneous Bézier points (w·P, w) with P relative to `origin`; `group` is the
    /// first of the three axes that measure the feed.
    pub(super) fn new(
        domain: (f64, f64),
        degree: usize,
        origin: AxisVector,
        homogeneous: &[(AxisVector, f64)],
        group: usize,
    ) -> Self {
        let mut axes = [Axes10::zeros(); POINTS];
        let mut feed = [Feed4::zeros(); POINTS];
        let shift = homogeneous
            .first()
            .map_or_else(AxisVector::zeros, |(point, weight)| point / *weight);
        for ((axes, feed), (point, weight)) in axes.iter_mut().zip(&mut feed).zip(homogeneous) {
            let relative = point - shift * *weight;
            for axis in 0..AXES {
                axes[axis] = relative[axis];
            }
            axes[AXES] = *weight;
            *feed = Feed4::new(
                relative[group],
                relative[group + 1],
                relative[group + 2],
                *weight,
            );
        }
        Self {
            from_u: domain.0,
            to_u: domain.1,
            degree,
            origin: origin + shift,
            axes,
            feed,
        }
    }

    /// Parameter at the start.
    #[must_use]
    pub const fn from_u(&self) -> f64 {
        self.from_u
    }

    /// Parameter at the end, greater than [`Self::from_u`].
    #[must_use]
    pub const fn to_u(&self) -> f64 {
        self.to_u
    }

    /// Local parameter, 0 at the start and 1 at the end.
    pub(super) fn local(&self, u: f64) -> f64 {
        ((u - self.from_u) / (self.to_u - self.from_u)).clamp(0.0, 1.0)
    }

    /// Homogeneous points in the axes that measure the feed, relative to the first.
    pub(super) fn feed_points(&self) -> &[Feed4] {
        &self.feed[..=self.degree]
    }

    /// Position and derivatives by `u`, which is clamped to the span; at its ends those of its
    /// side.
    #[must_use]
    pub fn jet(&self, u: f64) -> NurbsJet {
        let h = self.to_u - self.from_u;
        let homogeneous = derivatives(&self.axes, self.degree, self.local(u));
        let a: [AxisVector; 4] = homogeneous.map(|v| v.fixed_rows::<AXES>(0).into_owned());
        let w = homogeneous.map(|v| v[AXES]);
        let position = a[0] / w[0];
        let d1 = (a[1] - position * w[1]) / w[0];
        let d2 = (a[2] - d1 * (2.0 * w[1]) - position * w[2]) / w[0];
        let d3 = (a[3] - d2 * (3.0 * w[1]) - d1 * (3.0 * w[2]) - position * w[3]) / w[0];
        NurbsJet {
            position: self.origin + position,
            d1: d1 / h,
            d2: d2 / (h * h),
            d3: d3 / (h * h * h),
        }
    }

    /// ds/du and d²s/du².
    pub(super) fn speed_and_change(&self, u: f64) -> (f64, f64) {
        let h = self.to_u - self.from_u;
        let [a, a1, a2, _] = derivatives(&self.feed, self.degree, self.local(u));
        let c = a.xyz() / a.w;
        let d1 = (a1.xyz() - c * a1.w) / a.w;
        let d2 = (a2.xyz() - d1 * (2.0 * a1.w) - c * a2.w) / a.w;
        let speed = d1.norm();
        (speed / h, d1.dot(&d2) / (speed * h * h))
    }

    /// Length of the first derivative by `u` in the axes that measure the feed: ds/du, ≥ 0.
    pub(super) fn speed(&self, u: f64) -> f64 {
        let t = self.local(u);
        let mut p = self.feed;
        for level in (1..self.degree).rev() {
            for i in 0..=level {
                p[i] += (p[i + 1] - p[i]) * t;
            }
        }
        let derivative = p[1] - p[0];
        let value = p[0] + derivative * t;
        // C' = (A'w − Aw')/w², and with the last two points of the scheme, (a0, w0) and (a1, w1),
        // the numerator is degree·(a1·w0 − a0·w1) for every t.
        let numerator = (p[1].xyz() * p[0].w - p[0].xyz() * p[1].w) * self.degree as f64;
        numerator.norm() / (value.w * value.w * (self.to_u - self.from_u))
    }
}

/// Value and three derivatives by the local parameter of a Bézier curve: de Casteljau's scheme,
/// whose last columns hold the differences the derivatives are made of.
fn derivatives<const D: usize>(
    points: &[SVector<f64, D>; POINTS],
    degree: usize,
    t: f64,
) -> [SVector<f64, D>; 4] {
    let mut p = *points;
    let mut result = [SVector::zeros(); 4];
    let n = degree as f64;
    for level in (0..=degree).rev() {
        // Here p[0..=level] is the column of the scheme whose r-th differences, r = level, give the
        // derivative of that order.
        match level {
            3 => {
                let third = p[3] - (p[2] - p[1]) * 3.0 - p[0];
                result[3] = third * (n * (n - 1.0) * (n - 2.0));
            }
            2 => result[2] = (p[2] - p[1] * 2.0 + p[0]) * (n * (n - 1.0)),
            1 => result[1] = (p[1] - p[0]) * n,
            0 => result[0] = p[0],
            _ => {}
        }
        for i in 0..level {
            p[i] = p[i] + (p[i + 1] - p[i]) * t;
        }
    }
    result
}
