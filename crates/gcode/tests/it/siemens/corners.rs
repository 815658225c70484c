//! Tests of corners beside arcs, feeds of corners and of blocks, polar coordinates that are added
//! to the last ones. Values are computed by hand.

use glidepath_geometry::Segment;
use glidepath_program::{Event, ItemKind, PathMode, Rate};
use proptest::prelude::*;

use super::{ends, finds, items, moves, xs};

fn near(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6
}

fn flat(text: &str) -> Vec<[f64; 2]> {
    ends(text).into_iter().map(|[x, y, _]| [x, y]).collect()
}

#[test]
fn arcs_have_corners_too() {
    // Along X to (10, 0), then up about (20, 0), clockwise: the centre of an arc of radius 2 is 2 above
    // the line, and 12 from (20, 0).
    let text = "F600\nG1 X10 RND=2\nG2 X20 Y10 CR=10\nG1 X30";
    let x = 20.0 - 140.0_f64.sqrt();
    let touch = [20.0 - (20.0 - x) * 10.0 / 12.0, 2.0 * 10.0 / 12.0];
    let found = flat(text);
    assert!(
        near(found[0], [x, 0.0]) && near(found[1], touch),
        "{found:?}"
    );
    assert_eq!(found[2..], [[20.0, 10.0], [30.0, 10.0]]);
    // The other way round: the arc comes first.
    let text = "F600\nG0 X20 Y10\nG3 X10 Y0 CR=10 RND=2\nG1 X0";
    let found = flat(text);
    assert!(
        near(found[1], touch) && near(found[2], [x, 0.0]),
        "{found:?}"
    );
    // Between two arcs: about (10, 10) to the left, along X at its end, and about (20, 0) to the right,
    // upwards at first. The centre of the arc between them is 8 from the one and 12 from the other.
    let text = "F600\nG0 X0 Y10\nG3 X10 Y0 CR=10 RND=2\nG2 X20 Y10 CR=10";
    let all = moves(text);
    let Segment::Arc(arc) = all[2].0 else {
        panic!("an arc")
    };
    let x = 13.0 - 23.0_f64.sqrt();
    assert!(near(arc.center, [x, x - 6.0]), "{:?}", arc.center);
    let x = 20.0 - 140.0_f64.sqrt();
    // RNDM rounds where it fits, and leaves the rest.
    let text = "F600\nG1 X10 RNDM=2\nG2 X20 Y10 CR=10\nRNDM=0\nG1 X30";
    assert!(near(flat(text)[0], [x, 0.0]));
    finds(
        "F600\nG1 X10 CHR=2\nG2 X20 Y10 CR=10",
        &["3:1 invalid-value"],
    );
    finds(
        "F600\nG1 X10 RND=50\nG2 X20 Y10 CR=10",
        &["3:1 invalid-value"],
    );
    finds(
        "F600\nG1 X10 RND=2\nG2 X20 Y10 Z1 CR=10",
        &["3:1 not-supported"],
    );
    finds("F600\nG1 X10 RND=2\nG0 X20", &["3:1 not-supported"]);
    // Codes between the moves change nothing of it.
    let text = "F600 RNDM=2\nG1 X10\nY10\nX0 RNDM=0\nX-5";
    let with_codes = text.replace("\nY10", "\nM8\nY10");
    assert_eq!(flat(&with_codes), flat(text));
    finds(
        "G17 F600\nG2 X10 I5 RND=1\nG18 G1 X20",
        &["3:5 not-supported"],
    );
}

#[test]
fn up_to_three_blocks_without_a_move_leave_a_corner() {
    let round = flat("F600\nG1 X20 RND=2\nY20");
    assert_eq!(round, [[18.0, 0.0], [20.0, 2.0], [20.0, 20.0]]);
    for between in [
        "R1=5",
        "F600",
        "S500 M3",
        "G90\nG64\nG1",
        "G4 F0.5",
        "M0",
        "IF R1==0\nR2=1\nENDIF\nM8\nM9",
    ] {
        for corner in ["RND=2", "RNDM=2"] {
            let text = format!("F600\nG1 X20 {corner}\n{between}\nY20 RNDM=0");
            assert_eq!(flat(&text), round, "{text}");
        }
    }
    // A pole counts from the corner itself.
    let text = "F600\nG1 X20 RND=2\nG110 X0 Y0\nAP=90 RP=20";
    let found = flat(text);
    let near_all = found.iter().zip(&round).all(|(a, b)| near(*a, *b));
    assert!(near_all && found.len() == 3, "{found:?}");
    // Feed and mode of the move before stay its own.
    assert_eq!(
        rates("F600\nG1 X20 RND=2\nF100\nY20"),
        [600.0, 100.0, 100.0]
    );
    // The fourth is one too many: RNDM leaves the corner.
    let four = "R1=1\nR2=2\nM8\nF600";
    assert_eq!(
        flat(&format!("F600 RNDM=2\nG1 X20\n{four}\nY20 RNDM=0")),
        [[20.0, 0.0], [20.0, 20.0]]
    );
    let text = format!("F600\nG1 X20 RND=2\n{four}\nY20");
    finds(&text, &["6:1 not-supported"]);
}

