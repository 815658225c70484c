//! A bound on the distance between an implicit curve and its chord.
//!
//! ```text
//!        v ↑  ┌──────────────────────────────┐ r
//!             │        ___-----___           │       u along the chord, v and w across;
//!           p ●──'''────────────────'''──────● q     the curve as (v(u), w(u))
//!             └──────────────────────────────┘
//! ```
//!
//! If over the whole tube |v|, |w| ≤ r the surfaces' Jacobian J by (v, w) is regular, the curve
//! inside is a graph over u. Its slopes are ξ′ = −J⁻¹ (f_u, g_u), and its second derivatives −J⁻¹
//! (ξᵀ Hf ξ, ξᵀ Hg ξ) with ξ = (1, v′, w′); interval arithmetic encloses both. A function with
//! v(0) = v(L) = 0 and |v″| ≤ b is within b L²/8 of zero. If that is smaller than r, the curve
//! cannot leave the tube, and since J is regular there is only one in it: the chord's. Slopes
//! below 1 also make the distance from p grow all along: q is the first crossing.
//!
//! Gradients are taken from the tube's middle with the mean value theorem, ∇f ∈ ∇f(c) + H (x − c):
//! over the axis-parallel box around a slanting tube they would vary much more than in the tube.

use super::ImplicitCurve;
use super::across::Across;
use glidepath_geometry::number::{Interval, Number, Series};
use nalgebra::Vector3;

/// A bound on the distance between the curve and the chord from `from` to `to`, both points of the
/// curve, mm: both ways, and in order. `None` if no tube of a few times the `expected_mm` gives a
/// proof.
#[must_use]
pub fn chord_error_mm(
    curve: &ImplicitCurve,
    from: &Vector3<f64>,
    to: &Vector3<f64>,
    expected_mm: f64,
) -> Option<f64> {
    [2.0, 6.0, 20.0]
        .into_iter()
        .find_map(|times| Tube::new(from, to, times * expected_mm + 1e-8).prove(curve))
}

/// How far the ends of a chord may be off the curve, mm, with room.
const ENDS_MM: f64 = 1e-9;

struct Tube {
    from: Vector3<f64>,
    to: Vector3<f64>,
    /// Unit vectors along and across.
    frame: [Vector3<f64>; 3],
    length_mm: f64,
    radius_mm: f64,
}

/// Derivatives of one surface in the tube's frame, all over the tube.
struct Slopes {
    gradient: [Interval; 3],
    hessian: [[Interval; 3]; 3],
}

impl Tube {
    fn new(from: &Vector3<f64>, to: &Vector3<f64>, radius_mm: f64) -> Self {
        let length_mm = (to - from).norm();
        let along = (to - from) / length_mm;
        let across = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
        Self {
            from: *from,
            to: *to,
            frame: [along, across, along.cross(&across)],
            length_mm,
            radius_mm,
        }
    }

    /// An axis-parallel box around the tube.
    fn boxed(&self) -> [Interval; 3] {
        core::array::from_fn(|i| {
            let across = self.frame[1][i].abs() + self.frame[2][i].abs();
            let reach = self.radius_mm * across * (1.0 + 1e-12);
            let (low, high) = (self.from[i].min(self.to[i]), self.from[i].max(self.to[i]));
            Interval::new((low - reach).next_down(), (high + reach).next_up())
        })
    }

    fn slopes(&self, curve: &ImplicitCurve) -> [Slopes; 2] {
        let middle = (self.from + self.to) * 0.5;
        let centre = curve.gradients(core::array::from_fn(|i| Interval::constant(middle[i])));
        let around = self.boxed();
        // The change of both gradients along each direction of the frame.
        let changes = self.frame.map(|direction| {
            let moving = core::array::from_fn(|i| {
                Series::<2, Interval>::new([around[i], Interval::constant(direction[i])])
            });
            curve
                .gradients(moving)
                .map(|gradient| gradient.partial.map(|p| p.derivative(1)))
        });
        let (half, r) = (0.5 * self.length_mm * (1.0 + 1e-12), self.radius_mm);
        let reach = [half, r, r].map(|x| Interval::new(-x, x));
        core::array::from_fn(|surface| {
            let hessian: [[Interval; 3]; 3] = core::array::from_fn(|j| {
                core::array::from_fn(|k| component(&changes[k][surface], &self.frame[j]))
            });
            let gradient = core::array::from_fn(|j| {
                let middle = component(&centre[surface].partial, &self.frame[j]);
                (0..3).fold(middle, |sum, k| sum + hessian[j][k] * reach[k])
            });
            Slopes { gradient, hessian }
        })
    }

    fn prove(&self, curve: &ImplicitCurve) -> Option<f64> {
        let surfaces = self.slopes(curve);
        let is_finite = surfaces.iter().all(|s| {
            let hessian = s.hessian.iter().flatten();
            s.gradient.iter().chain(hessian).all(|c| c.is_finite())
        });
        // The part of the Jacobian by (v, w).
        let [f, g] = [0, 1].map(|i: usize| [surfaces[i].gradient[1], surfaces[i].gradient[2]]);
        let across = Across::new([f, g]).filter(|_| is_finite)?;
        let [dv, dw] = across.solve([surfaces[0].gradient[0], surfaces[1].gradient[0]])?;
        let xi = [Interval::constant(1.0), dv, dw];
        let bends = [0, 1].map(|surface: usize| {
            let hessian = &surfaces[surface].hessian;
            let mut sum = Interval::constant(0.0);
            for j in 0..3 {
                sum = sum + hessian[j][j] * xi[j].square();
                for k in 0..j {
                    sum = sum + (hessian[j][k] * xi[j] * xi[k]).scale(2.0);
                }
            }
            sum
        });
        let bends = across.solve(bends)?;
        let steep = dv.magnitude().hypot(dw.magnitude());
        let off = bends.map(|b| 0.125 * b.magnitude() * self.length_mm * self.length_mm + ENDS_MM);
        let fits = off.iter().all(|o| *o < self.radius_mm);
        (steep < 1.0 && fits).then(|| off[0].hypot(off[1]) * (1.0 + 1e-12))
    }
}

/// A component of an interval vector.
fn component(vector: &[Interval; 3], direction: &Vector3<f64>) -> Interval {
    (0..3).fold(Interval::constant(0.0), |sum, i| {
        sum + vector[i] * Interval::constant(direction[i])
    })
}
