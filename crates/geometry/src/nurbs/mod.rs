//! NURBS: rational B-spline curves over all axes.
//!
//! ```text
//!            Σ N_i(u)·w_i·P_i        control points P_i, weights w_i > 0, knots u_0 ≤ u_1 ≤ …;
//!   C(u) =  ──────────────────       N_i the B-splines of degree p over the knots;
//!            Σ N_i(u)·w_i            the curve runs over [u_p, u_(m−p)], m the last knot's index
//! ```
//!
//! When a curve is made, every interior knot is inserted until it is there p times. What comes out
//! is one rational Bézier curve for each knot span, and everything is computed on those:
//! evaluation needs no basis functions and no search but that of the span, never allocates, and
//! inside a span the curve is smooth, so that curvature has polynomials (see [`SpanCurvature`]).
//!
//! The *feed length* of a curve is measured as for every segment: in X, Y, Z if one of them moves,
//! else in U, V, W, else in degrees of A, B, C. Speed, curvature and arc length are those of the
//! curve in these three axes; the others move along.
//!
//! Source: Piegl, Tiller, *The NURBS Book*, 2nd edition, chapters 4 and 5.

mod arc_length;
mod curvature;
mod degree;
mod error;
mod jet;
mod pieces;
mod polynomial;
mod range;
mod span;

pub use arc_length::NurbsPath;
pub use curvature::SpanCurvature;
pub use degree::MAX_DEGREE;
pub use error::NurbsError;
pub use jet::NurbsJet;
use range::{LEAST_DOMAIN, LEAST_WEIGHT, MOST_KNOT, MOST_MM, MOST_WEIGHT};
pub use span::Span;

use crate::segment::ROUNDING_MM;
use crate::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};
use core::ops::Range;

/// A rational B-spline curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Nurbs {
    degree: usize,
    control_points: Vec<AxisVector>,
    weights: Vec<f64>,
    knots: Vec<f64>,
    spans: Vec<Span>,
    group: Range<usize>,
}

impl Nurbs {
    /// A curve of degree 1 to [`MAX_DEGREE`] with one weight for each control point, and control
    /// points + degree + 1 knots. Control points in mm and degrees. The ends need not be clamped:
    /// the curve runs between the (degree + 1)-th knot from either end.
    ///
    /// # Errors
    /// Whatever makes these numbers no continuous curve.
    pub fn new(
        degree: usize,
        control_points: &[AxisVector],
        weights: &[f64],
        knots: &[f64],
    ) -> Result<Self, NurbsError> {
        check_counts(degree, control_points.len(), weights.len(), knots.len())?;
        check_values(control_points, weights, knots)?;
        check_ranges(control_points, weights, knots)?;
        check_knots(degree, knots)?;
        let group = feed_group(control_points);
        let mut curve = Self {
            degree,
            control_points: control_points.to_vec(),
            weights: weights.to_vec(),
            knots: knots.to_vec(),
            spans: Vec::new(),
            group,
        };
        curve.spans = curve.extract_spans()?;
        Ok(curve)
    }

    /// The degree, 1 to [`MAX_DEGREE`].
    #[must_use]
    pub const fn degree(&self) -> usize {
        self.degree
    }

    /// The control points, mm and degrees.
    #[must_use]
    pub fn control_points(&self) -> &[AxisVector] {
        &self.control_points
    }

    /// The weights, one for each control point, all positive.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The knots, never descending.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The knot spans in order, at least one; each begins where the one before it ends.
    #[must_use]
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// The three axes that measure the feed.
    #[must_use]
    pub fn feed_axes(&self) -> Range<usize> {
        self.group.clone()
    }

    /// First and last parameter.
    #[must_use]
    pub fn domain(&self) -> (f64, f64) {
        (
            self.knots[self.degree],
            self.knots[self.knots.len() - 1 - self.degree],
        )
    }

    /// Position and derivatives at `u`, which is clamped to the curve. At an interior knot the
    /// derivatives are those of the right-hand side.
    #[must_use]
    pub fn jet(&self, u: f64) -> NurbsJet {
        self.spans[self.span_index(u)].jet(u)
    }

    /// ds/du ≥ 0: the length of the first derivative in the axes that measure the feed.
    #[must_use]
    pub fn speed(&self, u: f64) -> f64 {
        self.spans[self.span_index(u)].speed(u)
    }

    /// Curvature in the axes that measure the feed, 1/mm, ≥ 0; infinite where the curve stands
    /// still and is not straight. At an interior knot that of the right-hand side.
    #[must_use]
    pub fn curvature(&self, u: f64) -> f64 {
        let jet = self.jet(u);
        let first = self.group.start;
        let (d1, d2) = (jet.d1.fixed_rows::<3>(first), jet.d2.fixed_rows::<3>(first));
        let turning = d1.cross(&d2).norm();
        if turning > 0.0 {
            turning / d1.norm().powi(3)
        } else {
            0.0
        }
    }

    /// Index of the span that holds `u`; of two, the right one.
    pub(crate) fn span_index(&self, u: f64) -> usize {
        self.spans
            .partition_point(|span| span.from_u <= u)
            .saturating_sub(1)
    }

