//! Tests of chords along implicit curves: the check vectors, nodes, error bounds.

#![allow(clippy::unwrap_used, reason = "a test")]

use crate::support::*;
use glidepath_curve::implicit::{
    End, ImplicitChords, ImplicitStepper, chord_error_mm, curvature_k, node,
};
use glidepath_curve::published::{Reading, linear_step};
use glidepath_curve::{ChordRule, CurveError, ImplicitCurve};
use nalgebra::Vector3;
use proptest::prelude::*;

fn of(v: &Vector) -> ImplicitCurve {
    surfaces([
        v.input["f"].as_str().unwrap(),
        v.input["g"].as_str().unwrap(),
    ])
}

fn viviani() -> ImplicitCurve {
    surfaces(["x^2+y^2+z^2-1600", "(x-20)^2+y^2-400"])
}

/// The parameter of a point of Viviani's curve, and how far the point is off it.
fn off_viviani(p: &Vector3<f64>) -> (f64, f64) {
    let half = (p.z / 40.0).clamp(-1.0, 1.0).asin();
    let mut t = 2.0 * half;
    // z has two parameters in a lap of 4π; x and y tell which.
    let at = |t: f64| {
        Vector3::new(
            20.0 * (1.0 + t.cos()),
            20.0 * t.sin(),
            40.0 * (0.5 * t).sin(),
        )
    };
    let other = 2.0 * (std::f64::consts::PI - half);
    if (at(other) - p).norm() < (at(t) - p).norm() {
        t = other;
    }
    // The nearest point, by Newton's method on the distance.
    for _ in 0..20 {
        let d = Vector3::new(-20.0 * t.sin(), 20.0 * t.cos(), 20.0 * (0.5 * t).cos());
        t -= (at(t) - p).dot(&d) / d.norm_squared();
    }
    (t, (at(t) - p).norm())
}

#[test]
fn published_steps_drift_as_computed() {
    let circle = surfaces(["x^2+y^2+z^2-625", "z-15"]);
    for (kind, reading) in [
        ("implicit_linear_pure_tangent", Reading::Tangent),
        ("implicit_linear_with_residual", Reading::Residual),
    ] {
        for v in vectors(kind) {
            let mut p = point(&v.input["p0"]);
            let mut ahead = Vector3::y();
            for _ in 0..v.input["steps"].as_u64().unwrap() {
                let next = linear_step(&circle, &p, &ahead, v.number("L"), reading).unwrap();
                ahead = next - p;
                p = next;
            }
            v.is(p.x.hypot(p.y), "radius_after");
            v.is((p.x.hypot(p.y) - 20.0).abs(), "off_curve");
        }
    }
}

#[test]
fn single_steps() {
    for v in vectors("implicit_step") {
        let (curve, from) = (of(&v), point(&v.input["p0"]));
        let hint = v
            .input
            .get("direction_hint")
            .map_or_else(|| point(&v.expect["tangent"]), point);
        let stepper = ImplicitStepper::new(&curve, from, &hint).unwrap();
        v.is_at(&stepper.ahead(), "tangent");
        let step = stepper.look(v.number("L")).unwrap();
        v.is_at(&step.point, "point");
        // The other way, from where it came.
        let back = ImplicitStepper::new(&curve, step.point, &(from - step.point)).unwrap();
        assert!((back.look(v.number("L")).unwrap().point - from).norm() < 1e-9);
    }
}

#[test]
fn curvature_and_nodes() {
    for v in vectors("implicit_curvature") {
        v.is(curvature_k(&of(&v), &point(&v.input["p"])), "kappa");
    }
    for v in vectors("implicit_node_tangents") {
        let found = node(&of(&v), &point(&v.input["p"])).unwrap();
        v.is(found.mu, "mu");
        for want in v.expect["tangents"].as_array().unwrap() {
            let want = point(want);
            let nearest = found
                .tangents
                .iter()
                .map(|t| (t.dot(&want).abs() - 1.0).abs())
                .fold(1.0, f64::min);
            assert!(nearest < 1e-12);
        }
    }
    // A sphere that touches a plane: an isolated point.
    let isolated = surfaces(["x^2+y^2+z^2-1", "z-1"]);
    assert_eq!(node(&isolated, &Vector3::z()), None);
    assert!(matches!(
        ImplicitStepper::new(&isolated, Vector3::z(), &Vector3::x()),
        Err(CurveError::Singular { .. })
    ));
}

