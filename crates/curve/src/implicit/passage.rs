//! A bound on the distance between a branch and a chord that passes a node.
//!
//! ```text
//!        · p      pieces, each with s in an interval            slopes of a piece within ±ω/2 of
//!          `-._                                                 a middle one: it is within ω ℓ / 4
//!              `·-.._ N                                         of its own chord
//!                    `·--..__
//!                            ``·---....__·  q
//! ```
//!
//! The arc is cut into pieces. For each, interval Newton on the equations of the branch (`branch.rs`)
//! proves that for every s of the piece there is one (u, w) in a box, and encloses it. The tangent
//! t + a m + b n of the curve is normal to ∇F / s and ∇g there, which encloses the slopes a and b. A
//! function whose slopes are in an interval of width ω is within ω ℓ / 4 of the chord of its graph over a
//! length ℓ. So the arc is no farther from the chord than the ends of the pieces are, and that. If all
//! tangents are within 45° of the chord, the distance from p grows all along: q is the first crossing,
//! and the arc is passed in order.

use super::ImplicitCurve;
use super::across::Across;
use super::branch::Branch;
use glidepath_geometry::number::{Interval, Number};
use nalgebra::{Vector2, Vector3};

/// Pieces of an arc, as many as it takes.
const PIECES: [u32; 4] = [4, 12, 36, 108];
/// How far computed points may be off the curve, mm, with room.
const ENDS_MM: f64 = 1e-9;
/// Cosine of the angle between the tangents and the chord, more than 45°.
const AHEAD: f64 = 0.71;

/// An arc of a branch and its chord.
pub(super) struct Passage<'a> {
    pub(super) curve: &'a ImplicitCurve,
    pub(super) branch: &'a Branch,
    /// Where it begins and ends.
    pub(super) s: [f64; 2],
    pub(super) ends: [Vector3<f64>; 2],
}

impl Passage<'_> {
    /// A bound on the distance between the arc and its chord, mm, both ways and in order, at most
    /// `most_mm`; `None` if that is not proven.
    pub(super) fn error_mm(&self, most_mm: f64) -> Option<f64> {
        PIECES
            .into_iter()
            .find_map(|pieces| self.error_in(pieces).filter(|error| *error <= most_mm))
    }

    fn error_in(&self, pieces: u32) -> Option<f64> {
        let [from, to] = &self.ends;
        let ahead = (to - from).normalize();
        let s = |k: u32| self.s[0] + (self.s[1] - self.s[0]) * f64::from(k) / f64::from(pieces);
        let (mut off_mm, mut within_mm): (f64, f64) = (0.0, 0.0);
        for k in 0..pieces {
            let out = self.branch.point(self.curve, s(k))? - from;
            off_mm = off_mm.max((out - ahead * out.dot(&ahead)).norm());
            within_mm = within_mm.max(self.piece_mm(s(k), s(k + 1), &ahead)?);
        }
        Some((off_mm + within_mm + ENDS_MM) * (1.0 + 1e-12))
    }

    /// How far a piece is from its own chord at most, mm, if all of it leads ahead.
    fn piece_mm(&self, from_s: f64, to_s: f64, ahead: &Vector3<f64>) -> Option<f64> {
        let middle = self.branch.solve(self.curve, 0.5 * (from_s + to_s))?;
        let s = Interval::new(from_s.min(to_s).next_down(), from_s.max(to_s).next_up());
        let box_ = self.enclose(s, &middle)?;
        let [a, b] = self.slopes(s, &box_)?;
        let tangent = self.direction(&[a, b]);
        let along = tangent.iter().zip(ahead.iter());
        let along = along.fold(Interval::constant(0.0), |sum, (t, c)| {
            sum + *t * Interval::constant(*c)
        });
        let length = (1.0 + a.magnitude().powi(2) + b.magnitude().powi(2)).sqrt();
        let is_ahead = along.low() >= AHEAD * length;
        is_ahead.then(|| 0.25 * s.width() * a.width().hypot(b.width()))
    }

    /// Interval Newton from a solution in the middle of a piece: a box that holds the one solution for
    /// every s.
    fn enclose(&self, s: Interval, middle: &Vector2<f64>) -> Option<[Interval; 2]> {
        let point = [0, 1].map(|i: usize| Interval::constant(middle[i]));
        let values = self.quotients(s, &point).values;
        let mut box_ = point;
        for _ in 0..6 {
            let gradients = self.quotients(s, &box_).gradients;
            let change = Across::new(self.across(&gradients))?.solve(values)?;
            let next = [0, 1].map(|i: usize| point[i] + change[i]);
            let is_inside = next
                .iter()
                .zip(&box_)
                .all(|(n, x)| x.low() < n.low() && n.high() < x.high());
            if is_inside {
                return Some(next);
            }
            // Half as much again about the middle, for the next turn.
            box_ = core::array::from_fn(|i| {
                let reach = 1.5 * change[i].magnitude() + 1e-12;
                Interval::new(middle[i] - reach, middle[i] + reach)
            });
        }
        None
    }

    /// Slopes (a, b) of the curve over s, all over a box.
    fn slopes(&self, s: Interval, box_: &[Interval; 2]) -> Option<[Interval; 2]> {
        let gradients = self.quotients(s, box_).gradients;
        let along = gradients.map(|gradient| component(&gradient, &self.branch.frame()[0]));
        Across::new(self.across(&gradients))?.solve(along)
    }

    fn quotients(&self, s: Interval, box_: &[Interval; 2]) -> super::branch::Quotients<Interval> {
        let d = self.direction(box_);
        // All points between the node and the piece.
        let reach = s.hull(Interval::constant(0.0));
        let around =
            core::array::from_fn(|i| Interval::constant(self.branch.node()[i]) + reach * d[i]);
        self.branch.quotients(self.curve, s, d, around)
    }

    fn direction(&self, box_: &[Interval; 2]) -> [Interval; 3] {
        let [t, m, n] = self.branch.frame();
        core::array::from_fn(|i| {
            Interval::constant(t[i])
                + box_[0] * Interval::constant(m[i])
                + box_[1] * Interval::constant(n[i])
        })
    }

    fn across(&self, gradients: &[[Interval; 3]; 2]) -> [[Interval; 2]; 2] {
        let [_, m, n] = self.branch.frame();
        gradients.map(|gradient| [component(&gradient, m), component(&gradient, n)])
    }
}

/// A component of an interval vector.
fn component(vector: &[Interval; 3], direction: &Vector3<f64>) -> Interval {
    (0..3).fold(Interval::constant(0.0), |sum, i| {
        sum + vector[i] * Interval::constant(direction[i])
    })
}
