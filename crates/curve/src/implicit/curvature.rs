//! The curvature of an implicit curve, which has no parametrisation.

use super::ImplicitCurve;
use glidepath_geometry::number::Series;
use nalgebra::Vector3;

/// Curvature at a point of the curve, 1/mm; not finite where the surfaces touch.
///
/// With w = ∇f × ∇g and T = w/|w|, the change of w along T is w′ = (Hf T) × ∇g + ∇f × (Hg T), and
/// κ = |T × w′| / |w|. The Hessian products are derivatives of the gradients along T.
#[must_use]
pub fn curvature_k(curve: &ImplicitCurve, point: &Vector3<f64>) -> f64 {
    let along = curve.contact(point).along();
    let size = along.norm();
    let tangent = along / size;
    let moving = core::array::from_fn(|i| Series::<2>::new([point[i], tangent[i]]));
    let [f, g] = curve.gradients(moving);
    let normal = |k| {
        (
            Vector3::from_fn(|i, _| f.partial[i].derivative(k)),
            Vector3::from_fn(|i, _| g.partial[i].derivative(k)),
        )
    };
    let ((nf, ng), (df, dg)) = (normal(0), normal(1));
    let change = df.cross(&ng) + nf.cross(&dg);
    tangent.cross(&change).norm() / size
}
