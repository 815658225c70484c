//! A curve, with everything that its file says about it.

use crate::implicit::{End, ImplicitChords};
use crate::parametric::ParametricChords;
use crate::{ChordRule, Chords, CurveError, ImplicitCurve, ParametricCurve};
use core::ops::Range;
use nalgebra::Vector3;

/// The curve of a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// x(t), y(t), z(t).
    Parametric {
        /// The formulas.
        curve: ParametricCurve,
        /// t at the start and, greater, at the end.
        domain: (f64, f64),
    },
    /// f = 0 = g.
    Implicit {
        /// The formulas.
        curve: ImplicitCurve,
        /// A point of the curve, mm.
        start: Vector3<f64>,
        /// The direction in which the curve is followed from there.
        direction: Vector3<f64>,
        /// Where it ends.
        end: End,
    },
}

/// Keys that say where a curve is, for diagnostics about the curve itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeKey {
    /// The formulas.
    Formula,
    /// Where it starts (or, for implicit curves, goes).
    Start,
    /// Where it ends.
    End,
}

/// A curve with what its file says about it.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveFile {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Programmed feedrate, mm/min.
    pub feed_mm_min: Option<f64>,
    /// Tolerance for everything together, mm.
    pub tolerance_mm: Option<f64>,
    /// Longest chord, mm.
    pub chord_mm: Option<f64>,
    /// Laps of a closed curve, at least 1.
    pub laps: u32,
    /// The curve.
    pub shape: Shape,
    pub(super) keys: [Range<usize>; 3],
}

impl CurveFile {
    /// The chords of the curve over all its laps.
    ///
    /// # Errors
    /// The curve cannot be followed from its start.
    pub fn chords(&self, rule: ChordRule) -> Result<Chords, CurveError> {
        let once: Chords = match &self.shape {
            Shape::Parametric { curve, domain } => {
                ParametricChords::new(curve.clone(), *domain, rule)?.into()
            }
            Shape::Implicit {
                curve,
                start,
                direction,
                end,
            } => ImplicitChords::new(curve.clone(), start, direction, *end, rule)?.into(),
        };
        Ok(once.with_laps(self.laps))
    }

    /// Where a key stands in the text, in bytes.
    #[must_use]
    pub fn key(&self, key: ShapeKey) -> Range<usize> {
        let [formula, start, end] = &self.keys;
        match key {
            ShapeKey::Formula => formula.clone(),
            ShapeKey::Start => start.clone(),
            ShapeKey::End => end.clone(),
        }
    }

    /// Which key an error of the curve is about.
    #[must_use]
    pub const fn blame(error: &CurveError) -> ShapeKey {
        match error {
            CurveError::Undefined { .. }
            | CurveError::Unbounded { .. }
            | CurveError::TooCoarse { .. }
            | CurveError::StandsStill { .. }
            | CurveError::Singular { .. } => ShapeKey::Formula,
            CurveError::Lost { .. } | CurveError::Sideways => ShapeKey::Start,
            CurveError::Endless { .. } => ShapeKey::End,
        }
    }
}
