//! Tests of SINUMERIK's ways to say where a move goes: polar coordinates, angles, arcs, rotary
//! axes, taps. Right values are computed by hand formulas.

use std::f64::consts::PI;

use glidepath_gcode::{Options, Program, Threading};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::{Event, ItemKind, Limits, Rate};
use proptest::prelude::*;

use super::{ends, finds, items, moves, options};

/// Length of all moves.
fn length(text: &str) -> f64 {
    moves(text)
        .iter()
        .map(|(segment, ..)| segment.length())
        .sum()
}

#[track_caller]
fn near(found: [f64; 3], right: [f64; 3]) {
    let far = (0..3)
        .map(|i| (found[i] - right[i]).abs())
        .fold(0.0, f64::max);
    assert!(far < 1e-5, "{found:?}, right {right:?}");
}

#[track_caller]
fn ends_at(text: &str, right: [f64; 3]) {
    near(*ends(text).last().expect("a move"), right);
}

#[test]
fn polar_coordinates_count_from_the_pole() {
    ends_at("G111 X10 Y10\nG1 AP=90 RP=5", [10.0, 15.0, 0.0]);
    // Without a pole it is the program's zero; what is left out keeps its value.
    assert_eq!(
        ends("G1 AP=0 RP=10\nAP=90\nRP=5"),
        [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 5.0, 0.0]]
    );
    assert_eq!(
        ends("G0 X10 Y10\nG110 X5 Y0\nG1 AP=0 RP=10\nAP=90\nG112 X0 Y10\nG1 AP=180 RP=5"),
        [
            [10.0, 10.0, 0.0],
            [25.0, 10.0, 0.0],
            [15.0, 20.0, 0.0],
            [10.0, 20.0, 0.0]
        ]
    );
    // The pole itself by an angle; with a third axis; in another plane, whose first axis is Z.
    ends_at("G111 RP=10 AP=90\nG1 RP=2 AP=0 Z3", [2.0, 10.0, 3.0]);
    ends_at("G18\nG1 RP=5 AP=90", [5.0, 0.0, 0.0]);
    // In a frame.
    ends_at("TRANS X100\nAROT Z90\nG1 RP=5 AP=0", [100.0, 5.0, 0.0]);
    finds("G1 AP=90", &["1:4 missing-word"]);
    finds("G1 RP=5", &["1:4 missing-word"]);
    finds("G1 X1 AP=90 RP=5", &["1:7 polar"]);
    finds("G91 G1 AP=90 RP=5", &["1:8 polar"]);
    finds("G1 AP=0 RP=-5", &["1:4 polar"]);
    finds("G111 AP=90", &["1:1 missing-word"]);
    finds("G111 X1 AP=90 RP=2", &["1:6 polar"]);
    finds("G1 AP=0 AP=1 RP=1", &["1:9 duplicate-word"]);
}

#[test]
fn the_pole_is_the_centre_of_an_arc() {
    let text = "G111 X10 Y10\nG0 X30 Y10\nG3 AP=90 RP=20";
    ends_at(text, [10.0, 30.0, 0.0]);
    let arc = moves(text).last().map(|(segment, ..)| segment.length());
    assert!((arc.expect("an arc") - 10.0 * PI).abs() < 1e-9);
    finds(
        "G111 X10 Y10\nG0 X30 Y10\nG3 AP=90 RP=15",
        &["3:1 arc-radius-mismatch"],
    );
}

#[test]
fn arcs_by_their_angle() {
    let arc = |text: &str| {
        let all = moves(&format!("G0 X10 Y0\n{text}"));
        let (segment, ..) = all.last().expect("an arc");
        let Segment::Arc(arc) = segment else {
            panic!("{text}: {segment:?}")
        };
        (arc.sweep_rad.to_degrees(), arc.center)
    };
    let (sweep, center) = arc("G3 X20 Y0 AR=180");
    assert!((sweep - 180.0).abs() < 1e-9 && (center[0] - 15.0).abs() < 1e-9);
    let (sweep, _) = arc("G2 X20 Y0 AR=270");
    assert!((sweep + 270.0).abs() < 1e-9);
    let (sweep, _) = arc("G3 X10 Y10 AR=60");
    assert!((sweep - 60.0).abs() < 1e-9);
    // By the centre: the end follows.
    ends_at("G0 X10 Y0\nG3 I-10 J0 AR=90", [0.0, 10.0, 0.0]);
    ends_at("G0 X10 Y0\nG2 I=AC(0) J=AC(0) AR=90 Z2", [0.0, -10.0, 2.0]);
    finds("G3 X20 Y0 I5 J0 AR=180", &["1:17 arc-overdetermined"]);
    finds("G3 AR=180", &["1:4 arc-overdetermined"]);
    finds("G3 X20 Y0 AR=360", &["1:11 arc-overdetermined"]);
    finds("G3 X0 Y0 AR=90", &["1:10 arc-full-circle-with-radius"]);
    finds("G1 X5 AR=90", &["1:7 unused-word"]);
}

