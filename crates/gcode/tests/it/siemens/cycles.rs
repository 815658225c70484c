//! Tests of SINUMERIK's cycles: drilling, boring, tapping, pockets, MCALL.

use glidepath_gcode::{Options, Program};
use glidepath_program::{Event, Item, ItemKind, OrientWay, PathMode, Rate};

use super::{ends, finds, items, moves, options};

/// A machine whose spindle is turned to an angle.
fn oriented() -> Options {
    Options {
        orients: true,
        ..options()
    }
}

fn of(text: &str, options: Options) -> impl Iterator<Item = Item> {
    Program::new(text.as_bytes(), options).map(|item| item.unwrap_or_else(|d| panic!("{d}")))
}

/// Z of every end, with `r` behind it where the move is a rapid.
fn levels(text: &str) -> Vec<String> {
    let all = moves(text).into_iter();
    all.map(|(segment, rate, _)| {
        let z = (segment.end()[2] * 1e6).round() / 1e6 + 0.0;
        let mark = if rate == Rate::Rapid { "r" } else { "" };
        format!("{z}{mark}")
    })
    .collect()
}

#[test]
fn holes_are_drilled() {
    let head = "G0 X5 Z50 F100\n";
    let drilled = ["50r", "2r", "-10", "20r"];
    assert_eq!(levels(&format!("{head}CYCLE81(20,0,2,-10)")), drilled);
    assert_eq!(levels(&format!("{head}CYCLE81(20,0,2,,10)")), drilled);
    // The depth counts from the surface where both are given.
    assert_eq!(levels(&format!("{head}CYCLE81(20,0,2,-99,10)")), drilled);
    let dwells = |text: &str| {
        let all = items(text).into_iter();
        all.filter_map(|item| match item.kind {
            ItemKind::Dwell(seconds) => Some(seconds),
            _ => None,
        })
        .collect::<Vec<_>>()
    };
    assert_eq!(dwells(&format!("{head}CYCLE82(20,0,2,-10,,1.5)")), [1.5]);
    let text = format!("{head}CYCLE85(20,0,2,-10,,,120,240)");
    assert_eq!(levels(&text), ["50r", "2r", "-10", "2", "20r"]);
    let rates: Vec<Rate> = moves(&text).into_iter().map(|(_, rate, _)| rate).collect();
    assert_eq!(rates[2..4], [Rate::Feed(2.0), Rate::Feed(4.0)]);
    // Modes and feed are those from before.
    let text = format!("{head}G91 G64 G1\nCYCLE85(20,0,2,-10,,,120,240)\nX1");
    let (last, rate, mode) = *moves(&text).last().unwrap();
    assert_eq!((last.end()[0], rate), (6.0, Rate::Feed(100.0 / 60.0)));
    assert_eq!(mode, PathMode::Continuous { tolerance_mm: None });
    assert_eq!(moves(&text)[2].2, PathMode::ExactPath);
}

