//! Kinematics of the translational hexapod: six struts whose universal joints keep the platform
//! from turning (6-UPU).
//!
//! With the outer axes of all universal joints parallel, and the inner ones, the platform only
//! translates: three degrees of freedom, held by six drives of which three are redundant. The
//! lengths of the struts of two similar regular hexagons then obey three identities whatever the
//! position, which [`TranslationalHexapod::closure_mm`] checks, and forward kinematics is a closed
//! form:
//!
//! ```text
//!   l_k = |p − Δ e_k|,  Δ = base radius − platform radius,  e_k = (cos 60°k, sin 60°k, 0)
//!   p_xy = −Σ l_k² e_k / (6 Δ)        p_z = ±√(mean l² − Δ² − |p_xy|²)
//! ```
//!
//! Lengths do not tell whether the platform stands above its base or hangs below it: of the two, the
//! side is taken on which it was last.
//!
//! A 6-UPU with joint axes in general position cannot move at all, and one whose nuts may rotate
//! is a
//! [`Hexapod`](crate::Hexapod); this type is neither.

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::{JOINTS, KinematicsError};
use glidepath_geometry::AxisVector;
use glidepath_geometry::number::{Number, Series};
use nalgebra::{SMatrix, Vector2};

const STRUTS: usize = 6;

/// A platform that only translates. X Y Z is its centre; J0…J5 are the lengths of the struts, mm,
/// J0 the one in direction +X, the others each 60° further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TranslationalHexapod {
    /// Radius of the base hexagon less that of the platform, mm, not 0.
    pub radius_difference_mm: f64,
    /// Height of the base joints, mm.
    pub base_z_mm: f64,
}

impl TranslationalHexapod {
    fn directions() -> [Vector2<f64>; STRUTS] {
        let half_root3 = 0.5 * 3.0_f64.sqrt();
        [
            Vector2::new(1.0, 0.0),
            Vector2::new(0.5, half_root3),
            Vector2::new(-0.5, half_root3),
            Vector2::new(-1.0, 0.0),
            Vector2::new(-0.5, -half_root3),
            Vector2::new(0.5, -half_root3),
        ]
    }

    /// The distance of six measured lengths from possible ones, mm: 0 for lengths of one position.
    /// The sums of squares of opposite struts are all equal, and so are those of every second
    /// strut.
    #[must_use]
    pub fn closure_mm(&self, joints: &JointVector) -> f64 {
        let squares: [f64; STRUTS] = core::array::from_fn(|k| joints[k] * joints[k]);
        let opposite: [f64; 3] = core::array::from_fn(|k| squares[k] + squares[k + 3]);
        let mean = squares.iter().sum::<f64>() / 6.0;
        let worst = opposite
            .iter()
            .map(|sum| (sum - 2.0 * mean).abs())
            .fold(0.0, f64::max);
        let odd = squares[0] + squares[2] + squares[4];
        let even = squares[1] + squares[3] + squares[5];
        // An error δ of one length changes its square by 2 l δ.
        worst.max((odd - even).abs()) / (2.0 * mean.sqrt())
    }
}

impl Kinematics for TranslationalHexapod {
    fn joints(&self) -> usize {
        STRUTS
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let mut joints = [Series::constant(0.0); JOINTS];
        let height = (axes[2] - Series::constant(self.base_z_mm)).square();
        for (joint, direction) in Self::directions().into_iter().enumerate() {
            let foot = direction * self.radius_difference_mm;
            let dx = axes[0] - Series::constant(foot.x);
            let dy = axes[1] - Series::constant(foot.y);
            let square = dx.square() + dy.square() + height;
            if square.nominal().partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
                return Err(KinematicsError::Unreachable { joint });
            }
            joints[joint] = square.sqrt();
        }
        Ok(joints)
    }

    fn forward(
        &self,
        joints: &JointVector,
        near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let delta = self.radius_difference_mm;
        let mut xy = Vector2::zeros();
        let mut mean = 0.0;
        for (k, direction) in Self::directions().into_iter().enumerate() {
            let square = joints[k] * joints[k];
            xy -= direction * (square / (6.0 * delta));
            mean += square / 6.0;
        }
        let square = mean - delta * delta - xy.norm_squared();
        if square.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
            return Err(KinematicsError::NoPosition);
        }
        let mut axes = AxisVector::zeros();
        (axes[0], axes[1]) = (xy.x, xy.y);
        axes[2] = self.base_z_mm + square.sqrt().copysign(near[2] - self.base_z_mm);
        Ok(axes)
    }

    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        let jacobian = self.jacobian(axes)?;
        let block: SMatrix<f64, STRUTS, 3> = jacobian.fixed_view::<STRUTS, 3>(0, 0).into_owned();
        Ok(Conditioning::of(block.singular_values().as_slice()))
    }
}
