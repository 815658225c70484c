//! Tests of FANUC's and Haas' mills: offsets by other words, depths of Haas, round pockets, names
//! of programs and variables, what is printed. Values are computed by hand.

use glidepath_gcode::{
    BoreShift, FanucParameters, OffsetMemory, Options, Program, RemarkKind, check,
};
use glidepath_geometry::Segment;
use glidepath_program::{Event, ItemKind, Rate};

use crate::fanuc_calls::{ends_with, options};
use crate::support::listed;

fn moves(text: &str) -> Vec<(Segment, Rate)> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => Some((segment, rate)),
            _ => None,
        })
        .collect()
}

fn ends(text: &str) -> Vec<[f64; 3]> {
    let all = moves(text).into_iter();
    all.map(|(segment, _)| [0, 1, 2].map(|axis| (segment.end()[axis] * 1e6).round() / 1e6 + 0.0))
        .collect()
}

fn last(text: &str) -> [f64; 3] {
    *ends(text).last().expect("a move")
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
}

#[test]
fn work_offsets_have_several_names() {
    let set = "G10 L20 P4 X30 Y20\n";
    for code in ["G54.1 P4", "G54 P4", "G154 P4"] {
        assert_eq!(
            last(&format!("{set}{code}\nG0 X1 Y1")),
            [31.0, 21.0, 0.0],
            "{code}"
        );
    }
    assert_eq!(last(&format!("{set}G0 G54 P4 X1 Y1")), [31.0, 21.0, 0.0]);
    assert_eq!(last("G10 L20 P2 X30\nG111\nG0 X1"), [31.0, 0.0, 0.0]);
    assert_eq!(last("G10 L20 P2 X30\nG111\nG54 G0 X1"), [1.0, 0.0, 0.0]);
    // Factors without a point count thousandths, however large they are.
    assert_eq!(last("G51 X0 Y0 I2000 J1000\nG0 X10 Y10"), [20.0, 10.0, 0.0]);
    // G112 and G113 are of a C axis, too.
    finds("G113", &["1:1 not-supported"]);
    finds("G54 P7", &["1:1 not-supported"]);
}

#[test]
fn the_length_follows_h() {
    let at = |text: &str| last(text)[2];
    assert_eq!(at("G43 H1 G0 Z5\nH2 Z5"), 25.0);
    assert_eq!(at("G44 H1 G0 Z5\nH2 Z5"), -15.0);
    assert_eq!(at("G43 H1 G0 Z5\nH0 Z5"), 5.0);
    // Without G43 it is the number that the next one takes.
    assert_eq!(at("G0 Z50 H2"), 50.0);
    assert_eq!(at("G0 Z50 H2\nG43 Z5"), 25.0);
    finds("G0 Z5 H9\nG43 Z5", &["2:1 unknown-tool"]);
}

#[test]
fn depths_of_haas_become_less() {
    // 8, 6, 4, 3, 3 …: from R2 to Z-22.
    let levels: Vec<f64> = ends("G0 Z20\nG98 G83 X0 Z-22 R2 I8 J2 K3 F100")
        .into_iter()
        .map(|[_, _, z]| z)
        .collect();
    let feeds: Vec<f64> = moves("G0 Z20\nG98 G83 X0 Z-22 R2 I8 J2 K3 F100")
        .into_iter()
        .filter(|(_, rate)| !matches!(rate, Rate::Rapid))
        .map(|(segment, _)| (segment.end()[2] * 1e6).round() / 1e6)
        .collect();
    assert_eq!(feeds, [-6.0, -12.0, -16.0, -19.0, -22.0]);
    assert_eq!(levels.last(), Some(&20.0));
    // The words are kept for the next hole.
    let both = ends("G0 Z20\nG98 G83 X0 Z-22 R2 I8 J2 K3 F100\nX10");
    assert_eq!(both.iter().filter(|end| end[2] == -19.0).count(), 2);
    finds("G0 Z20\nG83 X0 Z-5 R2 I8 Q1 F100", &["2:18 unused-word"]);
    finds("G0 Z20\nG81 X0 Z-5 R2 I8 F100", &["2:15 unused-word"]);
    finds("G0 Z20\nG83 X0 Z-5 R2 I2 K3 F100", &["2:15 canned-cycle"]);
}

