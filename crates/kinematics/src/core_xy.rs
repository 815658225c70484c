//! CoreXY kinematics: two fixed motors drive X and Y together by one belt.

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::trivial::{pass_back, pass_through};
use crate::{AxisList, KinematicsError};
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{Axis, AxisVector};

/// J0 = X + Y and J1 = X − Y in mm of belt; every further axis has a drive of its own, from J2 on.
/// A motor moves up to √2 times as fast as the tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CoreXy {
    /// The machine's axes besides X and Y.
    pub others: AxisList,
}

impl CoreXy {
    /// For a machine with these axes, X and Y among them.
    #[must_use]
    pub fn new(axes: &[Axis]) -> Self {
        Self {
            others: AxisList::new(axes).without(&[Axis::X, Axis::Y]),
        }
    }
}

impl Kinematics for CoreXy {
    fn joints(&self) -> usize {
        2 + self.others.len()
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let mut joints = [Series::constant(0.0); crate::JOINTS];
        joints[0] = axes[0] + axes[1];
        joints[1] = axes[0] - axes[1];
        pass_through(self.others, axes, &mut joints[2..]);
        Ok(joints)
    }

    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let mut axes = AxisVector::zeros();
        axes[0] = 0.5 * (joints[0] + joints[1]);
        axes[1] = 0.5 * (joints[0] - joints[1]);
        pass_back(self.others, &joints.as_slice()[2..], &mut axes);
        Ok(axes)
    }

    fn conditioning(&self, _axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        // Both singular values of [[1, 1], [1, −1]] are √2.
        Ok(Conditioning {
            condition: 1.0,
            smallest: core::f64::consts::SQRT_2,
        })
    }
}