#[test]
fn a_corner_too_large_for_its_moves_is_refused() {
    // The control makes it smaller, and does not say how much.
    let text = "F600 RNDM=20\nG1 X10\nY10 RNDM=0";
    finds(text, &["3:1 invalid-value"]);
    let text = "F600\nG1 X10 RNDM=50\nG2 X20 Y10 CR=10 RNDM=0";
    finds(text, &["3:1 invalid-value"]);
    // Back on itself there is none.
    assert_eq!(flat("F600 RNDM=2\nG1 X10\nX0 RNDM=0").len(), 2);
}

proptest! {
    /// A rounded corner of a line and an arc leaves and meets both along their own directions.
    #[test]
    fn a_rounded_corner_is_smooth(
        radius in 3.0..40.0_f64, round in 0.1..1.0_f64, angle in 20.0..160.0_f64, left in any::<bool>(),
    ) {
        // It fits: between the arc and the line that it comes back to, and on a quarter of the arc.
        let lens = radius * (1.0 - angle.to_radians().cos().abs());
        prop_assume!(angle < 90.0 || !left || 2.5 * round < lens);
        prop_assume!(round / (90.0 - 0.5 * angle).to_radians().tan() < 0.6 * radius);
        // A line along X to the origin, then an arc whose first direction has that angle to it.
        let (sin, cos) = angle.to_radians().sin_cos();
        let side = if left { 1.0 } else { -1.0 };
        let center = [-side * radius * sin, side * radius * cos];
        // A quarter of the circle.
        let from = [-center[0], -center[1]];
        let end = [center[0] - side * from[1], center[1] + side * from[0]];
        let code = if left { "G3" } else { "G2" };
        let text = format!(
            "F600\nG0 X-50 Y0\nG1 X0 RND={round}\n{code} X={} Y={} I={} J={}",
            end[0], end[1], center[0], center[1]
        );
        let all = moves(&text);
        prop_assert_eq!(all.len(), 4, "{}", text);
        for pair in all[1..].windows(2) {
            let (before, behind) = (pair[0].0, pair[1].0);
            let out = before.jet(before.length()).d1;
            let into = behind.jet(0.0).d1;
            prop_assert!((out - into).norm() < 1e-6, "{}: {} {}", text, out, into);
        }
        let Segment::Arc(arc) = all[2].0 else { panic!("an arc") };
        let distance = (arc.center[0] - arc.start[0]).hypot(arc.center[1] - arc.start[1]);
        prop_assert!((distance - round).abs() < 1e-6);
    }
}

/// Feeds of the moves, mm/min.
fn rates(text: &str) -> Vec<f64> {
    let all = moves(text).into_iter();
    all.map(|(_, rate, _)| match rate {
        Rate::Feed(feed_v) => (feed_v * 60.0).round(),
        _ => 0.0,
    })
    .collect()
}

#[test]
fn corners_and_blocks_have_feeds_of_their_own() {
    assert_eq!(
        rates("F600\nG1 X20 CHR=2 FRC=100\nY20\nX0"),
        [600.0, 100.0, 600.0, 600.0]
    );
    assert_eq!(
        rates("F600\nG1 X20 RND=2 FRCM=100\nY20 RND=2\nX0 FRCM=0 RND=1\nY10"),
        [600.0, 100.0, 600.0, 100.0, 600.0, 600.0, 600.0]
    );
    assert_eq!(rates("F600\nG1 X20 FB=100\nY20"), [100.0, 600.0]);
    assert_eq!(
        rates("RNDM=2\nF600\nG1 X20 FRC=100\nY20\nX0"),
        [600.0, 100.0, 600.0, 600.0, 600.0]
    );
    finds("F600\nG1 X20 FRC=100", &["2:8 unused-word"]);
    finds("F600\nG0 X20 FB=100", &["2:8 unused-word"]);
    finds("F600\nG1 X20 FB=0", &["2:8 bad-feed"]);
}

