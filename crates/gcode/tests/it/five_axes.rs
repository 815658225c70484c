//! Tests of machines with five axes: when the tip of the tool is followed, tilted planes,
//! directions of the tool.
//!
//! The table tilts about x (A) and carries one that turns about z (C): the joints of a tip w are
//! Rx(A) Rz(C) w, which is written out here.

use glidepath_gcode::{Connections, Dialect, Options, Program, Threading, Tool, ToolTable, check};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{FiveAxis, Rotaries, SkewedTilt, Tilt};
use glidepath_program::{ItemKind, Limits, Rate};
use nalgebra::Vector3;
use proptest::prelude::*;
use std::sync::Arc;

use crate::support::listed;

/// Tool 1 is 10 mm longer than the one that the kinematics know.
pub(crate) fn options(dialect: Dialect) -> Options {
    let mut tools = ToolTable::new();
    let mut tool = Tool::default();
    tool.offset[2] = 10.0;
    tools.set(1, tool);
    Options {
        dialect,
        five_axis: Some(FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::zeros(),
                rotary_point: Vector3::zeros(),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm: 50.0,
        }),
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        tools: Some(Arc::new(tools)),
        machine: glidepath_gcode::Machine::new(&[Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C]),
        ..Options::default()
    }
}

/// The linear joints of a tip, without the length of the tool.
pub(crate) fn joints(axes: &AxisVector) -> [f64; 3] {
    let (sa, ca) = axes[Axis::A.index()].to_radians().sin_cos();
    let (sc, cc) = axes[Axis::C.index()].to_radians().sin_cos();
    let (x, y, z) = (axes[0], axes[1], axes[2]);
    let (u, v) = (x * cc - y * sc, x * sc + y * cc);
    [u, v * ca - z * sa, v * sa + z * ca]
}

/// The moves: where each begins and ends, with its rate and length.
pub(crate) fn moves(dialect: Dialect, text: &str) -> Vec<(AxisVector, AxisVector, Rate, f64)> {
    Program::new(text.as_bytes(), options(dialect))
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                Some((segment.start(), segment.end(), rate, segment.length()))
            }
            _ => None,
        })
        .collect()
}

pub(crate) fn last(dialect: Dialect, text: &str) -> AxisVector {
    moves(dialect, text).last().expect("a move").1
}

pub(crate) fn at(x: f64, y: f64, z: f64, a: f64, c: f64) -> AxisVector {
    let mut axes = AxisVector::zeros();
    (axes[0], axes[1], axes[2]) = (x, y, z);
    (axes[Axis::A.index()], axes[Axis::C.index()]) = (a, c);
    axes
}

#[track_caller]
pub(crate) fn near(found: AxisVector, right: AxisVector) {
    assert!((found - right).amax() < 1e-6, "{found} right {right}");
}

#[track_caller]
pub(crate) fn finds(dialect: Dialect, text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options(dialect));
    assert_eq!(listed(&report), expected, "{text}");
}