/// Over many laps every chord is equal and every point on the curve, though no point is ever set
/// right from outside.
#[test]
fn ten_laps_without_drift() {
    for (curve, start, ahead, lap_mm) in [
        (
            surfaces(["x^2+y^2+z^2-625", "z-15"]),
            Vector3::new(20., 0., 15.),
            Vector3::y(),
            125.7,
        ),
        (
            surfaces(["x^2+y^2-225", "y^2+z^2-400"]),
            Vector3::new(15., 0., 20.),
            -Vector3::y(),
            100.0,
        ),
        (
            surfaces(["(x/40)^2+(y/15)^2-1", "z"]),
            Vector3::new(40., 0., 0.),
            Vector3::y(),
            182.0,
        ),
        (
            viviani(),
            Vector3::new(20.0, 20.0, 40.0 * 0.5_f64.sqrt()),
            -Vector3::x(),
            305.6,
        ),
    ] {
        for chord in [0.4, 2.0] {
            let mut stepper = ImplicitStepper::new(&curve, start, &ahead).unwrap();
            let mut travelled = 0.0;
            while travelled < 10.0 * lap_mm {
                let from = *stepper.point();
                let step = stepper.look(chord).unwrap();
                let length = (step.point - from).norm();
                assert!((length - chord).abs() <= 1e-9, "{length}");
                assert!(curve.residual_mm(&step.point) <= 1e-9);
                stepper.advance(&step);
                travelled += chord;
            }
        }
    }
}

/// The distance itself, not the residual, through a node where one is not the other.
#[test]
fn a_node_is_passed_on_the_branch_it_was_reached_by() {
    let curve = viviani();
    for chord in [0.4, 2.0, 0.37] {
        let start = Vector3::new(20.0, 20.0, 40.0 * 0.5_f64.sqrt());
        let mut stepper = ImplicitStepper::new(&curve, start, &-Vector3::x()).unwrap();
        let mut last = off_viviani(&start).0;
        let mut turned = 0.0;
        for _ in 0..4000 {
            let step = stepper.look(chord).unwrap();
            stepper.advance(&step);
            let (t, off) = off_viviani(stepper.point());
            assert!(off <= 1e-7, "off by {off} at t = {t}");
            let lap = 4.0 * std::f64::consts::PI;
            let turn = (t - last).rem_euclid(lap);
            // Always forwards, and never onto the other branch, which is half a lap away.
            assert!(turn > 0.0 && turn < 0.2, "from {last} to {t}");
            turned += turn;
            last = t;
        }
        assert!(turned > 30.0);
    }
}

#[test]
fn a_node_is_passed_when_a_chord_ends_on_it() {
    let curve = viviani();
    // Five chords before the node, so that the fifth ends on it.
    for chord in [0.4, 2.0] {
        let at = |t: f64| {
            Vector3::new(
                20.0 * (1.0 + t.cos()),
                20.0 * t.sin(),
                40.0 * (0.5 * t).sin(),
            )
        };
        let mut t = 0.0;
        for _ in 0..5 {
            let here = at(t);
            let (mut near, mut far) = (t - 0.2, t);
            for _ in 0..100 {
                let middle = 0.5 * (near + far);
                if (at(middle) - here).norm() > chord {
                    near = middle;
                } else {
                    far = middle;
                }
            }
            t = near;
        }
        let mut stepper =
            ImplicitStepper::new(&curve, at(t), &Vector3::new(0.0, 1.0, 1.0)).unwrap();
        for _ in 0..10 {
            let step = stepper.look(chord).unwrap();
            stepper.advance(&step);
        }
        let (t, off) = off_viviani(stepper.point());
        assert!(off < 1e-4 && t > 0.0 && t < 1.0, "{t} {off}");
    }
}

#[test]
fn few_corrections() {
    let circle = surfaces(["x^2+y^2+z^2-625", "z-15"]);
    let mut stepper =
        ImplicitStepper::new(&circle, Vector3::new(20., 0., 15.), &Vector3::y()).unwrap();
    let first = stepper.look(0.4).unwrap();
    stepper.advance(&first);
    for _ in 0..1000 {
        let step = stepper.look(0.4).unwrap();
        assert!(
            step.corrections <= 1,
            "the mirror is exact on circles: {}",
            step.corrections
        );
        stepper.advance(&step);
    }
}

/// The part of the lap between two points of an ellipse-like curve, sampled by short chords.
fn sampled_error(curve: &ImplicitCurve, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    let along = to - from;
    let mut stepper = ImplicitStepper::new(curve, *from, &along).unwrap();
    let mut worst: f64 = 0.0;
    for _ in 0..200 {
        let step = stepper.look(along.norm() / 100.0).unwrap();
        stepper.advance(&step);
        let out = stepper.point() - from;
        let share = out.dot(&along) / along.norm_squared();
        if share > 1.0 {
            break;
        }
        worst = worst.max((out - along * share).norm());
    }
    worst
}

