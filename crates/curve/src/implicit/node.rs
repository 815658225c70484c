//! Points where two branches cross.

use super::ImplicitCurve;
use glidepath_geometry::number::Series;
use nalgebra::{Matrix3, Vector3};

/// A point at which the surfaces touch and the curve crosses itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// ∇f = μ ∇g.
    pub mu: f64,
    /// Unit tangents of the two branches, their signs free.
    pub tangents: [Vector3<f64>; 2],
}

/// The two branches through a singular point: the directions in the common tangent plane in which
/// (Hf − μ Hg) vanishes. `None` if there are none (an isolated point) or only one (a cusp).
#[must_use]
pub fn node(curve: &ImplicitCurve, point: &Vector3<f64>) -> Option<Node> {
    let contact = curve.contact(point);
    let [nf, ng] = contact.normals;
    let mu = nf.dot(&ng) / ng.norm_squared();
    let mut hessian = Matrix3::zeros();
    for column in 0..3 {
        let moving = core::array::from_fn(|i| {
            Series::<2>::new([point[i], if i == column { 1.0 } else { 0.0 }])
        });
        let [f, g] = curve.gradients(moving);
        for row in 0..3 {
            hessian[(row, column)] =
                f.partial[row].derivative(1) - mu * g.partial[row].derivative(1);
        }
    }
    // A frame of the tangent plane, then a quadratic in the slope.
    let normal = ng / ng.norm();
    let e1 = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    let e2 = normal.cross(&e1);
    let form = |a: &Vector3<f64>, b: &Vector3<f64>| a.dot(&(hessian * b));
    let (a, b, c) = (form(&e1, &e1), form(&e1, &e2), form(&e2, &e2));
    let discriminant = b * b - a * c;
    let scale = a.abs().max(b.abs()).max(c.abs());
    if discriminant.partial_cmp(&(1e-12 * scale * scale)) != Some(core::cmp::Ordering::Greater) {
        return None;
    }
    // a cos² + 2 b cos sin + c sin² = 0, without dividing by what may be zero.
    let root = discriminant.sqrt();
    let first = if b >= 0.0 { -b - root } else { -b + root };
    let directions = [(first, a), (c, first)];
    let tangents = directions.map(|(x, y)| (e1 * x + e2 * y).normalize());
    Some(Node { mu, tangents })
}
