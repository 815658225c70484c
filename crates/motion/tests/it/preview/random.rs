//! Tests on random curves: the certified preview misses nothing.

use super::curves::Definition;
use glidepath_geometry::{AxisVector, Nurbs, NurbsPath};
use glidepath_motion::preview::{Certified, Demand, Preview, preview};
use proptest::prelude::*;

/// Curves of degree 2 to 5, flat and in space, with simple and multiple knots, with control points
/// that double back: cusps nearly, and now and then exactly.
fn curves() -> impl Strategy<Value = Definition> {
    (2..=5_usize, 0..10_usize, any::<bool>()).prop_flat_map(|(degree, more, flat)| {
        let n = degree + 1 + more;
        let coordinate = || (-50..=50_i32).prop_map(f64::from);
        let points = prop::collection::vec((coordinate(), coordinate(), coordinate()), n);
        let weights = prop::collection::vec(prop_oneof![Just(1.0), 0.3..4.0_f64], n);
        let gaps = prop::collection::vec(prop_oneof![1 => Just(0.0), 4 => 0.02..1.0_f64], more + 1);
        (points, weights, gaps).prop_map(move |(points, weights, gaps)| {
            let mut knots = vec![0.0; degree + 1];
            let mut run = degree + 1;
            for gap in &gaps[1..] {
                // A knot as often as the degree would be a corner, which has no curvature to
                // sample.
                let gap = if run + 1 >= degree {
                    gap.max(0.05)
                } else {
                    *gap
                };
                run = if gap > 0.0 { 1 } else { run + 1 };
                knots.push(knots[knots.len() - 1] + gap);
            }
            let end = knots[knots.len() - 1] + gaps[0].max(0.05);
            knots.extend(vec![end; degree + 1]);
            let over_axes = |(x, y, z): &(f64, f64, f64)| {
                let mut point = AxisVector::zeros();
                (point[0], point[1]) = (*x, *y);
                point[2] = if flat { 0.0 } else { *z };
                point
            };
            (
                degree,
                points.iter().map(over_axes).collect(),
                weights,
                knots,
            )
        })
    })
}

/// What is wrong with a preview according to sampling: `samples` points in each knot span and as
/// many around each minimum.
fn contradiction(path: &NurbsPath, found: &Preview, demand: &Demand) -> Option<String> {
    let critical_mm = demand.critical_radius_mm();
    let curve = path.curve();
    let (first, last) = curve.domain();
    let minima = || found.regions.iter().flat_map(|r| &r.minima);
    let check = |u: f64| {
        // Where the curve nearly stands still, sampling has no digits: there must be a minimum.
        if curve.speed(u) < 1e-4 * path.length() / (last - first) {
            let near = minima().any(|m| (m.u - u).abs() < 1e-2 * (last - first));
            return (!near).then(|| format!("stands still at {u}"));
        }
        let radius_mm = 1.0 / curve.curvature(u);
        if radius_mm >= critical_mm * (1.0 - 1e-7) {
            return None;
        }
        let inside = |from: f64, to: f64| from <= u && u <= to;
        let Some(region) = found.regions.iter().find(|r| inside(r.from_u, r.to_u)) else {
            return Some(format!("radius {radius_mm} at {u} is in no region"));
        };
        let least_mm = region
            .minima
            .iter()
            .map(|m| m.radius_mm)
            .fold(f64::MAX, f64::min);
        (radius_mm < least_mm * (1.0 - 1e-6))
            .then(|| format!("radius {radius_mm} at {u} is below the minimum {least_mm}"))
    };
    let spans = curve.spans().iter().flat_map(|span| {
        let (from, to) = (span.from_u(), span.to_u());
        (0..400).map(move |i| from + (to - from) * (f64::from(i) + 0.5) / 400.0)
    });
    let around = minima().flat_map(|m| {
        let reach = 1e-3 * (last - first);
        (-50..=50).map(move |i| (m.u + reach * (f64::from(i) / 50.0).powi(3)).clamp(first, last))
    });
    spans.chain(around).find_map(check)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1200))]

    #[test]
    fn no_region_and_no_minimum_is_missed(definition in curves(), four_ms in any::<bool>()) {
        let (degree, points, weights, knots) = definition;
        // Control points may coincide so that a span stands still, which is refused.
        if let Ok(curve) = Nurbs::new(degree, &points, &weights, &knots) {
            let path = NurbsPath::new(curve);
            let demand = Demand::chord(100.0, if four_ms { 0.004 } else { 0.001 }, 0.001);
            let found = preview(&path, &demand, &Certified);
            for pair in found.regions.windows(2) {
                prop_assert!(pair[0].to_u <= pair[1].from_u);
            }
            prop_assert!(found.regions.iter().all(|r| !r.minima.is_empty()));
            let wrong = contradiction(&path, &found, &demand);
            prop_assert!(wrong.is_none(), "{:?}", wrong);
        }
    }
}
