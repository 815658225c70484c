//! The highest speed along a path that the joints allow, and the accelerations possible at a speed.
//!
//! Along a path with position s, a joint moves by q̇ = q′ ṡ and q̈ = q′ s̈ + q″ ṡ². Velocity
//! limits cap ṡ at once. Acceleration limits leave, at each ṡ, an interval of s̈ for every joint;
//! intervals on a line have a common point iff every two of them have, so the highest speed at
//! which any s̈ is possible is a minimum over pairs of joints.

use crate::{JOINTS, JointLimits, JointVector, Kinematics, KinematicsError, axis_series};
use glidepath_geometry::{AxisVector, Jet};

/// The joints at a point of a path, and their first three derivatives by path position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathRates {
    /// q.
    pub position: JointVector,
    /// q′.
    pub d1: JointVector,
    /// q″.
    pub d2: JointVector,
    /// q‴.
    pub d3: JointVector,
}

/// Largest speeds along the path, mm/s; infinite where no joint limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedCaps {
    /// By velocities of the joints.
    pub velocity: f64,
    /// By accelerations, with whatever s̈ helps.
    pub acceleration: f64,
    /// By accelerations at constant speed.
    pub acceleration_steady: f64,
}

impl PathRates {
    /// The rates of a mechanism at a point of a path.
    ///
    /// # Errors
    /// The point is out of reach.
    pub fn at(machine: &impl Kinematics, path: &Jet) -> Result<Self, KinematicsError> {
        let derivatives: [AxisVector; 4] = [path.position, path.d1, path.d2, path.d3];
        let joints = machine.inverse_series(&axis_series::<4>(&derivatives))?;
        let derivative = |k| JointVector::from_fn(|i, _| joints[i].derivative(k));
        Ok(Self {
            position: derivative(0),
            d1: derivative(1),
            d2: derivative(2),
            d3: derivative(3),
        })
    }

    /// The speeds at which every joint keeps its limits.
    #[must_use]
    pub fn caps(&self, limits: &JointLimits) -> SpeedCaps {
        let (mut velocity, mut steady, mut square) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        for i in 0..JOINTS {
            let (a_i, d1, d2) = (limits.0[i].acceleration, self.d1[i], self.d2[i]);
            if d1 != 0.0 {
                velocity = velocity.min(limits.0[i].velocity / d1.abs());
            }
            if d2 != 0.0 {
                steady = steady.min(a_i / d2.abs());
            }
            if d1 == 0.0 && d2 != 0.0 {
                square = square.min(a_i / d2.abs());
            }
            for j in 0..i {
                let cross = (self.d2[i] * self.d1[j] - self.d2[j] * self.d1[i]).abs();
                if cross > 0.0 {
                    let sum = a_i * self.d1[j].abs() + limits.0[j].acceleration * d1.abs();
                    square = square.min(sum / cross);
                }
            }
        }
        SpeedCaps {
            velocity,
            acceleration: square.sqrt(),
            acceleration_steady: steady.sqrt(),
        }
    }

    /// The accelerations along the path, mm/s², at which every joint keeps its limit at a speed;
    /// `None` if there is none.
    #[must_use]
    pub fn accelerations(&self, limits: &JointLimits, speed_v: f64) -> Option<(f64, f64)> {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for i in 0..JOINTS {
            let (d1, bend) = (self.d1[i], self.d2[i] * speed_v * speed_v);
            let limit = limits.0[i].acceleration;
            if d1 == 0.0 {
                if bend.abs() > limit {
                    return None;
                }
                continue;
            }
            let (a, b) = ((-limit - bend) / d1, (limit - bend) / d1);
            low = low.max(a.min(b));
            high = high.min(a.max(b));
        }
        (low <= high).then_some((low, high))
    }
}
