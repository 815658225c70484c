//! Tests of SINUMERIK's frames: shifts, turns, mirrors and scales.

use glidepath_geometry::{Plane, Segment};

use super::{ends, finds, moves, xs};

#[test]
fn frames_shift_turn_mirror_and_scale() {
    let text = "G0 X1 Y2 Z3\nTRANS X10 Y=5*2\nX1 Y2 Z3\nATRANS Z1\nX1 Y2 Z3\nTRANS\nX1 Y2 Z3";
    let expected = [
        [1.0, 2.0, 3.0],
        [11.0, 12.0, 3.0],
        [11.0, 12.0, 4.0],
        [1.0, 2.0, 3.0],
    ];
    assert_eq!(ends(text), expected);
    assert_eq!(ends("ROT RPL=90\nG0 X5 Y1"), [[-1.0, 5.0, 0.0]]);
    assert_eq!(ends("TRANS X10\nAROT Z90\nG0 X5 Y1"), [[9.0, 5.0, 0.0]]);
    // What is not added comes in the place of all others.
    assert_eq!(ends("TRANS X10\nROT Z90\nG0 X5 Y1"), [[-1.0, 5.0, 0.0]]);
    assert_eq!(ends("MIRROR X0\nG0 X5 Y1"), [[-5.0, 1.0, 0.0]]);
    assert_eq!(ends("SCALE X2 Y3\nG0 X5 Y1 Z1"), [[10.0, 3.0, 1.0]]);
    assert_eq!(
        ends("TRANS X1\nASCALE X2\nATRANS X1\nG0 X5"),
        [[13.0, 0.0, 0.0]]
    );
    assert_eq!(ends("G18\nROT RPL=90\nG0 Z1"), [[1.0, 0.0, 0.0]]);
    assert_eq!(ends("G700\nTRANS X1\nG0 X1"), [[50.8, 0.0, 0.0]]);
}

#[test]
fn frames_turn_in_space() {
    // About X: Y becomes Z.
    assert_eq!(ends("ROT X90\nG0 X1 Y2 Z3"), [[1.0, -3.0, 2.0]]);
    // About Z, then about the new Y.
    assert_eq!(ends("ROT Y90 Z90\nG0 Z1"), [[0.0, 1.0, 0.0]]);
    // Increments are turned, and a move along one axis moves three of the machine.
    let text = "ROT X30\nG91 G1 Y10\nY-10\nG90 Z0";
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let round = |v: f64| (v * 1e6).round() / 1e6;
    let there = [0.0, round(10.0 * cos), round(10.0 * sin)];
    assert_eq!(ends(text), [there, [0.0, 0.0, 0.0]]);
}

#[test]
fn the_place_stays_where_it_is() {
    assert_eq!(
        xs("G0 X10\nTRANS X4\nG91 X1\nG90 X=IC(1)\nX0"),
        // The increment counts from X10, now 4 further on.
        [10.0, 15.0, 16.0, 4.0]
    );
    assert_eq!(ends("G0 X10\nROT Z90\nG0 Y1")[1], [-1.0, 0.0, 0.0]);
    // The end of the program ends its frame.
    assert_eq!(xs("TRANS X4\nG0 X1\nM30"), [5.0]);
}

fn arc(text: &str) -> (Plane, [f64; 2], f64) {
    let all = moves(text).into_iter();
    let mut arcs = all.filter_map(|(segment, ..)| match segment {
        Segment::Arc(arc) => Some(arc),
        _ => None,
    });
    let arc = arcs.next().unwrap_or_else(|| panic!("an arc: {text}"));
    let turns = (arc.sweep_rad.to_degrees() * 1e6).round() / 1e6;
    (
        arc.plane,
        arc.center.map(|c| (c * 1e6).round() / 1e6 + 0.0),
        turns,
    )
}