#[test]
fn deep_holes_are_drilled_in_strokes() {
    let head = "G0 Z20 F100\n";
    // 10, 8, 6, 4, then as long as DAM is; the last two of these are alike.
    let text = format!("{head}CYCLE83(20,0,2,-33,,-10,,2,,,1,0)");
    let expected = [
        "20r", "2r", "-10", "-9", "-18", "-17", "-24", "-23", "-28", "-27", "-30", "-29", "-31.5",
        "-30.5", "-33", "20r",
    ];
    assert_eq!(levels(&text), expected);
    // Back by VRT; a dwell of its own at the last depth.
    let text = format!("{head}CYCLE83(20,0,2,-10,,-5,,0,0.2,,1,0,,5,0.4,0.7)");
    assert_eq!(levels(&text), ["20r", "2r", "-5", "-4.6", "-10", "20r"]);
    let dwells: Vec<f64> = items(&text)
        .into_iter()
        .filter_map(|item| match item.kind {
            ItemKind::Dwell(seconds) => Some(seconds),
            _ => None,
        })
        .collect();
    assert_eq!(dwells, [0.2, 0.7]);
    let text = format!("{head}CYCLE83(20,0,2,-30,,,15,0,,,0.5,1)");
    let expected = ["20r", "2r", "-15", "2r", "-14.4r", "-30", "20r"];
    assert_eq!(levels(&text), expected);
    let feeds: Vec<f64> = moves(&text)
        .into_iter()
        .filter_map(|(_, rate, _)| match rate {
            Rate::Feed(v) => Some((v * 60.0).round()),
            Rate::Rapid => None,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(feeds, [50.0, 100.0]);
    // Each stroke half of the one before.
    let text = format!("{head}CYCLE83(20,0,2,-15.5,,-8,,-0.5)");
    let bottoms: Vec<String> = levels(&text).into_iter().skip(2).step_by(2).collect();
    assert_eq!(bottoms[..5], ["-8", "-12", "-14", "-15", "-15.5"]);
    finds(
        "G0 Z20\nCYCLE83(20,0,2,-18,,-8,,-0.5)",
        &["2:1 canned-cycle"],
    );
    // Rapid ends 3 mm above the depth reached.
    let text = format!("{head}CYCLE83(20,0,2,-30,,,15,0,,,1,1,,0,0,0,3)");
    assert_eq!(
        levels(&text),
        ["20r", "2r", "-15", "2r", "-12r", "-30", "20r"]
    );
}

/// MDEP: the least stroke where DAM is a factor.
#[test]
fn strokes_do_not_become_shorter_than_the_least_one() {
    let bottoms = |text: &str| -> Vec<String> {
        let text = format!("G0 Z20 F100\n{text}");
        levels(&text).into_iter().skip(2).step_by(2).collect()
    };
    // 8, 4, 2, then 2 each.
    assert_eq!(
        bottoms("CYCLE83(20,0,2,-19,,-8,,-0.5,,,1,0,,2)")[..6],
        ["-8", "-12", "-14", "-16", "-18", "-19"]
    );
    // 10, 8 (0.8), 6.4, then 6 each.
    assert_eq!(
        bottoms("CYCLE83(20,0,2,-40,,-10,,-0.8,,,1,0,,6)")[..6],
        ["-10", "-18", "-24.4", "-30.4", "-36.4", "-40"]
    );
    // Longer than the first one.
    assert_eq!(
        bottoms("CYCLE83(20,0,2,-12,,-2,,-0.8,,,1,0,,5)")[..3],
        ["-2", "-7", "-12"]
    );
    // With an amount it changes nothing as long as no stroke is shorter.
    let plain = bottoms("CYCLE83(20,0,2,-33,,-10,,2,,,1,0)");
    assert_eq!(bottoms("CYCLE83(20,0,2,-33,,-10,,2,,,1,0,,1)"), plain);
    for (text, code) in [
        ("CYCLE83(20,0,2,-33,,-10,,2,,,1,0,,1.8)", "canned-cycle"),
        ("CYCLE83(20,0,2,-33,,-10,,2,,,1,0,,3)", "canned-cycle"),
        ("CYCLE83(20,0,2,-33,,-10,,-0.8,,,1,0,,-1)", "canned-cycle"),
        ("CYCLE83(20,0,2,-33,,-10,,-0.8,,,1,0,1,2)", "not-supported"),
    ] {
        finds(&format!("G0 Z20\n{text}"), &[&format!("2:1 {code}")]);
    }
}

#[test]
fn bores_are_left_with_the_spindle_at_an_angle() {
    let text = "G0 X1 Y2 Z20\nCYCLE86(20,0,2,-10,,0.5,3,-1,0.5,1,45)";
    let expected = [
        [1.0, 2.0, 20.0],
        [1.0, 2.0, 2.0],
        [1.0, 2.0, -10.0],
        [0.0, 2.5, -9.0],
        [0.0, 2.5, 20.0],
        [1.0, 2.0, 20.0],
    ];
    let goes: Vec<[f64; 3]> = of(text, oriented())
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        })
        .map(|end| [end[0], end[1], end[2]])
        .collect();
    assert_eq!(goes, expected);
    let told: Vec<Event> = of(text, oriented())
        .filter_map(|item| match item.kind {
            ItemKind::Event(event @ (Event::MCode(_) | Event::SpindleAngle { .. })) => Some(event),
            _ => None,
        })
        .collect();
    let angle = Event::SpindleAngle {
        deg: 45.0,
        way: OrientWay::Shortest,
    };
    assert_eq!(told, [Event::MCode(3), angle, Event::MCode(19)]);
    // A spindle that is not turned to an angle would draw the tip through the wall.
    finds(text, &["2:1 not-connected"]);
    let own = "G0 X1 Y2 Z20\nCYCLE86(20,0,2,-10,,0.5,3,-1,0.5,1)";
    assert_eq!(ends(own), expected);
}

