//! Curve files: a space curve given by formulas, as TOML.
//!
//! ```toml
//! kind = "parametric"
//! x = "20*(1 + cos(t))"       # mm; angles in radians
//! y = "20*sin(t)"
//! z = "40*sin(t/2)"
//! from = 0                    # t at the start and at the end: numbers, or formulas without variables
//! to = "4*pi"
//! feed = 3000.0               # mm/min; may be left out where the machine has a default
//! ```
//!
//! ```toml
//! kind = "implicit"
//! f = "x^2 + y^2 + z^2 - 1600"   # two surfaces, both zero on the curve
//! g = "(x - 20)^2 + y^2 - 400"
//! start = [20.0, 20.0, 28.2843]  # a point of the curve, within 0.01 mm
//! direction = [-1.0, 0.0, 0.0]   # which way to go from there, roughly
//! end = "closed"                 # or a point [x, y, z], or the length along the curve, mm
//! ```
//!
//! In both kinds, optional: `name`; `tolerance`, mm, everything included; `chord`, the longest chord,
//! mm; `laps` of a closed curve.

mod judge;

use crate::implicit::{End, ImplicitChords};
use crate::parametric::ParametricChords;
use crate::{ChordRule, Chords, CurveError, ImplicitCurve, ParametricCurve};
use core::ops::Range;
use nalgebra::Vector3;
use serde::Deserialize;
use toml::Spanned;

type Key<T> = Option<Spanned<T>>;

/// The file as it is written, before any value is judged.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    kind: Spanned<String>,
    name: Option<String>,
    feed: Key<f64>,
    tolerance: Key<f64>,
    chord: Key<f64>,
    laps: Key<i64>,
    x: Key<String>,
    y: Key<String>,
    z: Key<String>,
    from: Key<Number>,
    to: Key<Number>,
    f: Key<String>,
    g: Key<String>,
    start: Key<[f64; 3]>,
    direction: Key<[f64; 3]>,
    end: Key<RawEnd>,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Number {
    Value(f64),
    Formula(String),
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum RawEnd {
    Word(String),
    Point([f64; 3]),
    Length(f64),
}

/// What is wrong with a curve file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileDiagnostic {
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: String,
    /// Where, in bytes of the text.
    pub at: Range<usize>,
}

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
        /// Which way to go.
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
    places: [Range<usize>; 3],
}

impl CurveFile {
    /// Reads the text of a curve file.
    ///
    /// # Errors
    /// All diagnostics, at least one.
    pub fn parse(text: &str) -> Result<Self, Vec<FileDiagnostic>> {
        let raw: Raw = toml::from_str(text).map_err(|error| {
            vec![FileDiagnostic {
                message: error.message().lines().next().unwrap_or("").to_owned(),
                help: "a curve file is TOML with the keys of its kind".to_owned(),
                at: error.span().unwrap_or(0..0),
            }]
        })?;
        judge::judge(raw)
    }

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
    pub fn place(&self, key: ShapeKey) -> Range<usize> {
        let [formula, start, end] = &self.places;
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
            | CurveError::StandsStill { .. }
            | CurveError::Singular { .. } => ShapeKey::Formula,
            CurveError::Lost { .. } | CurveError::Sideways => ShapeKey::Start,
            CurveError::Endless { .. } => ShapeKey::End,
        }
    }
}
