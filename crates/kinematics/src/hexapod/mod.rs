//! Hexapod kinematics: six struts of variable length between a fixed base and a moving platform
//! (6-UPS, Stewart-Gough).
//!
//! ```text
//!            b_i ●───── platform, pose (p, R)       strut i:  l_i = |p + R b_i − a_i|
//!               ╱
//!              ╱ l_i                                 R = Rz(C) Ry(B) Rx(A)
//!             ╱                                      p = tool tip − R t
//!        a_i ●───────── base
//! ```
//!
//! All six degrees of freedom are held only if the joints are arranged well. Two similar regular
//! hexagons, one above the other, are the worst case: at every level pose the six struts leave
//! three rotations free, and one remains free however the platform is tilted. Joints in pairs,
//! base pairs opposite the gaps between platform pairs, are good. [`Hexapod::conditioning`] tells.
//!
//! [`Hexapod::conditioning`]: crate::Kinematics::conditioning

mod admission;
mod forward;
mod guards;
mod struts;

pub use guards::Guards;
pub use struts::Hexapod;

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::space::{Point, RAD, add, norm_squared, offset};
use crate::{JOINTS, KinematicsError};
use glidepath_geometry::AxisVector;
use glidepath_geometry::number::{Number, Series};
use nalgebra::Vector3;
use struts::STRUTS;

impl Kinematics for Hexapod {
    fn joints(&self) -> usize {
        STRUTS
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let rows = rotation_rows([axes[3], axes[4], axes[5]]);
        let turned = |b: &Vector3<f64>| -> Point<N, T> {
            rows.map(|[x, y, z]| x.scale(b.x) + y.scale(b.y) + z.scale(b.z))
        };
        let tip = [axes[0], axes[1], axes[2]];
        let mut joints = [Series::constant(0.0); JOINTS];
        for (i, joint) in joints.iter_mut().take(STRUTS).enumerate() {
            let lever = turned(&(self.platform[i] - self.tool));
            let square = norm_squared(offset(add(tip, lever), &-self.base[i]));
            if square.nominal().partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
                return Err(KinematicsError::Unreachable { joint: i });
            }
            *joint = square.sqrt();
        }
        Ok(joints)
    }

    fn forward(
        &self,
        joints: &JointVector,
        near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        forward::forward(self, joints, near)
    }

    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        Ok(self.strut_conditioning(axes))
    }

    fn admit(&self, axes: &AxisVector) -> Result<(), KinematicsError> {
        admission::admitted(self, axes).map(|_| ())
    }

    fn admitted(&self, axes: &AxisVector) -> Result<JointVector, KinematicsError> {
        let lengths_mm = admission::admitted(self, axes)?;
        let mut joints = JointVector::zeros();
        for (joint, length_mm) in joints.iter_mut().zip(lengths_mm) {
            *joint = length_mm;
        }
        Ok(joints)
    }
}

/// The rows of Rz(C) Ry(B) Rx(A) along a parameter, from the angles A, B, C in degrees. Written
/// out, it takes a third of the products three turns one after the other take: it is computed at
/// every tick.
fn rotation_rows<const N: usize, T: Number>(angles_deg: [Series<N, T>; 3]) -> [Point<N, T>; 3] {
    let [(sa, ca), (sb, cb), (sc, cc)] = angles_deg.map(|angle| angle.scale(RAD).sin_cos());
    let (cc_sb, sc_sb) = (cc * sb, sc * sb);
    [
        [cc * cb, cc_sb * sa - sc * ca, cc_sb * ca + sc * sa],
        [sc * cb, sc_sb * sa + cc * ca, sc_sb * ca - cc * sa],
        [-sb, cb * sa, cb * ca],
    ]
}