#[test]
fn a_modal_call_drills_at_every_move() {
    let text = "G0 Z20\nMCALL CYCLE81(20,0,2,-5)\nX1\nM8\nG4 F1\nR1=5\nX2\nMCALL\nX3";
    let bottoms = ends(text).into_iter().filter(|[.., z]| *z == -5.0);
    assert_eq!(bottoms.map(|[x, ..]| x).collect::<Vec<_>>(), [1.0, 2.0]);
    finds("MCALL HOLES1(1)", &["1:7 not-supported"]);
    finds("MCALL CYCLE81(-1,0,2,-5)\nX3", &["1:7 canned-cycle"]);
    // The cycle is along the axis normal to the plane, and in the frame.
    let text = "G18\nTRANS Y100\nG0 Y20\nCYCLE81(20,0,2,-5)";
    let ys: Vec<f64> = ends(text).into_iter().map(|[_, y, _]| y).collect();
    assert_eq!(ys, [120.0, 102.0, 95.0, 120.0]);
}

#[test]
fn cycles_that_cannot_be_made_are_refused() {
    let head = "T6 M6\nG0 Z20\nM3 S100\n";
    for (cycle, code) in [
        ("CYCLE81(20,0,2)", "missing-word"),
        ("CYCLE81(,0,2,-5)", "missing-word"),
        ("CYCLE81(-1,0,2,-5)", "canned-cycle"),
        ("CYCLE81(20,0,2,5)", "canned-cycle"),
        ("CYCLE81(20,0,-2,-5)", "canned-cycle"),
        ("CYCLE81(20,0,2,-5", "expression"),
        ("CYCLE81(20,0,2,-5,,1,1)", "not-supported"),
        ("CYCLE81(20,0,2,-5) G0", "unused-word"),
        ("CYCLE82(20,0,2,-5,,-1)", "canned-cycle"),
        ("CYCLE83(20,0,2,-5,,1)", "canned-cycle"),
        ("CYCLE83(20,0,2,-5,,-1,,-2)", "canned-cycle"),
        ("CYCLE83(20,0,2,-5,,-1,,-0.001)", "canned-cycle"),
        ("CYCLE86(20,0,2,-5,,,5)", "canned-cycle"),
        ("POCKET4(20,0,2,-5,2,0,0)", "canned-cycle"),
        ("POCKET4(20,0,2,-5,20,0,0,,,,,,7)", "canned-cycle"),
        ("POCKET4(20,0,2,-5,20,0,0,,,,,,0,31)", "canned-cycle"),
        ("POCKET4(20,0,2,-5,20,0,0,,,,,,0,21)", "missing-word"),
        ("POCKET4(20,0,2,-5,20,0,0,,,,,,0,11,5)", "canned-cycle"),
        ("POCKET4(20,0,2,-5,20,0,0,,,,,,0,11,,3)", "canned-cycle"),
        (
            "POCKET4(20,0,2,-5,20,0,0,0.0000001,,,,,0,11)",
            "canned-cycle",
        ),
        ("POCKET3(20,0,2,-5,20,10,2,0,0)", "canned-cycle"),
        ("POCKET3(20,0,2,-5,20,10,6,0,0)", "canned-cycle"),
        ("POCKET3(20,0,2,-5,20,6,3,0,0)", "canned-cycle"),
    ] {
        let text = format!("{head}{cycle}");
        let report = glidepath_gcode::check(text.as_bytes(), options());
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .map(|d| (d.line, d.code.as_str()))
            .collect();
        assert_eq!(found, [(4, code)], "{cycle}");
        let diagnostic = &report.diagnostics[0];
        assert!(
            !diagnostic.help.is_empty() && !diagnostic.reason.is_empty(),
            "{diagnostic}"
        );
    }
    finds("G0 Z20\nPOCKET4(20,0,2,-5,20,0,0)", &["2:1 canned-cycle"]);
    // What is wrong with a step is wrong with the cycle's line.
    finds("G0 Z20\nG91 CYCLE81(20,0,2,-5)", &["2:5 not-supported"]);
}