#[test]
fn proven_errors_hold() {
    let rule = ChordRule {
        longest_mm: 5.0,
        error_mm: 2e-3,
    };
    for curve in [
        surfaces(["x^2+y^2-225", "y^2+z^2-400"]),
        surfaces(["(x/15)^2+(y/6)^2+(z/20)^2-1", "z - 0.02*x*y - 3"]),
    ] {
        let start = Vector3::new(15.0, 0.0, 20.0);
        let start = glidepath_curve::implicit::onto_curve(&curve, &start, 30.0).unwrap();
        let mut chords =
            ImplicitChords::new(curve.clone(), &start, &Vector3::y(), End::Closed, rule).unwrap();
        let (mut from, mut sharp, mut count) = (start, 0.0, 0);
        while let Some(chord) = chords.next_chord().unwrap() {
            assert!(chord.is_proven && chord.error_mm <= rule.error_mm);
            let error = sampled_error(&curve, &from, &chord.point);
            assert!(error <= chord.error_mm, "{error} {}", chord.error_mm);
            sharp += error / chord.error_mm;
            count += 1;
            from = chord.point;
        }
        assert!((from - start).norm() < 1e-12);
        // The proof costs less than a factor of four.
        assert!(sharp > 0.25 * f64::from(count), "{sharp} of {count}");
    }
}

#[test]
fn ends() {
    let circle = surfaces(["x^2+y^2-400", "z"]);
    let start = Vector3::new(20.0, 0.0, 0.0);
    let rule = ChordRule {
        longest_mm: 0.4,
        error_mm: 1e-2,
    };
    let walk = |end| {
        let mut chords =
            ImplicitChords::new(circle.clone(), &start, &Vector3::y(), end, rule).unwrap();
        let mut points = Vec::new();
        while let Some(chord) = chords.next_chord().unwrap() {
            points.push(chord.point);
        }
        points
    };
    let lap = walk(End::Closed);
    assert_eq!(lap.len(), 315);
    assert_eq!(*lap.last().unwrap(), start);
    let quarter = walk(End::At(Vector3::new(0.0, 20.0, 0.0)));
    assert!((quarter.last().unwrap() - Vector3::new(0.0, 20.0, 0.0)).norm() < 1e-9);
    let length = walk(End::Length(10.0));
    let angle = length.last().unwrap().y.atan2(length.last().unwrap().x);
    assert!((20.0 * angle - 10.0).abs() < 1e-6, "{}", 20.0 * angle);
    assert!(matches!(
        ImplicitChords::new(
            circle.clone(),
            &(start * 1.1),
            &Vector3::y(),
            End::Closed,
            rule
        )
        .map(|_| ()),
        Err(CurveError::Lost { .. })
    ));
    assert!(matches!(
        ImplicitChords::new(circle.clone(), &start, &Vector3::x(), End::Closed, rule).map(|_| ()),
        Err(CurveError::Sideways)
    ));
}

/// An error as large as the curve itself is no reason to leave a part of it out.
#[test]
fn a_large_error_leaves_nothing_out() {
    for radius in [0.001, 1.0, 20.0] {
        let circle = surfaces([&format!("x^2+y^2-{:e}", radius * radius), "z"]);
        let start = Vector3::new(radius, 0.0, 0.0);
        // The angle passed on the way to an end, and the longest chord.
        let turned = |end, errors: f64, longest: f64| {
            let rule = ChordRule {
                longest_mm: longest * radius,
                error_mm: errors * radius,
            };
            let chords = ImplicitChords::new(circle.clone(), &start, &Vector3::y(), end, rule);
            let (mut chords, mut from, mut angle) = (chords.unwrap(), start, 0.0);
            while let Some(chord) = chords.next_chord().unwrap() {
                let turn = from.angle(&chord.point);
                let sagitta = radius * (1.0 - (0.5 * turn).cos());
                assert!(chord.is_proven && sagitta <= chord.error_mm, "{chord:?}");
                angle += turn;
                from = chord.point;
            }
            angle
        };
        for errors in [0.01, 0.3, 0.5, 0.9, 1.1, 2.0, 5.0, 100.0] {
            for longest in [0.1, 0.7, 3.0, 100.0] {
                let what = format!("radius {radius}, {errors} of it, chords {longest}");
                let lap = turned(End::Closed, errors, longest);
                assert!((lap - std::f64::consts::TAU).abs() < 1e-6, "{lap}: {what}");
                for wanted in [0.2, 2.0, 4.0, 6.0_f64] {
                    let end = Vector3::new(radius * wanted.cos(), radius * wanted.sin(), 0.0);
                    let angle = turned(End::At(end), errors, longest);
                    assert!(
                        (angle - wanted).abs() < 1e-6,
                        "{angle} for {wanted}: {what}"
                    );
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn bounds_of_chords_on_crossing_cylinders(r in 5.0..15.0_f64, s in 0.05..0.95_f64, chord in 0.05..2.0_f64) {
        let text = format!("x^2+y^2-{}", r * r);
        let curve = surfaces([&text, "y^2+z^2-400"]);
        let y = s * r;
        let from = Vector3::new((r * r - y * y).sqrt(), y, (400.0 - y * y).sqrt());
        let stepper = ImplicitStepper::new(&curve, from, &-Vector3::y()).unwrap();
        let to = stepper.look(chord).unwrap().point;
        let error = sampled_error(&curve, &from, &to);
        if let Some(bound) = chord_error_mm(&curve, &from, &to, error) {
            prop_assert!(error <= bound, "{error} {bound}");
        }
    }
}
