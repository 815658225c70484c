//! What points do not tell of dimensions: sums of them that could have any value.

use super::dimensions::{DimensionName, Model};
use super::error::CalibrationError;
use super::least_squares::{Decomposed, Problem, decomposed};
use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest one are rounding's and that of differences.
const NOTHING_R: f64 = 1e-7;
/// A weak sum has more than this share of the largest standard deviation that counts as told.
const WEAK_R: f64 = 0.1;
/// Parts of a sum below this share of its largest one are left out.
const PART_R: f64 = 0.05;
/// A zero of a joint keeps its value before a dimension does that is as large a part of a sum: it is set by homing.
const ZERO_WEIGHT: f64 = 1.5;
/// Parts within this share count as equally large; the last of them keeps its value.
const EQUAL_R: f64 = 0.98;

/// A part of a sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DimensionPart {
    /// The dimension, by its place in the list of all.
    pub place: usize,
    /// How many times its unit it is in the sum.
    pub factor: f64,
}

/// A sum of dimensions that points tell badly or not at all: changed together in this ratio, they change nothing
/// that was measured, or little.
#[derive(Debug, Clone, PartialEq)]
pub struct DimensionSum {
    /// Its parts, of which the first has the factor 1, or the largest.
    pub parts: Vec<DimensionPart>,
    /// Standard deviation of the first part if all of them are looked for, mm or degrees; infinite where nothing is
    /// told.
    pub deviation: f64,
}

impl DimensionSum {
    /// The dimension that keeps its nominal value because of it.
    pub(super) fn kept(&self) -> usize {
        self.parts[0].place
    }
}

/// How well dimensions are told.
pub(super) struct Told {
    /// Standard deviations of those that are looked for, in their order.
    pub(super) deviations: Vec<f64>,
    pub(super) untold: Vec<DimensionSum>,
    pub(super) weak: Vec<DimensionSum>,
    pub(super) spread_r: Option<f64>,
}

impl Told {
    /// At the values that fit best.
    pub(super) fn of(
        problem: &Problem<'_>,
        values: &DVector<f64>,
        free: &[usize],
        most_deviation: f64,
    ) -> Result<Self, CalibrationError> {
        let residuals = problem
            .residuals(values)
            .map_err(|_| CalibrationError::NotSettled)?;
        let square: f64 = residuals.weighted.iter().map(|r| r * r).sum();
        let Decomposed { singular, v_t, .. } = decomposed(problem.derivatives(values, free)?)?;
        let largest = singular.amax();
        let told = singular
            .iter()
            .filter(|s| **s > NOTHING_R * largest)
            .count();
        #[allow(clippy::cast_precision_loss, reason = "a count of numbers")]
        let spare = residuals.weighted.len().saturating_sub(told) as f64;
        let spread_r = (spare > 0.0).then(|| (square / spare).sqrt().max(1.0));
        // Of sums along the singular vectors.
        let of_sum = |i: usize| {
            if singular[i] > NOTHING_R * largest {
                spread_r.unwrap_or(1.0) / singular[i]
            } else {
                f64::INFINITY
            }
        };
        let of_sums: Vec<f64> = (0..singular.len()).map(of_sum).collect();
        let deviations: Vec<f64> = (0..free.len())
            .map(|column| deviation(&of_sums, &v_t, column))
            .collect();
        // Whether it alone makes a dimension uncertain.
        let is_untold = |i: &usize| {
            let most = v_t.row(*i).amax();
            most * of_sums[*i] > most_deviation
        };
        let (untold, rest): (Vec<usize>, Vec<usize>) = (0..of_sums.len()).partition(is_untold);
        let weak = rest
            .into_iter()
            .filter(|i| of_sums[*i] > WEAK_R * most_deviation)
            .map(|i| sum(v_t.row(i).iter().copied().collect(), free, None, of_sums[i]))
            .collect();
        Ok(Self {
            untold: apart(problem.model, &v_t, &untold, free)
                .into_iter()
                .map(|(row, column)| sum(row, free, Some(column), deviations[column]))
                .collect(),
            deviations,
            weak,
            spread_r,
        })
    }
}

/// The standard deviation of a dimension from those of the sums.
fn deviation(of_sums: &[f64], v_t: &DMatrix<f64>, column: usize) -> f64 {
    let parts = of_sums.iter().enumerate().map(|(i, of_sum)| {
        let part = v_t[(i, column)];
        // Rounding is no part.
        if part.abs() > NOTHING_R {
            (part * of_sum).powi(2)
        } else {
            0.0
        }
    });
    parts.sum::<f64>().sqrt()
}

/// A sum from its factors; `first` comes first, with the factor 1.
fn sum(
    mut factors: Vec<f64>,
    free: &[usize],
    first: Option<usize>,
    deviation: f64,
) -> DimensionSum {
    if let Some(first) = first {
        let own = factors[first];
        factors.iter_mut().for_each(|factor| *factor /= own);
    }
    let largest = factors
        .iter()
        .fold(0.0_f64, |most, factor| most.max(factor.abs()));
    let mut parts: Vec<(usize, f64)> = factors
        .into_iter()
        .enumerate()
        .filter(|(_, factor)| factor.abs() >= PART_R * largest)
        .collect();
    parts.sort_by(|a, b| {
        let rank = |(column, factor): &(usize, f64)| {
            (Some(*column) == first, (factor.abs() * 1e6).round())
        };
        rank(b)
            .partial_cmp(&rank(a))
            .unwrap_or(core::cmp::Ordering::Equal)
    });
    let sign = parts.first().map_or(1.0, |(_, factor)| factor.signum());
    let part = |(column, factor): (usize, f64)| DimensionPart {
        place: free[column],
        factor: factor * sign,
    };
    DimensionSum {
        parts: parts.into_iter().map(part).collect(),
        deviation,
    }
}

/// Some singular vectors, combined so that each has a dimension that the others have not: it keeps its value, and
/// the sum says of which others it cannot be told. Rows with their own dimensions.
fn apart(
    model: &Model,
    v_t: &DMatrix<f64>,
    rows: &[usize],
    free: &[usize],
) -> Vec<(Vec<f64>, usize)> {
    let mut rows: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| v_t.row(*row).iter().copied().collect())
        .collect();
    let weight = |column: usize| match model.names()[free[column]] {
        DimensionName::Zero { .. } => ZERO_WEIGHT,
        DimensionName::Key { .. } | DimensionName::Of { .. } => 1.0,
    };
    let mut own: Vec<usize> = Vec::new();
    for row in 0..rows.len() {
        // The largest number of what is left, over all rows.
        let sizes = |column: usize| {
            let left = rows[row..].iter().map(move |r| r[column].abs());
            left.fold(0.0, f64::max) * weight(column)
        };
        let most = (0..free.len()).map(sizes).fold(0.0, f64::max);
        let pivot = (0..free.len()).rev().find(|c| sizes(*c) >= EQUAL_R * most);
        let Some(pivot) = pivot.filter(|_| most > 0.0) else {
            break;
        };
        let with_it = (row..rows.len())
            .max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()));
        rows.swap(row, with_it.unwrap_or(row));
        let unit: Vec<f64> = rows[row].iter().map(|x| x / rows[row][pivot]).collect();
        for (other, numbers) in rows.iter_mut().enumerate() {
            if other == row {
                numbers.clone_from(&unit);
                continue;
            }
            let times = numbers[pivot];
            for (number, of_unit) in numbers.iter_mut().zip(&unit) {
                *number -= times * of_unit;
            }
        }
        own.push(pivot);
    }
    rows.into_iter().zip(own).collect()
}
