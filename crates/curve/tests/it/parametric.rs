//! Tests of chords along parametric curves: the check vectors, first crossings, cusps, error
//! bounds.

#![allow(clippy::unwrap_used, reason = "a test")]

use crate::support::*;
use glidepath_curve::parametric::{
    Method, ParametricChords, ParametricStepper, bracket, breaks, certify_bracket,
};
use glidepath_curve::published::equal_chords;
use glidepath_curve::{ChordRule, CurveError, ParametricCurve, chord_mm, sagitta_mm};
use proptest::prelude::*;

const METHODS: [Method; 3] = [Method::Newton, Method::Secant, Method::Bisection];

#[test]
fn single_steps() {
    for v in vectors("param_step") {
        let (curve, t0) = (v.curve(), v.number("t0"));
        for method in METHODS {
            let stepper = ParametricStepper::new(&curve, t0, method);
            let step = stepper.look(v.number("L"), t0 + 10.0).unwrap();
            v.is(step.t - t0, "dt");
            v.is_at(&step.local.point, "point");
        }
    }
}

#[test]
fn laps_in_equal_chords() {
    for v in vectors("equal_chord_lap") {
        let (t0, t1) = (v.number("t0"), v.number("t1"));
        let equal = equal_chords(&v.curve(), (t0, t1), v.number("L")).unwrap();
        v.is(f64::from(equal.full), "full_chords");
        v.is(equal.remainder_mm, "remainder");
        v.is(f64::from(equal.count), "N_equalised");
        v.is(equal.chord_mm, "L_equalised");
    }
}

/// Brackets that hold several crossings are not certified, and the stepper finds the first.
#[test]
fn traps_of_plain_bisection() {
    for v in vectors("first_crossing_trap") {
        let (curve, t0, chord) = (v.curve(), v.number("t0"), v.number("L"));
        let bad = curve.bounds(t0, t0 + v.number("m_bad")).unwrap();
        let certified = certify_bracket(&bad, chord);
        assert!(
            certified.is_none_or(|(_, high)| high > v.number("m_bad")),
            "{}",
            v.id
        );
        for method in METHODS {
            let step = ParametricStepper::new(&curve, t0, method)
                .look(chord, t0 + 20.0)
                .unwrap();
            v.is(step.t - t0, "first_root");
        }
    }
    for v in vectors("no_bracket") {
        let (curve, t0) = (v.curve(), v.number("t0"));
        for method in METHODS {
            let step = ParametricStepper::new(&curve, t0, method)
                .look(v.number("L"), v.number("m"))
                .unwrap();
            assert!(!step.is_end);
            v.is(step.t - t0, "dt");
        }
    }
}

#[test]
fn a_cusp_is_the_end_of_a_chord() {
    for v in vectors("cusp_skipped") {
        let (curve, t0, chord) = (v.curve(), v.number("t0"), v.number("L"));
        // Without the break the first crossing is beyond the cusp.
        let step = ParametricStepper::new(&curve, t0, Method::Newton)
            .look(chord, 5.0)
            .unwrap();
        v.is(step.t - t0, "first_root");
        let cusps = breaks(&curve, t0, 5.0).unwrap();
        assert_eq!(cusps.len(), 1);
        assert!(cusps[0].abs() < 1e-9);
        let step = ParametricStepper::new(&curve, t0, Method::Newton)
            .look(chord, cusps[0])
            .unwrap();
        assert!(step.is_end);
        v.is(step.chord_mm, "distance_to_cusp");
    }
    let rule = ChordRule {
        longest_mm: 0.05,
        error_mm: 1e-3,
    };
    let curve = formulas(["t^2", "t^3", "0"]);
    let mut chords = ParametricChords::new(curve.clone(), (-0.3, 0.3), rule).unwrap();
    let mut at_tip = 0;
    while let Some(chord) = chords.next_chord().unwrap() {
        assert!(chord.error_mm <= 1e-3);
        at_tip += u32::from(chord.point.norm() < 1e-15);
    }
    assert_eq!(at_tip, 1);
}

#[test]
fn bracket_from_bounds() {
    for v in vectors("rigorous_bracket") {
        // The whole ellipse: bounds as the vector names them.
        let curve = formulas(["40*cos(t)", "15*sin(t)", "0"]);
        let mut bounds = curve.bounds(0.0, 1e-9).unwrap();
        bounds.curvature_k = v.number("kappa_max");
        bounds.speed =
            glidepath_geometry::number::Interval::new(v.number("speed_min"), v.number("speed_max"));
        let (low, high) = certify_bracket(&bounds, v.number("L")).unwrap();
        v.is(low, "dt_lo");
        v.is(high / (1.0 + 1e-6), "dt_hi");
    }
}

#[test]
fn chords_from_tolerance() {
    for v in vectors("chord_from_tolerance") {
        let (error, radius, period_t) = (v.number("tol"), v.number("R"), v.number("Ts"));
        let chord = chord_mm(1.0 / radius, error);
        v.is(chord, "L");
        v.is(chord / period_t, "v_max");
        assert!((sagitta_mm(1.0 / radius, chord) - error).abs() < 1e-12);
    }
    for v in vectors("arc_speed_excess") {
        let chord = v.number("kappa_L");
        v.is(
            glidepath_curve::arc_over_chord(1.0, chord) - 1.0,
            "ratio_minus_1",
        );
    }
}

