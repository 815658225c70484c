//! An implicit curve as a sequence of chords whose error is proven.

use super::step::{ImplicitStep, ImplicitStepper, Place, onto_curve};
use super::tube::chord_error_mm;
use super::{ImplicitCurve, curvature_k};
use crate::{Chord, ChordRule, CurveError, arc_over_chord, chord_mm, sagitta_mm};
use nalgebra::Vector3;

/// How far a given point may be off the curve, mm: coordinates in files are rounded.
const GIVEN_MM: f64 = 0.01;
/// Length after which a curve that does not end is given up, mm.
const ENDLESS_MM: f64 = 1e7;
/// Corrections beyond which a chord is too long for the curve.
const HARD: u32 = 6;
/// Longest chord that may pass a node without proof, mm.
const NODE_MM: f64 = 0.01;
/// Angle of the surfaces (its sine) that makes a place a node.
const NODE_SINE: f64 = 0.01;

/// Where a curve ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// Back at its start.
    Closed,
    /// At a point of the curve.
    At(Vector3<f64>),
    /// After a length along the curve, mm.
    Length(f64),
}

/// Chords from a start to an end.
#[derive(Debug, Clone)]
pub struct ImplicitChords {
    curve: ImplicitCurve,
    place: Place,
    rule: ChordRule,
    /// Where it ends, if at a point.
    target: Option<Vector3<f64>>,
    /// Length along the curve at which it ends, mm.
    until_mm: f64,
    travelled_mm: f64,
    last_mm: f64,
    is_over: bool,
}

impl ImplicitChords {
    /// Chords from the point of the curve next to `start`, in the direction of `ahead`.
    ///
    /// # Errors
    /// Start or end are not on the curve, or the surfaces touch at the start.
    pub fn new(
        curve: ImplicitCurve,
        start: &Vector3<f64>,
        ahead: &Vector3<f64>,
        end: End,
        rule: ChordRule,
    ) -> Result<Self, CurveError> {
        let start = onto_curve(&curve, start, GIVEN_MM)?;
        let (target, until_mm) = match end {
            End::Closed => (Some(start), ENDLESS_MM),
            End::At(point) => (Some(onto_curve(&curve, &point, GIVEN_MM)?), ENDLESS_MM),
            End::Length(length_mm) => (None, length_mm),
        };
        let place = ImplicitStepper::new(&curve, start, ahead)?.place();
        Ok(Self {
            curve,
            place,
            rule,
            target,
            until_mm,
            travelled_mm: 0.0,
            last_mm: f64::INFINITY,
            is_over: false,
        })
    }

    /// Where the next chord starts.
    #[must_use]
    pub const fn point(&self) -> &Vector3<f64> {
        &self.place.point
    }

    /// The next chord; `None` after the last.
    ///
    /// # Errors
    /// The error of no chord can be bounded, or the end does not come.
    pub fn next_chord(&mut self) -> Result<Option<Chord>, CurveError> {
        if self.is_over {
            return Ok(None);
        }
        if self.travelled_mm >= ENDLESS_MM {
            return Err(CurveError::Endless {
                length_mm: ENDLESS_MM,
            });
        }
        let here = curvature_k(&self.curve, self.point());
        let mut wanted = self.rule.longest_mm.min(1.5 * self.last_mm);
        if here.is_finite() {
            wanted = wanted.min(chord_mm(here, self.rule.error_mm));
        }
        loop {
            let rest = self.until_mm - self.travelled_mm;
            let bend = if here.is_finite() && here * rest < 1.0 {
                arc_over_chord(here, rest)
            } else {
                1.0
            };
            wanted = wanted.min(rest / bend);
            if let Some((step, chord)) = self.attempt(wanted) {
                return Ok(Some(self.take(&step, chord, wanted)));
            }
            let is_least = wanted <= self.rule.shortest_mm();
            if is_least {
                return Err(CurveError::Singular {
                    point: *self.point(),
                });
            }
            wanted *= 0.6;
        }
    }

    /// A chord of a length, if it is within the error.
    fn attempt(&self, wanted: f64) -> Option<(ImplicitStep, Chord)> {
        let step = ImplicitStepper::resume(&self.curve, self.place)
            .look(wanted)
            .ok()?;
        if step.corrections > HARD {
            return None;
        }
        let expected = self.expected_mm(&step, wanted);
        let proven = chord_error_mm(&self.curve, self.point(), &step.point, expected);
        // Near a node nothing can be proven, but a short chord is harmless.
        let is_proven = proven.is_some();
        let passes_node = wanted <= NODE_MM && step.sine <= NODE_SINE;
        let error_mm = proven.or_else(|| passes_node.then_some(2.0 * expected))?;
        (error_mm <= self.rule.error_mm).then_some((
            step,
            Chord {
                point: step.point,
                chord_mm: wanted,
                error_mm,
                is_proven,
            },
        ))
    }

    /// The sagitta by the curvature at both ends, as far as it is known, and by the last turn.
    fn expected_mm(&self, step: &ImplicitStep, chord: f64) -> f64 {
        let ends = [*self.point(), step.point];
        let sharpest = ends
            .iter()
            .map(|p| curvature_k(&self.curve, p))
            .filter(|k| k.is_finite())
            .fold(1e-6, f64::max);
        sagitta_mm(sharpest, chord).min(chord)
    }

    fn take(&mut self, step: &ImplicitStep, chord: Chord, wanted: f64) -> Chord {
        self.last_mm = wanted;
        let from = *self.point();
        if let Some(target) = self.passed(&from, &step.point) {
            self.is_over = true;
            self.place.point = target;
            return Chord {
                point: target,
                chord_mm: (target - from).norm(),
                ..chord
            };
        }
        let mut stepper = ImplicitStepper::resume(&self.curve, self.place);
        stepper.advance(step);
        self.place = stepper.place();
        let curvature = curvature_k(&self.curve, &step.point);
        let arc = if curvature.is_finite() && curvature * wanted < 1.0 {
            wanted * arc_over_chord(curvature, wanted)
        } else {
            wanted
        };
        self.travelled_mm += arc;
        if self.travelled_mm >= self.until_mm - 1e-9 {
            self.is_over = true;
        }
        chord
    }

    /// The end point, if a chord passes it: it is then inside the sphere over the chord, next to it.
    fn passed(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> Option<Vector3<f64>> {
        let target = self.target.filter(|_| self.travelled_mm > 0.0)?;
        let along = to - from;
        let out = target - from;
        let share = out.dot(&along) / along.norm_squared();
        let off = (out - along * share).norm();
        let near = 2.0 * self.rule.error_mm + 1e-9;
        (share > 0.0 && share <= 1.0 + 1e-9 && off <= near).then_some(target)
    }
}
