//! Tests of CYCLE95. Values are computed by hand.

use std::sync::Arc;

use glidepath_gcode::{Machine, Options, Program, Tool, ToolTable, check};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::Rate;

use crate::support::listed;

fn lathe() -> Options {
    Options {
        tools: None,
        machine: Machine::new(&[Axis::X, Axis::Z]),
        ..super::options()
    }
}

/// Tool 1 with a round nose of 0.8 mm radius, whose tip is that of a tool for outside (orientation 2).
fn round_nose() -> Options {
    nose_of(0.8)
}

fn nose_of(radius_mm: f64) -> Options {
    let mut tools = ToolTable::new();
    let tool = Tool {
        diameter_mm: 2.0 * radius_mm,
        orientation: 2,
        ..Tool::default()
    };
    tools.set(1, tool);
    Options {
        tools: Some(Arc::new(tools)),
        ..lathe()
    }
}

/// Ends in X (a radius) and Z: `r` behind rapids, `+` and `-` behind arcs counterclockwise and clockwise.
fn ways_with(text: &str, options: Options) -> Vec<String> {
    let mut ways = Vec::new();
    for item in Program::new(text.as_bytes(), options) {
        let item = item.unwrap_or_else(|found| panic!("{text}\n{found}"));
        if let glidepath_program::ItemKind::Move { segment, rate, .. } = item.kind {
            let [x, z] = [0, 2].map(|axis| (segment.end()[axis] * 1e3).round() / 1e3 + 0.0);
            let mark = match segment {
                Segment::Arc(arc) if arc.sweep_rad > 0.0 => "+",
                Segment::Arc(_) => "-",
                _ if rate == Rate::Rapid => "r",
                _ => "",
            };
            ways.push(format!("{x} {z}{mark}"));
        }
    }
    ways
}

fn ways(text: &str) -> Vec<String> {
    ways_with(text, lathe())
}

const HEAD: &str = "G18 G90 DIAMON G95 S600 M3\nG0 X60 Z10\n";
/// A step from 20 to 40 at Z-20, as a subprogram.
const STEP: &str = "\nM30\n%_N_STEP_SPF\nG1 X20 Z0\nZ-20\nX40\nM17\n";

#[test]
fn a_step_outside_is_roughed() {
    // 10 deep less nothing: passes of 2 at most are five of 2; 0.2 is left along Z, 0.5 along X.
    let text = format!("{HEAD}CYCLE95(\"STEP\",2,0.2,0.5,,0.3,,,1){STEP}");
    let mut expected = vec![
        "30 10r".to_owned(),
        "21.5 1.2r".to_owned(),
        "20.5 1.2r".to_owned(),
    ];
    for level in [18.5, 16.5, 14.5, 12.5] {
        expected.extend([
            format!("{level} 1.2r"),
            format!("{level} -19.8"),
            format!("{} -18.8r", level + 1.0),
            format!("{} 0.2r", level + 1.0),
            format!("{level} 1.2r"),
        ]);
    }
    // The last one goes along the contour.
    expected.extend(
        [
            "10.5 1.2r",
            "10.5 0.2",
            "10.5 -19.8",
            "20.5 -19.8",
            "21.5 -19.8r",
            "21.5 1.2r",
        ]
        .map(str::to_owned),
    );
    assert_eq!(ways(&text), expected);
    // Nothing at feed comes nearer to the contour than it may, nor leaves the length of it.
    let rates: Vec<Rate> = moves(&text).into_iter().map(|(.., rate)| rate).collect();
    assert_eq!(rates[4], Rate::Feed(0.3 * 10.0));
}

/// The moves with their rates, at 600 rev/min.
fn moves(text: &str) -> Vec<(Segment, Rate)> {
    Program::new(text.as_bytes(), lathe())
        .filter_map(|item| match item.expect("no fault").kind {
            glidepath_program::ItemKind::Move { segment, rate, .. } => Some((segment, rate)),
            _ => None,
        })
        .collect()
}

