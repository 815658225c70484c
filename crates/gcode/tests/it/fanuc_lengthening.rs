//! Tests of G45 to G48 of FANUC's mills. Values are computed by hand: the offset is the radius of D, 3 mm of D1 and
//! 5 mm of D2.

use glidepath_gcode::{Dialect, FanucParameters, Machine, OffsetMemory, Options, Program, check};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::ItemKind;

use crate::fanuc_calls::{ends, finds, options};
use crate::support::listed;

fn moves(text: &str) -> Vec<Segment> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment),
            _ => None,
        })
        .collect()
}

fn last(text: &str) -> [f64; 3] {
    *ends(text).last().expect("a move")
}

#[test]
fn a_way_is_longer_or_shorter_by_the_offset_or_twice_that() {
    for (code, there) in [("G45", 13.0), ("G46", 7.0), ("G47", 16.0), ("G48", 4.0)] {
        assert_eq!(
            last(&format!("G91 {code} G0 X10 D1")),
            [there, 0.0, 0.0],
            "{code}"
        );
        assert_eq!(
            last(&format!("G91 {code} G0 X-10 D1")),
            [-there, 0.0, 0.0],
            "{code}"
        );
    }
    // Each way of the block, the feed's too.
    assert_eq!(last("G91 G45 G1 X10 Y-5 D2 F100"), [15.0, -10.0, 0.0]);
    assert_eq!(last("G91 G45 G0 Z-10 D1"), [0.0, 0.0, -13.0]);
    // Inches: .5 in are 12.7 mm.
    assert_eq!(last("G20 G91 G45 G0 X.5 D1"), [15.7, 0.0, 0.0]);
    // What is shorter than the offset goes the other way: 20 mm less twice 15 mm.
    assert_eq!(last("G10 L12 P1 R15\nG91 G48 G0 X20 D1"), [-10.0, 0.0, 0.0]);
    // An offset below zero.
    assert_eq!(last("G10 L12 P1 R-4\nG91 G45 G0 X20 D1"), [16.0, 0.0, 0.0]);
    // Wear is part of it.
    assert_eq!(last("G10 L13 P1 R0.5\nG91 G45 G0 X20 D1"), [23.5, 0.0, 0.0]);
    assert_eq!(last("G91 G45 G0 X10 D0"), [10.0, 0.0, 0.0]);
    assert_eq!(last("G91 G45 G0 X10"), [10.0, 0.0, 0.0]);
}

#[test]
fn a_way_of_zero_has_a_direction() {
    for (block, there) in [
        ("G45 G0 X0", 3.0),
        ("G45 G0 X-0", -3.0),
        ("G46 G0 X0", -3.0),
        ("G46 G0 X-0.", 3.0),
    ] {
        assert_eq!(
            last(&format!("D1\nG91\n{block}")),
            [there, 0.0, 0.0],
            "{block}"
        );
    }
}

#[test]
fn it_holds_for_its_block_and_d_until_another_one() {
    assert_eq!(
        ends("G91 G45 G0 X10 D1\nX10\nG45 X10\nG46 X10 D2"),
        [
            [13.0, 0.0, 0.0],
            [23.0, 0.0, 0.0],
            [36.0, 0.0, 0.0],
            [41.0, 0.0, 0.0]
        ]
    );
}

/// Round a rectangle of 40 by 30 mm whose first corner is at 20, 20.
#[test]
fn a_rectangle_is_gone_round_beside_it() {
    let text =
        "G91 G46 G0 X20 Y20 D1\nG47 G1 Y30 F100\nG47 X40\nG47 Y-30\nG47 X-40\nG46 G0 X-20 Y-20";
    assert_eq!(
        ends(text),
        [
            [17.0, 17.0, 0.0],
            [17.0, 53.0, 0.0],
            [63.0, 53.0, 0.0],
            [63.0, 17.0, 0.0],
            [17.0, 17.0, 0.0],
            [0.0, 0.0, 0.0]
        ]
    );
}