/// The largest distance of the curve between two parameters from their chord, by sampling.
fn sampled_error(curve: &ParametricCurve, t0: f64, t1: f64) -> f64 {
    let (a, b) = (curve.point(t0), curve.point(t1));
    let along = (b - a).normalize();
    (0..=400)
        .map(|i| curve.point(t0 + (t1 - t0) * f64::from(i) / 400.0) - a)
        .map(|out| (out - along * out.dot(&along).clamp(0.0, (b - a).norm())).norm())
        .fold(0.0, f64::max)
}

#[test]
fn the_published_sagitta_is_no_bound_and_ours_is() {
    for v in vectors("sagitta_counterexample") {
        let curve = v.curve();
        let t = (0.5 * v.number("L") / 2.0_f64).asin();
        let error = sampled_error(&curve, -t, t);
        v.is(error, "true_sagitta");
        let end = curve.local(t).curvature_k();
        v.is(1.0 / end, "R_endpoints");
        v.is(sagitta_mm(end, v.number("L")), "paper_bound");
        assert!(v.want("paper_bound") < error);
        v.is(
            sagitta_mm(1.0 / v.want("R_min_on_arc"), v.number("L")),
            "correct_bound",
        );
        assert!(curve.chord_error_mm(-t, t).unwrap() >= error);
    }
    for v in vectors("sagitta") {
        let curve = v.curve();
        let step = ParametricStepper::new(&curve, 0.0, Method::Newton)
            .look(v.number("L"), 9.0)
            .unwrap();
        let error = sampled_error(&curve, 0.0, step.t);
        assert!((error - v.want("max_deviation")).abs() < 1e-6);
        v.is(
            sagitta_mm(curve.local(0.0).curvature_k(), v.number("L")),
            "bound",
        );
        let proven = curve.chord_error_mm(0.0, step.t).unwrap();
        assert!(proven >= v.want("max_deviation") && proven < 1.2 * v.want("max_deviation"));
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let rule = ChordRule {
        longest_mm: 0.4,
        error_mm: 1e-3,
    };
    let refused = |xyz, domain| ParametricChords::new(formulas(xyz), domain, rule).map(|_| ());
    assert!(matches!(
        refused(["sqrt(t)", "t", "0"], (-1.0, 1.0)),
        Err(CurveError::Unbounded { .. })
    ));
    assert!(matches!(
        refused(["1/t", "t", "0"], (-1.0, 1.0)),
        Err(CurveError::Unbounded { .. })
    ));
    // A jump of the value, not of the derivatives.
    assert!(matches!(
        refused(["atan2(sin(t), cos(t))", "0", "0"], (0.0, 6.0)),
        Err(CurveError::Unbounded { t }) if (t - std::f64::consts::PI).abs() < 1e-3
    ));
    assert!(matches!(
        refused(["1", "2", "0*t"], (0.0, 1.0)),
        Err(CurveError::StandsStill { .. })
    ));
}

#[test]
fn a_curve_that_moves_less_than_its_coordinates_can_tell_stands_still() {
    // tanh(107) is 1 in doubles, its derivatives are not 0 in them.
    let curve = formulas(["14", "0", "tanh(107 + 24*sin(t)^4)"]);
    let rule = ChordRule {
        longest_mm: 0.5,
        error_mm: 0.01,
    };
    let followed = ParametricChords::new(curve, (0.0, 5.0 * std::f64::consts::PI), rule)
        .and_then(|mut chords| chords.next_chord());
    assert!(matches!(followed, Err(CurveError::StandsStill { .. })));
}

#[test]
fn a_curve_that_is_rounded_by_more_than_its_chords_is_refused() {
    let rule = ChordRule {
        longest_mm: 0.5,
        error_mm: 0.01,
    };
    let turn = (1.0, std::f64::consts::TAU);
    // e^266 mm from the origin; steps of 1e-4 mm in a chord of 0.5; steps of 4e-3 mm.
    for (z, is_told) in [
        ("sinh(400 - 225*sin(t)^3)", false),
        ("t + 1e12 - 1e12", true),
        ("t + 3e13 - 3e13", false),
    ] {
        let mut chords = ParametricChords::new(formulas(["7", "5*sin(t)", z]), turn, rule).unwrap();
        let followed = (0..10).try_for_each(|_| chords.next_chord().map(drop));
        assert_eq!(followed.is_ok(), is_told, "{z}: {followed:?}");
        if !is_told {
            assert!(
                matches!(followed, Err(CurveError::TooCoarse { .. })),
                "{z}: {followed:?}"
            );
        }
    }
}

#[test]
fn far_out_a_chord_is_as_long_as_coordinates_can_tell() {
    // 6.4e7 mm from the origin, where neighbouring doubles are 7e-9 mm apart.
    let curve = formulas(["7", "5*sin(t)", "sqrt(400 - 225*sin(t))^6"]);
    let rule = ChordRule {
        longest_mm: 0.5,
        error_mm: 0.01,
    };
    let mut chords = ParametricChords::new(curve, (0.0, std::f64::consts::TAU), rule).unwrap();
    for _ in 0..10 {
        let chord = chords.next_chord().unwrap().unwrap();
        let room_mm = 8.0 * f64::EPSILON * chord.point.amax();
        assert!((chord.chord_mm - rule.longest_mm).abs() <= room_mm);
    }
}

/// Coefficients of a cubic Bezier through a box.
fn cubic() -> impl Strategy<Value = ParametricCurve> {
    prop::array::uniform4(prop::array::uniform3(-40.0..40.0_f64)).prop_map(|p| {
        let xyz: [String; 3] = core::array::from_fn(|i| {
            let (a, b, c, d) = (p[0][i], p[1][i], p[2][i], p[3][i]);
            format!("({a})*(1-t)^3 + 3*({b})*(1-t)^2*t + 3*({c})*(1-t)*t^2 + ({d})*t^3")
        });
        formulas([&xyz[0], &xyz[1], &xyz[2]])
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Every chord has its length, is the first crossing, and costs no more than bisection.
    #[test]
    fn chords_are_equal_and_first(curve in cubic(), chord in 0.05..4.0_f64) {
        for method in METHODS {
            let mut stepper = ParametricStepper::new(&curve, 0.0, method);
            loop {
                let from = stepper.local().point;
                let t0 = stepper.t();
                let step = stepper.look(chord, 1.0).unwrap();
                for i in 1..40 {
                    let t = t0 + (step.t - t0) * f64::from(i) / 40.0;
                    prop_assert!((curve.point(t) - from).norm() <= chord + 1e-9);
                }
                if step.is_end {
                    break;
                }
                prop_assert!((step.chord_mm - chord).abs() <= 1e-9);
                stepper.advance(&step);
            }
        }
    }

    /// Proven errors hold, and are not far from what is.
    #[test]
    fn proven_errors_hold(curve in cubic(), error_mm in 1e-4..1e-2_f64) {
        let rule = ChordRule { longest_mm: 5.0, error_mm };
        let mut chords = ParametricChords::new(curve.clone(), (0.0, 1.0), rule).unwrap();
        let (mut from, mut t) = (curve.point(0.0), 0.0);
        while let Some(chord) = chords.next_chord().unwrap() {
            prop_assert!(chord.error_mm <= error_mm && chord.is_proven);
            prop_assert!((chord.chord_mm - (chord.point - from).norm()).abs() < 1e-12);
            let stepper = ParametricStepper::new(&curve, t, Method::Newton);
            let to = stepper.look(chord.chord_mm * (1.0 - 1e-12), 1.0).unwrap().t;
            let error = sampled_error(&curve, t, to);
            prop_assert!(error <= chord.error_mm + 1e-9, "{error} {}", chord.error_mm);
            (from, t) = (chord.point, to);
        }
        prop_assert!((from - curve.point(1.0)).norm() < 1e-12);
    }
}

#[test]
fn evaluations_are_few() {
    for (xyz, end) in [
        (["20*cos(t)", "20*sin(t)", "0"], 6.0),
        (["40*cos(t)", "15*sin(t)", "0"], 6.0),
        (["20*(1+cos(t))", "20*sin(t)", "40*sin(t/2)"], 12.0),
        (["15*cos(t)", "15*sin(t)", "3*t"], 12.0),
    ] {
        let curve = formulas(xyz);
        let mut stepper = ParametricStepper::new(&curve, 0.0, Method::Newton);
        let (mut sum, mut worst, mut count) = (0, 0, 0);
        loop {
            let step = stepper.look(0.4, end).unwrap();
            if step.is_end {
                break;
            }
            assert_eq!(step.enclosures, 1);
            sum += step.evaluations;
            worst = worst.max(step.evaluations);
            count += 1;
            stepper.advance(&step);
        }
        assert!(
            f64::from(sum) <= 3.1 * f64::from(count) && worst <= 6,
            "{xyz:?}: {sum} {worst} {count}"
        );
    }
}

#[test]
fn the_bracket_holds_the_root_alone() {
    let curve = formulas(["40*cos(t)", "15*sin(t)", "0"]);
    for i in 0..60 {
        let t = 0.1 * f64::from(i);
        let at = curve.local(t);
        let found = bracket(&curve, t, &at, 4.0, 100.0).unwrap().unwrap();
        let distance = |t: f64| (curve.point(t) - at.point).norm();
        assert!(distance(found.low) <= 4.0 + 1e-9 && distance(found.high) >= 4.0 - 1e-9);
        let samples: Vec<f64> = (0..=50)
            .map(|k| distance(found.low + (found.high - found.low) * f64::from(k) / 50.0))
            .collect();
        assert!(samples.windows(2).all(|w| w[0] < w[1] + 1e-12));
    }
}