proptest! {
    /// An arc by its angle has that angle, and both ways of giving it are the same arc.
    #[test]
    fn an_angle_and_a_centre_are_the_same_arc(
        at in prop::array::uniform2(-50.0_f64..50.0),
        center in prop::array::uniform2(-50.0_f64..50.0),
        angle in 1.0_f64..359.0,
        counterclockwise in prop::bool::ANY,
    ) {
        let (dx, dy) = (at[0] - center[0], at[1] - center[1]);
        prop_assume!(dx.hypot(dy) > 1.0);
        let code = if counterclockwise { "G3" } else { "G2" };
        let turn = if counterclockwise { angle } else { -angle }.to_radians();
        let end = [
            center[0] + dx * turn.cos() - dy * turn.sin(),
            center[1] + dx * turn.sin() + dy * turn.cos(),
        ];
        let start = format!("G0 X{} Y{}\n", at[0], at[1]);
        let by_center = format!("{start}{code} I=AC({}) J=AC({}) AR={angle}", center[0], center[1]);
        let by_end = format!("{start}{code} X{} Y{} AR={angle}", end[0], end[1]);
        let right = dx.hypot(dy) * angle.to_radians();
        for text in [by_center, by_end] {
            let last = *ends(&text).last().expect("an arc");
            prop_assert!((last[0] - end[0]).abs() < 1e-4 && (last[1] - end[1]).abs() < 1e-4);
            let arc = moves(&text).last().map_or(0.0, |(segment, ..)| segment.length());
            prop_assert!((arc - right).abs() < 1e-4 * right.max(1.0), "{text}: {arc} {right}");
        }
    }

    /// CIP: as long as the circle through three points says, wherever they are in space.
    #[test]
    fn an_arc_through_a_point_is_on_its_circle(
        turn in prop::array::uniform3(-180.0_f64..180.0),
        radius in 1.0_f64..50.0,
        via in 5.0_f64..170.0,
        end in 175.0_f64..350.0,
    ) {
        let at = |angle: f64| {
            let (sin, cos) = angle.to_radians().sin_cos();
            format!("{} {}", radius * cos, radius * sin)
        };
        let split = |text: String| {
            let mut parts = text.split(' ').map(str::to_owned);
            (parts.next().unwrap_or_default(), parts.next().unwrap_or_default())
        };
        let ((vx, vy), (ex, ey)) = (split(at(via)), split(at(end)));
        let text = format!(
            "ROT X{} Y{} Z{}\nG0 X{radius} Y0 Z0\nG1 F600\nCIP X={ex} Y={ey} Z0 I1={vx} J1={vy} K1=0",
            turn[0], turn[1], turn[2]
        );
        let all = moves(&text);
        let arc: f64 = all.iter().skip(1).map(|(segment, ..)| segment.length()).sum();
        let right = radius * end.to_radians();
        prop_assert!((arc - right).abs() < 1e-4 * right, "{arc} {right}");
        for (segment, ..) in all.iter().skip(1) {
            let place = segment.jet(0.5 * segment.length()).position;
            let far = (0..3).map(|i| place[i] * place[i]).sum::<f64>().sqrt();
            prop_assert!((far - radius).abs() < 1e-4);
        }
    }
}

