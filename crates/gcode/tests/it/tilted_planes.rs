//! Tilted planes in other forms than by a zero and angles, and how their machine gets there.

use glidepath_gcode::{Dialect, Options, Program, SiemensParameters, check};
use glidepath_geometry::AxisVector;
use glidepath_program::ItemKind;

use crate::five_axes::{at, finds, joints, last, near, options};
use crate::support::listed;

#[test]
fn a_plane_may_count_in_another_one_and_in_inches() {
    let end = |text: &str| last(Dialect::Siemens, text);
    // 30 degrees about X, then 10 on along the new Y, and 15 more about X: 45 degrees in all.
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let steps = "CYCLE800(0,\"\",0,57,5,0,0,30,0,0,0,0,0,-1)\nCYCLE800(0,\"\",200001,57,0,10,0,15,0,0,0,0,0,-1)\nG0 X0 Y0 Z0";
    near(end(steps), at(5.0, 10.0 * cos, 10.0 * sin, -45.0, 0.0));
    let new = steps.replace("200001", "200000");
    near(end(&new), at(0.0, 10.0, 0.0, -15.0, 0.0));
    let inches = "G700\nCYCLE800(0,\"\",0,57,1,2,0,30,0,0,0,0,0,-1)\nG0 X0 Y0 Z0";
    near(end(inches), at(25.4, 50.8, 0.0, -30.0, 0.0));
}

#[test]
fn the_tool_goes_up_before_the_table_swivels() {
    let with = |swivel_z_mm: Option<f64>| Options {
        siemens: SiemensParameters {
            swivel_z_mm,
            ..SiemensParameters::default()
        },
        ..options(Dialect::Siemens)
    };
    let text = "G0 Z20\nCYCLE800(1,\"TC\",0,57,0,0,0,30,0,0,0,0,0,-1)";
    let ends = |options: Options| -> Vec<AxisVector> {
        Program::new(text.as_bytes(), options)
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Move { segment, .. } => Some(segment.end()),
                _ => None,
            })
            .collect()
    };
    let up = ends(with(Some(150.0)));
    near(up[1], at(0.0, 0.0, 150.0, 0.0, 0.0));
    let last = up.last().expect("a move");
    assert!((last[3] + 30.0).abs() < 1e-9);
    assert!((joints(last)[2] - 150.0).abs() < 1e-6, "{last:?}");
    // Never down.
    near(ends(with(Some(10.0)))[0], at(0.0, 0.0, 20.0, 0.0, 0.0));
    let down = ends(with(Some(10.0)));
    assert!(down.iter().all(|end| joints(end)[2] > 20.0 - 1e-6));
    let report = check(text.as_bytes(), with(None));
    assert_eq!(listed(&report), ["2:1 canned-cycle"]);
}

#[test]
fn the_tool_goes_aside_once_it_is_up() {
    let with = |swivel_xy_mm: [Option<f64>; 2]| Options {
        siemens: SiemensParameters {
            swivel_z_mm: Some(150.0),
            swivel_xy_mm,
            ..SiemensParameters::default()
        },
        ..options(Dialect::Siemens)
    };
    let text = "G0 X5 Y6 Z20\nCYCLE800(2,\"TC\",0,57,0,0,0,30,0,0,0,0,0,-1)";
    let ends: Vec<AxisVector> = Program::new(text.as_bytes(), with([Some(-40.0), Some(70.0)]))
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        })
        .collect();
    near(ends[1], at(5.0, 6.0, 150.0, 0.0, 0.0));
    near(ends[2], at(-40.0, 70.0, 150.0, 0.0, 0.0));
    let last = joints(ends.last().expect("a move"));
    for (joint, place) in [(0, -40.0), (1, 70.0), (2, 150.0)] {
        assert!((last[joint] - place).abs() < 1e-6, "{last:?}");
    }
    for lacking in [[None, Some(70.0)], [Some(-40.0), None]] {
        let report = check(text.as_bytes(), with(lacking));
        assert_eq!(listed(&report), ["2:1 canned-cycle"]);
    }
    let follows = text.replace("CYCLE", "TRAORI\nCYCLE").replace("(2,", "(4,");
    let report = check(follows.as_bytes(), with([Some(-40.0), Some(70.0)]));
    assert_eq!(listed(&report), ["3:1 canned-cycle"]);
}

/// A plane at (20, 10, 0) that is turned by 30 degrees about X.
const PLANE: &str = "G68.2 X20 Y10 Z0 J30\nG53.1\nG0 X1 Y2 Z3";