#[test]
fn the_feed_is_that_of_the_contour() {
    // The radius of the tool is 3: inside of an arc of 12 its centre goes 9/12 as far, outside 15/12.
    let around = |word: &str, arc: &str| {
        rates(&format!(
            "T6 M6 D1\n{word}\nF600\nG0 X0 Y-20\nG1 G41 X0 Y-10\nY0\n{arc} Y12 CR=12\nG1 Y30\nG40 Y50"
        ))[3]
    };
    for (word, inside, outside) in [
        ("", 450.0, 750.0),
        ("CFC", 450.0, 750.0),
        ("CFIN", 450.0, 600.0),
        ("CFTCP", 600.0, 600.0),
    ] {
        assert_eq!(around(word, "G3 X-12"), inside, "{word}");
        assert_eq!(around(word, "G2 X12"), outside, "{word}");
    }
}

#[test]
fn polar_coordinates_are_added_to_the_last_ones() {
    let text = "G111 X0 Y0\nG0 RP=10 AP=0\nG1 AP=IC(90) F600\nAP=IC(90) RP=IC(5)\nRP=AC(2)";
    let expected = [[10.0, 0.0], [0.0, 10.0], [-15.0, 0.0], [-2.0, 0.0]];
    assert_eq!(flat(text), expected);
    finds("G111 X0 Y0\nG0 RP=10 AP=IC(1,2)", &["2:13 missing-word"]);
}

#[test]
fn blocks_have_the_forms_of_the_control() {
    assert_eq!(xs(":30 G0 X5\n/3 X6\nN40 X7"), [5.0, 6.0, 7.0]);
    assert_eq!(xs("S1=500 M1=3\nSETMS(1)\nG0 X5"), [5.0]);
    assert_eq!(xs("ACC[X]=50\nLFON\nTRAFOOF()\nG0 X5"), [5.0]);
    finds("S2=500", &["1:1 not-supported"]);
    finds("VELOLIM[X]=50", &["1:1 not-supported"]);
    finds("SETMS(2)", &["1:1 not-supported"]);
    // What is computed is a code of this language, too, and what names become is no text of it.
    assert_eq!(xs("R1=30\nG0 X5\nM=R1\nX9"), [5.0]);
    for (text, place) in [
        ("G=28 X5", "1:1 not-supported"),
        ("G=92 X5", "1:1 not-supported"),
        ("M=60", "1:1 not-supported"),
        ("M1=62", "1:1 not-supported"),
        ("M=3.5", "1:1 unknown-m-code"),
        ("G4 P=5", "1:4 unknown-word"),
        ("G2 X5 Y5 R=5", "1:10 unknown-word"),
        ("G0 X10 ,M5", "1:8 bad-character"),
        ("G97 S500 M3 ,S300", "1:13 bad-character"),
        ("G1 X10,Y5", "1:7 bad-character"),
    ] {
        finds(text, &[place]);
    }
    finds("G0 X1,5", &["1:5 malformed-number"]);
    // The angle of this spindle is not known, but it is this one's.
    finds("SPOS[1]=90", &["1:1 not-connected"]);
    finds("SPOS[2]=90", &["1:1 not-supported"]);
}

#[test]
fn what_is_left_open_holds_for_plain_moves_too() {
    let rounded = [[0.0, 0.0], [8.0, 0.0], [10.0, 2.0], [10.0, 10.0]];
    assert_eq!(flat("F600\nG0 Z20\nRNDM=2\nG1 X10\nY10\nRNDM=0"), rounded);
    finds("F600\nG1 ANG=45\nX20 Y0", &["3:1 polar"]);
}

#[test]
fn corners_of_cycles_stay() {
    // The cycle goes down and up at feed, and the corners behind it are round again.
    let text = "F600\nG0 Z20\nG1 X0 RNDM=2\nCYCLE85(20,0,2,-10,,,120,240)\nG1 X10\nY10\nRNDM=0";
    let all = moves(text);
    let arcs = all
        .iter()
        .filter(|(segment, ..)| matches!(segment, Segment::Arc(_)));
    assert_eq!(arcs.count(), 1);
    assert!(ends(text).contains(&[0.0, 0.0, -10.0]) && ends(text).contains(&[8.0, 0.0, 20.0]));
}

#[test]
fn the_move_to_a_corner_has_the_modes_of_its_own_block() {
    // 600 mm/min up to the corner, 2 mm a turn of 120 a minute from there on.
    assert_eq!(
        rates("S120 M3\nG1 X20 F600 RND=2\nG95 Y20 F2"),
        [600.0, 240.0, 240.0]
    );
    let modes = |text: &str| -> Vec<PathMode> {
        let all = moves(text).into_iter();
        all.map(|(_, _, mode)| mode).collect()
    };
    let on = PathMode::Continuous { tolerance_mm: None };
    let stop = PathMode::ExactStop;
    assert_eq!(modes("G60 G1 X20 F600 RND=2\nG64 Y20"), [stop, on, on],);
    // A time is of one move, and a corner has none.
    finds("G93 G1 X20 F60 RND=2\nY20 F60", &["1:5 not-supported"]);
    finds("G1 X20 F600 RND=2\nG93 G1 Y20 F60", &["2:5 not-supported"]);
    assert_eq!(moves("RNDM=2\nG93 G1 X20 F60\nY20 F60").len(), 2);
    assert_eq!(moves("RNDM=2\nG1 X20 F600\nG93 Y20 F60").len(), 2);
}

