//! Tests of NURBS against reference values, against their definition, and bad definitions.

use crate::support::{curve, definition, evaluate, numbers, point, random_definition, reference};
use glidepath_geometry::{Axis, AxisVector, Nurbs, NurbsError, NurbsPath};
use proptest::prelude::*;

const CURVES: [&str; 10] = [
    "butterfly",
    "butterfly_closed",
    "infinity",
    "circle",
    "star",
    "fan",
    "snail",
    "trident_like",
    "helix3d",
    "needle",
];

fn close(actual: f64, expected: f64, relative: f64) -> bool {
    (actual - expected).abs() <= relative * (1.0 + expected.abs())
}

#[test]
fn reference_points_derivatives_curvature_and_length() {
    let all = reference("curve_reference");
    let mut seen = 0;
    for name in CURVES {
        let expected = &all["curves"][name];
        let path = NurbsPath::new(curve(name));
        let length = expected["length_mm"].as_f64().expect("length");
        assert!(
            (path.length() - length).abs() < 1e-9,
            "{name}: {} for {length}",
            path.length()
        );
        if let Some(spans) = expected["spans"].as_u64() {
            assert_eq!(path.curve().spans().len() as u64, spans, "{name}");
        }
        let points = expected["points"].as_array();
        for at in points.into_iter().flatten() {
            let u = at["u"].as_f64().expect("u");
            let jet = path.curve().jet(u);
            for (actual, key) in [(jet.position, "C"), (jet.d1, "C1"), (jet.d2, "C2")] {
                let expected = point(&numbers(&at[key]));
                let error = (actual - expected).amax();
                assert!(
                    error <= 1e-10 * (1.0 + expected.amax()),
                    "{name} {key} at {u}: {error}"
                );
                seen += 1;
            }
            let kappa = at["kappa"].as_f64().expect("kappa");
            assert!(close(path.curve().curvature(u), kappa, 1e-10), "{name} {u}");
            let s = at["s"].as_f64().expect("s");
            assert!((path.s_at(u) - s).abs() < 1e-9, "{name} {u}");
        }
    }
    assert!(seen >= 9 * 33, "only {seen} values were compared");
}

#[test]
fn parameters_of_path_positions() {
    let vectors = reference("us_vectors");
    let path = NurbsPath::new(curve("butterfly"));
    for row in vectors["s_u_xy"].as_array().expect("rows") {
        let row = numbers(row);
        assert!((path.u_at(row[0]) - row[1]).abs() < 1e-9, "u at {}", row[0]);
        let jet = path.jet(row[0]);
        assert!((jet.position[0] - row[2]).abs() < 1e-9);
        assert!((jet.position[1] - row[3]).abs() < 1e-9);
    }
}

#[test]
fn u_of_s_is_monotone_exact_and_does_not_drift() {
    for name in CURVES {
        let path = NurbsPath::new(curve(name));
        let (first, last) = path.curve().domain();
        assert!(path.u_at(0.0) <= first && path.u_at(path.length()) >= last);
        assert!((path.s_at(last) - path.length()).abs() <= 1e-12 * path.length());
        let steps = 3000;
        let mut before = first;
        for i in 1..=steps {
            let s = path.length() * f64::from(i) / f64::from(steps);
            let u = path.u_at(s);
            assert!(u > before, "{name}: u stands still at {s}");
            assert!((path.s_at(u) - s).abs() < 1e-10, "{name} at {s}");
            before = u;
        }
    }
}

#[test]
fn derivatives_by_path_position_are_differences_of_positions() {
    let path = NurbsPath::new(curve("helix3d"));
    let h = 1e-2;
    // Inside spans: the third derivative jumps at knots.
    let knots = path.curve().knots().to_vec();
    let far = |s: f64| knots.iter().all(|u| (path.s_at(*u) - s).abs() > 3.0 * h);
    let mut checked = 0;
    for i in 1..200 {
        let s = path.length() * f64::from(i) / 200.0;
        if !far(s) {
            continue;
        }
        let at = |k: f64| path.jet(s + k * h).position;
        let jet = path.jet(s);
        assert!((jet.d1.norm() - 1.0).abs() < 1e-12);
        let d1 = (at(1.0) - at(-1.0)) / (2.0 * h);
        let d2 = (at(1.0) - at(0.0) * 2.0 + at(-1.0)) / (h * h);
        let d3 = (at(2.0) - at(1.0) * 2.0 + at(-1.0) * 2.0 - at(-2.0)) / (2.0 * h * h * h);
        assert!((d1 - jet.d1).amax() < 1e-6);
        assert!((d2 - jet.d2).amax() < 1e-6);
        assert!((d3 - jet.d3).amax() < 1e-5, "{d3} {}", jet.d3);
        checked += 1;
    }
    assert!(checked > 150);
}

