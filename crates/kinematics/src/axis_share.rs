//! The share of their acceleration and jerk that axes may use, so that no joint has to do more than
//! it can.
//!
//! Axes are limited one by one, so at a corner all of them may accelerate at once, in any
//! direction: the accelerations possible are a box. A joint sees a projection of it:
//!
//! ```text
//!   q̈ = J ẍ + ẋᵀH ẋ            |J ẍ| ≤ Σ_k |J_k| A_k      the box, at a place
//!   q⃛ = J x⃛ + 3 ẋᵀH ẍ + …      |J x⃛| ≤ Σ_k |J_k| J_k
//! ```
//!
//! The share is what every axis' limit is multiplied by so that the first term leaves a part of
//! every joint's limit ([`BENDS_A`], [`BENDS_J`]) for the bends of the mechanism, the other terms,
//! anywhere in the travel of the axes. It belongs to the machine, not to a program: what moves by hand,
//! without a plan, goes by it.
//!
//! The travel is searched at a fixed set of places: the lattice of ends and middles, and points
//! spread evenly between them. What they miss is found by whoever judges the motion itself.

use crate::{JOINTS, JointLimits, JointWatch, Kinematics as _, Mechanism};
use glidepath_geometry::{AXES, Axis, AxisVector};
use nalgebra::SMatrix;

/// Part of a joint's acceleration that axes leave for the bends of the mechanism.
const BENDS_A: f64 = 0.1;
/// Part of a joint's jerk that axes leave for them.
const BENDS_J: f64 = 0.25;
/// Places between the lattice's.
const SPREAD: u32 = 512;
/// Axes of which a lattice of ends and middles has at most so many places as is reasonable.
const LATTICE_AXES: usize = 6;

/// Largest acceleration and jerk of the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisRates {
    /// mm/s² or °/s², of every axis; those that the mechanism does not use do not matter.
    pub acceleration: AxisVector,
    /// mm/s³ or °/s³.
    pub jerk: AxisVector,
}

/// What joints let each axis do by itself, anywhere in the travel, if the others stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AloneLimits {
    /// mm/s or °/s; infinite of an axis that no joint follows.
    pub velocity: AxisVector,
    /// mm/s² or °/s².
    pub acceleration: AxisVector,
    /// mm/s³ or °/s³.
    pub jerk: AxisVector,
}

impl AloneLimits {
    /// Those of a mechanism, from the first terms alone: nothing is left for its bends.
    #[must_use]
    pub fn over(mechanism: &Mechanism, limits: &JointLimits, travel: &[(Axis, f64, f64)]) -> Self {
        let none = AxisVector::repeat(f64::INFINITY);
        let mut alone = Self {
            velocity: none,
            acceleration: none,
            jerk: none,
        };
        for jacobian in jacobians(mechanism, limits, travel) {
            for (axis, ..) in travel {
                let k = axis.index();
                for (joint, limit) in limits.0.iter().enumerate() {
                    let by = jacobian[(joint, k)].abs();
                    if by > 0.0 {
                        alone.velocity[k] = alone.velocity[k].min(limit.velocity / by);
                        alone.acceleration[k] = alone.acceleration[k].min(limit.acceleration / by);
                        alone.jerk[k] = alone.jerk[k].min(limit.jerk / by);
                    }
                }
            }
        }
        alone
    }
}

/// The Jacobians at places in the travel where the mechanism may stand.
fn jacobians<'a>(
    mechanism: &'a Mechanism,
    limits: &JointLimits,
    travel: &'a [(Axis, f64, f64)],
) -> impl Iterator<Item = SMatrix<f64, JOINTS, AXES>> + 'a {
    // Judges standing only, so the period does not matter.
    let watch = JointWatch::new(*mechanism, *limits, 1.0);
    places(travel)
        .filter(move |place| watch.stand(place).is_ok())
        .filter_map(|place| mechanism.jacobian(&place).ok())
}

/// Factors on the limits of all axes, each above 0 and at most 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisShare {
    /// On acceleration.
    pub acceleration: f64,
    /// On jerk.
    pub jerk: f64,
    /// The joints that leave no more, of acceleration and of jerk.
    pub joints: [Option<usize>; 2],
}

impl AxisShare {
    /// The whole of the limits.
    pub const FULL: Self = Self {
        acceleration: 1.0,
        jerk: 1.0,
        joints: [None; 2],
    };

    /// The share that a mechanism leaves anywhere in the travel (mm, degrees) of its axes.
    #[must_use]
    pub fn over(
        mechanism: &Mechanism,
        limits: &JointLimits,
        travel: &[(Axis, f64, f64)],
        rates: &AxisRates,
    ) -> Self {
        let mut share = Self::FULL;
        for jacobian in jacobians(mechanism, limits, travel) {
            for joint in 0..JOINTS {
                let needed = |limits: &AxisVector| -> f64 {
                    let axes = travel.iter().map(|(axis, ..)| axis.index());
                    axes.map(|k| jacobian[(joint, k)].abs() * limits[k]).sum()
                };
                let limit = &limits.0[joint];
                let left_a = (1.0 - BENDS_A) * limit.acceleration / needed(&rates.acceleration);
                if left_a < share.acceleration {
                    (share.acceleration, share.joints[0]) = (left_a, Some(joint));
                }
                let left_j = (1.0 - BENDS_J) * limit.jerk / needed(&rates.jerk);
                if left_j < share.jerk {
                    (share.jerk, share.joints[1]) = (left_j, Some(joint));
                }
            }
        }
        share
    }

    /// The rates of the axes that the share leaves.
    #[must_use]
    pub fn of(&self, rates: &AxisRates) -> AxisRates {
        AxisRates {
            acceleration: rates.acceleration * self.acceleration,
            jerk: rates.jerk * self.jerk,
        }
    }
}

/// Places in the travel of the axes; the other axes are zero.
fn places(travel: &[(Axis, f64, f64)]) -> impl Iterator<Item = AxisVector> + '_ {
    let at = |unit: &dyn Fn(usize) -> f64| {
        let mut place = AxisVector::zeros();
        for (k, (axis, low, high)) in travel.iter().enumerate() {
            place[axis.index()] = low + (high - low) * unit(k);
        }
        place
    };
    let lattice = 3_u32.pow(u32::try_from(travel.len().min(LATTICE_AXES)).unwrap_or(0));
    let ends = (0..lattice).map(move |index| {
        at(&|k| {
            let power = u32::try_from(k).unwrap_or(0);
            f64::from(index / 3_u32.saturating_pow(power) % 3) / 2.0
        })
    });
    // An additive recurrence with irrational steps: the powers of the root of x^(d+1) = x + 1.
    let between = (1..=SPREAD).map(move |index| {
        let steps = travel.len().max(1);
        let root = root(steps);
        at(&|k| {
            let power = i32::try_from(k + 1).unwrap_or(1);
            (0.5 + f64::from(index) * root.powi(-power)).fract()
        })
    });
    ends.chain(between)
}

/// The root above 1 of x^(d+1) = x + 1.
fn root(dimensions: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "at most nine axes")]
    let exponent = 1.0 / (dimensions as f64 + 1.0);
    (0..32).fold(2.0, |x: f64, _| (1.0 + x).powf(exponent))
}
