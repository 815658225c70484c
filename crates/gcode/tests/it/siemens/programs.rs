//! Tests of words that CAM systems write into every program.

use super::{ends, finds, moves, options};
use glidepath_gcode::{
    Dialect, Machine, Options, Program, SiemensParameters, Tool, ToolTable, check,
};
use std::sync::Arc;

/// Tool 1, 10 mm long and 6 mm thick.
fn with_tool() -> Options {
    let mut tools = ToolTable::new();
    let mut tool = Tool {
        diameter_mm: 6.0,
        ..Tool::default()
    };
    tool.offset[2] = 10.0;
    tools.set(1, tool);
    Options {
        tools: Some(Arc::new(tools)),
        ..options()
    }
}

fn last(text: &str) -> [f64; 3] {
    let items = Program::new(text.as_bytes(), with_tool());
    let end = items
        .filter_map(
            |item| match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
                glidepath_program::ItemKind::Move { segment, .. } => Some(segment.end()),
                _ => None,
            },
        )
        .last()
        .expect("a move");
    [0, 1, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0)
}

#[test]
fn an_edge_is_length_and_radius() {
    assert_eq!(last("T1 M6\nD1\nG0 Z2"), [0.0, 0.0, 12.0]);
    assert_eq!(last("T1 M6\nD1\nG0 Z2\nD0\nZ2"), [0.0, 0.0, 2.0]);
    // Beside the contour by half the diameter.
    assert_eq!(last("T1 M6 D1\nG0 Y-20\nG1 G41 X0 Y-10 F100\nY20")[0], -3.0);
    // Without offsets: with the length, and without.
    assert_eq!(last("TRANS X10\nT1 M6 D1\nG0 SUPA X2 Z0"), [2.0, 0.0, 10.0]);
    assert_eq!(
        last("TRANS X10\nT1 M6 D1\nG0 G153 X2 Z0 D0"),
        [2.0, 0.0, 0.0]
    );
    finds("T1 M6\nD2", &["2:1 unknown-tool"]);
}

#[test]
fn headers_are_read_over() {
    let text = "WORKPIECE(,\"\",,\"BOX\",112,0,-51)\nG601 FNORM\nBRISK\nDYNFINISH\nTRAFOOF\nCYCLE800()\nG500\nM41\nG0 X1";
    assert_eq!(ends(text), [[1.0, 0.0, 0.0]]);
    finds("CYCLE800(1,\"TC1\")", &["1:1 canned-cycle"]);
    assert_eq!(ends("CYCLE800(0,\"0\")\nG0 X1"), [[1.0, 0.0, 0.0]]);
    finds("CYCLE800(2,\"0\")", &["1:1 canned-cycle"]);
    assert_eq!(ends("R1='H0A' R2='B101'\nG0 X=R1 Y=R2"), [[10.0, 5.0, 0.0]]);
    assert_eq!(
        ends("DIAMON\nG0 X20\nDIAMOF X3"),
        [[10.0, 0.0, 0.0], [3.0, 0.0, 0.0]]
    );
    finds("R1='X1'", &["1:4 malformed-number"]);
}

#[test]
fn holes_are_drilled_along_patterns() {
    let holes = |pattern: &str| {
        let text = format!("G0 Z5\nF400\nMCALL CYCLE81(5,0,2,-4)\n{pattern}\nMCALL");
        let all = ends(&text);
        let bottoms = all.into_iter().filter(|[_, _, z]| *z == -4.0);
        bottoms.map(|[x, y, _]| [x, y]).collect::<Vec<_>>()
    };
    assert_eq!(
        holes("HOLES1(10,0,90,5,20,3)"),
        [[10.0, 5.0], [10.0, 25.0], [10.0, 45.0]]
    );
    // A row begins at its end that is nearer to the tool, and with its first hole where both are as near.
    let row = [[0.0, 0.0], [20.0, 0.0], [40.0, 0.0]];
    let back = [row[2], row[1], row[0]];
    for (place, expected) in [("X35 Y3", back), ("X5", row), ("X20 Y9", row)] {
        let pattern = format!("MCALL\nG0 {place}\nMCALL CYCLE81(5,0,2,-4)\nHOLES1(0,0,0,0,20,3)");
        assert_eq!(holes(&pattern), expected, "{place}");
    }
    // In the frame in force: the tool is at X-5 there.
    let shifted = "MCALL\nG0 X35\nTRANS X40\nMCALL CYCLE81(5,0,2,-4)\nHOLES1(0,0,0,0,20,3)";
    assert_eq!(holes(shifted), [[40.0, 0.0], [60.0, 0.0], [80.0, 0.0]]);
    assert_eq!(
        holes("HOLES2(0,0,20,0,0,4)"),
        [[20.0, 0.0], [0.0, 20.0], [-20.0, 0.0], [0.0, -20.0]]
    );
    assert_eq!(
        holes("G91\nCYCLE801(0,0,0,10,20,2,2)"),
        [[0.0, 0.0], [10.0, 0.0], [0.0, 20.0], [10.0, 20.0]]
    );
    // The second position counts from the first one along X.
    assert_eq!(
        holes("CYCLE802(111111121,111111111,10,5,20,7,3,3,,,,,,,,,,,,,0,0,1)"),
        [[10.0, 5.0], [30.0, 7.0], [3.0, 3.0]]
    );
    finds(
        "MCALL CYCLE81(5,0,2,-4)\nCYCLE802(111,111,1,1,,,,,,,,,,,,,,,,,0,0,2)",
        &["2:1 canned-cycle"],
    );
    finds("CYCLE802(111,111,1,1)", &["1:1 canned-cycle"]);
    finds("HOLES1(0,0,0,0,1,3)", &["1:1 canned-cycle"]);
    finds(
        "MCALL CYCLE81(5,0,2,-4)\nHOLES1(0,0,0,0,1,2.5)",
        &["2:1 canned-cycle"],
    );
}

