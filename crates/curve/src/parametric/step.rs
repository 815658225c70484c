//! One chord along a parametric curve.
//!
//! The equation is d(x) = |C(t + x) − C(t)| = L. The published method bisects F = d² − L² on [0,
//! m]: safe once m is (see [`bracket`]), but 30 to 35 evaluations. The default solves d − L, which
//! is nearly linear in x, by Newton's method from a second-order guess: two to three evaluations.
//! A step that would leave the bracket is replaced by a bisection, so the bracket's guarantee
//! stays.

use super::bracket::{Bracket, bracket};
use super::{Local, ParametricCurve};
use crate::CurveError;
use nalgebra::Vector3;

/// The method by which the equation of a chord is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Newton's method on d − L inside the bracket.
    #[default]
    Newton,
    /// The secant method on d − L inside the bracket, for curves whose derivatives are dear.
    Secant,
    /// The published method: plain bisection of d² − L².
    Bisection,
}

/// The end of a chord, or of the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChordEnd {
    /// Parameter.
    pub t: f64,
    /// The point there, with derivatives.
    pub local: Local,
    /// Length of the chord, mm; shorter than asked for only at the end.
    pub chord_mm: f64,
    /// Whether this is the end of the domain.
    pub is_end: bool,
    /// Evaluations of the curve at a point, with or without derivatives.
    pub evaluations: u32,
    /// Evaluations over an interval.
    pub enclosures: u32,
}

/// Walks along a curve in chords.
#[derive(Debug, Clone)]
pub struct ParametricStepper<'a> {
    curve: &'a ParametricCurve,
    method: Method,
    t: f64,
    local: Local,
}

/// What is left of a chord's error, mm.
pub(super) fn precision_mm(point: &Vector3<f64>) -> f64 {
    // Rounding of coordinates makes a few units in the last place of the distance.
    2e-12 + 8.0 * f64::EPSILON * point.amax()
}

impl<'a> ParametricStepper<'a> {
    /// Starts at a parameter.
    #[must_use]
    pub fn new(curve: &'a ParametricCurve, t: f64, method: Method) -> Self {
        Self {
            curve,
            method,
            t,
            local: curve.local(t),
        }
    }

    /// Goes on where another one stood.
    pub(super) const fn resume(curve: &'a ParametricCurve, t: f64, local: Local) -> Self {
        Self {
            curve,
            method: Method::Newton,
            t,
            local,
        }
    }

    /// Where it stands.
    #[must_use]
    pub const fn local(&self) -> &Local {
        &self.local
    }

    /// Its parameter.
    #[must_use]
    pub const fn t(&self) -> f64 {
        self.t
    }

    /// The end of the next chord of a length, no further than `limit`. Does not move.
    ///
    /// # Errors
    /// The curve is not defined or not bounded there.
    pub fn look(&self, chord_mm: f64, limit: f64) -> Result<ChordEnd, CurveError> {
        let Some(bracket) = bracket(self.curve, self.t, &self.local, chord_mm, limit)? else {
            let local = self.curve.local(limit);
            return Ok(ChordEnd {
                t: limit,
                local,
                chord_mm: (local.point - self.local.point).norm(),
                is_end: true,
                evaluations: 1,
                enclosures: 1,
            });
        };
        let step = match self.method {
            Method::Newton => self.newton(&bracket, chord_mm),
            Method::Secant => self.secant(&bracket, chord_mm),
            Method::Bisection => self.bisection(&bracket, chord_mm),
        };
        if step.t.is_finite() && step.chord_mm.is_finite() {
            Ok(step)
        } else {
            Err(CurveError::Undefined { t: bracket.low })
        }
    }

    /// Moves to the end of a chord.
    pub fn advance(&mut self, step: &ChordEnd) {
        self.t = step.t;
        self.local = step.local;
    }

    fn step(&self, t: f64, local: Local, evaluations: u32, bracket: &Bracket) -> ChordEnd {
        ChordEnd {
            t,
            local,
            chord_mm: (local.point - self.local.point).norm(),
            is_end: false,
            evaluations: evaluations + bracket.evaluations,
            enclosures: bracket.enclosures,
        }
    }

    /// Bisections that suffice.
    fn most(&self, bracket: &Bracket) -> u32 {
        let width = (bracket.high - bracket.low) * self.local.d1.norm().max(1e-3);
        let halvings = (width / precision_mm(&self.local.point)).log2().ceil();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 200 by the clamp"
        )]
        let halvings = halvings.clamp(0.0, 200.0) as u32;
        halvings + 2
    }

    fn newton(&self, bracket: &Bracket, chord_mm: f64) -> ChordEnd {
        let (mut low, mut high) = (bracket.low, bracket.high);
        let precision = precision_mm(&self.local.point);
        let mut t = (self.t + self.local.guess(chord_mm)).clamp(low, high);
        let mut evaluations = 0;
        let mut there = self.curve.local(t);
        for _ in 0..self.most(bracket) {
            evaluations += 1;
            let out = there.point - self.local.point;
            let distance = out.norm();
            let excess = distance - chord_mm;
            if excess.abs() <= precision {
                break;
            }
            if excess < 0.0 {
                low = t;
            } else {
                high = t;
            }
            let newton = t - excess * distance / out.dot(&there.d1);
            t = inside(newton, low, high);
            there = self.curve.local(t);
        }
        self.step(t, there, evaluations, bracket)
    }

    fn secant(&self, bracket: &Bracket, chord_mm: f64) -> ChordEnd {
        let (mut low, mut high) = (bracket.low, bracket.high);
        let precision = precision_mm(&self.local.point);
        let mut t = (self.t + self.local.guess(chord_mm)).clamp(low, high);
        let mut last = (self.t, -chord_mm);
        let mut evaluations = 0;
        for _ in 0..2 * self.most(bracket) {
            let excess = (self.curve.point(t) - self.local.point).norm() - chord_mm;
            evaluations += 1;
            if excess.abs() <= precision {
                break;
            }
            if excess < 0.0 {
                low = t;
            } else {
                high = t;
            }
            let secant = t - excess * (t - last.0) / (excess - last.1);
            last = (t, excess);
            t = inside(secant, low, high);
        }
        self.step(t, self.curve.local(t), evaluations + 1, bracket)
    }

    /// The published bisection, from the start point on.
    fn bisection(&self, bracket: &Bracket, chord_mm: f64) -> ChordEnd {
        let (mut low, mut high) = (self.t, bracket.high);
        let whole = Bracket { low, ..*bracket };
        let mut evaluations = 0;
        for _ in 0..self.most(&whole) {
            let middle = 0.5 * (low + high);
            let square = (self.curve.point(middle) - self.local.point).norm_squared();
            evaluations += 1;
            if square < chord_mm * chord_mm {
                low = middle;
            } else {
                high = middle;
            }
        }
        let t = 0.5 * (low + high);
        self.step(t, self.curve.local(t), evaluations + 1, bracket)
    }
}

/// A candidate if it is inside the bracket, else its middle.
pub(crate) fn inside(candidate: f64, low: f64, high: f64) -> f64 {
    if candidate > low && candidate < high {
        candidate
    } else {
        0.5 * (low + high)
    }
}
