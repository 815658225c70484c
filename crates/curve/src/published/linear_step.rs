//! The published step: one linearisation for each chord. It is for comparison, not for use.
//!
//! ```text
//!   ∇f · d = −f(p),   ∇g · d = −g(p),   |d| = L
//! ```
//!
//! Read with zeros on the right, it is Euler's method: on a circle every step adds L² to the
//! square of the radius, about π L a lap whatever the radius. With the residuals it does not
//! accumulate, but every point stays κ L²/2 off the curve, four times the sagitta.

use crate::ImplicitCurve;
use nalgebra::{Matrix2, Vector2, Vector3};

/// The two ways to read the published equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// Right side 0.
    Tangent,
    /// Right side −f(p), −g(p).
    Residual,
}

/// One step of a length from a point, on the side of `ahead`; `None` where the equations have no
/// solution.
#[must_use]
pub fn linear_step(
    curve: &ImplicitCurve,
    from: &Vector3<f64>,
    ahead: &Vector3<f64>,
    chord_mm: f64,
    reading: Reading,
) -> Option<Vector3<f64>> {
    let contact = curve.contact(from);
    let [a, b] = contact.normals;
    let right = match reading {
        Reading::Tangent => Vector2::zeros(),
        Reading::Residual => Vector2::from(contact.values),
    };
    let gram = Matrix2::new(a.dot(&a), a.dot(&b), a.dot(&b), b.dot(&b));
    let weights = gram.try_inverse()? * right;
    let across = -(a * weights.x + b * weights.y);
    let square = chord_mm * chord_mm - across.norm_squared();
    let step = across + contact.tangent(ahead) * square.sqrt();
    step.iter().all(|c| c.is_finite()).then(|| from + step)
}
