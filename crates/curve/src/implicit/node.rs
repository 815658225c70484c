//! Nodes of an implicit curve: points where two branches cross.

use super::ImplicitCurve;
use glidepath_geometry::number::Series;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// Distance from the surfaces that is taken for rounding of their formulas, mm, at least.
const EXACT_MM: f64 = 1e-12;
/// Steps at most to find a node; four to six are taken.
const STEPS: u32 = 40;

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
    let [nf, ng] = curve.contact(point).normals;
    let mu = nf.dot(&ng) / ng.norm_squared();
    let hessian = hessian(curve, point, mu);
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

/// Hf − μ Hg.
fn hessian(curve: &ImplicitCurve, point: &Vector3<f64>, mu: f64) -> Matrix3<f64> {
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
    hessian
}

/// The point within `reach_mm` of a guess at which both surfaces meet and touch, but for the
/// rounding of their formulas: f = g = 0 and ∇f = μ ∇g. These are five equations for four
/// unknowns; at a node they agree, and Gauss-Newton steps converge to it quadratically.
pub(super) fn touching_point(
    curve: &ImplicitCurve,
    guess: &Vector3<f64>,
    reach_mm: f64,
) -> Option<Vector3<f64>> {
    let mut point = *guess;
    let mut mu = None;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let contact = curve.contact(&point);
        let [nf, ng] = contact.normals;
        let ratio = mu.unwrap_or_else(|| nf.dot(&ng) / ng.norm_squared());
        let bend = hessian(curve, &point, ratio);
        // Every row in mm: the distance from a surface, and from where the gradients are parallel.
        let size = bend.norm();
        let apart = (nf - ng * ratio) / size;
        let mut rows = SMatrix::<f64, 5, 4>::zeros();
        let mut residual = SVector::<f64, 5>::zeros();
        for i in 0..2 {
            let steep = contact.normals[i].norm();
            rows.fixed_view_mut::<1, 3>(i, 0)
                .copy_from(&(contact.normals[i] / steep).transpose());
            residual[i] = contact.values[i] / steep;
        }
        rows.fixed_view_mut::<3, 3>(2, 0).copy_from(&(bend / size));
        rows.fixed_view_mut::<3, 1>(2, 3).copy_from(&(-ng / size));
        residual.fixed_rows_mut::<3>(2).copy_from(&apart);
        if !rows.iter().chain(residual.iter()).all(|c| c.is_finite()) {
            return None;
        }
        let off = residual.amax();
        let exact = EXACT_MM.max(64.0 * f64::EPSILON * point.amax());
        if off <= exact && off >= 0.5 * last {
            return Some(point);
        }
        last = off;
        let step = rows.svd(true, true).solve(&residual, 1e-12).ok()?;
        point -= step.fixed_rows::<3>(0).into_owned();
        mu = Some(ratio - step[3]);
        if (point - guess).norm() > reach_mm {
            return None;
        }
    }
    None
}
