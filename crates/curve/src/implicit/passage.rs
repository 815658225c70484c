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
//! The arc is cut into pieces. For each, interval Newton on the equations of the branch
//! (`branch.rs`) proves that for every s of the piece there is one (u, w) in a box. The tangent is
//! t + a m + b n, normal to ∇F / s and ∇g there, which encloses the slopes a and b. A function
//! whose slopes are in an interval of width ω is within ω ℓ / 4 of the chord of its graph over a
//! length ℓ. So the arc is no farther from the chord than the ends of the pieces are, and that. If
//! all tangents are within 45° of the chord, the distance from p grows all along: q is the first
//! crossing, and the arc is passed in order.

use super::ImplicitCurve;
use super::across::Across;
use super::branch::{Branch, Quotients};
use glidepath_geometry::number::{Interval, Number};
use nalgebra::{Vector2, Vector3};

/// Pieces of an arc, as many as it takes.
const PIECES: [u32; 3] = [4, 12, 36];
/// Rounds of interval Newton; two are taken, or three.
const ROUNDS: u32 = 6;
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
        for pieces in PIECES {
            // Points of the curve too far away are too far in any number of pieces.
            let off_mm = self.off_mm(pieces).filter(|off_mm| *off_mm < most_mm)?;
            let Some(within_mm) = self.within_mm(pieces) else {
                continue;
            };
            let error_mm = (off_mm + within_mm + ENDS_MM) * (1.0 + 1e-12);
            if error_mm <= most_mm {
                return Some(error_mm);
            }
            // Pieces a third as long are a ninth as far from their chords.
            if off_mm + within_mm / 8.0 > most_mm {
                return None;
            }
        }
        None
    }

    /// Where piece `k` of so many begins.
    fn at(&self, k: u32, pieces: u32) -> f64 {
        let [from_s, to_s] = self.s;
        from_s + (to_s - from_s) * f64::from(k) / f64::from(pieces)
    }

    /// Unit vector along the chord.
    fn ahead(&self) -> Vector3<f64> {
        (self.ends[1] - self.ends[0]).normalize()
    }

    /// Largest distance of the ends of pieces from the chord, mm.
    fn off_mm(&self, pieces: u32) -> Option<f64> {
        let ahead = self.ahead();
        (1..pieces).try_fold(0.0_f64, |off_mm, k| {
            let point = self.branch.point(self.curve, self.at(k, pieces))?;
            let out = point - self.ends[0];
            Some(off_mm.max((out - ahead * out.dot(&ahead)).norm()))
        })
    }

    /// How far pieces are from their own chords at most, mm, if all of them lead ahead.
    fn within_mm(&self, pieces: u32) -> Option<f64> {
        let ahead = self.ahead();
        (0..pieces).try_fold(0.0_f64, |within_mm, k| {
            let piece_mm = self.piece_mm(self.at(k, pieces), self.at(k + 1, pieces), &ahead)?;
            Some(within_mm.max(piece_mm))
        })
    }

    fn piece_mm(&self, from_s: f64, to_s: f64, ahead: &Vector3<f64>) -> Option<f64> {
        let middle = self.branch.solve(self.curve, 0.5 * (from_s + to_s))?;
        let s = Interval::new(from_s, to_s);
        let [a, b] = self.slopes(s, &middle)?;
        let tangent = self.direction(&[a, b]);
        let along = tangent.iter().zip(ahead.iter());
        let along = along.fold(Interval::constant(0.0), |sum, (t, c)| {
            sum + *t * Interval::constant(*c)
        });
        let length = (1.0 + a.magnitude().powi(2) + b.magnitude().powi(2)).sqrt();
        let is_ahead = along.low() >= AHEAD * length;
        is_ahead.then(|| 0.25 * s.width() * a.width().hypot(b.width()))
    }

    /// Slopes (a, b) of the curve for all s of an interval.
    ///
    /// Interval Newton, from the solution in the middle: if it maps a box into itself, the box
    /// holds one solution for every s, and the slopes of all of them are found from the gradients
    /// over the box.
    fn slopes(&self, s: Interval, middle: &Vector2<f64>) -> Option<[Interval; 2]> {
        let point = [0, 1].map(|i: usize| Interval::constant(middle[i]));
        let Quotients {
            values,
            mut gradients,
            ..
        } = self.quotients(s, &point);
        let mut about = point;
        for _ in 0..ROUNDS {
            let across = Across::new(self.across(&gradients))?;
            let change = across.solve(values)?;
            let is_inside = change.iter().zip(&about).zip(&point).all(|((c, x), m)| {
                let next = *m + *c;
                x.low() < next.low() && next.high() < x.high()
            });
            if is_inside {
                let [t, ..] = self.branch.frame();
                return across.solve(gradients.map(|gradient| component(&gradient, t)));
            }
            // Half as much again about the middle, for the next round.
            about = core::array::from_fn(|i| {
                let reach = 1.5 * change[i].magnitude() + 1e-12;
                Interval::new(middle[i] - reach, middle[i] + reach)
            });
            gradients = self.quotients(s, &about).gradients;
        }
        None
    }

    fn quotients(&self, s: Interval, box_: &[Interval; 2]) -> Quotients<Interval> {
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
