//! Five-bar kinematics: two arms side by side in the plane hold the tool between their forearms.
//!
//! ```text
//!            ● tool          α = acos((r² + a² − f²) / (2 a r)),  r = from shoulder to tool
//!          ╱   ╲             J0 = direction of the tool from its shoulder + α
//!        ╱       ╲           J1 = direction of the tool from its shoulder − α
//!  knee ●         ● knee
//!        ╲       ╱
//!         ●─────●            shoulders, at x = ∓ distance / 2
//! ```

use crate::machine::{AxisSeries, Conditioning, JointSeries, JointVector, Kinematics};
use crate::space::RAD;
use crate::trivial::{pass_back, pass_through};
use crate::{AxisList, JOINTS, KinematicsError};
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{Axis, AxisVector};
use nalgebra::{Matrix2, Vector2};

/// A five-bar linkage. J0 and J1 are the directions of the upper arms at x < 0 and at x > 0, degrees
/// from +X: J0 from 0° to 360°, J1 from −180° to 180°. The knees are outside, and the tool is beyond them
/// and beyond the shoulders, towards +Y. Every axis besides X and Y has a drive of its own, from J2 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FiveBar {
    /// Distance of the shoulders, mm, > 0.
    pub shoulder_distance_mm: f64,
    /// Upper arms, mm, > 0.
    pub upper_arm_mm: f64,
    /// Forearms, mm, > 0.
    pub forearm_mm: f64,
    /// The machine's axes besides X and Y.
    pub others: AxisList,
}

/// The sign of x of each arm's shoulder; the knee bends to that side.
const SIDES: [f64; 2] = [-1.0, 1.0];

impl FiveBar {
    /// For a machine with these axes, X and Y among them.
    #[must_use]
    pub fn new(
        shoulder_distance_mm: f64,
        upper_arm_mm: f64,
        forearm_mm: f64,
        axes: &[Axis],
    ) -> Self {
        Self {
            shoulder_distance_mm,
            upper_arm_mm,
            forearm_mm,
            others: AxisList::new(axes).without(&[Axis::X, Axis::Y]),
        }
    }

    /// The direction of an upper arm, degrees.
    fn arm<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
        side: f64,
    ) -> Option<Series<N, T>> {
        let (a, f) = (self.upper_arm_mm, self.forearm_mm);
        let x = axes[0] - Series::constant(0.5 * side * self.shoulder_distance_mm);
        let y = axes[1];
        let square = x.square() + y.square();
        // Cosine and sine of the bend, times the reach: law of cosines.
        let beside = (square + Series::constant(a * a - f * f)).scale((2.0 * a).recip());
        let rest = square - beside.square();
        // Stretched or folded; behind the shoulders the knees would be inside. Nor is a position there that is
        // not a number.
        let is_reached = |value: &Series<N, T>| {
            value.nominal().partial_cmp(&0.0) == Some(core::cmp::Ordering::Greater)
        };
        if !(is_reached(&rest) && is_reached(&y)) {
            return None;
        }
        let bend = rest.sqrt().atan2(beside);
        Some((y.atan2(x) - bend.scale(side)).scale(RAD.recip()))
    }

    /// The knees at angles of the shoulders, degrees.
    fn knees(&self, joints: &JointVector) -> [Vector2<f64>; 2] {
        core::array::from_fn(|arm| {
            let (sin, cos) = (joints[arm] * RAD).sin_cos();
            let shoulder = 0.5 * SIDES[arm] * self.shoulder_distance_mm;
            Vector2::new(shoulder + self.upper_arm_mm * cos, self.upper_arm_mm * sin)
        })
    }
}

impl Kinematics for FiveBar {
    fn joints(&self) -> usize {
        2 + self.others.len()
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let mut joints = [Series::constant(0.0); JOINTS];
        for (joint, side) in SIDES.into_iter().enumerate() {
            joints[joint] = self
                .arm(axes, side)
                .ok_or(KinematicsError::Unreachable { joint })?;
        }
        pass_through(self.others, axes, &mut joints[2..]);
        Ok(joints)
    }

    /// The tool is at a forearm's length from both knees, to the left of the way from the first to the second.
    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let [first, second] = self.knees(joints);
        let between = second - first;
        let half = 0.5 * between.norm();
        let rest = self.forearm_mm * self.forearm_mm - half * half;
        if !(rest > 0.0 && half > 0.0) {
            return Err(KinematicsError::NoPosition);
        }
        let beyond = Vector2::new(-between.y, between.x) * (0.5 * rest.sqrt() / half);
        let tool = (first + second) * 0.5 + beyond;
        let mut axes = AxisVector::zeros();
        (axes[0], axes[1]) = (tool.x, tool.y);
        pass_back(self.others, &joints.as_slice()[2..], &mut axes);
        Ok(axes)
    }

    /// On the other side of the knees the same joints hold the tool elsewhere: no pose there is held well.
    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        let [first, second] = self.knees(&self.inverse(axes)?);
        let to_tool = Vector2::new(axes[0], axes[1]) - first;
        if (second - first).perp(&to_tool) <= 0.0 {
            return Ok(Conditioning::of(&[1.0, 0.0]));
        }
        let jacobian = self.jacobian(axes)?;
        let block: Matrix2<f64> = jacobian.fixed_view::<2, 2>(0, 0) * (RAD * self.upper_arm_mm);
        let [first, second] = block.singular_values().into();
        // Beside the tool's own speed: with both arms stretched at once, both are as large.
        Ok(Conditioning::of(&[first, second, 1.0]))
    }
}
