//! Tests of equal chords through nodes: every chord of its length, every end on the curve, every
//! error proven and kept, judged by formulas of the same curves with a parameter.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test")]

use crate::support::*;
use core::f64::consts::TAU;
use glidepath_curve::implicit::{End, ImplicitChords};
use glidepath_curve::{ChordRule, CurveError, ImplicitCurve, ParametricCurve};
use nalgebra::Vector3;

/// A curve with nodes in both forms, closed over `lap_t`.
struct Case {
    name: String,
    curve: ImplicitCurve,
    oracle: ParametricCurve,
    lap_t: f64,
    /// A chord much longer than 0.4 mm that its sharpest bends allow, mm.
    long_mm: f64,
}

impl Case {
    fn new(name: &str, fg: [&str; 2], xyz: [&str; 3], lap_t: f64) -> Self {
        Self {
            long_mm: 2.0,
            name: name.to_owned(),
            curve: surfaces(fg),
            oracle: formulas(xyz),
            lap_t,
        }
    }
}

/// What was seen on the way.
#[derive(Debug, Default)]
struct Seen {
    chords: u32,
    /// Chords before the first that is not as long as all are to be: only what is left at the end
    /// is shorter.
    equal: u32,
    unproven: u32,
    /// Largest error over its bound.
    sharpest: f64,
    /// Largest distance of an end from the curve, mm.
    off_mm: f64,
}

/// The parameter of the point of a curve next to `p`, from a guess.
fn nearest(curve: &ParametricCurve, p: &Vector3<f64>, guess: f64) -> f64 {
    let mut t = guess;
    for _ in 0..30 {
        let at = curve.local(t);
        let out = at.point - p;
        t -= out.dot(&at.d1) / (at.d1.norm_squared() + out.dot(&at.d2)).max(1e-3);
    }
    t
}

/// Follows a curve lap after lap, forwards or backwards, each lap beginning where the last one
/// ended; judges every chord.
fn follow(case: &Case, start_t: f64, is_back: bool, rule: ChordRule, laps: u32) -> Seen {
    let sign = if is_back { -1.0 } else { 1.0 };
    let at = case.oracle.local(start_t);
    let mut chords = ImplicitChords::new(
        case.curve.clone(),
        &at.point,
        &(at.d1 * sign),
        End::Length(f64::from(laps) * length_mm(case)),
        rule,
    )
    .unwrap_or_else(|e| panic!("{}: {e}", case.name));
    let mut seen = Seen::default();
    let (mut from, mut t) = (*chords.point(), start_t);
    while let Some(chord) = chords
        .next_chord()
        .unwrap_or_else(|e| panic!("{} at {t}: {e}", case.name))
    {
        let speed = case.oracle.local(t).d1.norm();
        let next = nearest(
            &case.oracle,
            &chord.point,
            t + sign * chord.chord_mm / speed,
        );
        assert!((next - t) * sign > 0.0, "{}: back at {t}", case.name);
        let off = (case.oracle.point(next) - chord.point).norm();
        seen.off_mm = seen.off_mm.max(off);
        assert!(off <= 1e-9, "{}: {off} at {next}", case.name);
        let length = (chord.point - from).norm();
        assert!((length - chord.chord_mm).abs() <= 1e-9);
        let along = (chord.point - from) / length;
        let error = (1..40)
            .map(|k| {
                let out = case.oracle.point(t + (next - t) * f64::from(k) / 40.0) - from;
                let share = out.dot(&along).clamp(0.0, length);
                (out - along * share).norm()
            })
            .fold(0.0, f64::max);
        assert!(
            error <= chord.error_mm,
            "{}: {error} > {}",
            case.name,
            chord.error_mm
        );
        assert!(chord.error_mm <= rule.error_mm);
        seen.sharpest = seen.sharpest.max(error / chord.error_mm);
        seen.chords += 1;
        seen.unproven += u32::from(!chord.is_proven);
        let is_equal = (length - rule.longest_mm).abs() <= 1e-9;
        if is_equal && seen.equal + 1 == seen.chords {
            seen.equal += 1;
        }
        (from, t) = (chord.point, next);
    }
    seen
}

/// Of a lap, by Simpson's rule on a periodic function: any rule is exact.
fn length_mm(case: &Case) -> f64 {
    let n = 4000;
    (0..n)
        .map(|k| {
            case.oracle
                .local(case.lap_t * f64::from(k) / f64::from(n))
                .d1
                .norm()
        })
        .sum::<f64>()
        * case.lap_t
        / f64::from(n)
}