#[test]
fn an_arc_through_a_point() {
    let text = "G1 X0 Y0 Z0\nCIP X20 Y0 Z0 I1=10 J1=0 K1=10";
    ends_at(text, [20.0, 0.0, 0.0]);
    assert!((length(text) - 10.0 * PI).abs() < 1e-5);
    // In G91 the point counts from the start; the mode stays.
    let text = "G0 X5\nG91 CIP X20 I1=10 J1=10\nX20 I1=10 J1=-10";
    ends_at(text, [45.0, 0.0, 0.0]);
    assert!((length(text) - 5.0 - 20.0 * PI).abs() < 1e-4);
    // AC and IC say it for the word alone: half a circle about X15, and about X10.
    let right = 5.0 * PI;
    let made = |text: &str| {
        let all = moves(text).into_iter().skip(1);
        all.map(|(segment, ..)| segment.length()).sum::<f64>()
    };
    for text in [
        "G0 X10\nCIP X20 Y0 I1=AC(15) J1=AC(5)",
        "G0 X10\nG91 CIP X=AC(20) Y=AC(0) I1=AC(15) J1=AC(5)",
        "G0 X10\nCIP X=IC(10) Y=IC(0) I1=IC(5) J1=IC(5)",
        "G0 X10\nG91 CIP X10 Y0 I1=IC(5) J1=IC(5)",
    ] {
        assert!((made(text) - right).abs() < 1e-6, "{text}: {}", made(text));
    }
    finds("CIP X20 Y0 I1=AC() J1=5", &["1:15 missing-word"]);
    finds("G4 F2 X10", &["1:7 unused-word"]);
    finds("CIP X20 I1=10", &["1:1 arc-without-center"]);
    finds("CIP X20 Y0", &["1:1 missing-word"]);
    finds("G1 X20 I1=10", &["1:8 unused-word"]);
    finds("CIP I1=10", &["1:1 missing-word"]);
    finds(
        "T1 M6\nG41 G1 X5 Y5\nCIP X20 Y5 I1=10 J1=10",
        &["3:1 cutter-radius"],
    );
}

#[test]
fn an_arc_that_goes_on_tangentially() {
    // A quarter circle of radius 10, which turns left.
    let text = "G1 X10\nCT X20 Y10";
    ends_at(text, [20.0, 10.0, 0.0]);
    assert!((length(text) - 10.0 - 5.0 * PI).abs() < 1e-9);
    // Behind an arc: a half circle from (20, 10) upwards.
    let text = "G1 X10\nCT X20 Y10\n; a comment\nX0 Y10";
    assert!((length(text) - 10.0 - 15.0 * PI).abs() < 1e-9);
    // Straight on it is a line.
    assert!((length("G1 X10\nCT X20 Y0") - 20.0).abs() < 1e-9);
    finds("CT X20 Y10", &["1:1 arc-without-center"]);
    finds("G1 X10\nCT X0 Y0", &["2:1 arc-without-center"]);
}

#[test]
fn lines_by_their_angle() {
    ends_at("G1 X10 ANG=45", [10.0, 10.0, 0.0]);
    ends_at("G1 X2 Y1\nY5 ANG=135", [-2.0, 5.0, 0.0]);
    ends_at("G1 X2 Y1\nG91 X3 ANG=-45", [5.0, -2.0, 0.0]);
    assert_eq!(
        ends("G1 ANG=45\nX20 Y0 ANG=315"),
        [[10.0, 10.0, 0.0], [20.0, 0.0, 0.0]]
    );
    // The corner may be broken; feeds are those of their blocks.
    let text = "G1 ANG=90 RND=2 F100\nX10 Y10 ANG=0 F200";
    assert_eq!(
        ends(text),
        [[0.0, 8.0, 0.0], [2.0, 10.0, 0.0], [10.0, 10.0, 0.0]]
    );
    let rates: Vec<Rate> = moves(text).into_iter().map(|(_, rate, _)| rate).collect();
    assert_eq!(rates[0], Rate::Feed(100.0 / 60.0));
    assert_eq!(rates[2], Rate::Feed(200.0 / 60.0));
    finds("G1 X10 Y5 ANG=45", &["1:11 polar"]);
    finds("G1 ANG=45\nX20", &["2:1 polar"]);
    finds("G1 ANG=45\nM8", &["2:1 polar"]);
    finds("G1 ANG=45\nX20 Y0 ANG=225", &["2:8 polar"]);
    finds("G1 X10 ANG=90", &["1:8 polar"]);
    finds("G0 X10 ANG=90", &["1:8 unused-word"]);
    assert_eq!(
        glidepath_gcode::check("G1 ANG=45\n".as_bytes(), options())
            .diagnostics
            .len(),
        1
    );
}

