//! Calibration: the dimensions of a mechanism from points that were measured.
//!
//! A point has the joints as they said where they were, and where the tool was found. The dimensions are
//! those with which forward kinematics brings the tool nearest to where it was found, in the sense of least
//! squares, each measured number divided by the accuracy it was measured with:
//!
//! ```text
//!   minimise Σ ((forward(q + zeros; dimensions) − measured) / accuracy)²       Levenberg–Marquardt
//! ```
//!
//! Beside the dimensions of the mechanism's table, each joint has a *zero*: by how much it is further than it says.
//!
//! Points do not tell everything. What they do not tell is in the singular vectors of the derivatives: a sum of
//! dimensions along one with singular value σ has the standard deviation 1/σ. Where that is more than is asked for,
//! one of the dimensions in the sum keeps its nominal value, and the others are found anew with that
//! ([`untold`]).

mod dimensions;
mod error;
mod least_squares;
mod residuals;
mod untold;

pub use dimensions::{DimensionName, DimensionUnit};
pub use error::CalibrationError;
pub use residuals::{MeasuredPoint, MeasuringAccuracy, PointResiduals, ResidualSize};
pub use untold::{DimensionPart, DimensionSum};

use crate::{JointVector, Mechanism};
use dimensions::Model;
use least_squares::{Problem, minimise};
use nalgebra::DVector;
use untold::Told;

/// What is asked of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationSettings {
    /// How accurately was measured.
    pub accuracy: MeasuringAccuracy,
    /// Largest standard deviation with which a dimension counts as told, mm or degrees, > 0.
    pub most_deviation: f64,
    /// Dimensions that keep their nominal values, by their places in the list of all.
    pub held: Vec<usize>,
}

/// A dimension as it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundDimension {
    /// Its name.
    pub name: DimensionName,
    /// The value before, mm or degrees.
    pub nominal: f64,
    /// The value that fits the points; the nominal one if it was kept.
    pub value: f64,
    /// Standard deviation of the value; `None` if it was kept.
    pub deviation: Option<f64>,
}

/// The result of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The mechanism with the dimensions that were found.
    pub mechanism: Mechanism,
    /// What each joint is further than it says, mm or degrees.
    pub zeros: JointVector,
    /// All dimensions in their order, those of the mechanism's table first.
    pub dimensions: Vec<FoundDimension>,
    /// What the points do not tell: each sum kept one of its dimensions at its nominal value.
    pub untold: Vec<DimensionSum>,
    /// What they tell with a standard deviation of more than a tenth of what is asked for.
    pub weak: Vec<DimensionSum>,
    /// With nominal dimensions.
    pub before: PointResiduals,
    /// With those that were found.
    pub after: PointResiduals,
    /// How many numbers were measured.
    pub numbers: usize,
    /// How many times the stated accuracy the points are off as they are; at least 1. `None` if as many
    /// dimensions were found as numbers were measured: nothing is left to tell.
    pub spread_r: Option<f64>,
}

/// The names of all dimensions of a mechanism and of its joints' zeros, in the order of
/// [`Calibration::dimensions`]; empty where the joints are the axes.
#[must_use]
pub fn dimension_names(mechanism: &Mechanism) -> Vec<DimensionName> {
    Model::new(mechanism).map_or_else(Vec::new, |model| model.names().to_vec())
}

/// The dimensions of a mechanism that fit points best.
///
/// # Errors
/// The points give none.
pub fn calibrate(
    mechanism: &Mechanism,
    points: &[MeasuredPoint],
    settings: &CalibrationSettings,
) -> Result<Calibration, CalibrationError> {
    let model = Model::new(mechanism).ok_or(CalibrationError::NoDimensions)?;
    let nominal = model.values();
    let problem = Problem {
        model: &model,
        points,
        accuracy: settings.accuracy,
    };
    let before = problem
        .residuals(&nominal)
        .map_err(|(point, error)| CalibrationError::Unreachable { point, error })?;
    let numbers = before.weighted.len();
    let mut free: Vec<usize> = (0..nominal.len())
        .filter(|place| !settings.held.contains(place))
        .collect();
    if numbers < free.len() {
        return Err(CalibrationError::TooFew {
            numbers,
            dimensions: free.len(),
        });
    }
    let mut values = nominal.clone();
    let mut untold: Vec<DimensionSum> = Vec::new();
    // Each round keeps one dimension more, or is the last.
    loop {
        if free.is_empty() {
            return Err(CalibrationError::NothingTold);
        }
        values = minimise(&problem, &values, &free)?;
        let told = Told::of(&problem, &values, &free, settings.most_deviation)?;
        if told.untold.is_empty() {
            let after = problem
                .residuals(&values)
                .map_err(|_| CalibrationError::NotSettled)?;
            return Ok(Calibration {
                mechanism: model
                    .mechanism(&values)
                    .ok_or(CalibrationError::NotSettled)?,
                zeros: model.zeros(&values),
                dimensions: found(&model, (&nominal, &values), &free, &told),
                untold,
                weak: told.weak,
                before: before.summary,
                after: after.summary,
                numbers,
                spread_r: told.spread_r,
            });
        }
        for sum in told.untold {
            free.retain(|place| *place != sum.kept());
            values[sum.kept()] = nominal[sum.kept()];
            untold.push(sum);
        }
    }
}

fn found(
    model: &Model,
    (nominal, values): (&DVector<f64>, &DVector<f64>),
    free: &[usize],
    told: &Told,
) -> Vec<FoundDimension> {
    let names = model.names().iter().enumerate();
    names
        .map(|(place, name)| FoundDimension {
            name: *name,
            nominal: nominal[place],
            value: values[place],
            deviation: free
                .iter()
                .position(|known| *known == place)
                .map(|column| told.deviations[column]),
        })
        .collect()
}
