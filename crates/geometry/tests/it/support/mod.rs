//! Reference curves and an evaluation of NURBS that shares nothing with the crate's.

#![allow(
    dead_code,
    clippy::expect_used,
    clippy::panic,
    reason = "each test file uses its part, and a test that fails may panic"
)]

use glidepath_geometry::{AxisVector, MAX_DEGREE, Nurbs};
use proptest::prelude::*;
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

/// A point of two or three coordinates over all axes.
pub(crate) fn point(coordinates: &[f64]) -> AxisVector {
    let mut point = AxisVector::zeros();
    for (axis, x) in coordinates.iter().enumerate() {
        point[axis] = *x;
    }
    point
}

/// Degree, control points, weights and knots.
pub(crate) type Definition = (usize, Vec<AxisVector>, Vec<f64>, Vec<f64>);

pub(crate) fn definition(name: &str) -> Definition {
    let curve = reference(name);
    let degree = usize::try_from(curve["degree"].as_u64().expect("degree")).expect("small");
    let points = curve["control_points"].as_array().expect("points");
    let points = points.iter().map(|p| point(&numbers(p))).collect();
    (
        degree,
        points,
        numbers(&curve["weights"]),
        numbers(&curve["knots"]),
    )
}

pub(crate) fn curve(name: &str) -> Nurbs {
    let (degree, points, weights, knots) = definition(name);
    Nurbs::new(degree, &points, &weights, &knots).expect("a reference curve")
}

/// The recursion of Cox and de Boor.
pub(crate) fn basis(i: usize, p: usize, u: f64, knots: &[f64]) -> f64 {
    if p == 0 {
        let last = knots.iter().copied().fold(f64::MIN, f64::max);
        let closes = u >= last && knots[i + 1] >= last && knots[i] < last;
        return f64::from(u8::from((knots[i] <= u && u < knots[i + 1]) || closes));
    }
    let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
    ratio(u - knots[i], knots[i + p] - knots[i]) * basis(i, p - 1, u, knots)
        + ratio(knots[i + p + 1] - u, knots[i + p + 1] - knots[i + 1])
            * basis(i + 1, p - 1, u, knots)
}

/// The curve by its definition.
pub(crate) fn evaluate((degree, points, weights, knots): &Definition, u: f64) -> AxisVector {
    let mut sum = AxisVector::zeros();
    let mut weight = 0.0;
    for (i, (point, w)) in points.iter().zip(weights).enumerate() {
        let share = w * basis(i, *degree, u, knots);
        sum += point * share;
        weight += share;
    }
    sum / weight
}

/// Degree, points, weights and knots of a random curve, knots up to `degree`-fold.
pub(crate) fn random_definition() -> impl Strategy<Value = Definition> {
    (1..=MAX_DEGREE).prop_flat_map(|degree| {
        (degree + 1..degree + 12).prop_flat_map(move |n| {
            let points = prop::collection::vec(prop::array::uniform3(-100.0..100.0_f64), n);
            let weights = prop::collection::vec(0.2..5.0_f64, n);
            let gaps = prop::collection::vec(prop_oneof![Just(0.0), 0.01..1.0_f64], n - degree);
            (points, weights, gaps).prop_map(move |(points, weights, gaps)| {
                let mut knots = vec![0.0; degree + 1];
                let mut run = degree;
                for gap in &gaps[1..] {
                    let last = knots[knots.len() - 1];
                    let gap = if run >= degree { gap + 0.01 } else { *gap };
                    run = if gap > 0.0 { 1 } else { run + 1 };
                    knots.push(last + gap);
                }
                let end = knots[knots.len() - 1] + gaps[0] + 0.01;
                knots.extend(vec![end; degree + 1]);
                (
                    degree,
                    points.iter().map(|p| point(p)).collect(),
                    weights,
                    knots,
                )
            })
        })
    })
}
