//! Linear delta kinematics: three carriages on vertical towers hold the tool by rods of equal
//! length.
//!
//! The effector does not turn, so each rod is a link from a tower, moved inwards by the effector's
//! own radius, to the tool's point:
//!
//! ```text
//!   carriage ●          c = z + √(rod² − d²),  d = distance in the plane from (moved) tower to tool
//!            │╲ rod
//!            │  ╲
//!   tower    │────● tool
//!              d
//! ```

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::space::{RAD, below_three};
use crate::trivial::{pass_back, pass_through};
use crate::{AxisList, KinematicsError};
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{Axis, AxisVector};
use nalgebra::{Matrix3, Vector2, Vector3};

/// A linear delta. J0…J2 are the heights of the carriage pivots above the plane z = 0 of the
/// effector pivots, mm; every axis besides X Y Z has a drive of its own, from J3 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearDelta {
    /// Length of the rods between pivots, mm, > 0.
    pub rod_mm: f64,
    /// Radius of the towers less that of the effector less the carriages' offset, mm, > 0.
    pub radius_mm: f64,
    /// Direction of each tower, degrees from +X. Controls differ in their order: 90, 210, 330 has
    /// the first tower at x = 0; 210, 330, 90 is common too.
    pub tower_deg: [f64; 3],
    /// The machine's axes besides X Y Z.
    pub others: AxisList,
}

impl LinearDelta {
    fn towers(&self) -> [Vector2<f64>; 3] {
        self.tower_deg.map(|deg| {
            let (sin, cos) = (deg * RAD).sin_cos();
            Vector2::new(cos, sin) * self.radius_mm
        })
    }
}

impl Kinematics for LinearDelta {
    fn joints(&self) -> usize {
        3 + self.others.len()
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let mut joints = [Series::constant(0.0); crate::JOINTS];
        for (joint, tower) in self.towers().into_iter().enumerate() {
            let dx = axes[0] - Series::constant(tower.x);
            let dy = axes[1] - Series::constant(tower.y);
            let rest = Series::constant(self.rod_mm * self.rod_mm) - dx.square() - dy.square();
            // A rod that lies flat cannot lift; nor does a position that is not a number.
            if rest.nominal().partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
                return Err(KinematicsError::Unreachable { joint });
            }
            joints[joint] = axes[2] + rest.sqrt();
        }
        pass_through(self.others, axes, &mut joints[3..]);
        Ok(joints)
    }

    /// The lower of the two points at a rod's length from all three carriages.
    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let towers = self.towers();
        let carriages = core::array::from_fn(|i| Vector3::new(towers[i].x, towers[i].y, joints[i]));
        let point = below_three(carriages, self.rod_mm).ok_or(KinematicsError::NoPosition)?;
        let mut axes = AxisVector::zeros();
        axes.fixed_rows_mut::<3>(0).copy_from(&point);
        pass_back(self.others, &joints.as_slice()[3..], &mut axes);
        Ok(axes)
    }

    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        let jacobian = self.jacobian(axes)?;
        let block: Matrix3<f64> = jacobian.fixed_view::<3, 3>(0, 0).into_owned();
        Ok(Conditioning::of(block.singular_values().as_slice()))
    }
}

impl LinearDelta {
    /// A delta for a machine with these axes, X Y Z among them.
    #[must_use]
    pub fn new(rod_mm: f64, radius_mm: f64, tower_deg: [f64; 3], axes: &[Axis]) -> Self {
        Self {
            rod_mm,
            radius_mm,
            tower_deg,
            others: AxisList::new(axes).without(&[Axis::X, Axis::Y, Axis::Z]),
        }
    }
}
