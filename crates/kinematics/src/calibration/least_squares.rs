//! Levenberg–Marquardt over the dimensions of a mechanism.
//!
//! With the derivatives J = U Σ Vᵀ of the residuals r by the dimensions, each counted in its own unit, a step is
//! −V diag(σ/(σ² + λ)) Uᵀ r: that of Gauss and Newton where λ is small, and short downhill where it is large. λ falls
//! after a step that was one, and rises until there is one. Directions in which nothing is told have σ = 0, and no
//! step.

use super::dimensions::Model;
use super::error::CalibrationError;
use super::residuals::{Evaluated, Gathering, MeasuredPoint, MeasuringAccuracy};
use crate::{Kinematics as _, KinematicsError};
use nalgebra::{DMatrix, DVector, SVD};

/// By how much a dimension is changed for a difference, mm or degrees. Forward kinematics is exact to 1e-12 mm, and
/// bends little over this: derivatives are exact to about eight digits.
const STEP: f64 = 1e-4;
/// Steps at most; a few are taken as a rule.
const STEPS: usize = 200;
/// A step of all dimensions below which the search has settled, mm or degrees.
const SETTLED: f64 = 1e-9;
/// A share of the sum of squares below which a gain is rounding's.
const GAIN_R: f64 = 1e-13;
/// λ at the beginning and its bounds, in squares of the largest singular value.
const DAMPING: f64 = 1e-6;
const LEAST_DAMPING: f64 = 1e-16;
const MOST_DAMPING: f64 = 1e6;
/// Iterations of the decomposition at most: it takes some tens.
const DECOMPOSITION: usize = 10_000;

/// What is to be fitted to what.
pub(super) struct Problem<'a> {
    pub(super) model: &'a Model,
    pub(super) points: &'a [MeasuredPoint],
    pub(super) accuracy: MeasuringAccuracy,
}

impl Problem<'_> {
    /// The residuals with some values; or the point that no place of the tool fits.
    pub(super) fn residuals(
        &self,
        values: &DVector<f64>,
    ) -> Result<Evaluated, (usize, KinematicsError)> {
        let none = (0, KinematicsError::NoPosition);
        let mechanism = self.model.mechanism(values).ok_or(none)?;
        let zeros = self.model.zeros(values);
        let mut gathering = Gathering::default();
        for (number, point) in self.points.iter().enumerate() {
            let at = mechanism
                .forward(&(point.joints + zeros), &point.near)
                .map_err(|error| (number, error))?;
            if !at.iter().all(|coordinate| coordinate.is_finite()) {
                return Err((number, KinematicsError::NoPosition));
            }
            gathering.take(number, point, &at, &self.accuracy);
        }
        Ok(gathering.finish())
    }

    /// The derivatives of the residuals by some of the values.
    pub(super) fn derivatives(
        &self,
        values: &DVector<f64>,
        free: &[usize],
    ) -> Result<DMatrix<f64>, CalibrationError> {
        let mut columns = Vec::with_capacity(free.len());
        for place in free {
            let at = |step: f64| {
                let mut moved = values.clone();
                moved[*place] += step;
                let residuals = self.residuals(&moved);
                residuals.map_err(|_| CalibrationError::NotSettled)
            };
            let (above, below) = (at(STEP)?.weighted, at(-STEP)?.weighted);
            let pairs = above.iter().zip(&below);
            let column: Vec<f64> = pairs.map(|(a, b)| (a - b) / (2.0 * STEP)).collect();
            columns.push(DVector::from_vec(column));
        }
        Ok(DMatrix::from_columns(&columns))
    }
}

/// Derivatives as U Σ Vᵀ.
pub(super) struct Decomposed {
    pub(super) u: DMatrix<f64>,
    pub(super) singular: DVector<f64>,
    pub(super) v_t: DMatrix<f64>,
}

/// The singular values and vectors of derivatives.
pub(super) fn decomposed(derivatives: DMatrix<f64>) -> Result<Decomposed, CalibrationError> {
    let svd = SVD::try_new(derivatives, true, true, f64::EPSILON, DECOMPOSITION);
    match svd {
        Some(SVD {
            u: Some(u),
            v_t: Some(v_t),
            singular_values: singular,
        }) => Ok(Decomposed { u, singular, v_t }),
        _ => Err(CalibrationError::NotSettled),
    }
}

/// The values that fit best, of which only some are `free`.
pub(super) fn minimise(
    problem: &Problem<'_>,
    start: &DVector<f64>,
    free: &[usize],
) -> Result<DVector<f64>, CalibrationError> {
    let evaluate = |values: &DVector<f64>| {
        let residuals = problem.residuals(values).ok()?;
        Some(DVector::from_vec(residuals.weighted))
    };
    let mut values = start.clone();
    let mut residuals = evaluate(&values).ok_or(CalibrationError::NotSettled)?;
    let mut damping = DAMPING;
    for _ in 0..STEPS {
        let derivatives = problem.derivatives(&values, free)?;
        let Decomposed { u, singular, v_t } = decomposed(derivatives)?;
        let along = u.tr_mul(&residuals);
        let largest = singular.amax();
        let square = residuals.norm_squared();
        loop {
            let weight = |s: f64| s / (s * s + damping * largest * largest);
            let parts = DVector::from_fn(singular.len(), |i, _| -along[i] * weight(singular[i]));
            let step = v_t.tr_mul(&parts);
            if step.amax() < SETTLED || largest <= 0.0 {
                return Ok(values);
            }
            let mut moved = values.clone();
            for (place, part) in free.iter().zip(step.iter()) {
                moved[*place] += part;
            }
            if let Some(better) = evaluate(&moved).filter(|r| r.norm_squared() < square) {
                let gain = square - better.norm_squared();
                (values, residuals) = (moved, better);
                damping = (damping * 0.1).max(LEAST_DAMPING);
                if gain <= GAIN_R * square {
                    return Ok(values);
                }
                break;
            }
            damping *= 10.0;
            if damping > MOST_DAMPING {
                // Nothing downhill is left but rounding.
                return Ok(values);
            }
        }
    }
    Err(CalibrationError::NotSettled)
}