#[test]
fn rotary_axes_go_the_way_that_is_said() {
    let cs = |text: &str| -> Vec<f64> {
        let all = moves(text).into_iter();
        all.map(|(segment, ..)| segment.end()[Axis::C.index()])
            .collect()
    };
    assert_eq!(cs("G0 C10\nC=ACP(350)\nC=ACN(300)"), [10.0, 350.0, 300.0]);
    assert_eq!(cs("G0 C350\nC=ACP(10)"), [350.0, 370.0]);
    assert_eq!(cs("G0 C10\nC=ACN(350)"), [10.0, -10.0]);
    assert_eq!(cs("G0 C350\nC=DC(10)\nC=DC(200)"), [350.0, 370.0, 200.0]);
    // Where the axis is already, it stays.
    assert_eq!(cs("G0 C370\nC=ACP(10)\nC=ACN(10)"), [370.0]);
    // Also in G91.
    assert_eq!(cs("G0 C350\nG91 C=ACP(10)"), [350.0, 370.0]);
    finds("G0 X=DC(5)", &["1:6 invalid-value"]);
    finds("G0 C=ACP()", &["1:6 missing-word"]);
}

#[test]
fn arcs_in_a_tilted_frame() {
    let text = "ROT X30\nG0 X10 Y0 Z0\nG3 X0 Y10 CR=10 F600";
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    ends_at(text, [0.0, 10.0 * cos, 10.0 * sin]);
    assert!((length(text) - 10.0 - 5.0 * PI).abs() < 1e-5);
    // A full helix: every turn is as long as it is in the plane.
    let text = "ROT X30\nG0 X10 Y0 Z0\nG2 X10 Y0 Z-4 I-10 J0 F600";
    ends_at(text, [10.0, 4.0 * sin, -4.0 * cos]);
    let right = 10.0 + (2.0 * PI * 10.0).hypot(4.0);
    assert!((length(text) - right).abs() < 1e-3, "{}", length(text));
    // Circles do not stay ones.
    finds(
        "ROT X30\nASCALE X2\nG0 X10 Y0\nG3 X0 Y10 CR=10",
        &["4:1 arc-plane"],
    );
}

#[test]
fn inches_of_lengths_and_of_feeds() {
    let first = |text: &str| {
        let (segment, rate, _) = moves(text)[0];
        (segment.length(), rate)
    };
    assert_eq!(first("G70 G1 X1 F600"), (25.4, Rate::Feed(10.0)));
    assert_eq!(first("G700 G1 X1 F60"), (25.4, Rate::Feed(25.4)));
    assert_eq!(first("G71 G1 X1 F600"), (1.0, Rate::Feed(10.0)));
    // Also in lines with nothing but words.
    let rates = moves("G700\nG1 X1 F60\nG70\nX2 F60\nG710\nX3 F60");
    let rates: Vec<Rate> = rates.into_iter().map(|(_, rate, _)| rate).collect();
    assert_eq!(rates, [Rate::Feed(25.4), Rate::Feed(1.0), Rate::Feed(1.0)]);
}

#[test]
fn a_dwell_in_turns_of_the_spindle() {
    let dwell = |text: &str| {
        items(text).into_iter().find_map(|item| match item.kind {
            ItemKind::Dwell(seconds) => Some(seconds),
            _ => None,
        })
    };
    assert_eq!(dwell("S600 M3\nG4 S5"), Some(0.5));
    assert_eq!(dwell("S600 M3\nG4 F2"), Some(2.0));
    finds("S600\nG4 S5", &["2:1 missing-word"]);
}

