//! One solve of the tube spline: the curve of least jerk for given weights, and where the samples
//! have their feet on it.
//!
//! ```text
//! minimise  ∫ |C‴|² dt  +  Σ w_j h_j |C(t_j) − Q_j|²
//! ```
//!
//! over the control points that are free, for feet t_j that are given: linear least squares. Half the
//! gradient by the control points is K·c + Σ w_j h_j N_j (N_j·c − Q_j), half the Hessian
//! K + Σ w_j h_j N_j N_jᵀ, with K the penalty's (`stiffness`) and N_j the basis at t_j: four neighbouring
//! points at most, so seven bands. It is the same for every axis. The system is solved for the increment
//! of the control points, which keeps three digits more than solving for the points themselves.
//!
//! Weights and feet are what makes it a tube: they are changed between solves ([`super::window`]), so
//! each is one banded factorisation. Bounds of the distance as constraints would need a solver for
//! inequalities; what they would be exact for is asked of the certificate anyway.
//!
//! Parameters (`_t`) are mm along the chords, nearly length of the curve, so C‴ is in 1/mm² and a weight
//! in 1/mm⁶: its sixth root is a spatial frequency, below which the curve follows the samples.

use super::banded::Banded;
use super::knots::{Basis, DEGREE, third_derivative};
use super::sample::Sample;
use super::still::StillCoordinates;
use super::vector::{add_scaled, dot, minus};

/// The share of the distance to its neighbours' feet that a foot may move in a window. Feet that
/// run free let the curve fold: it was 2.4 mm off then. Below a half no two can pass each other.
const FOOT_SHARE_R: f64 = 0.35;
/// The least square of a slope by length, which is about 1: where the curve stands still, a foot is moved
/// as far as it may be, and not by what is no number.
const LEAST_SQUARE: f64 = 1e-12;

/// The spline of a window, and what is needed to fit it.
#[derive(Debug, Clone)]
pub(super) struct Spline<const D: usize> {
    /// Knots, those at the end repeated.
    pub(super) knots: Vec<f64>,
    pub(super) control: Vec<[f64; D]>,
    /// Matrix of the penalty.
    stiffness: Vec<[f64; 4]>,
    system: Banded<D>,
    /// Feet at the start of the fit, between which they may move.
    nominal_t: Vec<f64>,
    still: StillCoordinates<D>,
}

impl<const D: usize> Spline<D> {
    pub(super) const fn new() -> Self {
        Self {
            knots: Vec::new(),
            control: Vec::new(),
            stiffness: Vec::new(),
            system: Banded::new(),
            nominal_t: Vec::new(),
            still: StillCoordinates::new(),
        }
    }

    /// Number of spans.
    pub(super) fn spans(&self) -> usize {
        self.knots.len().saturating_sub(2 * DEGREE + 1)
    }

    /// Sets up the penalty, and the feet as they are now as the nominal ones.
    pub(super) fn prepare(&mut self, samples: &[Sample<D>]) {
        self.nominal_t.clear();
        self.nominal_t.extend(samples.iter().map(|s| s.foot_t));
        self.still.find(&self.knots, samples);
        self.stiffness.clear();
        self.stiffness.resize(self.control.len(), [0.0; 4]);
        for span in 0..self.spans() {
            // C‴ is constant on a span, so the integral is exact.
            let length_t = self.knots[span + 4] - self.knots[span + 3];
            let third = third_derivative(&self.knots, span);
            for i in 0..4 {
                for j in i..4 {
                    self.stiffness[span + i][j - i] += length_t * third[i] * third[j];
                }
            }
        }
    }

    /// Solves once, with so many control points fixed at each end, and moves the feet. The others are
    /// put inside the travel, and the curve with them: it is in their hull; and where the program leaves an
    /// axis alone.
    pub(super) fn solve(
        &mut self,
        samples: &mut [Sample<D>],
        fixed: (usize, usize),
        [lowest, highest]: &[[f64; D]; 2],
    ) {
        self.assemble(samples);
        let count = self.control.len();
        for i in (0..fixed.0.min(count)).chain(count.saturating_sub(fixed.1)..count) {
            self.system.fix(i);
        }
        self.system.solve();
        for (point, step) in self.control.iter_mut().zip(&self.system.right) {
            *point = add_scaled(point, 1.0, step);
        }
        let free = fixed.0.min(count)..count.saturating_sub(fixed.1).max(fixed.0.min(count));
        self.still.hold(&mut self.control, &free);
        for point in &mut self.control[free] {
            for i in 0..D {
                point[i] = point[i].max(lowest[i]).min(highest[i]);
            }
        }
        self.move_feet(samples);
    }

