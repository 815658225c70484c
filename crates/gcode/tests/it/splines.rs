//! Tests of splines: where they go, and what is refused.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use glidepath_gcode::{Options, Program, check};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{ItemKind, Rate};
use serde_json::Value;
use std::fmt::Write as _;

/// Points of each piece of a curve.
const SAMPLES: u32 = 32;

/// The points a program's feed moves go through, the start first, and their feedrates.
fn path(text: &str) -> (Vec<AxisVector>, Vec<f64>) {
    let (mut points, mut feeds) = (Vec::new(), Vec::new());
    for item in Program::new(text.as_bytes(), Options::default()) {
        let item = item.unwrap_or_else(|diagnostic| panic!("{diagnostic:?}\n{text}"));
        if let ItemKind::Move {
            segment,
            rate: Rate::Feed(feed_v),
            ..
        } = item.kind
        {
            if points.is_empty() {
                points.push(segment.start());
            }
            assert_eq!(points.last(), Some(&segment.start()), "a gap");
            if let Segment::Curve(curve) = segment {
                let inner = (1..SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES));
                points.extend(inner.map(|x| segment.jet(x * curve.length).position));
            }
            points.push(segment.end());
            feeds.push(feed_v);
        }
    }
    (points, feeds)
}

fn diagnostic(text: &str) -> String {
    let report = check(text.as_bytes(), Options::default());
    let first = report.diagnostics.first().expect("a diagnostic");
    format!(
        "{}:{} {} {}",
        first.line,
        first.column,
        first.code.as_str(),
        first.message
    )
}

/// Largest distance of points of a curve from the polyline, at most a micrometre.
fn assert_on(points: &[AxisVector], curve: impl Fn(f64) -> [f64; 2]) {
    for i in 0..=1000 {
        let [x, y] = curve(f64::from(i) / 1000.0);
        let mut at = AxisVector::zeros();
        (at[0], at[1]) = (x, y);
        let nearest = points.windows(2).map(|pair| {
            let chord = pair[1] - pair[0];
            let share = ((at - pair[0]).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (at - pair[0] - chord * share).norm()
        });
        let distance = nearest.fold(f64::INFINITY, f64::min);
        assert!(distance <= 0.001 + 1e-9, "{distance} at {x} {y}");
    }
}

fn cubic(p: [[f64; 2]; 4], t: f64) -> [f64; 2] {
    let s = 1.0 - t;
    let b = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    [0, 1].map(|k| (0..4).map(|i| b[i] * p[i][k]).sum())
}

#[test]
fn g5_is_a_bezier_cubic_and_goes_on_smoothly() {
    let (points, feeds) = path("F600\nG5 I0 J30 P0 Q-30 X20 Y20\nG5 P5 Q-25 X50 Y0\n");
    let end = points
        .iter()
        .position(|p| (p[0] - 20.0).abs() < 1e-9 && p[1] > 19.0);
    let end = end.expect("the end of the first");
    let first = [[0.0, 0.0], [0.0, 30.0], [20.0, -10.0], [20.0, 20.0]];
    assert_on(&points[..=end], |t| cubic(first, t));
    let second = [[20.0, 20.0], [20.0, 50.0], [55.0, -25.0], [50.0, 0.0]];
    assert_on(&points[end..], |t| cubic(second, t));
    assert!(feeds.iter().all(|feed_v| (feed_v - 10.0).abs() < 1e-12));
    // A long curve is not cut finer than its tolerance needs.
    assert!(feeds.len() < 90, "{} pieces", feeds.len());
}

#[test]
fn g5_1_is_a_parabola_in_inches_and_in_a_turned_system_too() {
    // The parabola of the LinuxCNC manual: through (-2,4), (0,0), (2,4).
    let text = "G90 F600\nG1 X-2 Y4\nG5.1 X2 I2 J-8\n";
    let (points, _) = path(text);
    assert_on(&points[1..], |t| [4.0 * t - 2.0, (4.0 * t - 2.0).powi(2)]);
    let (inches, _) = path("G20 F60\nG1 X-2 Y4\nG5.1 X2 I2 J-8\n");
    let last = inches.last().expect("points");
    assert!((last[0] - 50.8).abs() < 1e-9 && (last[1] - 101.6).abs() < 1e-9);
    let (turned, _) = path("F600 G10 L2 P1 R90\nG1 X-2 Y4\nG5.1 X2 I2 J-8\n");
    assert_on(&turned[1..], |t| [-(4.0 * t - 2.0).powi(2), 4.0 * t - 2.0]);
}

#[test]
fn g5_2_is_a_nurbs_over_uniform_knots() {
    // Four control points of order 4 are a Bézier cubic; its weights are 1.
    let (points, _) = path("F600\nG5.2 X0 Y30 P1 L4\nX20 Y-10 P1\nX20 Y20 P1\nG5.3\nG1 X30\n");
    let control = [[0.0, 0.0], [0.0, 30.0], [20.0, -10.0], [20.0, 20.0]];
    assert_on(&points[..points.len() - 1], |t| cubic(control, t));
    // A quarter circle: order 3 and a weight of cos 45°.
    let text = "G18 F600\nG1 Z10 X0\nG5.2 Z10 X10 P0.7071067811865476\nZ0 X10 P1\nG5.3\n";
    let (points, _) = path(text);
    assert!(
        points[1..]
            .iter()
            .all(|p| (p[0].hypot(p[2]) - 10.0).abs() <= 0.001 + 1e-9)
    );
    // The weight of the first control point.
    let (heavy, _) = path("F600\nG5.2 P9 L3\nX10 Y10 P1\nX20 Y0 P1\nG5.3\n");
    let (light, _) = path("F600\nG5.2 L3\nX10 Y10 P1\nX20 Y0 P1\nG5.3\n");
    let top = |points: &[AxisVector]| points.iter().map(|p| p[1]).fold(0.0, f64::max);
    assert!(
        top(&heavy) < 0.6 * top(&light),
        "{} {}",
        top(&heavy),
        top(&light)
    );
}

#[test]
fn g6_2_has_knots_and_weights() {
    let data = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/method/circle.json"
    );
    let text = std::fs::read_to_string(data).expect("the circle");
    let circle: Value = serde_json::from_str(&text).expect("JSON");
    let list = |key: &str| circle[key].as_array().expect("a list").clone();
    let (points, weights, knots) = (list("control_points"), list("weights"), list("knots"));
    let mut program = String::from("G0 X50 Y0\n");
    for (i, knot) in knots.iter().enumerate() {
        let code = match i {
            0 => "G06.2 P3 F600 ",
            _ => "",
        };
        let point = points.get(i).map_or(String::new(), |point| {
            format!(" X{} Y{} R{}", point[0], point[1], weights[i])
        });
        writeln!(program, "{code}K{knot}{point}").expect("text");
    }
    program += "G1 X40\n";
    let (path, _) = path(&program);
    let round = &path[..path.len() - 1];
    assert!(
        round
            .iter()
            .all(|p| (p[0].hypot(p[1]) - 50.0).abs() <= 0.001)
    );
    let length: f64 = round
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm())
        .sum();
    assert!(
        (length / (100.0 * std::f64::consts::PI) - 1.0).abs() < 1e-4,
        "{length}"
    );
}

