//! Tests of lathe cycles (G70 to G72.2): passes by hand, and diagnostics.

#![allow(clippy::expect_used, reason = "a test")]

use std::fmt::Write;

use crate::support::listed;
use glidepath_gcode::{AxisTravel, Machine, Options, Program, check};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::{ItemKind, Rate};

/// A shaft: radius 5 from Z0 to Z-10, then a shoulder to radius 8.
const SHAFT: &str = "G18 G21 G90 F100\nO100 sub\nG0 X5 Z0\nG1 Z-10\nX8\nO100 endsub\n";

/// A groove of 2 mm at a radius of 8.
const GROOVE: &str =
    "G18 G21 G90 F100\nO100 sub\nG0 X8 Z1\nG1 Z-4\nX6\nZ-8\nX8\nZ-12\nO100 endsub\n";

fn program(head: &str, text: &str) -> String {
    format!("{head}G0 X20 Z2\n{text}\nM2\n")
}

/// Moves as short text: `r` rapid, `f` feed, `a` arc, with X and Z of the end; the first one left
/// out.
fn moves(text: &str) -> String {
    let mut all = String::new();
    for item in Program::new(text.as_bytes(), Options::default()).skip(1) {
        if let ItemKind::Move { segment, rate, .. } = item.expect("a sound program").kind {
            let kind = match (&segment, rate) {
                (Segment::Arc(_), _) => 'a',
                (_, Rate::Rapid) => 'r',
                _ => 'f',
            };
            let end = segment.end();
            let [x, z] = [end[0], end[2]].map(|v| (v * 1e3).round() / 1e3 + 0.0);
            write!(all, "{kind}({x},{z}) ").expect("a string");
        }
    }
    all.trim_end().to_owned()
}

#[track_caller]
fn finds(text: &str, place_and_code: &str) {
    let report = check(text.as_bytes(), Options::default());
    assert_eq!(listed(&report), [place_and_code], "{text}");
}

#[test]
fn turning_goes_layer_by_layer_and_ends_along_the_contour() {
    // From X9, 2 at a time: 9, 7; 5.5 is the contour. The wall at Z-10 keeps 0.5. The way down is
    // that from X9 Z2 to X5.5 Z0: at X7 it is at Z 2 - 2 · 2/3.5.
    assert_eq!(
        moves(&program(SHAFT, "G71 Q100 X9 Z2 D.5 I2 R.5")),
        "r(9,2) f(9,-9.5) r(9.5,-9) r(9.5,1.5) r(9,2) \
         r(7,0.857) f(7,-9.5) r(7.5,-9) r(7.5,0.357) r(7,0.857) \
         r(5.5,0) f(5.5,-9.5) f(8,-9.5) f(9,-9.5)"
    );
}

#[test]
fn facing_does_the_same_along_x() {
    // The end face of a shaft, with a step: from Z0 at X8, to Z-3 at X3, seen from the outside.
    let face = "G18 G21 G90 F100\nO7 sub\nG0 X10 Z-3\nG1 X3\nZ0\nO7 endsub\n";
    assert_eq!(
        moves(&program(face, "G72 Q7 X12 Z0 I2 R.5")),
        "r(12,0) f(3,0) r(3.5,0.5) r(11.5,0.5) r(12,0) \
         r(10.667,-2) f(3,-2) r(3.5,-1.5) r(10.167,-1.5) r(10.667,-2) \
         r(10,-3) f(3,-3) f(3,0)"
    );
}

