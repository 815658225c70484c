//! The speed along a path at which joints keep their limits whatever the axes do within theirs.
//!
//! With the direction d of the path, |ẋ| along it v, and axes that keep their accelerations A_k and
//! jerks J_k,
//!
//! ```text
//!   |q̇| ≤ |J d| v                                                              ≤ V
//!   |q̈| ≤ Σ_k |J_k| A_k + |dᵀH d| v²                                            ≤ A
//!   |q⃛| ≤ Σ_k |J_k| J_k + 3 Σ_k |H d|_k A_k v + |T d d d| v³                     ≤ J
//! ```
//!
//! with H and T the second and third derivatives of a joint by the axes. The first terms of the
//! last two lines are kept below the limits by [`AxisShare`](crate::AxisShare); the rest is what
//! the speed may take. The acceleration of the axes that a curve itself asks for is in the first
//! terms.

use crate::{
    AxisRates, JOINTS, JointLimits, JointVector, Kinematics as _, KinematicsError, Mechanism,
    axis_series,
};
use glidepath_geometry::{AXES, AxisVector, LINEAR_XYZ, ROTARY_ABC};
use nalgebra::SMatrix;

/// Part of every limit that is left for what these bounds do not see: the change of derivatives
/// between places, the tolerance of the path, differences in place of derivatives.
const SPARE_R: f64 = 0.01;
/// The same of the velocities where rotary axes turn along with linear ones: the feed is that of
/// the linear ones, and within the tolerance the others may for moments be faster than along the
/// path.
const TURNING_SPARE_R: f64 = 0.05;
/// Least part of a limit that is used for bends where axes leave none.
const LEAST_R: f64 = 0.01;

type Square = SMatrix<f64, AXES, AXES>;

/// The mechanism, its limits and the axes' rates, from which speeds along a path are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathCaps {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What its joints can do.
    pub limits: JointLimits,
    /// What the axes do at most.
    pub rates: AxisRates,
}

/// The direction of a path, as far as it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading {
    /// Change of every axis per path position.
    pub d1: AxisVector,
    /// How much the linear axes together may differ from that.
    pub linear_spread: f64,
    /// The same of the rotary axes, degrees per path position.
    pub rotary_spread: f64,
}

/// The caps at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceCaps {
    caps: PathCaps,
    jacobian: SMatrix<f64, JOINTS, AXES>,
    /// What the axes leave of accelerations and jerks of the joints.
    left_a: JointVector,
    left_j: JointVector,
    /// H of every joint.
    bends: Box<[Square; JOINTS]>,
}

impl PathCaps {
    /// The caps at a place; they hardly change over a millimetre or a degree.
    ///
    /// # Errors
    /// A position out of reach.
    pub fn at(&self, place: &AxisVector) -> Result<PlaceCaps, KinematicsError> {
        let jacobian = self.mechanism.jacobian(place)?;
        let left = |rates: &AxisVector, limit: &dyn Fn(usize) -> f64| {
            JointVector::from_fn(|i, _| {
                // An axis that the machine does not have may be said to do anything.
                let used: f64 = (0..AXES)
                    .filter(|&k| jacobian[(i, k)] != 0.0)
                    .map(|k| jacobian[(i, k)].abs() * rates[k])
                    .sum();
                ((1.0 - SPARE_R) * limit(i) - used).max(LEAST_R * limit(i))
            })
        };
        let joints = &self.limits.0;
        Ok(PlaceCaps {
            caps: *self,
            jacobian,
            left_a: left(&self.rates.acceleration, &|i| joints[i].acceleration),
            left_j: left(&self.rates.jerk, &|i| joints[i].jerk),
            bends: Box::new(self.bends(place, &jacobian)?),
        })
    }

    /// Second derivatives of the joints by the axes, the mixed ones from those along sums of two.
    fn bends(
        &self,
        place: &AxisVector,
        jacobian: &SMatrix<f64, JOINTS, AXES>,
    ) -> Result<[Square; JOINTS], KinematicsError> {
        let along = |axes: &[usize]| {
            let mut direction = AxisVector::zeros();
            for &k in axes {
                direction[k] = 1.0;
            }
            let series = axis_series::<3>(&[*place, direction]);
            let joints = self.mechanism.inverse_series(&series)?;
            Ok(joints.map(|joint| joint.derivative(2)))
        };
        let mut bends = [Square::zeros(); JOINTS];
        let is_used = |k: &usize| jacobian.column(*k).amax() > 0.0;
        let used: Vec<usize> = (0..AXES).filter(is_used).collect();
        for (count, &k) in used.iter().enumerate() {
            for (bend, own) in bends.iter_mut().zip(along(&[k])?) {
                bend[(k, k)] = own;
            }
            for &l in used.iter().take(count) {
                for (bend, both) in bends.iter_mut().zip(along(&[k, l])?) {
                    let mixed = (both - bend[(k, k)] - bend[(l, l)]) / 2.0;
                    bend[(k, l)] = mixed;
                    bend[(l, k)] = mixed;
                }
            }
        }
        Ok(bends)
    }
}

impl PlaceCaps {
    /// The largest speed along a path through `place`, near where this belongs to; infinite where
    /// joints do not limit it.
    ///
    /// # Errors
    /// A position out of reach.
    pub fn speed(&self, place: &AxisVector, heading: &Heading) -> Result<f64, KinematicsError> {
        let d1 = &heading.d1;
        let series = axis_series::<4>(&[*place, *d1]);
        let joints = self.caps.mechanism.inverse_series(&series)?;
        let is_moved = |axes: core::ops::Range<usize>| axes.clone().any(|k| d1[k] != 0.0);
        let is_turning = is_moved(LINEAR_XYZ) && is_moved(ROTARY_ABC);
        let spare_r = if is_turning { TURNING_SPARE_R } else { SPARE_R };
        let mut speed = f64::INFINITY;
        for (i, joint) in joints.iter().enumerate() {
            let [along, bend, third] = [1, 2, 3].map(|k| joint.derivative(k).abs());
            let rate = along + self.aside(i, heading);
            let bent = self.bends[i] * d1;
            // An axis that the machine does not have bends nothing, and may be said to do anything.
            let cross: f64 = (0..AXES)
                .filter(|&k| bent[k] != 0.0)
                .map(|k| bent[k].abs() * self.caps.rates.acceleration[k])
                .sum();
            let at_most = |limit: f64, factor: f64| {
                if factor > 0.0 {
                    limit / factor
                } else {
                    f64::INFINITY
                }
            };
            let velocity = (1.0 - spare_r) * self.caps.limits.0[i].velocity;
            speed = speed
                .min(at_most(velocity, rate))
                .min(at_most(self.left_a[i], bend).sqrt())
                // Half of what is left for each of two terms.
                .min(at_most(0.5 * self.left_j[i], 3.0 * cross))
                .min(at_most(0.5 * self.left_j[i], third).cbrt());
        }
        Ok(speed)
    }

    /// What a joint may move besides its motion along the path, per path position.
    fn aside(&self, joint: usize, heading: &Heading) -> f64 {
        let row = self.jacobian.row(joint);
        let is_rotary = |k: &usize| ROTARY_ABC.contains(k);
        let group = |is_in: &dyn Fn(&usize) -> bool| -> f64 {
            let squares = (0..AXES).filter(is_in).map(|k| row[k] * row[k]);
            squares.sum::<f64>().sqrt()
        };
        group(&|k| !is_rotary(k)) * heading.linear_spread
            + group(&is_rotary) * heading.rotary_spread
    }
}