#[test]
fn the_feed_is_measured_in_the_linear_axes_and_rotary_axes_move_along() {
    let with_rotary = |x: f64, a: f64| {
        let mut p = point(&[x, x * x / 10.0]);
        p[Axis::A.index()] = a;
        p
    };
    let points = [0.0, 1.0, 2.0, 5.0].map(|x| with_rotary(x, 90.0 * x));
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let path = NurbsPath::new(Nurbs::new(3, &points, &[1.0; 4], &knots).expect("valid"));
    let mut flat = points;
    flat.iter_mut().for_each(|p| p[Axis::A.index()] = 0.0);
    let alone = NurbsPath::new(Nurbs::new(3, &flat, &[1.0; 4], &knots).expect("valid"));
    assert!((path.length() - alone.length()).abs() < 1e-12);
    let jet = path.jet(path.length());
    assert!((jet.position[Axis::A.index()] - 450.0).abs() < 1e-9);

    let rotary = points.map(|p| {
        let mut only = AxisVector::zeros();
        only[Axis::A.index()] = p[Axis::A.index()];
        only
    });
    let curve = Nurbs::new(3, &rotary, &[1.0; 4], &knots).expect("valid");
    assert!((NurbsPath::new(curve).length() - 450.0).abs() < 1e-9);
}

#[test]
fn ends_need_not_be_clamped() {
    let points: Vec<AxisVector> = (0..8)
        .map(|i| point(&[f64::from(i), f64::from(i % 3)]))
        .collect();
    let knots: Vec<f64> = (0..12).map(f64::from).collect();
    let weights = [1.0, 2.0, 1.0, 0.5, 1.0, 3.0, 1.0, 1.0];
    let curve = Nurbs::new(3, &points, &weights, &knots).expect("valid");
    assert_eq!(curve.domain(), (3.0, 8.0));
    let definition = (3, points, weights.to_vec(), knots);
    for i in 0..100 {
        let u = 3.0 + 0.05 * f64::from(i);
        let error = (curve.jet(u).position - evaluate(&definition, u)).amax();
        assert!(error < 1e-13, "{error} at {u}");
    }
}

#[test]
fn a_cusp_has_a_length_and_a_parameter_everywhere() {
    // (t², t³) for t from -1 to 1: the derivative vanishes in the middle.
    let points = [
        [1.0, -1.0],
        [-1.0 / 3.0, 1.0],
        [-1.0 / 3.0, -1.0],
        [1.0, 1.0],
    ]
    .map(|p| point(&p));
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let path = NurbsPath::new(Nurbs::new(3, &points, &[1.0; 4], &knots).expect("valid"));
    // ∫|t|·sqrt(4 + 9t²) dt from -1 to 1.
    let length = 2.0 * (13.0_f64.powf(1.5) - 8.0) / 27.0;
    assert!((path.length() - length).abs() < 1e-10, "{}", path.length());
    assert!((path.u_at(0.5 * length) - 0.5).abs() < 1e-5);
    for i in 0..=1000 {
        let s = length * f64::from(i) / 1000.0;
        assert!((path.s_at(path.u_at(s)) - s).abs() < 1e-9, "at {s}");
        assert!(path.jet(s).d1.iter().all(|x| x.is_finite()));
    }
}

type Change<'a> = &'a dyn Fn(&mut Vec<AxisVector>, &mut Vec<f64>, &mut Vec<f64>);