#[test]
fn pockets_are_cut_left_out_or_all_that_is_cut() {
    let whole = moves(&program(GROOVE, "G71 Q100 X9 Z2 I1 R.2"));
    let (bar, groove) = whole.split_at(whole.find("f(8,-4)").expect("the way to the groove"));
    assert_eq!(
        bar.trim_end(),
        "r(9,2) f(9,-12) r(9.2,-11.8) r(9.2,1.8) r(9,2) r(8,1)"
    );
    // At X8 the groove is at its top, so the pass there is the last one over it; then 7. Its bottom
    // is the contour itself.
    assert_eq!(
        groove,
        "f(8,-4) f(8,-8) r(8.2,-7.8) r(8.2,-4.2) f(8,-4) f(7,-4) f(7,-8) r(7.2,-7.8) r(7.2,-4.2) \
         f(7,-4) f(6,-4) f(6,-8) f(8,-8) f(8,-12) f(9,-12)"
    );
    assert_eq!(
        moves(&program(GROOVE, "G71.1 Q100 X9 Z2 I1 R.2")),
        "r(9,2) f(9,-12) r(9.2,-11.8) r(9.2,1.8) r(9,2) r(8,1) f(8,-4) f(8,-8) f(8,-12) f(9,-12)"
    );
    assert_eq!(
        moves(&program(GROOVE, "G71.2 Q100 X9 Z2 I1 R.2")),
        format!("r(9,2) r(8,1) {groove}")
    );
}

#[test]
fn finishing_comes_from_its_first_distance_to_its_last() {
    // 0.1 + (0.5 - 0.1) / 2, then 0.1; round the edge of the shoulder with an arc.
    let shaft = SHAFT.replace("X8\n", "X8\nZ-12\n");
    assert_eq!(
        moves(&program(&shaft, "G70 Q100 X9 Z2 D.5 E.1 P2")),
        "r(9,2) r(5.3,0) f(5.3,-9.7) f(8,-9.7) a(8.3,-10) f(8.3,-12) \
         r(9,2) r(5.1,0) f(5.1,-9.9) f(8,-9.9) a(8.1,-10) f(8.1,-12)"
    );
    assert_eq!(
        moves(&program(&shaft, "G70 Q100 X9 Z2")),
        "r(9,2) r(5,0) f(5,-10) f(8,-10) f(8,-12)"
    );
}

#[test]
fn between_finishing_passes_the_tool_rises_where_the_way_back_is_not_free() {
    // Behind the hill at X9 the profile ends at X6.
    let hill = "G18 G21 G90 F100\nO100 sub\nG0 X5 Z0\nG1 X9 Z-4\nX6 Z-7\nO100 endsub\n";
    assert_eq!(
        moves(&program(hill, "G70 Q100 X10 Z2 P2")),
        "r(10,2) r(5,0) f(9,-4) f(6,-7) f(10,-7) r(10,2) r(5,0) f(9,-4) f(6,-7)"
    );
}

#[test]
fn a_profile_may_be_computed_incremental_and_have_its_corners_cut() {
    let steps = "G18 G21 G90 F100\nO100 sub\nG0 X2 Z0\nO101 repeat [2]\nG1 W-4\nU2 A1\nO101 endrepeat\n\
                 G1 Z-12 C1\nX12\nO100 endsub\n";
    let finished = "r(15,2) r(2,0) f(2,-4) f(3,-4) a(4,-5) f(4,-8) f(5,-8) a(6,-9) f(6,-11) \
                    f(7,-12) f(12,-12)";
    assert_eq!(moves(&program(steps, "G70 Q100 X15 Z2")), finished);
    // The same in diameters, and all incremental.
    let diameters = steps
        .replace("G90", "G90 G7")
        .replace("X2 Z0", "X4 Z0")
        .replace("U2", "U4")
        .replace("X12", "X24");
    let text = program(&diameters, "G70 Q100 X30 Z2").replace("X20", "X40");
    assert_eq!(moves(&text), finished);
    let incremental = steps
        .replace("X2 Z0", "X-13 Z-2")
        .replace("W-4", "Z-4")
        .replace("U2", "X2")
        .replace("Z-12 C1", "Z-4 C1")
        .replace("X12", "X6");
    let text = program(&incremental, "G0 X15 Z2\nG91\nG70 Q100");
    assert_eq!(moves(&text), finished);
    // Offsets carry the cycle along; items belong to the line of the cycle.
    let shifted = program(steps, "G92 X20 Z-3\nG70 Q100 X15 Z2");
    let machine = moves(&shifted);
    assert!(machine.starts_with("r(15,7) r(2,5) f(2,1)"), "{machine}");
    let lines: Vec<u32> = Program::new(shifted.as_bytes(), Options::default())
        .map(|item| item.expect("a sound program").line)
        .collect();
    assert_eq!((lines[0], lines[1], lines[10]), (11, 13, 13));
}

