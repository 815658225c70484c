//! The struts of a hexapod: where they are held, and their directions at a pose.

use super::guards::Guards;
use crate::machine::Conditioning;
use glidepath_geometry::AxisVector;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// Struts of a hexapod.
pub(crate) const STRUTS: usize = 6;

/// A hexapod. X Y Z is the tool's tip in the frame of the base joints, A B C the platform's
/// orientation: turned about the fixed x axis by A, then about y by B, then about z by C. J0…J5 are
/// the lengths of the struts between the centres of their joints, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hexapod {
    /// Centres of the base joints, mm.
    pub base: [Vector3<f64>; STRUTS],
    /// Centres of the platform joints in the platform's frame, mm, in the order of the base joints.
    pub platform: [Vector3<f64>; STRUTS],
    /// The tool's tip in the platform's frame, mm.
    pub tool: Vector3<f64>,
    /// What its build forbids.
    pub guards: Guards,
}

/// A pose of the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// The platform's origin, mm.
    pub(crate) position: Vector3<f64>,
    pub(crate) rotation: Matrix3<f64>,
}

impl Hexapod {
    /// Joints in three pairs on two circles, mm: base pairs around 0°, 120°, 240°, platform pairs
    /// around 60°, 180°, 300°, the joints of a pair `half_angle_deg` to either side. Strut 0 and 1
    /// start at the first base pair. At 30° both are regular hexagons and the hexapod is singular.
    #[must_use]
    pub fn paired(base_radius_mm: f64, platform_radius_mm: f64, half_angle_deg: f64) -> Self {
        let on = |radius: f64, degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            Vector3::new(radius * cos, radius * sin, 0.0)
        };
        let h = half_angle_deg;
        let base = [-h, h, 120.0 - h, 120.0 + h, 240.0 - h, 240.0 + h];
        let platform = [
            300.0 + h,
            60.0 - h,
            60.0 + h,
            180.0 - h,
            180.0 + h,
            300.0 - h,
        ];
        Self {
            base: base.map(|deg| on(base_radius_mm, deg)),
            platform: platform.map(|deg| on(platform_radius_mm, deg)),
            tool: Vector3::zeros(),
            guards: Guards::NONE,
        }
    }

    /// The pose that brings the tool to a position of the axes.
    pub(crate) fn pose(&self, axes: &AxisVector) -> Pose {
        let rotation = rotation(axes);
        let tip = Vector3::new(axes[0], axes[1], axes[2]);
        Pose {
            position: tip - rotation * self.tool,
            rotation,
        }
    }

    /// Strut vectors from base to platform, mm.
    pub(crate) fn struts(&self, pose: &Pose) -> [Vector3<f64>; STRUTS] {
        core::array::from_fn(|i| pose.position + pose.rotation * self.platform[i] - self.base[i])
    }

    /// Derivative of the strut lengths by velocity (mm) and angular velocity (rad) of the
    /// platform's origin, both in the fixed frame: rows `[nᵀ, (R b × n)ᵀ]`.
    #[must_use]
    pub fn strut_jacobian(&self, axes: &AxisVector) -> Matrix6<f64> {
        self.rows(&self.pose(axes))
    }

    pub(crate) fn rows(&self, pose: &Pose) -> Matrix6<f64> {
        let struts = self.struts(pose);
        let rows = self.rows_of(pose, &struts, &lengths_mm(&struts));
        Matrix6::from_fn(|row, column| rows[row][column])
    }

    /// The rows `[nᵀ, (R b × n)ᵀ]`, as arrays: a jog asks for them at every place of every stop.
    fn rows_of(
        &self,
        pose: &Pose,
        struts: &[Vector3<f64>; STRUTS],
        lengths_mm: &[f64; STRUTS],
    ) -> [[f64; 6]; STRUTS] {
        core::array::from_fn(|i| {
            let n = struts[i] / lengths_mm[i];
            let lever = (pose.rotation * self.platform[i]).cross(&n);
            [n.x, n.y, n.z, lever.x, lever.y, lever.z]
        })
    }

    /// Mean distance of the platform joints from the platform's origin, mm.
    fn platform_radius_mm(&self) -> f64 {
        self.platform.iter().map(Vector3::norm).sum::<f64>() / 6.0
    }

    /// The derivative of the strut lengths, rotations taken at the platform joints.
    pub(super) fn scaled_jacobian(
        &self,
        pose: &Pose,
        struts: &[Vector3<f64>; STRUTS],
        lengths_mm: &[f64; STRUTS],
    ) -> [[f64; 6]; STRUTS] {
        let radius_mm = self.platform_radius_mm();
        self.rows_of(pose, struts, lengths_mm)
            .map(|[x, y, z, a, b, c]| [x, y, z, a / radius_mm, b / radius_mm, c / radius_mm])
    }

    /// How well the struts hold the platform.
    pub(super) fn strut_conditioning(&self, axes: &AxisVector) -> Conditioning {
        let pose = self.pose(axes);
        let struts = self.struts(&pose);
        conditioning_of(&self.scaled_jacobian(&pose, &struts, &lengths_mm(&struts)))
    }
}

/// How long struts are, mm.
pub(super) fn lengths_mm(struts: &[Vector3<f64>; STRUTS]) -> [f64; STRUTS] {
    struts.map(|strut| strut.norm())
}

/// The conditioning of a scaled Jacobian that is given by its rows.
pub(super) fn conditioning_of(rows: &[[f64; 6]; STRUTS]) -> Conditioning {
    let jacobian = Matrix6::from_fn(|row, column| rows[row][column]);
    Conditioning::of(jacobian.singular_values().as_slice())
}

/// Rz(C) Ry(B) Rx(A).
fn rotation(axes: &AxisVector) -> Matrix3<f64> {
    nalgebra::Rotation3::from_euler_angles(
        axes[3].to_radians(),
        axes[4].to_radians(),
        axes[5].to_radians(),
    )
    .into_inner()
}