#[test]
fn arcs_follow_their_frame() {
    let quarter = "G0 X10 Y0\nG3 X0 Y10 I-10 J0 F100";
    assert_eq!(arc(quarter), (Plane::Xy, [0.0, 0.0], 90.0));
    assert_eq!(
        arc(&format!("MIRROR X0\n{quarter}")),
        (Plane::Xy, [0.0, 0.0], -90.0)
    );
    assert_eq!(
        arc(&format!("TRANS X5 Y5\nAROT RPL=30\n{quarter}")),
        (Plane::Xy, [5.0, 5.0], 90.0)
    );
    let text = "SCALE X2 Y2\nG0 X10 Y0\nG3 X0 Y10 CR=10 F100";
    assert_eq!(arc(text), (Plane::Xy, [0.0, 0.0], 90.0));
    assert_eq!(moves(text)[1].0.end()[1], 20.0);
    // Of three points in a turned frame: start, end and centre are where the matrix puts them.
    let (plane, center, turns) = arc(&format!("ROT X90\nATRANS X1 Y2 Z3\n{quarter}"));
    // X Y of the program are X Z of the machine; ZX counts from Z to X.
    assert_eq!((plane, center, turns), (Plane::Zx, [2.0, 1.0], -90.0));
    finds("ROT X30\nG0 X10\nG2 X0 I-5 F100", &[]);
    finds("SCALE X2\nG0 X10\nG2 X0 I-5 F100", &["3:1 arc-plane"]);
    finds("ROT X30\nG18\nG0 X10\nG2 X0 I-5 F100", &[]);
}

#[test]
fn compensation_changes_sides_in_a_mirror() {
    let contour = "T4 M6\nG41 D1\nG1 X10 Y0 F100\nX20\nX30\nG40 X40 Y10\n";
    let offset = |head: &str, axis: usize| {
        let text = format!("{head}G0 X0 Y0\n{contour}");
        ends(&text)[1][axis]
    };
    // Left of a move in +X is +Y; mirrored in X it goes in −X, and the tool stays at +Y.
    assert_eq!(offset("", 1), 2.0);
    assert_eq!(offset("MIRROR X0\n", 1), 2.0);
    assert_eq!(offset("MIRROR Y0\n", 1), -2.0);
    finds("ROT X90\nG41 D1", &["2:1 cutter-radius"]);
    finds(
        "G41 D1\nG1 X10 Y0 F100\nX20\nTRANS X5\nG40 X40 Y10",
        &["4:1 cutter-radius"],
    );
}

#[test]
fn frames_that_are_wrong_are_refused() {
    finds("SCALE X0", &["1:7 invalid-value"]);
    finds("SCALE X-1", &["1:7 invalid-value"]);
    finds("ATRANS", &["1:1 missing-word"]);
    finds("TRANS X1 X2", &["1:10 duplicate-word"]);
    finds("TRANS X1 G0", &["1:10 unused-word"]);
    finds("TRANS RPL=3", &["1:7 not-supported"]);
    finds("ROT A5", &["1:5 not-supported"]);
    finds("TRANS X", &["1:7 missing-number"]);
    finds("TRANS X5\nG92 X0", &["2:1 unknown-g-code"]);
    finds("LOOP\nASCALE X10\nENDLOOP", &["2:1 invalid-value"; 20]);
}

#[test]
fn corners_are_broken_by_their_words() {
    // An arc of radius 5 behind 15 mm; chamfers by their legs and by their own length.
    assert_eq!(
        ends("G1 X20 F100 RND=5\nY20")[..2],
        [[15.0, 0.0, 0.0], [20.0, 5.0, 0.0]]
    );
    assert_eq!(
        ends("G1 X20 F100 CHR=2\nY20")[..2],
        [[18.0, 0.0, 0.0], [20.0, 2.0, 0.0]]
    );
    let own = ends("G1 X20 F100 CHF=2\nY20");
    assert!(
        (own[0][0] - (20.0 - 2.0_f64.sqrt())).abs() < 1e-6,
        "{own:?}"
    );
    // RNDM rounds where two moves meet, and leaves the others.
    let all = ends("G1 X20 F100 RNDM=4\nY20\nX0\nM8\nG1 X-5 RNDM=0\nX-9");
    let corner = [
        [16.0, 0.0, 0.0],
        [20.0, 4.0, 0.0],
        [20.0, 16.0, 0.0],
        [16.0, 20.0, 0.0],
    ];
    assert_eq!(all[..4], corner);
    assert_eq!(
        all[4..],
        [[0.0, 20.0, 0.0], [-5.0, 20.0, 0.0], [-9.0, 20.0, 0.0]]
    );
}
