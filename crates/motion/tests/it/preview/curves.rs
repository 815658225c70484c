//! Reference curves.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

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

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("array")
        .iter()
        .map(|x| x.as_f64().expect("number"))
        .collect()
}

/// Degree, control points, weights and knots.
pub(crate) type Definition = (usize, Vec<AxisVector>, Vec<f64>, Vec<f64>);

pub(crate) fn definition(name: &str) -> Definition {
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
    (
        degree,
        points.iter().map(over_axes).collect(),
        numbers(&curve["weights"]),
        numbers(&curve["knots"]),
    )
}

/// A reference curve, measured.
pub(crate) fn path(name: &str) -> NurbsPath {
    let (degree, points, weights, knots) = definition(name);
    NurbsPath::new(Nurbs::new(degree, &points, &weights, &knots).expect("valid"))
}