#[test]
fn without_the_tip_the_joints_stand_while_the_tables_turn() {
    for (dialect, text) in [
        (Dialect::Fanuc, "G0 X10 Y20 Z30\nG1 A30 C60 F2000"),
        (
            Dialect::Fanuc,
            "G43.4 H0\nG0 X10 Y20 Z30\nG49\nG1 A30 C60 F2000",
        ),
        (
            Dialect::Siemens,
            "TRAORI\nG0 X10 Y20 Z30\nTRAFOOF\nG1 A30 C60 F2000",
        ),
        (Dialect::LinuxCnc, "G0 X10 Y20 Z30\nM429\nG1 A30 C60 F2000"),
    ] {
        let all = moves(dialect, text);
        for (from, to, ..) in &all[1..] {
            for share in [0.0, 0.5, 1.0] {
                let axes = from + (to - from) * share;
                let found = joints(&axes);
                let far = [10.0, 20.0, 30.0].into_iter().zip(found);
                let far = far.map(|(right, found)| (right - found).abs());
                assert!(far.fold(0.0, f64::max) < 2e-4, "{text}: {found:?}");
            }
        }
        near(
            all.last().expect("a move").1,
            at(
                32.990_381_056_766_58,
                7.5,
                15.980_762_113_533_162,
                30.0,
                60.0,
            ),
        );
        // F counts degrees of the tables: 67.08 degrees at 2000 a minute.
        let time: f64 = all[1..]
            .iter()
            .map(|(.., rate, length)| match rate {
                Rate::Feed(feed_v) => length / feed_v,
                _ => f64::NAN,
            })
            .sum();
        assert!((time - 30.0_f64.hypot(60.0) * 60.0 / 2000.0).abs() < 1e-6);
    }
    // LinuxCNC's programs follow it at all times.
    near(
        last(Dialect::LinuxCnc, "G0 X10 Y20 Z30\nG1 A30 C60 F2000"),
        at(10.0, 20.0, 30.0, 30.0, 60.0),
    );
    near(
        last(
            Dialect::LinuxCnc,
            "M429\nG0 X10 Y20 Z30\nM428\nG1 A30 C60 F2000",
        ),
        at(10.0, 20.0, 30.0, 30.0, 60.0),
    );
    finds(Dialect::LinuxCnc, "M430", &["1:1 not-supported"]);
    // Whole rounds are no rest.
    assert!(moves(Dialect::Fanuc, "G0 X10\nG1 C1440. F9000").len() > 40);
}

#[test]
fn straight_moves_stay_straight_at_angles_that_rest() {
    let all = moves(
        Dialect::Fanuc,
        "G0 A30 C90\nG1 X10 Y5 Z-2 F600\nG3 X20 Y15 R10",
    );
    let lines: Vec<_> = all
        .iter()
        .filter(|(_, _, rate, _)| *rate == Rate::Feed(10.0))
        .collect();
    let (from, to, ..) = lines[0];
    assert!((Vector3::from(joints(to)) - Vector3::new(10.0, 5.0, -2.0)).amax() < 1e-9);
    assert!(Vector3::from(joints(from)).amax() < 1e-9);
    // The quarter circle, as long as in the machine.
    let arc: f64 = lines[1..].iter().map(|(.., length)| length).sum();
    assert!((arc - 5.0 * std::f64::consts::PI).abs() < 1e-4, "{arc}");
    for (_, to, ..) in &lines[1..] {
        let found = joints(to);
        let radius = (found[0] - 10.0).hypot(found[1] - 15.0);
        assert!((radius - 10.0).abs() < 1e-4, "{found:?}");
    }
}

#[test]
fn a_length_counts_along_the_tool() {
    // The tool leans by -A on the work; the known length is there already.
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    near(
        last(Dialect::Fanuc, "G43.4 H1\nG0 X1 Y2 Z3 A30"),
        at(1.0, 2.0 + 10.0 * sin, 3.0 + 10.0 * cos, 30.0, 0.0),
    );
    near(
        last(Dialect::Siemens, "T1 M6 D1\nTRAORI\nG0 X1 Y2 Z3 A30"),
        at(1.0, 2.0 + 10.0 * sin, 3.0 + 10.0 * cos, 30.0, 0.0),
    );
    // Without the tip it counts along Z of the machine, which is along the tool on tables.
    let found = joints(&last(Dialect::Fanuc, "G43 H1 Z3\nG0 A30"));
    assert!((found[2] - 13.0).abs() < 1e-9);
    // Switching moves nothing, and the length stays in force.
    let text = "G43 H1 Z3\nG0 A30\nG43.4 H1\nG49\nG43 H1 Z3";
    let found = joints(&last(Dialect::Fanuc, text));
    assert!((found[2] - 13.0).abs() < 1e-9);
    near(
        last(Dialect::Siemens, "T1 M6 D1\nG0 Z3\nTRAORI\nTRAFOOF\nG0 X1"),
        at(1.0, 0.0, 13.0, 0.0, 0.0),
    );
}