#[test]
fn boring_and_the_other_end_are_the_same_seen_in_a_mirror() {
    let mirrored = |x: f64, z: f64, text: &str| {
        let mut all = String::new();
        for item in Program::new(text.as_bytes(), Options::default()).skip(1) {
            if let ItemKind::Move { segment, .. } = item.expect("a sound program").kind {
                let end = segment.end();
                let place = [20.0 + x * (end[0] - 20.0), z * end[2]];
                let [x, z] = place.map(|v| (v * 1e3).round() / 1e3 + 0.0);
                write!(all, "({x},{z}) ").expect("a string");
            }
        }
        all
    };
    let hill = |x: f64, z: f64| {
        let to = |a: f64, b: f64| format!("X{} Z{}", 20.0 + x * (a - 20.0), z * b);
        let turn = if x * z > 0.0 { 3 } else { 2 };
        format!(
            "G18 G21 G90 F100\nO100 sub\nG0 {}\nG1 {}\nG{turn} {} R3\nG1 {}\nO100 endsub\nG0 {}\n\
             G71 Q100 {} D.3 I.7 R.4\nG70 Q100 {} D.3 P2\nM2\n",
            to(5.0, 1.0),
            to(6.0, -4.0),
            to(6.0, -8.0),
            to(9.0, -10.0),
            to(14.0, 3.0),
            to(12.0, 2.0),
            to(12.0, 2.0),
        )
    };
    let outside = mirrored(1.0, 1.0, &hill(1.0, 1.0));
    assert!(outside.len() > 500);
    for (x, z) in [(-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        assert_eq!(mirrored(x, z, &hill(x, z)), outside, "{x} {z}");
    }
}

#[test]
fn finishing_goes_beside_the_profile_with_compensation_on() {
    // A radius of 0.4 with the tip in the direction of orientation 2: the tip's path is that of its
    // centre, shifted by the radius; along Z it is the profile itself.
    let text = "G42.1 D.8 L2\nG70 Q100 X14 Z3\nG40\nG0 X20 Z10";
    let shaft = SHAFT.replace("X8\n", "X8\nZ-15\n");
    let made = moves(&program(&shaft, text));
    assert!(made.starts_with("r(14,3) r("), "{made}");
    assert!(made.contains("f(5,-10)"), "{made}");
    assert!(made.ends_with("r(20,10)"), "{made}");
    finds(
        &program(&shaft, "G42.1 D.8\nG71 Q100 X14 Z3"),
        "10:1 cutter-radius",
    );
}

#[test]
fn what_cannot_be_cut_is_refused_with_its_place() {
    let with = |cycle: &str| program(SHAFT, cycle);
    finds(&with("G71 X9 Z2"), "8:1 missing-word");
    finds(&with("G71 Q5 X9 Z2"), "8:5 unknown-subroutine");
    finds(&with("G71 Q100 X9 Z2 I0"), "8:16 canned-cycle");
    finds(&with("G70 Q100 X9 Z2 P0"), "8:16 canned-cycle");
    finds(&with("G71 Q100 X9 Z2 D-1"), "8:16 invalid-value");
    finds(&with("G71 Q100 X9 Z2 E1"), "8:16 unknown-word");
    finds(&with("G70 Q100 X9 Z2 I1"), "8:16 unused-word");
    finds(&with("G71 Q100 X9 Y1"), "8:13 canned-cycle");
    finds(&with("G71 Q100 X3 Z2"), "8:1 canned-cycle");
    finds(&with("G71 Q100 X5.3 Z2 D.5"), "8:1 canned-cycle");
    finds(&with("G71 Q100 X9 Z2 I.0001"), "8:1 canned-cycle");
    finds(&with("G71 Q100 X9 Z2 D20"), "8:16 canned-cycle");
    finds(&with("G71 Q100 X9 Z2 M2"), "8:16 canned-cycle");
    finds(&with("G93 G71 Q100 X9 Z2"), "8:5 canned-cycle");
    finds(&with("G17 G71 Q100 X9 Z2"), "8:5 canned-cycle");
    finds(&with("G71 Q100 X9 Z2\nX5"), "9:1 no-motion-mode");
    finds(&with("G71.3 Q100 X9 Z2"), "8:1 unknown-g-code");

    let profile = |blocks: &str| {
        let text =
            format!("G18 G90 F9\nO1 sub\n{blocks}\nO1 endsub\nG0 X20 Z5\nG71 Q1 X15 Z3\nM2\n");
        text
    };
    finds(&profile("X5 Z0\nG1 Z-5"), "3:1 no-motion-mode");
    finds(&profile("G2 X5 Z0 R9\nG1 Z-5"), "3:1 canned-cycle");
    finds(&profile("G0 X5 Z0\nG1 Z-5 Y1"), "4:8 unused-word");
    finds(&profile("G0 X5 Z0\nG1 Z-5 W-1"), "4:8 canned-cycle");
    finds(&profile("G0 X5 Z0\nG1 Z-5\nG20 X6"), "5:1 canned-cycle");
    finds(&profile("G0 X5 Z0\nG81 Z-5 R1"), "4:1 canned-cycle");
    finds(
        &profile("G0 X5 Z0\nG2 X6 Z-5 K1"),
        "4:11 arc-radius-mismatch",
    );
    finds(&profile("G0 X5 Z0\nG1 Z-5 A9\nX6"), "5:1 canned-cycle");
    finds(&profile("G0 X5 Z0\nG1 Z-5 A1 C1\nX6"), "4:11 canned-cycle");
    finds(&profile("G0 X5 Z0\nM2"), "4:1 canned-cycle");
    finds(&profile("G0 X5 Z0\nG71 Q1"), "4:1 canned-cycle");
    let teeth = (1..400).fold(String::from("G0 X5 Z0\nG1 Z-1"), |mut all, i| {
        write!(all, "\nX{}", 5 + i % 2).expect("a string");
        write!(all, "\nZ-{}", 1 + i).expect("a string");
        all
    });
    finds(
        &profile(&teeth).replace("G71 Q1 X15 Z3", "G70 Q1 X15 Z3 P100"),
        "805:1 canned-cycle",
    );
    // Those that show only when the profile is complete are told of the cycle.
    finds(&profile("G0 X5 Z0"), "6:5 canned-cycle");
    finds(&profile("G0 X5 Z0\nG1 Z-5 A1"), "7:5 canned-cycle");
    finds(&profile("G0 X5 Z0\nG1 Z-5\nX6 Z-4"), "8:5 canned-cycle");
    finds(
        &profile("G0 X5 Z0\nG3 X5 Z-2 K-1 I3 \nG1 Z-5"),
        "8:5 canned-cycle",
    );
}

#[test]
fn the_passes_keep_to_the_travel_of_the_axes() {
    let machine = Machine::unlimited().with_travel(
        Axis::Z,
        AxisTravel {
            min: -9.0,
            max: 100.0,
        },
    );
    let options = Options {
        machine,
        ..Options::default()
    };
    let text = program(SHAFT, "G71 Q100 X9 Z2 D.5 I2 R.5");
    let report = check(text.as_bytes(), options);
    assert_eq!(report.soft_limit_violations(), 1);
    assert_eq!(report.diagnostics[0].line, 8);
}

/// Units on other controls: whoever means them finds the codes that they are here.
#[test]
fn g70_and_g71_alone_may_be_meant_as_units() {
    for text in ["G70", "G71", "G17 G71 G90"] {
        let report = check(text.as_bytes(), Options::default());
        assert!(
            report.diagnostics[0]
                .help
                .contains("G20 (inches) or G21 (mm)")
        );
    }
    let report = check(&b"G18\nG71 D0.5 I1"[..], Options::default());
    assert!(!report.diagnostics[0].help.contains("G20"));
}