/// The program of FANUC's manual: round a part with a quarter outside and one inside, with a tool of 20 mm.
#[test]
fn quarters_of_a_circle_have_larger_or_smaller_radii() {
    let text = "G10 L12 P1 R10
G91 G46 G0 X80 Y50 D1
G47 G1 X50 F120
Y40
G48 X40
Y-40
G45 X30
G45 G3 X30 Y30 J30
G45 G1 Y20
G46 X0
G46 G2 X-30 Y30 J30
G45 G1 Y0
G47 X-120
G47 Y-80
G46 G0 X-80 Y-50";
    let way = [
        [70.0, 40.0],
        [140.0, 40.0],
        [140.0, 80.0],
        [160.0, 80.0],
        [160.0, 40.0],
        [200.0, 40.0],
        [240.0, 80.0],
        [240.0, 110.0],
        [230.0, 110.0],
        [210.0, 130.0],
        [210.0, 140.0],
        [70.0, 140.0],
        [70.0, 40.0],
        [0.0, 0.0],
    ];
    let found: Vec<[f64; 2]> = ends(text).into_iter().map(|[x, y, _]| [x, y]).collect();
    assert_eq!(found, way);
    let arcs: Vec<[f64; 3]> = moves(text)
        .into_iter()
        .filter_map(|segment| match segment {
            Segment::Arc(arc) => Some([arc.center[0], arc.center[1], arc.sweep_rad.to_degrees()]),
            _ => None,
        })
        .map(|arc| arc.map(f64::round))
        .collect();
    assert_eq!(arcs, [[200.0, 80.0, 90.0], [230.0, 130.0, -90.0]]);
    // Three quarters have the same words.
    let text = "G91 G45 G2 X10 Y10 J10 D1 F100";
    assert_eq!(last(text), [13.0, 13.0, 0.0]);
    let [Segment::Arc(arc)] = moves(text)[..] else {
        panic!("an arc")
    };
    assert!((arc.sweep_rad.to_degrees() + 270.0).abs() < 1e-9);
}

#[test]
fn what_it_does_not_go_with_is_refused() {
    for (text, expected) in [
        ("G45", "1:1 missing-word"),
        ("G91 G45 D1", "1:5 missing-word"),
        ("G90 G45 G0 X10 D1", "1:5 not-supported"),
        ("G91 G45 G0 Z2 H1", "1:15 not-supported"),
        ("G91 G45 G2 X10 Y5 I10 D1 F100", "1:5 not-supported"),
        ("G91 G45 G2 X10 I5 D1 F100", "1:5 not-supported"),
        ("G91 G45 G2 X10 Y10 R10 D1 F100", "1:5 not-supported"),
        ("G91 G45 G2 X10 Y10 Z1 I10 D1 F100", "1:5 not-supported"),
        ("G91 G45 G81 X10 Z-5 R1 F100", "1:5 not-supported"),
        ("G45 G28 X0", "1:1 not-supported"),
        ("G45 G53 X0", "1:1 not-supported"),
        ("G91 G45 G47 X1 D1", "1:9 modal-group-conflict"),
        ("G91 G45 G0 X10 D7", "1:16 unknown-tool"),
        ("G91 G47 E20 F40 J5 P0 Z-1 (AB)", "1:5 not-supported"),
        ("G51.1 X0\nG91 G45 G0 X10 D1", "2:5 not-supported"),
        ("G16\nG91 G45 G0 X10 Y5 D1", "2:5 not-supported"),
        ("G91 G45 G1 X10 ,C1 D1 F100\nY10", "1:5 not-supported"),
        (
            "G41 D1 G1 X0 Y20 F600\nY40\nG91 G45 X9",
            "3:5 not-supported",
        ),
    ] {
        finds(text, &[expected]);
    }
    // A Haas engraves by G47, and does not have the others.
    let haas = Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..options()
    };
    for text in ["G91 G45 G0 X10 D1", "G91 G47 G0 X10 D1"] {
        let report = check(text.as_bytes(), haas.clone());
        assert_eq!(listed(&report), ["1:5 not-supported"], "{text}");
    }
    let lathe = Options {
        dialect: Dialect::Fanuc,
        machine: Machine::new(&[Axis::X, Axis::Z]),
        ..Options::default()
    };
    let report = check("G98 G45 G0 X10".as_bytes(), lathe);
    assert_eq!(listed(&report), ["1:5 not-supported"]);
}
