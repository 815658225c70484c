//! The joints along a curve of the axes, and how they change if the curve does.
//!
//! For a curve x(σ) with Taylor coefficients x₀ … x₃, the inverse of a mechanism gives those of the joints,
//! and, computed with numbers that carry the derivatives by x₀, the Jacobian along the curve,
//!
//! ```text
//!   J(σ) = J₀ + J₁ σ + J₂ σ² + J₃ σ³
//! ```
//!
//! with the bends of the mechanism in J₁, J₂ and J₃. If a term B(σ)·c is added to an axis a, as the basis
//! function of a control point does, then ∂q/∂c = J_a(σ)·B(σ) as functions of σ, and so
//!
//! ```text
//!   ∂q⁽ʳ⁾/∂c = r! Σ_{i ≤ r} J_{i,a} · B⁽ʳ⁻ⁱ⁾ / (r − i)!
//! ```
//!
//! exactly: what a row of a problem in the control points needs for the position (r = 0), velocity,
//! acceleration and jerk of a joint.

use crate::{JOINTS, JointVector, Kinematics, KinematicsError};
use glidepath_geometry::number::{Gradient, Number as _, Series};
use glidepath_geometry::{AXES, AxisVector};
use nalgebra::SMatrix;

/// Derivatives that are followed: position, velocity, acceleration, jerk.
const ORDERS: usize = 4;
const FACTORIAL: [f64; ORDERS] = [1.0, 1.0, 2.0, 6.0];

/// The joints at a place of a curve: their derivatives by its parameter, and the Jacobian along it by the
/// first `D` axes (3 for X Y Z, 6 with the rotary ones).
#[derive(Debug, Clone, PartialEq)]
pub struct CurveRates<const D: usize> {
    /// q, q′, q″ and q‴, in mm or degrees per parameter.
    pub derivatives: [JointVector; ORDERS],
    /// J₀ … J₃: derivatives of every joint by every axis, as Taylor coefficients.
    jacobian: [SMatrix<f64, JOINTS, D>; ORDERS],
}

impl<const D: usize> CurveRates<D> {
    /// The rates at a place of a curve, from the position of the axes (mm, degrees) there and its first
    /// three derivatives. Axes from the `D`-th on are moved, but nothing is derived by them.
    ///
    /// # Errors
    /// The place is out of reach.
    pub fn at(
        machine: &impl Kinematics,
        curve: &[AxisVector; ORDERS],
    ) -> Result<Self, KinematicsError> {
        let axes: [Series<ORDERS, Gradient<f64, D>>; AXES] = core::array::from_fn(|axis| {
            let mut coefficients: [Gradient<f64, D>; ORDERS] =
                core::array::from_fn(|k| Gradient::constant(curve[k][axis] / FACTORIAL[k]));
            if axis < D {
                coefficients[0].partial[axis] = 1.0;
            }
            Series::new(coefficients)
        });
        let joints = machine.inverse_series(&axes)?;
        let derivatives = core::array::from_fn(|k| {
            JointVector::from_fn(|joint, _| joints[joint].coefficients()[k].value * FACTORIAL[k])
        });
        let jacobian = core::array::from_fn(|k| {
            SMatrix::from_fn(|joint, axis| joints[joint].coefficients()[k].partial[axis])
        });
        Ok(Self {
            derivatives,
            jacobian,
        })
    }

    /// J₀ … J₃: the Jacobian along the curve, as Taylor coefficients by its parameter.
    #[must_use]
    pub const fn jacobian(&self) -> &[SMatrix<f64, JOINTS, D>; ORDERS] {
        &self.jacobian
    }

    /// How q, q′, q″ and q‴ of every joint change with a control point of every axis, from its basis
    /// function B and the first three derivatives of that, at the place.
    #[must_use]
    pub fn by_control_point(&self, basis: &[f64; ORDERS]) -> [SMatrix<f64, JOINTS, D>; ORDERS] {
        core::array::from_fn(|r| {
            let terms = self.jacobian.iter().take(r + 1).enumerate();
            let sum = terms.fold(SMatrix::zeros(), |sum, (i, jacobian)| {
                sum + jacobian * (basis[r - i] / FACTORIAL[r - i])
            });
            sum * FACTORIAL[r]
        })
    }
}
