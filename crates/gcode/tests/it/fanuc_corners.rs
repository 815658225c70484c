//! Tests of G41 and G42 on a FANUC: the way round outer corners. Values are computed by hand, for a tool of
//! 10 mm diameter.

use glidepath_gcode::{FanucParameters, OffsetMemory, Options, OuterCorners, Program};
use glidepath_geometry::Segment;
use glidepath_program::{ItemKind, Rate};

use crate::fanuc_calls::options;

/// From below, along Y to a corner at (0, 40).
const HEAD: &str = "G0 X-20 Y-20\nG1 G41 D2 X0 Y0 F600\nY40\n";

fn moves(text: &str, fanuc: FanucParameters) -> Vec<(Segment, Rate)> {
    let options = Options { fanuc, ..options() };
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => Some((segment, rate)),
            _ => None,
        })
        .collect()
}

/// Ends in X and Y behind the move to the place beside the first one, to the micrometre, with `a` where the
/// move is an arc.
fn ways(text: &str, fanuc: FanucParameters) -> Vec<String> {
    let moves = moves(&format!("{HEAD}{text}"), fanuc);
    let shown = moves.into_iter().skip(2).map(|(segment, _)| {
        let [x, y] = [0, 1].map(|axis| (segment.end()[axis] * 1e3).round() / 1e3 + 0.0);
        let mark = if matches!(segment, Segment::Arc(_)) {
            "a"
        } else {
            ""
        };
        format!("{x} {y}{mark}")
    });
    shown.collect()
}

fn usual(text: &str) -> Vec<String> {
    ways(text, FanucParameters::default())
}

#[test]
fn sides_go_on_to_where_they_meet() {
    // A right angle: both lines are longer by the radius.
    assert_eq!(usual("X40"), ["-5 45", "40 45"]);
    // By 45 degrees: longer by 5 · tan 22.5°.
    assert_eq!(usual("X40 Y80"), ["-5 42.071", "36.464 83.536"]);
    // To an arc: on along the line, along the arc's tangent to its beginning.
    assert_eq!(
        usual("G2 X20 Y40 I10 J-10"),
        ["-5 42.071", "-3.536 43.536", "23.536 43.536a"]
    );
    // From an arc to a line: the arc ends at (20, 40) towards (1, -1), and the line leads down.
    assert_eq!(
        usual("G2 X20 Y40 I10 J-10\nG1 Y0")[2..],
        ["23.536 43.536a", "25 42.071", "25 0"]
    );
}

#[test]
fn round_sharp_corners_they_go_on_by_the_radius() {
    // Back by 135 degrees: on by 5, across to 5 in front of the beginning of the next side.
    assert_eq!(usual("X40 Y0"), ["-5 45", "0 47.071", "43.536 3.536"]);
    // All the way back.
    assert_eq!(usual("Y0"), ["-5 45", "5 45", "5 0"]);
}

#[test]
fn the_way_across_is_as_fast_as_the_next_block() {
    let rates: Vec<Rate> = moves(&format!("{HEAD}X40 Y0 F1200"), FanucParameters::default())
        .into_iter()
        .map(|(_, rate)| rate)
        .collect();
    assert_eq!(
        rates[2..],
        [Rate::Feed(10.0), Rate::Feed(20.0), Rate::Feed(20.0)]
    );
}

#[test]
fn arcs_where_the_control_makes_arcs() {
    let arcs = ["-5 40", "0 45a", "40 45"];
    let of = |outer_corners, offset_memory| FanucParameters {
        outer_corners,
        offset_memory,
        ..FanucParameters::default()
    };
    use OuterCorners::{Arcs, Lines, Unsaid};
    assert_eq!(ways("X40", of(Arcs, OffsetMemory::Unsaid)), arcs);
    assert_eq!(ways("X40", of(Unsaid, OffsetMemory::Haas)), arcs);
    assert_eq!(
        ways("X40", of(Lines, OffsetMemory::Haas)),
        ["-5 45", "40 45"]
    );
    // Inner corners are the same.
    for corners in [Arcs, Lines] {
        assert_eq!(
            ways("X-40", of(corners, OffsetMemory::A)),
            ["-5 35", "-40 35"]
        );
    }
}