    /// Hessian and negative gradient, by halves.
    fn assemble(&mut self, samples: &[Sample<D>]) {
        let control = &self.control;
        let system = &mut self.system;
        system.rows.clear();
        system.rows.extend_from_slice(&self.stiffness);
        system.right.clear();
        system.right.resize(control.len(), [0.0; D]);
        for (i, row) in self.stiffness.iter().enumerate() {
            let mut sum = add_scaled(&system.right[i], -row[0], &control[i]);
            for j in 1..4.min(control.len() - i) {
                sum = add_scaled(&sum, -row[j], &control[i + j]);
                system.right[i + j] = add_scaled(&system.right[i + j], -row[j], &control[i]);
            }
            system.right[i] = sum;
        }
        let mut span = 0;
        for (j, sample) in samples.iter().enumerate().skip(1) {
            span = span_of(&self.knots, sample.foot_t, span);
            let next_t = samples.get(j + 1).map_or(sample.spacing_t, |s| s.spacing_t);
            let weight = sample.weight * 0.5 * (sample.spacing_t + next_t);
            let basis = Basis::at(&self.knots, span, sample.foot_t).value;
            let mut residual = sample.point;
            for i in 0..4 {
                residual = add_scaled(&residual, -basis[i], &control[span + i]);
            }
            for i in 0..4 {
                let weighted = weight * basis[i];
                for (slot, value) in system.rows[span + i].iter_mut().zip(&basis[i..]) {
                    *slot += weighted * value;
                }
                let right = &mut system.right[span + i];
                *right = add_scaled(right, weighted, &residual);
            }
        }
    }

    /// Moves the feet to where the samples are nearest, one Gauss-Newton step each. What a foot was kept
    /// from going counts as error, or samples held back would seem to be on the curve.
    fn move_feet(&self, samples: &mut [Sample<D>]) {
        let last = samples.len().saturating_sub(1);
        let least_t = self.knots[DEGREE];
        let mut span = 0;
        for (j, sample) in samples.iter_mut().enumerate().skip(1) {
            span = span_of(&self.knots, sample.foot_t, span);
            let basis = Basis::at(&self.knots, span, sample.foot_t);
            let (point, slope) = basis.apply(&self.control[span..]);
            let residual = minus(&sample.point, &point);
            let square = dot(&slope, &slope).max(LEAST_SQUARE);
            let along = dot(&residual, &slope);
            let mut error_mm2 = (dot(&residual, &residual) - along * along / square).max(0.0);
            if j < last {
                let nominal_t = self.nominal_t[j];
                let wanted_t = sample.foot_t + along / square;
                let low_t = nominal_t - FOOT_SHARE_R * (nominal_t - self.nominal_t[j - 1]);
                let high_t = nominal_t + FOOT_SHARE_R * (self.nominal_t[j + 1] - nominal_t);
                let foot_t = wanted_t.max(low_t).min(high_t).max(least_t);
                let missed_t = wanted_t - foot_t;
                error_mm2 += missed_t * missed_t * square;
                sample.foot_t = foot_t;
            }
            sample.error_mm = error_mm2.sqrt();
        }
    }

    /// Point and slope at a parameter of a span.
    #[inline]
    pub(super) fn at(&self, span: usize, t: f64) -> ([f64; D], [f64; D]) {
        Basis::at(&self.knots, span, t).apply(&self.control[span..])
    }
}

/// The span of a parameter, not before another.
#[inline]
pub(super) fn span_of(knots: &[f64], t: f64, not_before: usize) -> usize {
    let last = knots.len().saturating_sub(2 * DEGREE + 2);
    let mut span = not_before;
    while span < last && t > knots[span + 4] {
        span += 1;
    }
    span
}