#[test]
fn the_contour_between_two_labels_is_finished_as_it_stands() {
    // With a quarter of 5 mm and a chamfer; its end is behind the program's.
    let text = format!(
        "{HEAD}CYCLE95(\"FROM_A:TO_B\",,,,,,,0.1,5,,,2)\nM30\nFROM_A: G1 X20 Z0\nG1 X30 CHR=1\nZ-15\n\
         G2 X40 Z-20 CR=5\nTO_B: G1 X50"
    );
    assert_eq!(
        ways(&text)[1..],
        [
            "27 2r", "10 2r", "10 0", "14 0", "15 -1", "15 -15", "20 -20-", "25 -20", "27 -20",
            "27 2r"
        ]
        .map(str::to_owned)
    );
}

#[test]
fn finishing_alone_goes_as_the_contour_is_programmed() {
    // From the high end down to the low one: in across, out along Z.
    let back = "\nM30\n%_N_BACK_SPF\nG0 X40 Z-20\nG1 X20\nZ0\nRET\n";
    let text = format!("{HEAD}CYCLE95(\"BACK\",,,,,,,0.1,5){back}");
    assert_eq!(
        ways(&text)[1..],
        ["21 -20r", "20 -20", "10 -20", "10 0", "10 1", "21 1r"].map(str::to_owned)
    );
    // Roughing goes from the low end all the same, and so does finishing with it.
    let text = format!("{HEAD}CYCLE95(\"BACK\",10,,,,0.2,,0.1,9){back}");
    assert_eq!(
        ways(&text)[1..],
        [
            "21 1r", "20 1r", "10 1r", "10 0", "10 -20", "20 -20", "21 -20r", "21 1r", "10 1r",
            "10 0", "10 -20", "20 -20", "21 -20", "21 1r",
        ]
        .map(str::to_owned)
    );
}

#[test]
fn a_bore_is_roughed_inside() {
    // From 40 at the face to 20 at Z-20, in two passes of 5; 0.5 is left along X.
    let text = format!(
        "{HEAD}CYCLE95(\"BORE\",6,,0.5,,0.2,,,3)\nM30\n%_N_BORE_SPF\nG1 X40 Z0\nZ-20\nX20\nM17\n"
    );
    assert_eq!(
        ways(&text)[1..],
        [
            "8.5 1r",
            "9.5 1r",
            "14.5 1r",
            "14.5 -20",
            "13.5 -19r",
            "13.5 0r",
            "14.5 1r",
            "19.5 1r",
            "19.5 0",
            "19.5 -20",
            "9.5 -20",
            "8.5 -20r",
            "8.5 1r",
        ]
        .map(str::to_owned)
    );
}

#[test]
fn an_allowance_along_the_contour() {
    // A cone of 45 degrees from 20 to 40: beside it at 1 mm, the root of 2 along Z; 1 above the cylinder.
    let text = format!(
        "{HEAD}CYCLE95(\"CONE\",20,,,1,0.2,,,1)\nM30\n%_N_CONE_SPF\nG1 X20 Z0\nX40 Z-10\nZ-20\nM17\n"
    );
    let ways = ways(&text);
    assert_eq!(ways[1..4], ["22 1r", "21 1r", "11 1r"].map(str::to_owned));
    let root = std::f64::consts::SQRT_2;
    // Where the cone at a distance meets the line before it, and the one behind it.
    let near = ((root - 1.0) * 1e3).round() / 1e3;
    assert_eq!(ways[4], format!("11 {near}"));
    // Round the corner between the cone and the cylinder, 1 mm away.
    let half = root / 2.0;
    let [x, z] = [20.0 + half, half - 10.0].map(|mm| (mm * 1e3).round() / 1e3);
    assert_eq!(ways[5..7], [format!("{x} {z}"), "21 -10+".to_owned()]);
}