#[test]
fn a_plane_that_does_not_turn_is_a_zero_on_every_machine() {
    let plane = "CYCLE800(0,\"\",0,57,10,20,0,0,0,0,0,0,5,-1)";
    assert_eq!(
        ends(&format!("{plane}\nG0 X1 Y1 Z1\nCYCLE800()\nG0 X1 Y1 Z1")),
        [[11.0, 21.0, 6.0], [1.0, 1.0, 1.0]]
    );
    assert_eq!(
        ends(&format!(
            "{plane}\nTRANS X100\nG0 X1\nTRANS\nCYCLE800()\nG0 X1"
        )),
        [[111.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    );
    finds(&format!("TRANS X1\n{plane}"), &["2:1 not-supported"]);
    finds(
        &format!("{plane}\nTRANS X1\nCYCLE800()"),
        &["3:1 not-supported"],
    );
    // Where there is no plane a frame stays what it is.
    assert_eq!(ends("TRANS X100\nCYCLE800()\nG0 X1"), [[101.0, 0.0, 0.0]]);
}

#[test]
fn feeds_of_cycles_are_those_of_the_program_in_inches_of_lengths() {
    let rates = |text: &str| -> Vec<Rate> {
        let all = moves(text).into_iter();
        all.map(|(_, rate, _)| rate)
            .filter(|rate| *rate != Rate::Rapid)
            .collect()
    };
    // The first stroke at half of 600 mm/min.
    let text = "G70 F600\nG0 Z1\nCYCLE83(1,0,0.1,-0.5,,-0.25,,0.1,,,0.5,0)";
    let all = rates(text);
    assert!(
        matches!(all[0], Rate::Feed(feed_v) if (feed_v - 5.0).abs() < 1e-9),
        "{all:?}"
    );
    let last = all.last().expect("a move");
    assert!(
        matches!(last, Rate::Feed(feed_v) if (feed_v - 10.0).abs() < 1e-9),
        "{all:?}"
    );
}

/// A machine whose spindle is followed.
fn with_encoder() -> Options {
    Options {
        orients: true,
        threading: Some(Threading {
            overtravel: 20.0,
            spindle_a: Some(40.0),
            ..Threading::new(Limits::uniform(200.0, 2_000.0, 40_000.0), 0.004)
        }),
        ..options()
    }
}

#[test]
fn a_tap_goes_in_and_out() {
    let events = |text: &str| -> Vec<Event> {
        Program::new(text.as_bytes(), with_encoder())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Event(event @ (Event::MCode(_) | Event::Tap { .. })) => Some(event),
                _ => None,
            })
            .collect()
    };
    let right = events("SPOS=0\nG0 Z5\nG331 Z-15 K1.25 S500\nG332 Z5 K1.25");
    assert!(
        matches!(
            right[..],
            [
                Event::MCode(19),
                Event::MCode(3),
                Event::Tap {
                    axis: 2,
                    pitch_mm: -1.25,
                    ..
                },
                Event::MCode(5)
            ]
        ),
        "{right:?}"
    );
    let left = events("G0 Z5\nG331 Z-15 K-1.25 S500\nG332 Z5 K-1.25");
    assert!(matches!(left[0], Event::MCode(4)), "{left:?}");
    let found = |text: &str| {
        let report = glidepath_gcode::check(text.as_bytes(), with_encoder());
        crate::support::listed(&report)
    };
    assert_eq!(
        found("G0 Z5\nG331 Z-15 K1.25 S500\nG4 F1"),
        ["3:4 not-supported"]
    );
    assert_eq!(found("G332 Z5 K1.25"), ["1:1 not-supported"]);
    assert_eq!(
        found("G0 Z5\nG331 Z-15 K1.25 S500\nG332 Z5 K1"),
        ["3:1 invalid-value"]
    );
    assert_eq!(
        found("G0 Z5\nG331 Z-15 K1.25 S500\nG332 Z0 K1.25"),
        ["3:1 not-supported"]
    );
    assert_eq!(found("G0 Z5\nG331 Z-15 S500"), ["2:1 missing-word"]);
    assert_eq!(
        found("M4 S500\nG0 Z5\nG331 Z-15 K1.25\nG332 Z5 K1.25"),
        ["4:1 spindle"]
    );
    // Nobody knows the angle of this spindle.
    finds("SPOS=0", &["1:1 not-connected"]);
}

#[test]
fn the_distance_from_corners_belongs_to_its_code() {
    // In a block with an arc it was the number of its turns.
    finds("G3 X10 I5 F100 ADIS=2", &["1:16 unused-word"]);
    finds("G641\nADIS=0.1", &["2:1 unused-word"]);
    finds("G641 ADIS=0.1 G1 X5 F100", &[]);
}