#[test]
fn the_tolerance_is_that_of_the_options_or_a_share_of_g64_p() {
    let curve = "F600\nG5 I0 J30 P0 Q-30 X20 Y20\n";
    let fine = path(&format!("G64 P0.00001\n{curve}")).1.len();
    let coarse = path(&format!("G64 P2\n{curve}")).1.len();
    let plain = path(curve).1.len();
    assert!(coarse < plain && plain < fine, "{coarse} {plain} {fine}");
}

#[test]
fn what_is_no_spline_is_refused() {
    let refused = [
        (
            "F9\nG5 X1 Y1 P1 Q1",
            "2:1 missing-word the first G5 without I and J",
        ),
        (
            "F9\nG5 X1 Y1 I1 J1 P1",
            "2:1 missing-word G5 without P and Q",
        ),
        (
            "F9\nG5 X1 I1 P1 Q1",
            "2:1 missing-word G5 without both I and J",
        ),
        (
            "F9 G18\nG5 X1 Z1 I1 J1 P1 Q1",
            "2:1 spline G5 outside the XY plane",
        ),
        ("F9\nG5.1 X1 Y1 Z1 I1", "2:12 spline Z in a block with G5.1"),
        ("F9\nG5.1 X1 Y1", "2:1 missing-word G5.1 without I or J"),
        ("F9\nG5.3", "2:1 spline G5.3 without G5.2"),
        ("F9\nG5.2 X1 Y1 P0", "2:12 spline a weight of 0"),
        (
            "F9\nG5.2 X1 Y1\nX2 Y2\nX3 Z1",
            "4:4 spline Z in a control point of G5.2",
        ),
        (
            "F9\nG5.2 X1 Y1 L4\nG5.3",
            "3:1 spline the NURBS begun in line 2 is no curve",
        ),
        (
            "F9\nG5.2 X1 Y1\nG1 X2",
            "3:1 spline the NURBS begun in line 2 is not complete",
        ),
        (
            "F9\nG5.2 X1 Y1\nX2 Y2\nM2",
            "4:1 spline the NURBS begun in line 2 is not complete",
        ),
        (
            "F9\nG6.2 P4 K0 X1",
            "2:1 spline the first control point is not where the tool stands",
        ),
        (
            "F9\nG6.2 P4 K0 X0\nK1 X1\nK0.5 X2",
            "4:1 spline the knot 0.5 is below the one before it",
        ),
        ("F9\nG6.2 P4 X0", "2:1 missing-word G6.2 without K"),
        (
            "G5.1 X1 Y1 I1",
            "1:1 missing-feed a feed move without a feedrate",
        ),
    ];
    for (text, expected) in refused {
        let actual = diagnostic(text);
        assert!(actual.starts_with(expected), "{text}\n{actual}\n{expected}");
    }
}

#[test]
fn a_program_that_ends_inside_a_nurbs_is_refused() {
    let report = check("F9\nG5.2 X1 Y1\nX2 Y2\n".as_bytes(), Options::default());
    let last = report.diagnostics.last().expect("a diagnostic");
    assert_eq!(last.message, "the NURBS begun in line 2 is not complete");
    assert!(report.totals.straight_feeds == 0);
}

#[test]
fn the_feed_of_a_whole_curve_in_inverse_time() {
    // A quarter of a minute for the whole curve.
    let (points, feeds) = path("G93\nG5.1 X10 Y10 I10 J0 F4\n");
    let length: f64 = points
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).norm())
        .sum();
    assert!(
        feeds
            .iter()
            .all(|feed_v| (feed_v / (length / 15.0) - 1.0).abs() < 1e-4)
    );
}