    fn extract_spans(&self) -> Result<Vec<Span>, NurbsError> {
        let (p, knots) = (self.degree, &self.knots);
        let mut spans: Vec<Span> = Vec::new();
        let mut last: Option<(AxisVector, f64)> = None;
        for k in p..knots.len() - 1 - p {
            let (from_u, to_u) = (knots[k], knots[k + 1]);
            if from_u >= to_u {
                continue;
            }
            let origin = self.control_points[k - p];
            let mut points: Vec<(AxisVector, f64)> =
                (0..=p).map(|ends| self.blossom(k, ends, origin)).collect();
            // Neighbours meet exactly, not only within rounding.
            if let Some((point, weight)) = last {
                points[0] = (point - origin * weight, weight);
            }
            last = points.last().map(|(a, w)| (a + origin * *w, *w));
            let stands = points.iter().all(|(a, w)| {
                let offset = a / *w - points[0].0 / points[0].1;
                self.group.clone().all(|i| offset[i].abs() <= ROUNDING_MM)
            });
            if stands {
                return Err(NurbsError::StandsStill { from_u, to_u });
            }
            let start = self.group.start;
            spans.push(Span::new((from_u, to_u), p, origin, &points, start));
        }
        Ok(spans)
    }

    /// Bézier point number `ends` of span `k`, homogeneous and relative to `origin`: what remains
    /// of the control points when knots are inserted at the start of the span and, `ends` times,
    /// at its end.
    fn blossom(&self, k: usize, ends: usize, origin: AxisVector) -> (AxisVector, f64) {
        let (p, knots) = (self.degree, &self.knots);
        let mut d = [(AxisVector::zeros(), 0.0); MAX_DEGREE + 1];
        for (j, slot) in d.iter_mut().enumerate().take(p + 1) {
            let i = k - p + j;
            let weight = self.weights[i];
            *slot = ((self.control_points[i] - origin) * weight, weight);
        }
        for r in 1..=p {
            let u = if r <= p - ends {
                knots[k]
            } else {
                knots[k + 1]
            };
            for j in (r..=p).rev() {
                let i = k - p + j;
                let (low, high) = (knots[i], knots[i + p + 1 - r]);
                let share = (u - low) / (high - low);
                d[j] = (
                    d[j - 1].0 * (1.0 - share) + d[j].0 * share,
                    d[j - 1].1 * (1.0 - share) + d[j].1 * share,
                );
            }
        }
        d[p]
    }
}

/// The group of three axes in which the control points differ, in the order of precedence.
fn feed_group(points: &[AxisVector]) -> Range<usize> {
    let extent = |group: &Range<usize>| {
        points.iter().fold(0.0_f64, |largest, point| {
            let offset = point - points[0];
            group
                .clone()
                .fold(largest, |largest, i| largest.max(offset[i].abs()))
        })
    };
    [LINEAR_XYZ, UVW, ROTARY_ABC]
        .into_iter()
        .find(|group| extent(group) > ROUNDING_MM)
        .unwrap_or(LINEAR_XYZ)
}

fn check_counts(
    degree: usize,
    points: usize,
    weights: usize,
    knots: usize,
) -> Result<(), NurbsError> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(NurbsError::Degree { degree });
    }
    if points <= degree {
        return Err(NurbsError::TooFewPoints { points, degree });
    }
    if weights != points {
        return Err(NurbsError::WeightCount { weights, points });
    }
    let expected = points + degree + 1;
    if knots != expected {
        return Err(NurbsError::KnotCount { knots, expected });
    }
    Ok(())
}

fn check_values(points: &[AxisVector], weights: &[f64], knots: &[f64]) -> Result<(), NurbsError> {
    let finite = |point: &AxisVector| point.iter().all(|x| x.is_finite());
    if let Some(index) = points.iter().position(|point| !finite(point)) {
        return Err(NurbsError::Point { index });
    }
    let positive = |weight: f64| weight > 0.0 && weight.is_finite();
    if let Some((index, &weight)) = weights.iter().enumerate().find(|(_, w)| !positive(**w)) {
        return Err(NurbsError::Weight { index, weight });
    }
    let before = |index: usize| index.checked_sub(1).map_or(f64::NEG_INFINITY, |i| knots[i]);
    let wrong = |index: usize, knot: f64| !knot.is_finite() || knot < before(index);
    if let Some((index, &knot)) = knots.iter().enumerate().find(|(i, k)| wrong(*i, **k)) {
        return Err(NurbsError::KnotOrder { index, knot });
    }
    Ok(())
}

/// Refuses numbers that are out of their range. All of them are finite.
fn check_ranges(points: &[AxisVector], weights: &[f64], knots: &[f64]) -> Result<(), NurbsError> {
    if let Some(index) = points.iter().position(|point| point.amax() > MOST_MM) {
        return Err(NurbsError::FarPoint { index });
    }
    let is_light = |weight: f64| !(LEAST_WEIGHT..=MOST_WEIGHT).contains(&weight);
    if let Some((index, &weight)) = weights.iter().enumerate().find(|(_, w)| is_light(**w)) {
        return Err(NurbsError::WeightRange { index, weight });
    }
    let is_far = |knot: f64| knot.abs() > MOST_KNOT;
    if let Some((index, &knot)) = knots.iter().enumerate().find(|(_, k)| is_far(**k)) {
        return Err(NurbsError::KnotRange { index, knot });
    }
    Ok(())
}

fn check_knots(degree: usize, knots: &[f64]) -> Result<(), NurbsError> {
    let (first, last) = (degree, knots.len() - 1 - degree);
    let (start, end) = (knots[first], knots[last]);
    if start >= end {
        return Err(NurbsError::EmptyDomain { first, last });
    }
    if end - start < LEAST_DOMAIN {
        return Err(NurbsError::ShortDomain {
            from_u: start,
            to_u: end,
        });
    }
    let inside = knots
        .chunk_by(|a, b| a.total_cmp(b).is_eq())
        .filter(|run| run[0] > start && run[0] < end);
    for run in inside {
        if run.len() > degree {
            return Err(NurbsError::KnotMultiplicity {
                knot: run[0],
                multiplicity: run.len(),
                degree,
            });
        }
    }
    Ok(())
}