#[test]
fn newer_arguments_of_cycles_are_read_where_they_say_nothing_else() {
    let old = moves("G0 Z5 F400\nCYCLE81(5,0,2,-4)");
    assert_eq!(moves("G0 Z5 F400\nCYCLE81(5,0,2,-4,,0,0,10)"), old);
    let deep = moves("G0 Z5 F400\nCYCLE83(5,0,2,-20,,-6,,0,,,1,1)");
    assert_eq!(
        moves("G0 Z5 F400\nCYCLE83(5,0,2,-20,,-6,,0,,,1,1,,6,0,0,0,0,0,1001110)"),
        deep
    );
    finds("CYCLE81(5,0,2,-4,,0,0,13)", &["1:1 not-supported"]);
    finds("CYCLE83(5,0,2,-20,,-6,,1,,,1,1,,6)", &["1:1 canned-cycle"]);
}

#[test]
fn the_speed_of_g96_has_a_limit() {
    let text = "G18 G95 G96 S200 LIMS=3000 M3\nG0 X10 F0.2\nX0";
    let speeds: Vec<_> = Program::new(text.as_bytes(), options())
        .filter_map(|item| match item.expect("a sound program").kind {
            glidepath_program::ItemKind::Event(glidepath_program::Event::SpindleSpeed(speed)) => {
                Some(speed.round())
            }
            _ => None,
        })
        .collect();
    // 200 m/min at a radius of 10 mm are 3183 turns a minute.
    assert!(
        speeds.iter().all(|speed| *speed <= 3000.0) && speeds.contains(&3000.0),
        "{speeds:?}"
    );
}

#[test]
fn a_slicer_and_klipper_are_read() {
    let printer = "; generated by PrusaSlicer 2.7\nG21\nG1 X1 E1 F600\n";
    assert_eq!(
        Dialect::detect(printer.as_bytes(), &Machine::unlimited()).dialect,
        Dialect::Marlin
    );
    let marlin = |text: &str| {
        let options = Options {
            dialect: Dialect::Marlin,
            ..options()
        };
        crate::support::listed(&check(text.as_bytes(), options))
    };
    let silent = "EXCLUDE_OBJECT_DEFINE NAME=a CENTER=10,10\nSET_FAN_SPEED FAN=aux SPEED=0.5\nTIMELAPSE_TAKE_FRAME\nG1 X1 F600";
    assert_eq!(marlin(silent), [""; 0]);
    assert_eq!(marlin("START_PRINT BED=60"), ["1:1 not-supported"]);
    assert_eq!(marlin("G1 X5 F600\nG28 X Y\nG3 X5 I2.5 P0"), [""; 0]);
}

/// AMODE of cycles for holes: its ones say what DP and DPR are, its tens what DTB is.
#[test]
fn newer_arguments_say_what_the_depth_is() {
    let bottom = |text: &str| {
        let ends = ends(text);
        ends.into_iter().map(|[_, _, z]| z).fold(f64::MAX, f64::min)
    };
    for (text, right) in [
        ("CYCLE81(10,-5,2,-15,,0,0,1,12)", -15.0),
        // A coordinate counts, whatever DPR says.
        ("CYCLE81(10,-5,2,-15,3,0,0,0,2)", -15.0),
        ("CYCLE81(10,-5,2,,10,0,0,1,11)", -15.0),
        // DP above the surface can be an increment alone.
        ("CYCLE81(10,-5,2,10,,0,0,1,11)", -15.0),
        // Both are the same.
        ("CYCLE82(10,0,2,-10,,0.5,0,1,11)", -10.0),
        ("CYCLE82(10,0,2,-10,,0.5,0,1,12)", -10.0),
        ("CYCLE82(10,0,2,-10,,,0,1,22)", -10.0),
        ("CYCLE85(10,0,2,,10,,300,600,0,1,11)", -10.0),
        (
            "CYCLE83(10,0,2,,20,-6,,0,,,1,1,,6,0,0,0,0,1,1001111)",
            -20.0,
        ),
    ] {
        assert_eq!(bottom(&format!("G0 Z20 F300\n{text}")), right, "{text}");
    }
    for (text, code) in [
        // Either Z-12 or Z-15: which one is not known.
        ("CYCLE81(10,-5,2,-12,,0,0,1,11)", "canned-cycle"),
        ("CYCLE81(10,0,2,-10,,0,0,2,11)", "not-supported"),
        ("CYCLE81(10,0,2,-10,,0,10,1,11)", "not-supported"),
        ("CYCLE82(10,0,2,-10,,3,0,1,22)", "not-supported"),
        ("CYCLE81(10,0,2,-10,,0,0,1,13)", "not-supported"),
        ("CYCLE81(10,0,2,-10,,0,0,1,112)", "not-supported"),
        ("CYCLE81(10,0,2,,10,0,0,1,12)", "missing-word"),
        ("CYCLE81(10,0,2,-10,,0,0,1,12,1)", "not-supported"),
    ] {
        finds(&format!("G0 Z20 F300\n{text}"), &[&format!("2:1 {code}")]);
    }
}

