//! The compensation of axes across each other: squareness, straightness and sag.
//!
//! ```text
//! m = q + Σ e(p)      q: where an axis is to be      m: where its joint is to be
//!                     p: where another axis is to be      e: what the one is off by there
//! ```
//!
//! A machine whose Y leans towards X is off in X by a share of Y, and one whose guide sags is off in Z by a curve of X. So
//! each table adds to one axis what depends on the place of another: a straight line for squareness, a natural cubic
//! [spline](super::compensation) for what was measured. SINUMERIK calls it CEC, ISG cross compensation.
//!
//! **The limits hold for the joints.** What another axis adds, at its own highest velocity, acceleration and jerk, is kept
//! back of the limits of the one that it is added to, and its largest amounts of the travel. So whatever the axes do
//! inside of what is [left](CrossCompensation::left), the joints keep to their own.
//!
//! **Back** from joints to axes q = m − Σ e(p) is iterated. No axis gets more than a hundredth of what others move, so
//! each step makes the error a hundred times smaller.

use crate::JointLimit;
use crate::compensation::{
    CompensationError, LEAST_LEFT, MOST_POINTS, SPARE, STEEPEST, Spline, ascends,
};
use crate::machine::AxisSeries;
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{AXES, Axis, AxisVector};

/// Steps from joints to axes: the corrections, of 10 mm at most, times a hundredth to the power of this.
const STEPS: usize = 8;

/// What is added to an axis, by where another one is.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossTable {
    /// The axis that is corrected.
    pub corrected: Axis,
    /// The axis that the correction goes along.
    pub along: Axis,
    /// Its places, ascending, each with what is added to the corrected axis there; mm or degrees.
    pub points: Vec<(f64, f64)>,
}

/// A table at work.
#[derive(Debug, Clone, PartialEq)]
struct Correction {
    corrected: usize,
    along: usize,
    spline: Spline,
}

/// The compensation of the axes of a machine across each other.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossCompensation {
    corrections: Box<[Correction]>,
    /// What the joint of each corrected axis may do.
    joints: [Option<JointLimit>; AXES],
    /// What the axis may do, so that its joint keeps to that.
    left: [Option<JointLimit>; AXES],
}

impl CrossCompensation {
    /// The compensation by tables, for axes with the limits of their joints, the travel as `min_position` and
    /// `max_position`.
    ///
    /// # Errors
    /// What is wrong, and with which of the tables, from 0.
    pub fn new(
        tables: &[CrossTable],
        limits: &[(Axis, JointLimit)],
    ) -> Result<Self, (usize, CompensationError)> {
        for (number, table) in tables.iter().enumerate() {
            let points = &table.points;
            if points.len() < 2 || points.len() > MOST_POINTS {
                return Err((number, CompensationError::Points(points.len())));
            }
            ascends(points.iter().map(|(place, _)| *place)).map_err(|error| (number, error))?;
        }
        let correction = |table: &CrossTable| Correction {
            corrected: table.corrected.index(),
            along: table.along.index(),
            spline: Spline::through(&table.points),
        };
        let mut it = Self {
            corrections: tables.iter().map(correction).collect(),
            joints: [None; AXES],
            left: [None; AXES],
        };
        let mut all = [JointLimit::NONE; AXES];
        for (axis, limit) in limits {
            all[axis.index()] = *limit;
        }
        for (number, table) in tables.iter().enumerate() {
            // Of several tables of an axis the last one is that with which it is too much.
            let axis = table.corrected.index();
            let of_axis = tables[..=number].iter().zip(&it.corrections);
            let of_axis = of_axis.filter(|(other, _)| other.corrected == table.corrected);
            let of_axis: Vec<&Correction> = of_axis.map(|(_, correction)| correction).collect();
            let left = left(&of_axis, &all).map_err(|error| (number, error))?;
            it.joints[axis] = Some(all[axis]);
            it.left[axis] = Some(left);
        }
        Ok(it)
    }

    /// What the joint of an axis may do, if the axis is corrected.
    #[must_use]
    pub fn joint(&self, axis: Axis) -> Option<&JointLimit> {
        self.joints[axis.index()].as_ref()
    }

    /// What an axis may do so that its joint keeps its limits and its travel, whatever the others do, if it is corrected.
    #[must_use]
    pub fn left(&self, axis: Axis) -> Option<&JointLimit> {
        self.left[axis.index()].as_ref()
    }

