//! Curve files of one NURBS, as TOML or JSON.
//!
//! ```toml
//! kind = "nurbs"                  # may be left out
//! name = "arch"                   # may be left out
//! feed = 6000.0                   # mm/min, may be left out
//! tolerance = 0.01                # mm, everything included; may be left out
//! degree = 3
//! control_points = [[0.0, 0.0], [0.0, 20.0], [30.0, 20.0], [30.0, 0.0]]   # mm
//! weights = [1.0, 1.0, 1.0, 1.0]  # one for each point; may be left out if all are 1
//! knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]
//! ```
//!
//! A point has two to nine coordinates, in the order X Y Z A B C U V W; all points as many. JSON
//! has the same keys. A file that begins with `{` is JSON. `units`, `source`, `status` and `note`
//! say where a curve comes from; they change nothing, but `units` other than "mm" are refused.

mod place;
mod raw;

use crate::FileDiagnostic;
use crate::range::{FEED_MM_MIN, TOLERANCE_MM};
use core::ops::Range;
use glidepath_geometry::{AXES, AxisVector, Nurbs, NurbsError};
use place::place;
use raw::RawCurve;

/// A NURBS with what its file says about it.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsFile {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Programmed feedrate, mm/min.
    pub feed_mm_min: Option<f64>,
    /// Tolerance for everything together, mm.
    pub tolerance_mm: Option<f64>,
    /// Axes that have coordinates, in the order X Y Z A B C U V W; on the others it is at zero.
    pub axes: usize,
    /// The curve.
    pub curve: Nurbs,
    /// Where its control points stand in the text, in bytes.
    pub place: Range<usize>,
}

impl NurbsFile {
    /// True if the text of a curve file is meant to be that of a NURBS: it is JSON, or has a key
    /// that only these have.
    #[must_use]
    pub fn is_meant(text: &str) -> bool {
        let has = |key: &str| !place(text, key, None).is_empty();
        let kind = place(text, "kind", None);
        let value = text.get(kind.end..).and_then(|rest| rest.lines().next());
        let is_kind = !kind.is_empty() && value.is_some_and(|value| value.contains("\"nurbs\""));
        text.trim_start().starts_with('{') || is_kind || has("control_points") || has("knots")
    }

    /// Judges the text of a curve file.
    ///
    /// # Errors
    /// The first thing that has to be mended.
    pub fn parse(text: &str) -> Result<Self, Box<FileDiagnostic>> {
        judge(text)
    }
}

fn judge(text: &str) -> Result<NurbsFile, Box<FileDiagnostic>> {
    let raw = raw::parse(text)?;
    let fault = |key: &str, index: Option<usize>, message: String, help: &str| {
        Box::new(FileDiagnostic {
            message,
            help: help.to_owned(),
            at: place(text, key, index),
        })
    };
    if let Some(units) = raw.units.as_ref().filter(|units| *units != "mm") {
        let message = format!("units \"{units}\" are not known");
        return Err(fault(
            "units",
            None,
            message,
            "convert the coordinates to mm",
        ));
    }
    for (key, value, range) in [
        ("feed", raw.feed, &FEED_MM_MIN),
        ("tolerance", raw.tolerance, &TOLERANCE_MM),
    ] {
        if let Some((message, help)) = value.and_then(|value| range.refusal(key, value)) {
            return Err(fault(key, None, message, &help));
        }
    }
    let points = points(&raw).map_err(|(index, message)| {
        let help =
            "give every point the same two to nine coordinates, in the order X Y Z A B C U V W";
        fault("control_points", Some(index), message, help)
    })?;
    let weights = raw
        .weights
        .clone()
        .unwrap_or_else(|| vec![1.0; points.len()]);
    let degree = usize::try_from(raw.degree).unwrap_or(0);
    let curve = Nurbs::new(degree, &points, &weights, &raw.knots).map_err(|error| {
        let (key, index, help) = remedy(&error);
        fault(key, index, error.to_string(), help)
    })?;
    Ok(NurbsFile {
        axes: raw.control_points.first().map_or(0, Vec::len),
        name: raw.name,
        feed_mm_min: raw.feed,
        tolerance_mm: raw.tolerance,
        curve,
        place: place(text, "control_points", None),
    })
}

/// The control points over all axes; else the index of one that is none, and why.
fn points(raw: &RawCurve) -> Result<Vec<AxisVector>, (usize, String)> {
    let expected = raw.control_points.first().map_or(0, Vec::len);
    let over_axes = |(index, coordinates): (usize, &Vec<f64>)| {
        let count = coordinates.len();
        if count != expected || !(2..=AXES).contains(&count) {
            let message = if count == expected {
                format!("control points of {count} coordinates")
            } else {
                format!("control point {index} has {count} coordinates, the first {expected}")
            };
            return Err((index, message));
        }
        let mut point = AxisVector::zeros();
        for (axis, coordinate) in point.iter_mut().zip(coordinates) {
            *axis = *coordinate;
        }
        Ok(point)
    };
    raw.control_points
        .iter()
        .enumerate()
        .map(over_axes)
        .collect()
}

/// Which key an error is about, which of its elements, and how to mend it.
const fn remedy(error: &NurbsError) -> (&'static str, Option<usize>, &'static str) {
    match error {
        NurbsError::Degree { .. } => ("degree", None, "a cubic has degree 3"),
        NurbsError::TooFewPoints { .. } => (
            "control_points",
            None,
            "add control points, or lower the degree",
        ),
        NurbsError::WeightCount { .. } => (
            "weights",
            None,
            "give one weight for each point, or leave the weights out if all are 1",
        ),
        NurbsError::KnotCount { .. } => (
            "knots",
            None,
            "repeat the first and the last knot degree + 1 times, and put the others between",
        ),
        NurbsError::Point { index } => ("control_points", Some(*index), "give finite numbers"),
        NurbsError::Weight { index, .. } => (
            "weights",
            Some(*index),
            "give a positive weight: the larger, the nearer the curve to its point",
        ),
        NurbsError::FarPoint { index } => (
            "control_points",
            Some(*index),
            "give coordinates of -1000000 to 1000000 mm",
        ),
        NurbsError::WeightRange { index, .. } => (
            "weights",
            Some(*index),
            "multiply all weights by the same number: that does not change the curve",
        ),
        NurbsError::KnotRange { index, .. } => (
            "knots",
            Some(*index),
            "multiply all knots by the same number: that does not change the curve",
        ),
        NurbsError::ShortDomain { .. } => (
            "knots",
            None,
            "multiply all knots by the same number: that does not change the curve",
        ),
        NurbsError::KnotOrder { index, .. } => ("knots", Some(*index), "sort the knots"),
        NurbsError::KnotMultiplicity { .. } => (
            "knots",
            None,
            "a knot as often as the degree makes a corner; split the curve for a gap",
        ),
        NurbsError::EmptyDomain { first, .. } => (
            "knots",
            Some(*first),
            "let the last knots be greater than the first",
        ),
        NurbsError::StandsStill { .. } => (
            "control_points",
            None,
            "remove the control points that repeat, with their knots",
        ),
    }
}