/// K of a Haas counts no holes: in G73 beside Q it is how deep the tool goes before it comes out to R.
#[test]
fn g73_of_a_haas_comes_out_to_r_by_k() {
    let haas = || Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..options()
    };
    let levels: Vec<f64> = ends_with("G0 Z10\nG99 G73 Z-10 R0 Q2. K4. F300", haas())
        .into_iter()
        .map(|[_, _, z]| z)
        .collect();
    let right = [
        10.0, 0.0, -2.0, -1.746, -4.0, 0.0, -3.746, -6.0, -5.746, -8.0, 0.0, -7.746, -10.0, 0.0,
    ];
    assert_eq!(levels, right);
    let found = check("G0 Z10\nG81 Z-10 R0 K2 F300".as_bytes(), haas());
    assert_eq!(listed(&found), ["2:13 unused-word"]);
    let holes = ends_with("G91 G99 G81 X5 Z-1 R0 L2 F300", haas());
    assert_eq!(holes.last(), Some(&[10.0, 0.0, 0.0]));
}

#[test]
fn round_pockets_go_from_the_centre_and_back() {
    // A tool of radius 5 in a pocket of radius 20: its circle has 15.
    let text = "G0 X10 Y20 Z1\nG13 I20 D2 Z-3 F500";
    assert_eq!(
        ends(text)[1..],
        [
            [10.0, 20.0, -3.0],
            [25.0, 20.0, -3.0],
            [25.0, 20.0, -3.0],
            [10.0, 20.0, -3.0]
        ]
    );
    let length: f64 = moves(text)[1..]
        .iter()
        .map(|(segment, _)| segment.length())
        .sum();
    let circles = std::f64::consts::PI * (7.5 + 30.0 + 7.5);
    assert!((length - 4.0 - circles).abs() < 1e-9, "{length}");
    let sweeps = |text: &str| -> Vec<f64> {
        let all = moves(text).into_iter();
        all.filter_map(|(segment, _)| match segment {
            Segment::Arc(arc) => Some(arc.sweep_rad.to_degrees().round()),
            _ => None,
        })
        .collect()
    };
    assert_eq!(sweeps(text), [180.0, 360.0, 180.0]);
    assert_eq!(sweeps("G12 I20 D2 F500"), [-180.0, -360.0, -180.0]);
    // From I to K by Q, the last as far as is left; D0 takes nothing away.
    let xs: Vec<f64> = ends("G13 I5 K12 Q4 D0 F500")
        .iter()
        .map(|end| end[0])
        .collect();
    assert_eq!(xs, [5.0, 5.0, 9.0, 9.0, 12.0, 12.0, 0.0]);
    // Levels.
    let zs: Vec<f64> = ends("G91 G13 Z-1 L2 I6 D0 F500")
        .iter()
        .map(|end| end[2])
        .collect();
    assert_eq!(zs, [-1.0, -1.0, -1.0, -1.0, -2.0, -2.0, -2.0, -2.0]);
    finds("G13 I20 F500", &["1:1 missing-word"]);
    finds("G13 I4 D2 F500", &["1:5 canned-cycle"]);
    finds("G13 I5 K20 D0 F500", &["1:1 missing-word"]);
    finds("G13 Z-1 L2 I6 D0 F500", &["1:9 canned-cycle"]);
}

