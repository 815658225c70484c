//! Implicit curves: those in which two surfaces f(x, y, z) = 0 and g(x, y, z) = 0 cross.

mod across;
mod branch;
mod chords;
mod curvature;
mod node;
mod passage;
mod step;
mod tube;

pub use chords::{End, ImplicitChords};
pub use curvature::curvature_k;
pub use node::{Node, node};
pub use step::{ImplicitStep, ImplicitStepper, onto_curve};
pub use tube::chord_error_mm;

use crate::{Expression, ExpressionError};
use glidepath_geometry::number::{Gradient, Number};
use nalgebra::Vector3;

/// The curve in which two surfaces cross; coordinates in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct ImplicitCurve {
    surfaces: [Expression; 2],
}

/// Values and gradients of both surfaces at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    pub(crate) values: [f64; 2],
    pub(crate) normals: [Vector3<f64>; 2],
}

impl ImplicitCurve {
    /// From the formulas of f and g in x, y and z.
    ///
    /// # Errors
    /// The surface (0 for f) whose formula is wrong, and how.
    pub fn parse(formulas: [&str; 2]) -> Result<Self, (usize, ExpressionError)> {
        let parse =
            |i: usize| Expression::parse(formulas[i], &["x", "y", "z"]).map_err(|error| (i, error));
        Ok(Self {
            surfaces: [parse(0)?, parse(1)?],
        })
    }

    pub(crate) fn gradients<T: Number>(&self, point: [T; 3]) -> [Gradient<T>; 2] {
        let variables = Gradient::variables(point);
        core::array::from_fn(|i| self.surfaces[i].eval(&variables))
    }

    pub(crate) fn contact(&self, point: &Vector3<f64>) -> Contact {
        let gradients = self.gradients([point.x, point.y, point.z]);
        Contact {
            values: gradients.map(|g| g.value),
            normals: gradients.map(|g| g.partial.into()),
        }
    }

    /// Distance from the surfaces to first order, mm: the larger of |f|/|∇f| and |g|/|∇g|.
    #[must_use]
    pub fn residual_mm(&self, point: &Vector3<f64>) -> f64 {
        self.contact(point).residual_mm()
    }
}

impl Contact {
    pub(crate) fn residual_mm(&self) -> f64 {
        let of = |i: usize| self.values[i].abs() / self.normals[i].norm();
        of(0).max(of(1))
    }

    /// Direction of the curve, not of unit length; zero where the surfaces touch.
    pub(crate) fn along(&self) -> Vector3<f64> {
        self.normals[0].cross(&self.normals[1])
    }

    /// Sine of the angle between the surfaces: 0 where they touch.
    pub(crate) fn sine(&self) -> f64 {
        self.along().norm() / (self.normals[0].norm() * self.normals[1].norm())
    }

    /// Unit tangent on the side of `ahead`.
    pub(crate) fn tangent(&self, ahead: &Vector3<f64>) -> Vector3<f64> {
        let along = self.along();
        let unit = along / along.norm();
        if unit.dot(ahead) < 0.0 { -unit } else { unit }
    }
}
