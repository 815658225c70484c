//! Dense points on curves.

#![allow(
    dead_code,
    clippy::expect_used,
    clippy::panic,
    reason = "each user takes its part, and a test that fails may panic"
)]

use glidepath_fit::Point;
use glidepath_geometry::{AxisVector, Nurbs, NurbsPath};
use serde_json::Value;

/// A file of reference values.
pub(crate) fn reference(name: &str) -> Value {
    let path = format!(
        "{}/../../tests/data/method/{name}.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("array")
        .iter()
        .map(|x| x.as_f64().expect("number"))
        .collect()
}

/// A reference curve at equal steps of about `spacing_mm`, to the micrometre.
pub(crate) fn curve(name: &str, spacing_mm: f64) -> Vec<Point> {
    let curve = reference(name);
    let degree = usize::try_from(curve["degree"].as_u64().expect("degree")).expect("small");
    let over_axes = |coordinates: &Value| {
        let mut point = AxisVector::zeros();
        for (axis, x) in numbers(coordinates).into_iter().enumerate() {
            point[axis] = x;
        }
        point
    };
    let points = curve["control_points"].as_array().expect("points");
    let points: Vec<AxisVector> = points.iter().map(over_axes).collect();
    let (weights, knots) = (numbers(&curve["weights"]), numbers(&curve["knots"]));
    let path = NurbsPath::new(Nurbs::new(degree, &points, &weights, &knots).expect("valid"));
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count"
    )]
    let steps = (path.length() / spacing_mm).floor() as u32;
    let rounded = |x: f64| (x * 1000.0).round() / 1000.0;
    (0..=steps)
        .map(|i| {
            let at = path
                .jet(path.length() * f64::from(i) / f64::from(steps))
                .position;
            Point::new(rounded(at[0]), rounded(at[1]), rounded(at[2]))
        })
        .collect()
}

/// A full circle in the plane.
pub(crate) fn circle(radius_mm: f64, spacing_mm: f64) -> Vec<Point> {
    let turn = core::f64::consts::TAU;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count"
    )]
    let steps = (turn * radius_mm / spacing_mm).round() as u32;
    (0..=steps)
        .map(|i| {
            let (sin, cos) = (turn * f64::from(i) / f64::from(steps)).sin_cos();
            Point::new(radius_mm * cos, radius_mm * sin, 0.0)
        })
        .collect()
}
