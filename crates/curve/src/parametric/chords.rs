//! A parametric curve as a sequence of chords whose error is proven.

use super::step::{ChordEnd, ParametricStepper, precision_mm};
use super::{Local, ParametricCurve, breaks};
use crate::{Chord, ChordRule, CurveError, chord_mm};
use nalgebra::Vector3;

/// By how much rounding may make a chord longer than wanted, of the longest one. (Shorter ones come
/// from cusps, where the way is flat in the parameter.)
const MISS_R: f64 = 1e-3;

/// How much longer than the last one a chord may be tried, and how much shorter the next try is where the
/// error of one is too large. The error goes with the square of the length, so .7 halves it.
const LONGER_R: f64 = 1.5;
const SHORTER_R: f64 = 0.7;

/// Chords from one end of a domain to the other.
#[derive(Debug, Clone)]
pub struct ParametricChords {
    curve: ParametricCurve,
    rule: ChordRule,
    t: f64,
    local: Local,
    /// Cusps and the end, the last first.
    limits: Vec<f64>,
    last_mm: f64,
}

impl ParametricChords {
    /// Chords over `from` < `to`. Cusps become ends of chords.
    ///
    /// # Errors
    /// The curve is not defined or not bounded somewhere, or stands still.
    pub fn new(
        curve: ParametricCurve,
        (from, to): (f64, f64),
        rule: ChordRule,
    ) -> Result<Self, CurveError> {
        let mut limits = breaks(&curve, from, to)?;
        limits.push(to);
        limits.reverse();
        Ok(Self {
            local: curve.local(from),
            curve,
            rule,
            t: from,
            limits,
            last_mm: f64::INFINITY,
        })
    }

    /// Where the next chord starts.
    #[must_use]
    pub const fn point(&self) -> &Vector3<f64> {
        &self.local.point
    }

    /// The next chord; `None` after the last.
    ///
    /// # Errors
    /// The error of no chord can be bounded, or the curve stands still all over its domain.
    pub fn next_chord(&mut self) -> Result<Option<Chord>, CurveError> {
        while let Some(&limit) = self.limits.last() {
            let (step, wanted, error_mm) = self.look(limit)?;
            if !step.is_end || step.chord_mm > precision_mm(&step.local.point) {
                return Ok(Some(self.take(&step, wanted, error_mm)));
            }
            // What is left of the range up to a cusp or the end, or a range over which the curve
            // moves by less than its coordinates can tell.
            let t = self.t;
            self.go_to(&step);
            if self.limits.is_empty() && self.last_mm.is_infinite() {
                return Err(CurveError::StandsStill { t });
            }
        }
        Ok(None)
    }

    /// The longest chord that the rule allows: its end, the length asked for, its error, mm.
    fn look(&self, limit: f64) -> Result<(ChordEnd, f64, f64), CurveError> {
        let stepper = ParametricStepper::resume(&self.curve, self.t, self.local);
        let curvature = self.local.curvature_k();
        let round = if curvature.is_finite() {
            chord_mm(curvature, self.rule.error_mm)
        } else {
            self.rule.longest_mm
        };
        let mut wanted = self.rule.longest_mm.min(round).min(LONGER_R * self.last_mm);
        loop {
            let step = stepper.look(wanted, limit)?;
            let is_missed = step.chord_mm > wanted + MISS_R * self.rule.longest_mm
                || !step.is_end && step.chord_mm <= precision_mm(&step.local.point);
            if is_missed {
                return Err(CurveError::TooCoarse { t: self.t });
            }
            let error_mm = self.curve.chord_error_mm(self.t, step.t);
            if let Some(error_mm) = error_mm.filter(|error| *error <= self.rule.error_mm) {
                return Ok((step, wanted, error_mm));
            }
            wanted *= SHORTER_R;
            if wanted < self.rule.shortest_mm() {
                return Err(CurveError::Unbounded { t: self.t });
            }
        }
    }

    fn take(&mut self, step: &ChordEnd, wanted: f64, error_mm: f64) -> Chord {
        // The way back from a cusp begins as slowly as the way to it ended.
        self.last_mm = wanted;
        self.go_to(step);
        Chord {
            point: step.local.point,
            chord_mm: step.chord_mm,
            error_mm,
            is_proven: true,
        }
    }

    fn go_to(&mut self, step: &ChordEnd) {
        (self.t, self.local) = (step.t, step.local);
        if step.is_end {
            self.limits.pop();
        }
    }
}