fn cases() -> Vec<Case> {
    let mut cases = vec![
        Case::new(
            "Viviani",
            ["x^2+y^2+z^2-1600", "(x-20)^2+y^2-400"],
            ["20*(1+cos(t))", "20*sin(t)", "40*sin(t/2)"],
            2.0 * TAU,
        ),
        Case::new(
            "Viviani at a height",
            ["x^2+y^2+(z-500)^2-1600", "(x-20)^2+y^2-400"],
            ["20*(1+cos(t))", "20*sin(t)", "500+40*sin(t/2)"],
            2.0 * TAU,
        ),
        Case::new(
            "equal cylinders",
            ["x^2+y^2-225", "y^2+z^2-225"],
            ["15*cos(t)", "15*sin(t)", "15*cos(t)"],
            TAU,
        ),
        // In the plane y = r a torus with R = 2 r leaves a lemniscate of Bernoulli.
        Case::new(
            "lemniscate",
            ["(x^2+y^2+z^2+300)^2-1600*(x^2+y^2)", "y-10"],
            [
                "20*sqrt(2)*cos(t)/(1+sin(t)^2)",
                "10",
                "20*sqrt(2)*sin(t)*cos(t)/(1+sin(t)^2)",
            ],
            TAU,
        ),
        // The same with functions that are no polynomials: tan(y-10) = 0 where y = 10.
        Case::new(
            "lemniscate of other functions",
            [
                "sqrt(x^2+y^2+z^2+300+1000*sin(y-10)^2)-sqrt(40*sqrt(x^2+y^2))",
                "tan((y-10)/20)",
            ],
            [
                "20*sqrt(2)*cos(t)/(1+sin(t)^2)",
                "10",
                "20*sqrt(2)*sin(t)*cos(t)/(1+sin(t)^2)",
            ],
            TAU,
        ),
    ];
    // Cylinders that touch a sphere from inside, narrow and wide.
    for (sphere, cylinder) in [(40.0, 4.0), (40.0, 12.0), (40.0, 33.0), (7.0, 5.0)] {
        let offset = sphere - cylinder;
        let rise = 2.0 * f64::sqrt(cylinder * offset);
        let case = Case::new(
            &format!("cylinder {cylinder} in sphere {sphere}"),
            [
                &format!("x^2+y^2+z^2-{sphere:?}^2"),
                &format!("(x-{offset:?})^2+y^2-{cylinder:?}^2"),
            ],
            [
                &format!("{offset:?}+{cylinder:?}*cos(t)"),
                &format!("{cylinder:?}*sin(t)"),
                &format!("{rise:?}*sin(t/2)"),
            ],
            2.0 * TAU,
        );
        cases.push(Case {
            long_mm: 0.2 * cylinder,
            ..case
        });
    }
    cases
}

#[test]
fn chords_through_nodes_are_equal_and_proven() {
    for case in cases() {
        for (longest_mm, error_mm) in [(0.4, 0.01), (case.long_mm, 0.5), (0.37, 0.02)] {
            for is_back in [false, true] {
                let rule = ChordRule {
                    longest_mm,
                    error_mm,
                };
                let seen = follow(&case, 1.0, is_back, rule, 1);
                println!("{:32} {longest_mm} {seen:?}", case.name);
                assert_eq!(seen.unproven, 0, "{}", case.name);
                assert!(
                    seen.equal + 2 >= seen.chords,
                    "{} {}",
                    case.name,
                    seen.equal
                );
            }
        }
    }
}

/// Points are found from the one before, never set right from outside: after ten laps they are as
/// exact as in the first.
#[test]
fn nothing_drifts_in_ten_laps_through_a_node() {
    for case in [&cases()[0], &cases()[3]] {
        for is_back in [false, true] {
            let rule = ChordRule {
                longest_mm: 0.4,
                error_mm: 0.01,
            };
            let seen = follow(case, 1.0, is_back, rule, 10);
            println!("{:32} {seen:?}", case.name);
            assert!(seen.unproven == 0 && seen.equal + 2 >= seen.chords);
        }
    }
}

fn viviani() -> ImplicitCurve {
    surfaces(["x^2+y^2+z^2-1600", "(x-20)^2+y^2-400"])
}

const RULE: ChordRule = ChordRule {
    longest_mm: 0.4,
    error_mm: 0.01,
};

fn lengths(mut chords: ImplicitChords) -> Vec<f64> {
    let mut lengths = Vec::new();
    while let Some(chord) = chords.next_chord().unwrap() {
        assert!(chord.is_proven);
        lengths.push(chord.chord_mm);
    }
    lengths
}