#[test]
fn programs_and_variables_have_names() {
    let text = "%\nO<MAIN>\nM98 <SLOT> L2\nM30\nO<SLOT>\nG91 G0 X5\nG90\nM99\n%\n";
    assert_eq!(last(text), [10.0, 0.0, 0.0]);
    let text = "O1\nG65 <PART> X7\nM30\n<PART>\nG0 X#24\nM99";
    assert_eq!(last(text), [7.0, 0.0, 0.0]);
    finds("M98 <NONE>", &["1:1 unknown-subroutine"]);
    finds(
        "M98 <PART> P2\nM30\n<PART>\nM99\nO2\nM99",
        &["1:1 ambiguous-word"],
    );
    let text = "SETVN 510[DEPTH,WIDTH]\n#510=4\n[#WIDTH]=[#DEPTH]*2\nG0 X#511 Y[#DEPTH+1]";
    assert_eq!(last(text), [8.0, 5.0, 0.0]);
    finds("SETVN 10[DEPTH]", &["1:9 parameter"]);
    // A line that is refused has given no name.
    let mut typed =
        Program::new("SETVN 510[DEPTH,9]\nG0 X[#DEPTH]\n".as_bytes(), options()).typed();
    let refused = typed.by_ref().take(2).filter(Result::is_err).count();
    assert_eq!(refused, 2);
    finds("G0 X[#DEPTH]", &["1:6 parameter"]);
    assert_eq!(
        last("#1=BIN[18]\n#2=BCD[12]\nG0 X#1 Y#2"),
        [12.0, 18.0, 0.0]
    );
    finds("#1=BIN[10]", &["1:4 arithmetic"]);
}

#[test]
fn variables_are_printed() {
    let text = "POPEN\n#100=-1.5\nDPRNT[X#100[32]*Y#101[20]]\nPCLOS\n";
    let mut program = Program::new(text.as_bytes(), options()).with_remarks();
    assert!(program.by_ref().all(|item| item.is_ok()));
    let remarks = program.take_remarks();
    assert_eq!(remarks.len(), 1);
    assert_eq!(
        (remarks[0].line, remarks[0].kind, remarks[0].text.as_str()),
        (3, RemarkKind::Debug, "X-  1.50 Y  0")
    );
    finds("DPRNT[X#100]", &["1:8 expression"]);
    finds("DPRNT[X", &["1:6 expression"]);
}

#[test]
fn bored_holes_are_left_beside_the_wall() {
    let with = |bore_shift: BoreShift| Options {
        fanuc: FanucParameters {
            bore_shift,
            ..FanucParameters::default()
        },
        ..options()
    };
    let steps = |text: &str, options: Options| -> Vec<String> {
        let round = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
        Program::new(text.as_bytes(), options)
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Move { segment, rate, .. } => {
                    let [x, y, z] = [0, 1, 2].map(|axis| round(segment.end()[axis]));
                    let mark = if rate == Rate::Rapid { "r" } else { "" };
                    Some(format!("{x} {y} {z}{mark}"))
                }
                ItemKind::Dwell(seconds) => Some(format!("{seconds}s")),
                ItemKind::Event(Event::MCode(code)) => Some(format!("M{code}")),
                _ => None,
            })
            .collect()
    };
    let head = "G0 Z20 S500 M3\n";
    let hole = |x: f64, y: f64, aside: [f64; 2]| -> Vec<String> {
        let [u, v] = [x + aside[0], y + aside[1]];
        vec![
            format!("{x} {y} 2r"),
            format!("{x} {y} -10"),
            "0.5s".to_owned(),
            "M19".to_owned(),
            format!("{u} {v} -10r"),
            format!("{u} {v} 20r"),
            format!("{x} {y} 20r"),
            "M3".to_owned(),
        ]
    };
    for (shift, aside) in [
        (BoreShift::PlusX, [0.5, 0.0]),
        (BoreShift::MinusX, [-0.5, 0.0]),
        (BoreShift::PlusY, [0.0, 0.5]),
        (BoreShift::MinusY, [0.0, -0.5]),
    ] {
        let text = format!("{head}G98 G76 X10 Y5 Z-10 R2 Q0.5 P500 F100\nX30\nG80");
        let found = steps(&text, with(shift));
        assert_eq!(found[3..11], hole(10.0, 5.0, aside), "{shift:?}");
        assert_eq!(found[12..], hole(30.0, 5.0, aside), "{shift:?}");
    }
    // I and J say it by themselves; in G99 the tool stays at R.
    let text = format!("{head}G99 G76 X10 Y5 Z-10 R2 I-0.3 J0.4 F100");
    let found = steps(&text, options());
    assert_eq!(
        found[4..],
        [
            "10 5 -10",
            "M19",
            "9.7 5.4 -10r",
            "9.7 5.4 2r",
            "10 5 2r",
            "M3"
        ]
    );
    for (words, expected) in [
        ("G76 X1 Z-10 R2 Q0.5 F100", "2:16 ambiguous-word"),
        ("G76 X1 Z-10 R2 F100", "2:1 missing-word"),
        ("G76 X1 Z-10 R2 I1 Q0.5 F100", "2:19 unused-word"),
        ("G76 X1 Z-10 R2 I0 F100", "2:1 canned-cycle"),
        ("G18 G76 X1 Y-10 R2 I1 F100", "2:5 canned-cycle"),
        ("M5\nG76 X1 Z-10 R2 I1 F100", "3:1 spindle"),
        ("G68 X0 Y0 R90\nG76 X1 Z-10 R2 I1 F100", "3:1 canned-cycle"),
        ("G51.1 X0\nG76 X1 Z-10 R2 I1 F100", "3:1 canned-cycle"),
    ] {
        finds(&format!("{head}{words}"), &[expected]);
    }
    let report = check(
        format!("{head}G76 X1 Z-10 R2 Q5 F100").as_bytes(),
        with(BoreShift::PlusX),
    );
    assert_eq!(listed(&report), ["2:16 ambiguous-word"]);
}

