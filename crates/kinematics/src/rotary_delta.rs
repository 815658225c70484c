//! Rotary delta kinematics: three arms on a fixed base swing forearms that hold a platform which
//! does not turn.
//!
//! In the vertical plane of one arm, with u outwards and w across, the knee is on a circle of the
//! upper arm's length and at the forearm's length from the platform's joint:
//!
//! ```text
//!   a cos θ − z sin θ = K,   a = u + e − f,   K = (a² + w² + z² + rf² − re²) / (2 rf)
//! ```

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::space::{RAD, below_three};
use crate::{JOINTS, KinematicsError};
use glidepath_geometry::AxisVector;
use glidepath_geometry::number::{Number, Series};
use nalgebra::{Matrix3, Vector3};

/// A rotary delta below its base, z up. J0…J2 are the angles of the upper arms, degrees: 0
/// horizontal outwards, positive with the knee down. The knees point outwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotaryDelta {
    /// Radius f at which the arms pivot, mm.
    pub base_radius_mm: f64,
    /// Radius e at which the forearms hold the platform, mm.
    pub platform_radius_mm: f64,
    /// Length rf of the upper arms, mm.
    pub upper_arm_mm: f64,
    /// Length re of the forearms, mm.
    pub forearm_mm: f64,
    /// Direction of each arm, degrees from +X.
    pub arm_deg: [f64; 3],
}

impl RotaryDelta {
    fn arm<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
        arm_deg: f64,
    ) -> Option<Series<N, T>> {
        let (sin, cos) = (arm_deg * RAD).sin_cos();
        let (x, y, z) = (axes[0], axes[1], axes[2]);
        let outwards = x.scale(cos) + y.scale(sin);
        let across = y.scale(cos) - x.scale(sin);
        let a = outwards + Series::constant(self.platform_radius_mm - self.base_radius_mm);
        let (rf, re) = (self.upper_arm_mm, self.forearm_mm);
        let k = (a.square() + across.square() + z.square() + Series::constant(rf * rf - re * re))
            .scale((2.0 * rf).recip());
        let rest = a.square() + z.square() - k.square();
        if rest.nominal().partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
            return None;
        }
        let (middle, swing) = ((-z).atan2(a), rest.sqrt().atan2(k));
        let branches = [middle - swing, middle + swing];
        let outer = usize::from(branches[1].nominal().cos() > branches[0].nominal().cos());
        Some(branches[outer].scale(RAD.recip()))
    }
}

impl Kinematics for RotaryDelta {
    fn joints(&self) -> usize {
        3
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let mut joints = [Series::constant(0.0); JOINTS];
        for (joint, arm_deg) in self.arm_deg.into_iter().enumerate() {
            joints[joint] = self
                .arm(axes, arm_deg)
                .ok_or(KinematicsError::Unreachable { joint })?;
        }
        Ok(joints)
    }

    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let knees = core::array::from_fn(|i| {
            let (sin, cos) = (joints[i] * RAD).sin_cos();
            let radius = self.base_radius_mm - self.platform_radius_mm + self.upper_arm_mm * cos;
            let (y, x) = (self.arm_deg[i] * RAD).sin_cos();
            Vector3::new(radius * x, radius * y, -self.upper_arm_mm * sin)
        });
        let point = below_three(knees, self.forearm_mm).ok_or(KinematicsError::NoPosition)?;
        let mut axes = AxisVector::zeros();
        axes.fixed_rows_mut::<3>(0).copy_from(&point);
        Ok(axes)
    }

    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        let jacobian = self.jacobian(axes)?;
        let block: Matrix3<f64> = jacobian.fixed_view::<3, 3>(0, 0) * (RAD * self.upper_arm_mm);
        Ok(Conditioning::of(block.singular_values().as_slice()))
    }
}