#[test]
fn bad_definitions_are_refused_by_name() {
    let (degree, points, weights, knots) = definition("star");
    let with = |change: Change<'_>| {
        let (mut p, mut w, mut k) = (points.clone(), weights.clone(), knots.clone());
        change(&mut p, &mut w, &mut k);
        Nurbs::new(degree, &p, &w, &k).expect_err("bad")
    };
    let n = points.len();
    assert_eq!(
        Nurbs::new(8, &points, &weights, &knots),
        Err(NurbsError::Degree { degree: 8 })
    );
    assert_eq!(
        Nurbs::new(3, &points[..3], &weights[..3], &knots[..7]),
        Err(NurbsError::TooFewPoints {
            points: 3,
            degree: 3
        })
    );
    let error = with(&|_, w, _| assert!(w.pop().is_some()));
    assert_eq!(
        error,
        NurbsError::WeightCount {
            weights: n - 1,
            points: n
        }
    );
    let error = with(&|_, _, k| assert!(k.pop().is_some()));
    assert_eq!(
        error,
        NurbsError::KnotCount {
            knots: n + 3,
            expected: n + 4
        }
    );
    for weight in [0.0, -1.0, f64::INFINITY] {
        let error = with(&|_, w, _| w[2] = weight);
        assert_eq!(error, NurbsError::Weight { index: 2, weight });
    }
    assert!(matches!(
        with(&|_, w, _| w[2] = f64::NAN),
        NurbsError::Weight { index: 2, .. }
    ));
    assert_eq!(
        with(&|p, _, _| p[1][0] = f64::NAN),
        NurbsError::Point { index: 1 }
    );
    assert_eq!(
        with(&|_, _, k| k[5] = -1.0),
        NurbsError::KnotOrder {
            index: 5,
            knot: -1.0
        }
    );
    let error = with(&|_, _, k| (4..8).for_each(|i| k[i] = k[4]));
    assert!(matches!(
        error,
        NurbsError::KnotMultiplicity {
            multiplicity: 4,
            degree: 3,
            ..
        }
    ));
    let error = with(&|_, _, k| k.fill(0.5));
    assert_eq!(error, NurbsError::EmptyDomain { first: 3, last: n });
    let error = with(&|p, _, _| (0..5).for_each(|i| p[i] = p[0]));
    assert!(matches!(error, NurbsError::StandsStill { .. }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn evaluation_is_the_definition(definition in random_definition(), at in prop::collection::vec(0.0..1.0_f64, 20)) {
        let (degree, points, weights, knots) = &definition;
        let curve = Nurbs::new(*degree, points, weights, knots).expect("valid");
        let (from, to) = curve.domain();
        for t in at {
            let u = from + (to - from) * t;
            let error = (curve.jet(u).position - evaluate(&definition, u)).amax();
            prop_assert!(error < 1e-10, "{} at {}", error, u);
            let (speed, d1) = (curve.speed(u), curve.jet(u).d1.fixed_rows::<3>(0).norm());
            prop_assert!((speed - d1).abs() <= 1e-10 * (1.0 + d1));
        }
    }

    #[test]
    fn the_curvature_bound_holds_and_curvature_is_monotone_between_critical_points(
        definition in random_definition(),
    ) {
        let (degree, points, weights, knots) = &definition;
        let curve = Nurbs::new(*degree, points, weights, knots).expect("valid");
        for span in curve.spans() {
            let curvature = glidepath_geometry::SpanCurvature::new(span);
            let bound = curvature.bound_k();
            let mut nodes = vec![span.from_u()];
            curvature.critical(|u| nodes.push(u));
            nodes.push(span.to_u());
            for pair in nodes.windows(2) {
                prop_assert!(pair[0] <= pair[1]);
                let ends = [curvature.at(pair[0]), curvature.at(pair[1])];
                let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                for i in 0..=20 {
                    let u = pair[0] + (pair[1] - pair[0]) * f64::from(i) / 20.0;
                    let (k, direct) = (curvature.at(u), curve.curvature(u));
                    prop_assert!(k.abs() <= bound * (1.0 + 1e-12));
                    let slack = 1e-9 * (k.abs() + 1e-3);
                    prop_assert!(k >= low - slack && k <= high + slack, "{} {} {}", low, k, high);
                    if i > 0 && i < 20 {
                        prop_assert!((k.abs() - direct).abs() <= 1e-6 * (1e-3 + direct), "{} {}", k, direct);
                    }
                }
            }
        }
    }
}