/// Codes, and the ends of moves, in order.
fn codes_and_ends(text: &str) -> Vec<String> {
    let round = |value: f64| (value * 1e3).round() / 1e3 + 0.0;
    let all = items(text).into_iter();
    all.filter_map(|item| match item.kind {
        ItemKind::Move { segment, .. } => {
            let end = segment.end();
            Some(format!("{} {}", round(end[0]), round(end[1])))
        }
        ItemKind::Event(Event::MCode(code) | Event::PassingCode(code)) => Some(format!("M{code}")),
        _ => None,
    })
    .collect()
}

#[test]
fn codes_of_the_second_block_come_behind_the_first_move() {
    assert_eq!(
        codes_and_ends("G1 X20 F600 RND=2 M8\nY20 M9"),
        ["M8", "18 0", "M9", "20 2", "20 20"]
    );
    assert_eq!(
        codes_and_ends("RNDM=2\nG1 X20 F600\nY20 M9"),
        ["18 0", "M9", "20 2", "20 20"]
    );
    // Beside the contour, too: 3 mm to the left of it.
    let text = "T6 M6\nG41 G1 X10 Y10 F600\nX30 RND=5\nY30 M9\nG40 X50";
    let found = codes_and_ends(text);
    let at = found.iter().position(|it| it == "M9").expect("M9");
    assert_eq!(found[at - 1], "25 13", "{found:?}");
}

#[test]
fn both_moves_of_a_corner_are_made_with_the_same() {
    for (second, place) in [
        ("G41 Y20", "3:5"),
        ("G1 Y20 D1", "3:1"),
        ("Y20 T1 M6", "3:1"),
    ] {
        let text = format!("T2 M6\nG1 X20 F600 RND=2\n{second}");
        finds(&text, &[&format!("{place} not-supported")]);
    }
    finds(
        "S100 M3 G95 F1\nG1 X20 RND=2\nS200 Y20",
        &["3:1 not-supported"],
    );
    assert_eq!(
        flat("T2 M6\nRNDM=2\nG1 X20 F600\nY20 D0"),
        [[20.0, 0.0], [20.0, 20.0]]
    );
    // CT goes on in the direction of the move that it leaves as it is.
    let round = moves("RNDM=1\nG1 X10 F600\nCT X20 Y10");
    assert!(matches!(round[1].0, Segment::Arc(_)), "{round:?}");
}

#[test]
fn a_corner_without_a_move_of_its_own_is_refused() {
    for (text, place) in [
        ("G0 X10 RND=2\nG1 Y10 F100", "1:8"),
        ("G4 F1 RND=2\nG1 Y10 F100", "1:7"),
        ("G1 F100 CHR=2\nX10", "1:9"),
        ("G1 X10 F100\nCT X20 Y5 RND=1\nG1 X30", "2:11"),
        ("F100\nCIP X30 Y5 I1=10 J1=10 CHF=2\nG1 X2", "2:24"),
    ] {
        finds(text, &[&format!("{place} unused-word")]);
    }
    // None is broken by zero, and RNDM may stand in any block.
    finds("G0 X10 RND=0\nRNDM=1\nG1 Y10 F100", &[]);
}

#[test]
fn a_corner_of_less_than_nothing_is_refused() {
    for word in ["CHR=-2", "RND=-2", "RNDM=-2"] {
        let text = format!("G1 X10 F500 {word}\nY10");
        finds(&text, &["1:13 invalid-value"]);
    }
}

#[test]
fn rndm_counts_in_the_units_of_its_block() {
    let radius = |text: &str| {
        let found = moves(text)
            .into_iter()
            .find_map(|(segment, ..)| match segment {
                Segment::Arc(arc) => Some((arc.start_radius() * 1e6).round() / 1e6),
                _ => None,
            });
        found.expect("a rounded corner")
    };
    for units in ["G700", "G70"] {
        let text = format!("{units} RNDM=.1\nG1 X1 F10\nY1 RNDM=0");
        assert_eq!(radius(&text), 2.54, "{units}");
    }
    assert_eq!(radius("G70\nG71 RNDM=2\nG1 X10 F10\nY10 RNDM=0"), 2.0);
}