#[test]
fn the_speed_of_the_spindle_has_a_range() {
    let speeds = |text: &str| {
        Program::new(text.as_bytes(), options())
            .filter_map(|item| match item.expect("a sound program").kind {
                glidepath_program::ItemKind::Event(glidepath_program::Event::SpindleSpeed(
                    speed,
                )) => Some(speed.round()),
                _ => None,
            })
            .collect::<Vec<_>>()
    };
    let text = "G26 S3000\nG25 S20\nS5000 M3\nS10\nS500\nG26 S400\nS0";
    assert_eq!(speeds(text), [3000.0, 20.0, 500.0, 400.0, 0.0]);
    // LIMS does not go beyond it; 200 m/min at a radius of 5 mm are 6366 turns.
    let text = "G26 S=3000\nG18 G0 X5\nG95 G96 S200 LIMS=4000 M3";
    assert_eq!(speeds(text), [3000.0]);
    finds("G26 X100", &["1:1 not-supported"]);
    finds("G25", &["1:1 missing-word"]);
    finds("G26 S0", &["1:5 invalid-value"]);
    let report = check(&b"G25 S100 G26 S3000"[..], options());
    assert_eq!(
        report.diagnostics[0].message,
        "a second S of G26 in the block"
    );
}

#[test]
fn functions_of_the_plc_are_read_over_where_they_do_nothing() {
    let text = "H5\nG0 X1 H12.5 Y2\nH-3\nH=10\nH1=2.5\nR1=4\nG0 H2=R1*2 X1";
    finds(
        text,
        &[
            "1:1 not-supported",
            "2:7 not-supported",
            "3:1 not-supported",
            "4:1 not-supported",
            "5:1 not-supported",
            "7:4 not-supported",
        ],
    );
    let options = Options {
        siemens: SiemensParameters {
            reads_over_h: true,
            ..SiemensParameters::default()
        },
        ..options()
    };
    let report = check(text.as_bytes(), options);
    assert!(report.is_accepted(), "{:?}", report.diagnostics);
    assert_eq!(report.final_position.as_slice()[..2], [1.0, 2.0]);
}

#[test]
fn the_feed_is_that_of_x_y_and_z() {
    assert_eq!(ends("FGROUP(X,Y,Z)\nFGROUP()\nG0 X1"), [[1.0, 0.0, 0.0]]);
    finds("FGROUP(X,A)", &["1:1 not-supported"]);
    finds("FGROUP(X,Y)", &["1:1 not-supported"]);
}

#[test]
fn both_coolants_are_switched_on_in_one_block() {
    let codes = |text: &str| -> Vec<u32> {
        super::items(text)
            .into_iter()
            .filter_map(|item| match item.kind {
                glidepath_program::ItemKind::Event(
                    glidepath_program::Event::PassingCode(code)
                    | glidepath_program::Event::MCode(code),
                ) => Some(code),
                _ => None,
            })
            .collect()
    };
    assert_eq!(codes("S100 M3 M7 M8\nM9"), [3, 7, 8, 9]);
    assert_eq!(codes("M8 M7"), [8, 7]);
    finds("M8 M9", &["1:4 modal-group-conflict"]);
    finds("M8 M7 M8", &["1:7 modal-group-conflict"]);
    // Without an axis there is nothing that G153 and SUPA are of.
    assert_eq!(ends("G153\nSUPA D0\nG0 X1"), [[1.0, 0.0, 0.0]]);
}

#[test]
fn compensation_begins_beside_the_second_move() {
    // With 4 mm the tool is at X-2 beside a contour that goes up from X0 (NORM), from however near it comes.
    for from in [
        "X-10 Y-10",
        "X10 Y-10",
        "X-20 Y0",
        "X0 Y-1",
        "X-1 Y0",
        "X-0.5 Y-0.5",
        "X0.1",
    ] {
        let text = format!("T4 M6 D1 F500\nG0 {from}\nG1 G41 X0 Y0\nY20");
        assert_eq!(ends(&text)[1], [-2.0, 0.0, 0.0], "{from}");
    }
}

#[test]
fn a_slower_feed_at_corners_is_read_over() {
    assert_eq!(ends("G62 G1 X1\nG621 X2\nG1 Y1 F50"), ends("G1 X1\nX2\nY1"));
}

#[test]
fn programs_of_steps_are_refused_at_their_head() {
    finds("E_HEAD(0,100,0)", &["1:1 not-supported"]);
}