#[test]
fn tilted_planes() {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    // From the zero (20, 10, 0), up along the normal (0, -sin, cos), along x, and along y' (0, cos, sin).
    let right = [
        at(20.0, 10.0 - 10.0 * sin, 10.0 * cos, -30.0, 0.0),
        at(20.0, 10.0 + 2.0 * sin, -2.0 * cos, -30.0, 0.0),
        at(30.0, 10.0 + 2.0 * sin, -2.0 * cos, -30.0, 0.0),
        at(
            30.0,
            10.0 + 2.0 * sin + 5.0 * cos,
            -2.0 * cos + 5.0 * sin,
            -30.0,
            0.0,
        ),
    ];
    let path = "G0 X0 Y0 Z10\nG1 Z-2 F600\nX10\nY5\n";
    for (dialect, begin, end) in [
        (
            Dialect::Fanuc,
            "G68.2 X20 Y10 Z0 I0 J30 K0\nG53.1\n",
            "G69\nG0 X0",
        ),
        (
            Dialect::Fanuc,
            "G68.2 P1 X20 Y10 Z0 I30 J0 K0\nG53.1\n",
            "G69\nG0 X0",
        ),
        (
            Dialect::Siemens,
            "CYCLE800(0,\"TC1\",0,57,20,10,0,30,0,0,0,0,0,-1)\n",
            "CYCLE800()\nG0 X0",
        ),
    ] {
        let all = moves(dialect, &format!("{begin}{path}{end}"));
        let ends: Vec<AxisVector> = all.iter().map(|(_, to, ..)| *to).collect();
        for right in right {
            let found = ends.iter().any(|end| (end - right).amax() < 1e-6);
            assert!(found, "{dialect}: never at {right}");
        }
        // Behind it the axes are the machine's again.
        let found = joints(ends.last().expect("a move"));
        let before = joints(&right[3]);
        assert!(found[0].abs() < 1e-9 && (found[1] - before[1]).abs() < 1e-9);
    }
    // Euler's angles: about Z, about the new X, about the new Z.
    let text = "G68.2 X0 Y0 Z0 I90 J90 K0\nG53.1\nG0 X1 Y2 Z3";
    // x' = y, y' = z, z' = x.
    let found = last(Dialect::Fanuc, text);
    assert!((found[0] - 3.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9);
    assert!((found[2] - 2.0).abs() < 1e-9);
    // The other way of the tables.
    let text = "CYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,1)\nG0 Z10";
    let found = last(Dialect::Siemens, text);
    assert!((found[Axis::A.index()] - 30.0).abs() < 1e-9);
    assert!((found[Axis::C.index()].abs() - 180.0).abs() < 1e-9);
    // A length counts along the normal.
    near(
        last(Dialect::Fanuc, "G68.2 X0 Y0 Z0 I0 J30 K0\nG53.1\nG43 H1 Z0"),
        at(0.0, -10.0 * sin, 10.0 * cos, -30.0, 0.0),
    );
    // TRANS counts in the plane, and its end leaves the plane.
    near(
        last(
            Dialect::Siemens,
            "CYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,-1)\nTRANS Z10\nTRANS\nATRANS Y5\nG0 Z0 Y0 X0",
        ),
        at(0.0, 5.0 * cos, 5.0 * sin, -30.0, 0.0),
    );
}

#[test]
fn what_is_wrong_with_a_plane_is_told() {
    let fanuc = |text: &str, expected: &[&str]| finds(Dialect::Fanuc, text, expected);
    fanuc("G68.2 X0 J30\nG0 X1", &["2:1 not-supported"]);
    fanuc("G53.1", &["1:1 not-supported"]);
    fanuc("G68.2 P4 J30", &["1:7 not-supported"]);
    fanuc("G68.2 J30\nG53.1 X5", &["2:7 unused-word"]);
    fanuc("G68.2 J30\nG53.1 P3", &["2:7 not-supported"]);
    fanuc("G68.2 J30\nG53.1\nG68.2 J10", &["3:1 not-supported"]);
    fanuc("G43.4 H0\nG68.2 J30", &["2:1 not-supported"]);
    fanuc("G68.2 J30\nG53.1\nG43.4 H0", &["3:1 not-supported"]);
    fanuc("G68.2 A5 J30", &["1:7 unused-word"]);
    fanuc("G68.2 J30\nG53.1\nG53 G0 Z0", &[]);
    fanuc("G68.2 J30\nG53.1\nG28 Z0", &[]);
    // With the tool along the normal already it goes on at once.
    fanuc("G68.2 X5 J0\nG0 X1", &[]);
    let siemens = |text: &str, expected: &[&str]| finds(Dialect::Siemens, text, expected);
    for wrong in [
        "CYCLE800(1,\"\",0,57,0,0,0,30,0,0,0,0,0,-1)",
        "CYCLE800(2,\"\",0,57,0,0,0,30,0,0,0,0,0,-1)",
        "CYCLE800(0,\"\",2,57,0,0,0,30,0,0,0,0,0,-1)",
        "CYCLE800(0,\"\",10,57,0,0,0,30,0,0,0,0,0,-1)",
        "CYCLE800(0,\"\",200100,57,0,0,0,30,0,0,0,0,0,-1)",
        "CYCLE800(0,\"\",0,192,0,0,0,30,0,0,0,0,0,-1)",
        "CYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,0)",
    ] {
        siemens(wrong, &["1:1 canned-cycle"]);
    }
    // A tap behind a spindle that is followed has one axis.
    let followed = Options {
        threading: Some(Threading {
            overtravel: 20.0,
            spindle_a: Some(40.0),
            ..Threading::new(Limits::uniform(200.0, 2_000.0, 40_000.0), 0.004)
        }),
        ..options(Dialect::Siemens)
    };
    let tap = "G331 Z-15 K1.25 S500\nG332 Z5 K1.25";
    let found = |text: &str| listed(&check(text.as_bytes(), followed.clone()));
    assert_eq!(found(&format!("G0 Z5\n{tap}")), [""; 0]);
    assert_eq!(found(&format!("G0 Z5 A30\n{tap}")), ["3:1 not-supported"]);
}

#[test]
fn the_zero_goes_with_the_table() {
    let text =
        "G10 L2 P1 X20 Y10 Z0\nG54\nG0 A30 C90\nG254\nG0 X5 Y0 Z10\nG1 Z-2 F600\nX15\nG255\nG0 X0";
    let all = moves(Dialect::Fanuc, text);
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    // The zero is at Rx(30) Rz(90) (20, 10, 0) = (-10, 20 cos, 20 sin).
    for right in [
        [-5.0, 20.0 * cos, 20.0 * sin + 10.0],
        [-5.0, 20.0 * cos, 20.0 * sin - 2.0],
        [5.0, 20.0 * cos, 20.0 * sin - 2.0],
        // G255: the zero of G54 as it stands.
        [20.0, 20.0 * cos, 20.0 * sin - 2.0],
    ] {
        let found = all
            .iter()
            .any(|(_, to, ..)| (Vector3::from(joints(to)) - Vector3::from(right)).amax() < 1e-6);
        assert!(found, "never at {right:?}");
    }
    finds(Dialect::Fanuc, "G254\nG0 A30", &["2:4 not-supported"]);
    finds(Dialect::Fanuc, "G234 H1\nG254", &["2:1 not-supported"]);
}

#[test]
fn the_tool_has_a_direction() {
    let text =
        "TRAORI\nG0 X0 Y0 Z20 A3=0 B3=0 C3=1\nG1 X10 Z5 A3=0 B3=0.5 C3=0.8660254037844386 F900";
    near(last(Dialect::Siemens, text), at(10.0, 0.0, 5.0, 30.0, 0.0));
    let siemens = |text: &str, expected: &[&str]| finds(Dialect::Siemens, text, expected);
    siemens("G0 X1 A3=0 B3=0 C3=1", &["1:7 invalid-value"]);
    siemens("TRAORI\nG0 X1 A3=0 B3=0 C3=0", &["2:7 invalid-value"]);
    siemens("TRAORI\nG0 A30 A3=0 B3=0 C3=1", &["2:8 invalid-value"]);
    siemens("TRAORI\nG2 X1 CR=5 A3=0 C3=1", &["2:12 unused-word"]);
}

proptest! {
    /// Whatever a direction is, the tool stands along it.
    #[test]
    fn the_tool_stands_along_its_direction(
        way in prop::array::uniform3(-1.0_f64..1.0),
        scale in 0.1_f64..10.0,
    ) {
        let way = Vector3::from(way);
        prop_assume!(way.norm() > 0.1);
        let long = way * scale;
        let text = format!("TRAORI\nG0 A3={} B3={} C3={}", long.x, long.y, long.z);
        let axes = last(Dialect::Siemens, &text);
        let machine = options(Dialect::Siemens).five_axis.expect("five axes");
        let tool = machine.tool_axis(axes[Axis::A.index()], axes[Axis::C.index()]);
        prop_assert!((tool - way.normalize()).norm() < 1e-9);
    }

    /// A plane by any angles: its zero and its normal are where the frame says.
    #[test]
    fn a_plane_is_where_its_angles_say(
        angles in prop::array::uniform3(-90.0_f64..90.0),
        up in 1.0_f64..50.0,
    ) {
        let text = format!(
            "G68.2 X20 Y10 Z5 I{:.6} J{:.6} K{:.6}\nG53.1\nG0 X0 Y0 Z{up}",
            angles[0], angles[1], angles[2]
        );
        let axes = last(Dialect::Fanuc, &text);
        let (si, ci) = angles[0].to_radians().sin_cos();
        let (sj, cj) = angles[1].to_radians().sin_cos();
        let normal = Vector3::new(si * sj, -ci * sj, cj);
        let right = Vector3::new(20.0, 10.0, 5.0) + normal * up;
        let found = Vector3::new(axes[0], axes[1], axes[2]);
        prop_assert!((found - right).norm() < 1e-4, "{found} {right}");
        let machine = options(Dialect::Fanuc).five_axis.expect("five axes");
        let tool = machine.tool_axis(axes[Axis::A.index()], axes[Axis::C.index()]);
        prop_assert!((tool - normal).norm() < 1e-6);
    }
}

#[test]
fn directions_and_ways_to_turn_are_fanucs() {
    let vector = "G43.5 H0\nG0 X0 Y0 Z20 I0 J0 K2\nG1 X10 Z5 I0 J0.5 K0.8660254037844386 F900";
    near(last(Dialect::Fanuc, vector), at(10.0, 0.0, 5.0, 30.0, 0.0));
    let refused = |text: &str| finds(Dialect::Fanuc, text, &["3:7 unused-word"]);
    refused("G43.5 H0\nG49\nG1 X1 K1 F100");
    refused("G43.5 H0\nG43.4 H0\nG1 X1 K1 F100");
    let tilt = |form: &str| last(Dialect::Fanuc, &format!("G68.2 J30\nG53.1 {form}"))[3].round();
    assert_eq!(["", "P1", "P2"].map(tilt), [-30.0, 30.0, -30.0]);
}

#[test]
fn a_block_that_is_refused_leaves_tip_and_zero_as_they_were() {
    let end = |dialect: Dialect, text: &str| {
        let mut typed = Program::new(text.as_bytes(), options(dialect)).typed();
        assert_eq!(typed.by_ref().filter(Result::is_err).count(), 1, "{text}");
        *typed.position()
    };
    // The tool of 10 mm counts along Z again; G154 P9 was not set.
    let text = "T1 M6\nTRAORI G2 X5\nTRAFOOF\nG0 X1 Y2 Z5\n";
    let near = |a: AxisVector, b: AxisVector| (a - b).amax() < 1e-9;
    assert!(near(
        end(Dialect::Siemens, text),
        at(1.0, 2.0, 15.0, 0.0, 0.0)
    ));
    let text = "G10 L2 P1 Z20\nG0 A30\nG254 G154 P9\nG0 X1 Y2 Z5\n";
    let found = joints(&end(Dialect::Fanuc, text));
    let far = [1.0, 2.0, 25.0].into_iter().zip(found);
    assert!(
        far.into_iter()
            .all(|(right, found)| (right - found).abs() < 1e-6)
    );
}

#[test]
fn several_turns_of_an_arc_are_driven_while_the_table_turns_a_little() {
    // The joints go through four turns of radius 10, however little C turns meanwhile.
    for c in ["", " C0.00001", " C0.01", " C40"] {
        let text = format!("M429\nG0 X10 Y0 A10\nG2 X10 Y0 I-10 J0 P4{c} F600\nM2\n");
        let length: f64 = moves(Dialect::LinuxCnc, &text)
            .iter()
            .filter(|(.., rate, _)| matches!(rate, Rate::Feed(_)))
            .map(|(from, to, _, length)| {
                let ends = joints(to).into_iter().zip(joints(from));
                let way = ends.map(|(to, from)| to - from);
                let way = way.fold(0.0, f64::hypot);
                // A piece that is an arc itself: as long in the joints.
                if c.is_empty() { *length } else { way }
            })
            .sum();
        let turns = 4.0 * core::f64::consts::TAU * 10.0;
        assert!((length / turns - 1.0).abs() < 1e-3, "{c}: {length} {turns}");
    }
}

#[test]
fn arcs_of_a_turned_table_that_are_too_large_are_refused() {
    for (arc, code) in [
        ("G2 X10 Y0 I-10 J900000 P90", "3:1 spline"),
        ("G2 X10 Y0 I-10 J900000 P90 C4", "3:1 not-supported"),
    ] {
        let text = format!("M429\nG0 X10 Y0 A10\n{arc} F600\nM2\n");
        finds(Dialect::LinuxCnc, &text, &[code]);
    }
}

/// The same machine with a tilt axis at 45° between y and z.
fn nutating(dialect: Dialect) -> Options {
    let options = options(dialect);
    let tilt = SkewedTilt::new(Axis::A, &Vector3::new(0.0, 1.0, 1.0)).map(Tilt::Skewed);
    Options {
        five_axis: options.five_axis.map(|machine| FiveAxis {
            tilt: tilt.expect("a tilt axis"),
            ..machine
        }),
        ..options
    }
}

#[test]
fn planes_and_directions_that_a_skewed_axis_does_not_reach_are_refused() {
    let told = |dialect: Dialect, text: &str| listed(&check(text.as_bytes(), nutating(dialect)));
    let none: [&str; 0] = [];
    assert_eq!(told(Dialect::Fanuc, "G68.2 J89\nG53.1"), none);
    assert_eq!(told(Dialect::Fanuc, "G68.2 J91\nG53.1"), ["2:1 soft-limit"]);
    let siemens = |text: &str| told(Dialect::Siemens, text);
    assert_eq!(siemens("TRAORI\nG0 X1 A3=1 C3=0.01"), none);
    assert_eq!(
        siemens("TRAORI\nG0 X1 A3=1 C3=-0.01"),
        ["2:7 invalid-value"]
    );
}

proptest! {
    #[test]
    fn a_skewed_tool_stands_along_its_direction(
        way in prop::array::uniform3(-1.0_f64..1.0),
        scale in 0.1_f64..10.0,
    ) {
        let way = Vector3::new(way[0], way[1], way[2].abs());
        prop_assume!(way.norm() > 0.1);
        let long = way * scale;
        let text = format!("TRAORI\nG0 A3={} B3={} C3={}", long.x, long.y, long.z);
        let options = nutating(Dialect::Siemens);
        let machine = options.five_axis.expect("five axes");
        let items = Program::new(text.as_bytes(), options).map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")));
        let ends = items.filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        });
        let axes = ends.last().expect("a move");
        let tool = machine.tool_axis(axes[Axis::A.index()], axes[Axis::C.index()]);
        prop_assert!((tool - way.normalize()).norm() < 1e-7);
    }
}