#[test]
fn a_round_nose_finishes_with_compensation() {
    // The centre of the nose is 0.8 off the contour; the tip of orientation 2 is 0.8 aside in both axes.
    let text = format!("{HEAD}CYCLE95(\"STEP\",,,,,,,0.1,5){STEP}");
    let with_tool = |text: &str| ways_with(&format!("T1 M6\nD1\n{text}"), round_nose());
    let plain = ways(&text);
    let round = with_tool(&text);
    assert_eq!(
        plain[1..],
        [
            "21 1r", "10 1r", "10 0", "10 -20", "20 -20", "21 -20", "21 1r"
        ]
    );
    // Along cylinder and shoulder the tip is where it would be without a radius; it begins and ends where
    // the centre of the nose is beside the ends of the contour.
    assert_eq!(
        round[1..],
        [
            "21 1r", "10 1r", "10 -0.8", "10 -20", "19.2 -20", "21 -20", "21 1r"
        ]
    );
    // A nose that is larger than the way to the contour (1 mm) is led to it all the same.
    let large = ways_with(&format!("T1 M6\nD1\n{text}"), nose_of(1.5));
    assert_eq!(
        large[1..],
        [
            "21 1r", "10 1r", "10 -1.5", "10 -20", "18.5 -20", "21 -20", "21 1r"
        ]
    );
    // On a cone of 45 degrees it is 0.8 less 0.8 / root 2 deeper.
    let cone = with_tool(&text.replace("Z-20\nX40", "X40 Z-10\nZ-20"));
    for way in ["9.766 -0.234", "19.766 -10.234"] {
        assert!(cone.contains(&way.to_owned()), "{way} in {cone:?}");
    }
}

#[test]
fn what_is_refused() {
    let call = "CYCLE95(\"STEP\",2,0.2,0.5,,0.3,,,1)";
    let good = format!("{HEAD}{call}{STEP}");
    assert!(check(good.as_bytes(), lathe()).diagnostics.is_empty());
    for (from, to, place) in [
        (",1)", ",2)", "3:1 canned-cycle"),
        // The inside of what is an outside: the passes would begin behind the part.
        (",,,1)", ",,,3)", "3:1 canned-cycle"),
        (",,,1)", ",,,11)", "3:1 canned-cycle"),
        ("\"STEP\",2", "\"STEP\",0", "3:1 canned-cycle"),
        (",,,1)", ",,,1,0.5)", "3:1 canned-cycle"),
        (",,,1)", ",,,1,,,,1)", "3:1 canned-cycle"),
        ("\"STEP\",2", "\"STEP\",0.001", "3:1 canned-cycle"),
        ("\"STEP\"", "5", "3:1 missing-word"),
        ("\"STEP\"", "\"STAIR\"", "3:9 unknown-subroutine"),
        ("\"STEP\"", "\"A:B\"", "3:9 flow-structure"),
        ("G18", "G17", "3:1 canned-cycle"),
        ("DIAMON", "DIAM90", "3:1 canned-cycle"),
        ("Z-20\nX40", "Z-10\nX16\nZ-20\nX40", "3:1 canned-cycle"),
        ("Z-20\nX40", "Z-20 F2", "7:6 not-supported"),
        ("Z-20\nX40", "Z-20\nR1=5\nX40", "8:1 not-supported"),
        (
            "Z-20\nX40",
            "Z-20\nIF R1==0\nX40\nENDIF",
            "8:1 not-supported",
        ),
        ("Z-20\nX40", "Z-20 CHF=1\nX40", "7:6 not-supported"),
        ("Z-20\nX40", "ANG=180 Z-20\nX40", "7:1 not-supported"),
        ("X20 Z0", "X20 Z0 RND=1", "6:1 canned-cycle"),
        ("Z-20\nX40", "Z-20\nG64 X40 RND=1", "3:9 canned-cycle"),
        ("Z-20\nX40\n", "", "3:9 canned-cycle"),
        ("Z-20\nX40", "G4 F1", "7:1 canned-cycle"),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        let report = check(text.as_bytes(), lathe());
        assert_eq!(listed(&report), [place], "{text}");
    }
}