#[test]
fn a_curve_may_begin_and_end_at_a_node() {
    let node = Vector3::new(40.0, 0.0, 0.0);
    let start = |ahead, end| ImplicitChords::new(viviani(), &node, &ahead, end, RULE);
    // Either branch, either way.
    for ahead in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let ahead = Vector3::new(0.1, ahead.0, 0.7 * ahead.1);
        let mut chords = start(ahead, End::Length(1.0)).unwrap();
        let first = chords.next_chord().unwrap().unwrap();
        assert!(first.is_proven && (first.chord_mm - 0.4).abs() < 1e-12);
        assert!((first.point - node).normalize().dot(&ahead.normalize()) > 0.9);
        // All of it, though it passes its start on the other branch halfway.
        let lap = lengths(start(ahead, End::Closed).unwrap());
        assert!((lap.iter().sum::<f64>() - 305.6).abs() < 0.5);
        // Half of it.
        let half = lengths(start(ahead, End::At(node)).unwrap());
        assert!((half.iter().sum::<f64>() - 152.8).abs() < 0.25);
        let (_, equal) = lap.split_last().unwrap();
        assert!(equal.iter().all(|l| (l - 0.4).abs() <= 1e-9));
    }
    let between = start(Vector3::y(), End::Closed);
    assert_eq!(between.err(), Some(CurveError::Sideways));
}

/// The node is the end of a chord, to the last bit or nearly.
#[test]
fn a_chord_may_end_at_a_node() {
    let oracle = formulas(["20*(1+cos(t))", "20*sin(t)", "40*sin(t/2)"]);
    for off in [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, -1e-9, -1e-5] {
        // Back from the node five chords, by bisection.
        let mut t = 0.0;
        for k in 0..5 {
            let here = oracle.point(t);
            let want = 0.4 + if k == 0 { off } else { 0.0 };
            let (mut near, mut far) = (t - 0.2, t);
            for _ in 0..100 {
                let middle = 0.5 * (near + far);
                if (oracle.point(middle) - here).norm() > want {
                    near = middle;
                } else {
                    far = middle;
                }
            }
            t = near;
        }
        let at = oracle.local(t);
        let end = End::Length(4.0);
        let mut chords = ImplicitChords::new(viviani(), &at.point, &at.d1, end, RULE).unwrap();
        for k in 0..9 {
            let chord = chords.next_chord().unwrap().unwrap();
            let near = nearest(&oracle, &chord.point, t + 0.02);
            assert!(near > t, "{k}");
            let apart = (oracle.point(near) - chord.point).norm();
            assert!(apart <= 1e-9, "{off} {k}: {apart}");
            assert!(chord.is_proven && (chord.chord_mm - 0.4).abs() <= 1e-9);
            t = near;
        }
    }
}

/// Spheres and cylinders that touch from outside have one point in common, and no curve through it.
#[test]
fn an_isolated_point_is_no_node() {
    let touching = surfaces(["x^2+y^2+z^2-1600", "(x-60)^2+y^2-400"]);
    let at = Vector3::new(40.0, 0.0, 0.0);
    let chords = ImplicitChords::new(touching, &at, &Vector3::y(), End::Closed, RULE);
    assert!(matches!(chords, Err(CurveError::Singular { .. })));
}

/// A sphere a little too large or too small pulls the branches apart: what was a crossing is two
/// sharp turns. They are followed as finely as they need; hardly any of it is without proof.
#[test]
fn branches_that_do_not_quite_cross_are_told_apart() {
    for excess in [0.01, -0.01, 1e-4] {
        let curve = surfaces([
            &format!("x^2+y^2+z^2-{:?}", 1600.0 + excess),
            "(x-20)^2+y^2-400",
        ]);
        let start = Vector3::new(20.0, 20.0, f64::sqrt(800.0 + excess));
        let mut chords = ImplicitChords::new(
            curve.clone(),
            &start,
            &-Vector3::x(),
            End::Length(330.0),
            RULE,
        )
        .unwrap();
        let (mut proven, mut all) = (0.0, 0.0);
        while let Some(chord) = chords.next_chord().unwrap() {
            assert!(curve.residual_mm(&chord.point) < 1e-9);
            all += chord.chord_mm;
            proven += if chord.is_proven { chord.chord_mm } else { 0.0 };
        }
        println!("{excess}: {proven} of {all} mm");
        assert!(all - proven < 0.5 && all > 329.0);
    }
}
