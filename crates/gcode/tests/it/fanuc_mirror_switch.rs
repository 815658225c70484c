//! Tests of G101 and G100 of Haas' mills. Values are computed by hand.

use glidepath_gcode::{FanucParameters, OffsetMemory, Options, Program, check};
use glidepath_program::ItemKind;

use crate::fanuc_calls::{ends_with, finds, options};
use crate::support::listed;

fn haas() -> Options {
    Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..options()
    }
}

fn ends(text: &str) -> Vec<[f64; 3]> {
    ends_with(text, haas())
}

#[test]
fn axes_are_mirrored_about_the_zero_of_the_work_offset() {
    assert_eq!(ends("G101 X0\nG0 X5 Y1"), [[-5.0, 1.0, 0.0]]);
    assert_eq!(ends("G101 X0. Y0.\nG0 X5 Y1 Z2"), [[-5.0, -1.0, 2.0]]);
    assert_eq!(ends("G101 Y0\nG91 G0 X5 Y1"), [[5.0, -1.0, 0.0]]);
    // Of the offset in force, whichever that is: 100 mm less 5 mm.
    assert_eq!(
        ends("G10 L2 P2 X100\nG55\nG101 X0\nG0 X5"),
        [[95.0, 0.0, 0.0]]
    );
    assert_eq!(
        ends("G10 L2 P2 X100\nG101 X0\nG55 G0 X5"),
        [[95.0, 0.0, 0.0]]
    );
}

#[test]
fn each_axis_is_switched_by_itself() {
    assert_eq!(
        ends("G101 X0 Y0\nG0 X5 Y1\nG100 X0\nX5 Y1\nG101 X0\nX5\nG100 X0 Y0 Z0\nX5 Y1"),
        [
            [-5.0, -1.0, 0.0],
            [5.0, -1.0, 0.0],
            [-5.0, -1.0, 0.0],
            [5.0, 1.0, 0.0]
        ]
    );
    // What is not on may be switched off.
    assert_eq!(ends("G100 X0 Y0 Z0\nG0 X5"), [[5.0, 0.0, 0.0]]);
    // A program that ends leaves none.
    assert_eq!(ends("G101 X0\nG0 X5\nM30\n"), [[-5.0, 0.0, 0.0]]);
}

/// From (10, 0) over (15, 5) to (20, 0), clockwise; the image goes over (−15, 5), the other way round.
#[test]
fn arcs_turn_the_other_way_round() {
    let text = "G101 X0\nG0 X10 Y0\nG2 X20 Y0 I5 J0 F100\nM30\n";
    let arcs: Vec<_> = Program::new(text.as_bytes(), haas())
        .filter_map(|item| match item.unwrap().kind {
            ItemKind::Move { segment, .. } => Some(segment),
            _ => None,
        })
        .collect();
    let middle = arcs[1].jet(0.5 * arcs[1].length()).position;
    assert!(
        (middle[0] + 15.0).abs() < 1e-9 && (middle[1] - 5.0).abs() < 1e-9,
        "{middle}"
    );
}

#[test]
fn what_is_not_known_of_it_is_refused() {
    // A FANUC does not have the codes.
    finds("G101 X0", &["1:1 not-supported"]);
    finds("G101", &["1:1 missing-word"]);
    for (text, expected) in [
        ("G101", "1:1 missing-word"),
        ("G100", "1:1 missing-word"),
        ("G101 X5", "1:6 not-supported"),
        ("G101 Z0", "1:6 not-supported"),
        ("G101 X0 G0", "1:1 not-supported"),
        ("G69 G101 X0", "1:5 not-supported"),
        ("G101 X0 G51 Y0", "1:9 modal-group-conflict"),
        ("G52 X5\nG101 X0", "2:6 not-supported"),
        ("G92 X5\nG101 X0", "2:6 not-supported"),
        ("G101 X0\nG52 X5", "2:1 not-supported"),
        ("G101 X0\nG92 X5", "2:1 not-supported"),
        ("G68 X0 Y0 R30\nG101 X0", "2:1 not-supported"),
        (
            "G41 D1 G1 X0 Y20 F600\nY40\nG101 X0\nG40 X50",
            "3:1 cutter-radius",
        ),
    ] {
        let report = check(text.as_bytes(), haas());
        assert_eq!(listed(&report), [expected], "{text}");
    }
}