#[test]
fn a_plane_is_that_of_three_points() {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let points = |before: &str, aside: f64, end: &str| {
        let (y, z) = (10.0 + 10.0 * cos, 10.0 * sin);
        let text = format!(
            "{before}G68.2 P2 Q1 X20 Y10 Z0\nG68.2 P2 Q2 X25 Y10 Z0\nG68.2 P2 Q3 X{aside} Y{y} Z{z}\nG53.1\nG0 {end}"
        );
        last(Dialect::Fanuc, &text)
    };
    let right = last(Dialect::Fanuc, PLANE);
    near(
        right,
        at(
            21.0,
            10.0 + 2.0 * cos - 3.0 * sin,
            2.0 * sin + 3.0 * cos,
            -30.0,
            0.0,
        ),
    );
    near(points("", 20.0, "X1 Y2 Z3"), right);
    // The third point says on which side Y is, no more.
    near(points("", -7.0, "X1 Y2 Z3"), right);
    near(points("G68.2 P2 Q0 X1 Y2 Z3 R0\n", 20.0, "X0 Y0 Z0"), right);
    near(points("G68.2 P2 Q0 R90\n", 20.0, "X2 Y-1 Z3"), right);
    // Parameters may be written in between.
    near(points("#1=5\n", 20.0, "X1 Y2 Z3"), right);
}

#[test]
fn a_plane_is_that_of_two_directions() {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let directions = |x: &str| {
        let (j, k) = (-2.0 * sin, 2.0 * cos);
        let text =
            format!("G68.2 P3 Q1 X20 Y10 Z0 {x}\nG68.2 P3 Q2 I0 J{j} K{k}\nG53.1\nG0 X1 Y2 Z3");
        last(Dialect::Fanuc, &text)
    };
    let right = last(Dialect::Fanuc, PLANE);
    near(directions("I5"), right);
    // The normal is as it is written, whatever the digits of X.
    near(directions("I1 J-0.0005 K0.000866"), right);
}

#[test]
fn what_is_wrong_with_blocks_of_a_plane_is_told() {
    let fanuc = |text: &str, expected: &[&str]| finds(Dialect::Fanuc, text, expected);
    let first = "G68.2 P2 Q1 X0 Y0 Z0";
    fanuc(&format!("{first}\nG0 X1"), &["2:1 not-supported"]);
    fanuc(&format!("{first}\nG68.2 X1 J30"), &["2:1 not-supported"]);
    fanuc(&format!("{first}\nM30"), &["2:1 not-supported"]);
    fanuc(first, &["1:1 not-supported"]);
    fanuc("G68.2 P2 Q2 X0 Y0 Z0", &["1:10 not-supported"]);
    fanuc("G68.2 P3 Q2 K1", &["1:10 not-supported"]);
    fanuc("G68.2 P2 X0 Y0 Z0", &["1:1 missing-word"]);
    fanuc("G68.2 P2 Q1 X0 Y0", &["1:7 missing-word"]);
    fanuc("G68.2 P3 Q1 X0 Y0 Z0", &["1:7 missing-word"]);
    fanuc(&format!("{first} R5"), &["1:22 unused-word"]);
    fanuc(&format!("{first} I5"), &["1:22 unused-word"]);
    fanuc("G68.2 P2 Q0 X1 Y0 Z0 R5", &["1:22 ambiguous-word"]);
    fanuc(
        &format!("{first}\nG68.2 P2 Q2 X1 Y0 Z0\nG68.2 P2 Q3 X2 Y0 Z0"),
        &["3:1 invalid-value"],
    );
    fanuc(
        "G68.2 P3 Q1 X0 Y0 Z0 I1\nG68.2 P3 Q2 I1 K1",
        &["2:1 invalid-value"],
    );
    // A plane that is given up leaves the coordinates as they were.
    near(
        last(Dialect::Fanuc, &format!("{first}\nG69\nG0 X5")),
        at(5.0, 0.0, 0.0, 0.0, 0.0),
    );
    // A line that is refused may be written again.
    let text = format!("{first}\nG0 X9\nG68.2 P2 Q2 X1 Y0 Z0\nG68.2 P2 Q3 X0 Y1 Z0\nG0 X1 Y2 Z3\n");
    let mut typed = Program::new(text.as_bytes(), options(Dialect::Fanuc)).typed();
    assert_eq!(typed.by_ref().filter(Result::is_err).count(), 1);
    near(*typed.position(), at(1.0, 2.0, 3.0, 0.0, 0.0));
}