#[test]
fn the_local_offset_stands_beside_that_of_g92() {
    let xs = |text: &str| -> Vec<f64> { ends(text).into_iter().map(|[x, ..]| x).collect() };
    // The place is named 5; the local zero is 10 further, and back.
    assert_eq!(xs("G92 X5.\nG52 X10.\nG0 X5.\nG52 X0\nG0 X6."), [10.0, 1.0]);
    // In every coordinate system, and over those that are set.
    assert_eq!(
        xs("G52 X10.\nG55 G0 X1.\nG10 L2 P2 X100.\nG0 X1."),
        [11.0, 111.0]
    );
    // G92 ends it along its axes.
    assert_eq!(
        ends("G52 X10. Y20.\nG0 X0 Y0\nG92 X1.\nG0 X2. Y1."),
        [[10.0, 20.0, 0.0], [11.0, 21.0, 0.0]]
    );
    // A place of the machine is one.
    assert_eq!(last("G52 X10.\nG0 G53 X1."), [1.0, 0.0, 0.0]);
}

#[test]
fn offsets_of_g92_and_g52_are_taken_back_axis_by_axis() {
    let shifted = "G0 X10 Y10\nG92 X0 Y0\nG52 X5 Y5\n";
    assert_eq!(last(&format!("{shifted}X1 Y1")), [16.0, 16.0, 0.0]);
    // X again counts from the zero of G54, Y from where it was named.
    assert_eq!(last(&format!("{shifted}G92.1 X0\nX1 Y1")), [1.0, 16.0, 0.0]);
    assert_eq!(
        last(&format!("{shifted}G92.1 X0 Y0 Z0\nX1 Y1")),
        [1.0, 1.0, 0.0]
    );
    // It moves nothing, in increments, too.
    assert_eq!(
        last(&format!("{shifted}G91 G92.1 X0 Y0\nX1")),
        [11.0, 10.0, 0.0]
    );
    finds("G92.1", &["1:1 missing-word"]);
    finds("G92.1 X5", &["1:7 invalid-value"]);
}

