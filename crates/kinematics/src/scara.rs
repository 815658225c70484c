//! SCARA kinematics: two arms in the plane, a lift and a wrist.

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::space::RAD;
use crate::{JOINTS, KinematicsError};
use glidepath_geometry::AxisVector;
use glidepath_geometry::number::{Number, Series};
use nalgebra::Matrix2;

/// The side to which the elbow bends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elbow {
    /// J1 > 0.
    Positive,
    /// J1 < 0.
    Negative,
}

/// A SCARA arm. Axes X Y Z and the tool's heading C; J0 shoulder, J1 elbow, degrees, J2 the lift,
/// mm, downwards, J3 the wrist, degrees. The shoulder's angle is given from −180° to 180°: the arm
/// does not sweep through the half-line behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scara {
    /// Upper arm, mm.
    pub upper_arm_mm: f64,
    /// Forearm, mm.
    pub forearm_mm: f64,
    /// From the wrist's axis to the tool, in the direction C, mm.
    pub tool_mm: f64,
    /// Height of the tool where J2 is 0, mm.
    pub height_mm: f64,
    /// Which way the elbow bends.
    pub elbow: Elbow,
}

impl Kinematics for Scara {
    fn joints(&self) -> usize {
        4
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let (a, b) = (self.upper_arm_mm, self.forearm_mm);
        let heading = axes[5].scale(RAD);
        let (sin, cos) = heading.sin_cos();
        let x = axes[0] - cos.scale(self.tool_mm);
        let y = axes[1] - sin.scale(self.tool_mm);
        // Law of cosines.
        let cos_elbow = (x.square() + y.square() - Series::constant(a * a + b * b))
            .scale((2.0 * a * b).recip());
        let rest = Series::constant(1.0) - cos_elbow.square();
        if rest.nominal().partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
            return Err(KinematicsError::Unreachable { joint: 1 });
        }
        let sign = match self.elbow {
            Elbow::Positive => 1.0,
            Elbow::Negative => -1.0,
        };
        let sin_elbow = rest.sqrt().scale(sign);
        let elbow = sin_elbow.atan2(cos_elbow);
        let inner = sin_elbow
            .scale(b)
            .atan2(cos_elbow.scale(b) + Series::constant(a));
        let shoulder = y.atan2(x) - inner;
        let turn = core::f64::consts::TAU;
        let back = -(shoulder.nominal() / turn).round() * turn;
        let shoulder = shoulder + Series::constant(back);
        let mut joints = [Series::constant(0.0); JOINTS];
        joints[0] = shoulder.scale(RAD.recip());
        joints[1] = elbow.scale(RAD.recip());
        joints[2] = Series::constant(self.height_mm) - axes[2];
        joints[3] = axes[5] - joints[0] - joints[1];
        Ok(joints)
    }

    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let (shoulder, elbow) = (joints[0] * RAD, joints[1] * RAD);
        let heading_deg = joints[0] + joints[1] + joints[3];
        let reach = |angle: f64, arm: f64| (arm * angle.cos(), arm * angle.sin());
        let upper = reach(shoulder, self.upper_arm_mm);
        let fore = reach(shoulder + elbow, self.forearm_mm);
        let tool = reach(heading_deg * RAD, self.tool_mm);
        let mut axes = AxisVector::zeros();
        axes[0] = upper.0 + fore.0 + tool.0;
        axes[1] = upper.1 + fore.1 + tool.1;
        axes[2] = self.height_mm - joints[2];
        axes[5] = heading_deg;
        Ok(axes)
    }

    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        let jacobian = self.jacobian(axes)?;
        let scale = RAD * (self.upper_arm_mm + self.forearm_mm);
        let block: Matrix2<f64> = jacobian.fixed_view::<2, 2>(0, 0) * scale;
        Ok(Conditioning::of(block.singular_values().as_slice()))
    }
}