    /// Position, velocity and acceleration of the joints of axes for those of the axes.
    #[must_use]
    pub(crate) fn told(&self, rates: [&AxisVector; 3]) -> [AxisVector; 3] {
        let mut told = rates.map(|rates| *rates);
        for (k, added) in self.added(rates).into_iter().enumerate() {
            told[k] += added;
        }
        told
    }

    /// The same along a curve. What carries an enclosure has to lie between two points of a table.
    pub(crate) fn told_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> AxisSeries<N, T> {
        let mut added = [Series::constant(0.0); AXES];
        for correction in &self.corrections {
            let of_axis = &mut added[correction.corrected];
            *of_axis = *of_axis + correction.spline.along(axes[correction.along]);
        }
        core::array::from_fn(|axis| axes[axis] + added[axis])
    }

    /// Position, velocity and acceleration of axes for those of their joints.
    #[must_use]
    pub(crate) fn nominal(&self, told: [&AxisVector; 3]) -> [AxisVector; 3] {
        let mut axes = told.map(|rates| *rates);
        for _ in 0..STEPS {
            let added = self.added([&axes[0], &axes[1], &axes[2]]);
            axes = core::array::from_fn(|k| told[k] - added[k]);
        }
        axes
    }

    /// What is added to positions, velocities and accelerations: e, e′ v, e′ a + e″ v².
    fn added(&self, [q, v, a]: [&AxisVector; 3]) -> [AxisVector; 3] {
        let mut added = [AxisVector::zeros(); 3];
        for Correction {
            corrected,
            along,
            spline,
        } in &self.corrections
        {
            let at = spline.at(q[*along]);
            let (v, a) = (v[*along], a[*along]);
            added[0][*corrected] += at.value;
            added[1][*corrected] += at.first * v;
            added[2][*corrected] += at.first * a + at.second * v * v;
        }
        added
    }
}

/// What is left for an axis by its corrections: m′ = q′ + Σ e′ p′, and so on twice more, with every term at its largest
/// amount.
fn left(
    corrections: &[&Correction],
    all: &[JointLimit; AXES],
) -> Result<JointLimit, CompensationError> {
    let Some(first) = corrections.first() else {
        return Ok(JointLimit::NONE);
    };
    let joint = all[first.corrected];
    let mut steepest = 0.0;
    let (mut taken, mut range) = ([0.0; 3], [0.0; 2]);
    for Correction { along, spline, .. } in corrections {
        let [s1, s2, s3] = spline.most();
        let other = &all[*along];
        let (v, a, j) = (other.velocity, other.acceleration, other.jerk);
        steepest += s1;
        let shares = [
            product(s1, v),
            product(s1, a) + product(s2, v * v),
            product(s1, j) + 3.0 * product(s2, v * a) + product(s3, v * v * v),
        ];
        for (taken, share) in taken.iter_mut().zip(shares) {
            *taken += share;
        }
        let [lowest, highest] = spline.range(other.min_position, other.max_position);
        range = [range[0] + lowest, range[1] + highest];
    }
    if steepest > STEEPEST {
        return Err(CompensationError::TooSteep(steepest));
    }
    let all = [
        ("velocity", joint.velocity),
        ("acceleration", joint.acceleration),
        ("jerk", joint.jerk),
    ];
    let mut rates = [0.0; 3];
    for (k, (quantity, of)) in all.into_iter().enumerate() {
        rates[k] = (1.0 - SPARE) * of - taken[k];
        if rates[k] < LEAST_LEFT * of {
            let left_percent = 100.0 * rates[k].max(0.0) / of;
            return Err(CompensationError::TooRough {
                quantity,
                left_percent,
            });
        }
    }
    let [velocity, acceleration, jerk] = rates;
    Ok(JointLimit {
        min_position: joint.min_position - range[0].min(0.0),
        max_position: joint.max_position - range[1].max(0.0),
        velocity,
        acceleration,
        jerk,
    })
}

/// A product in which a line takes nothing, however fast the axis along it is.
fn product(slope: f64, rate: f64) -> f64 {
    if slope == 0.0 { 0.0 } else { slope * rate }
}

#[cfg(test)]
mod tests;