#[test]
fn compensation_begins_beside_the_second_move() {
    // With 6 mm the tool is at X-3 beside a contour that goes up from X0, whichever way it comes.
    for (text, entry) in [
        (
            "G0 X-10. Y-10.\nG1 G41 D1 X0 Y0 F500\nY20.",
            [-3.0, 0.0, 0.0],
        ),
        (
            "G0 X10. Y-10.\nG1 G41 D1 X0 Y0 F500\nY20.",
            [-3.0, 0.0, 0.0],
        ),
        ("G0 X-20. Y0\nG1 G42 D1 X0 Y0 F500\nY20.", [3.0, 0.0, 0.0]),
        (
            "G0 X-20. Y0\nG1 G41 D1 X0 Y0 F500\nG3 X10. Y10. J10.",
            [0.0, 3.0, 0.0],
        ),
        (
            "G0 X0 Y-20.\nG1 G42 D1 X0 Y0 F500\nG2 X10. Y10. I10.",
            [3.0, 0.0, 0.0],
        ),
    ] {
        assert_eq!(ends(text)[1], entry, "{text}");
    }
    // Down first, and then to the contour.
    assert_eq!(
        ends("G0 X-20. Y0\nG41 D1\nG1 Z-1. F500\nX0\nX20."),
        [
            [-20.0, 0.0, 0.0],
            [-20.0, 0.0, -1.0],
            [0.0, 3.0, -1.0],
            [20.0, 3.0, -1.0]
        ]
    );
    // And up again beside it, before the next move leads away.
    assert_eq!(
        ends("G0 X-20. Y0\nG1 G41 D1 X0 F500\nX20.\nG40 G0 Z10.\nG91 Z5.\nX5.")[2..],
        [
            [20.0, 3.0, 0.0],
            [20.0, 3.0, 10.0],
            [20.0, 3.0, 15.0],
            [25.0, 0.0, 15.0]
        ]
    );
    assert_eq!(
        last("G0 X-20. Y0\nG1 G41 D1 X0 F500\nX20.\nG40 X20."),
        [20.0, 0.0, 0.0]
    );
    finds(
        "G0 X-20. Y0\nG41 D1\nG2 X0 Y20. I20. F500",
        &["3:1 cutter-radius"],
    );
}

#[test]
fn g51_scales_the_levels_of_a_cycle_and_not_its_pecks() {
    let turns = |text: &str| -> Vec<f64> { ends(text).iter().map(|end| end[2]).collect() };
    // R2 and Z-20 are 1 and -10 of the machine; the strokes stay 4.
    let found = turns("G0 Z20.\nG51 X0 Y0 Z0 P500\nG99 G83 X10. Z-20. R2. Q4. F100");
    assert_eq!(
        found,
        [
            20.0, 20.0, 1.0, -3.0, 1.0, -2.746, -7.0, 1.0, -6.746, -10.0, 1.0
        ]
    );
    let found = turns("G0 Z20.\nG51 X0 Y0 Z0 P500\nG99 G73 X10. Z-20. R2. Q4. F100");
    assert_eq!(
        found,
        [20.0, 20.0, 1.0, -3.0, -2.746, -7.0, -6.746, -10.0, 1.0]
    );
    // The words of a block before count without its scale.
    let kept = "G0 Z20.\nG99 G83 X10. Z-8. R0 Q4. F100\nG51 X0 Y0 Z0 P2.\nX20.";
    let found = turns(kept);
    assert_eq!(
        found[found.len() - 12..],
        [
            0.0, -4.0, 0.0, -3.746, -8.0, 0.0, -7.746, -12.0, 0.0, -11.746, -16.0, 0.0
        ]
    );
}

#[test]
fn g53_goes_at_rapid_on_a_fanuc_and_leaves_g1_in_force() {
    let rates = |text: &str, options: Options| -> Vec<Rate> {
        Program::new(text.as_bytes(), options)
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Move { rate, .. } => Some(rate),
                _ => None,
            })
            .collect()
    };
    let text = "G1 X5. F600\nG53 X7.\nG53 G1 Y3.\nX9.";
    let feed = Rate::Feed(10.0);
    assert_eq!(
        rates(text, options()),
        [feed, Rate::Rapid, Rate::Rapid, feed]
    );
    let haas = Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..options().fanuc
        },
        ..options()
    };
    assert_eq!(rates(text, haas), [feed; 4]);
}