#[test]
fn rigid_taps_have_a_pitch_or_a_size() {
    use glidepath_gcode::{Options, Program, Threading, check};
    use glidepath_program::{Event, ItemKind, Limits};

    let options = || Options {
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..options()
    };
    let items = |text: &str| -> Vec<String> {
        Program::new(text.as_bytes(), options())
            .map(|item| match item.expect("a sound program").kind {
                ItemKind::Event(Event::Tap {
                    pitch_mm, depth_um, ..
                }) => format!("tap({pitch_mm},{depth_um})"),
                ItemKind::Event(Event::MCode(code)) => format!("M{code}"),
                ItemKind::Event(Event::SpindleSpeed(speed)) => format!("S{speed}"),
                ItemKind::Move { segment, .. } => format!("{}", segment.end()[2]),
                other => format!("{other:?}"),
            })
            .collect()
    };
    assert_eq!(
        items("G0 Z20\nCYCLE84(20,0,2,-10,,0,3,8,,0,600,600)"),
        ["20", "2", "S600", "M3", "tap(-1.25,12000)", "M3", "20"]
    );
    assert_eq!(
        items("G0 Z20\nCYCLE84(20,0,2,,10,,5,,-0.75,,400)"),
        ["20", "2", "S400", "M4", "tap(-0.75,12000)", "M5", "20"]
    );
    for (words, expected) in [
        ("20,0,2,-10,,,,7,,,600", "1:1 canned-cycle"),
        ("20,0,2,-10,,,,6", "1:1 missing-word"),
        ("20,0,2,-10,,1,,6,,,600", "1:1 canned-cycle"),
        ("20,0,2,-10,,,,6,,90,600", "1:1 canned-cycle"),
        ("20,0,2,-10,,,,6,,,600,900", "1:1 canned-cycle"),
        ("20,0,2,-10,,,,6,,,600,,,,,1,3", "1:1 canned-cycle"),
        ("20,0,2,-10,,,,6,,,600,,1", "1:1 canned-cycle"),
    ] {
        let text = format!("CYCLE84({words})");
        let report = check(text.as_bytes(), options());
        assert_eq!(crate::support::listed(&report), [expected], "{text}");
    }
}

#[test]
fn a_spindle_that_is_an_axis_does_all_of_cycle84() {
    use glidepath_gcode::{Options, Program, SpindleAxis};
    use glidepath_geometry::Axis;
    use glidepath_program::{Event, ItemKind, Limits};

    let mut limits = Limits::uniform(200.0, 2_000.0, 40_000.0);
    limits.velocity[5] = 18_000.0;
    let items = |text: &str| -> String {
        let spindle_axis = Some(SpindleAxis {
            axis: Axis::C,
            limits,
            rigid_tapping: false,
        });
        let options = Options {
            spindle_axis,
            ..options()
        };
        let shown = Program::new(text.as_bytes(), options).map(|item| {
            match item.expect("a sound program").kind {
                ItemKind::Event(Event::MCode(code)) => format!("M{code}"),
                ItemKind::Event(Event::SpindleSpeed(speed)) => format!("S{speed}"),
                ItemKind::Dwell(seconds) => format!("dwell{seconds}"),
                ItemKind::Move { segment, rate, .. } => {
                    let end = segment.end();
                    let feed = rate.feed_v().map(|feed_v| format!("f{:.0}", feed_v * 60.0));
                    format!("({},{}){}", end[2], end[5], feed.unwrap_or_default())
                }
                other => format!("{other:?}"),
            }
        });
        shown.collect::<Vec<_>>().join(" ")
    };
    assert_eq!(
        items("G0 Z20 C400\nM3\nCYCLE84(20,0,2,-10,,0.5,3,8,,90,600,900)"),
        "(20,400) M3 (2,400) S600 M5 (2,450) dwell0 (-10,3906)f750 dwell0.5 (2,450)f1125 M3 (20,450)"
    );
    // Back by a millimetre after every 5 mm, and all the way out.
    assert_eq!(
        items("G0 Z20\nCYCLE84(20,0,2,-10,,,,,-1,,600,,3,0,0,1,5)"),
        "(20,0) (2,0) S600 M5 dwell0 (-3,-1800)f600 (-2,-1440)f600 (-8,-3600)f600 (-7,-3240)f600 \
         (-10,-4320)f600 dwell0 (2,0)f600 (20,0)"
    );
    assert_eq!(
        items("G0 Z20\nCYCLE84(20,0,2,-10,,,,,1,,600,,3,0,0,2,6)"),
        "(20,0) (2,0) S600 M5 dwell0 (-4,2160)f600 (2,0)f600 (-10,4320)f600 dwell0 (2,0)f600 (20,0)"
    );
}
