//! Tests of FANUC's and Haas' mills: ends and ways by values computed by hand.

use glidepath_gcode::{
    Arctangent, FanucParameters, Machine, OffsetMemory, Options, PointInput, Program, RemarkKind,
    Tool, ToolTable, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind};
use std::f64::consts::PI;
use std::sync::Arc;

use crate::support::listed;

/// The same with rotary axes.
fn options() -> Options {
    Options {
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C]),
        ..crate::fanuc_calls::options()
    }
}

fn ends_with(text: &str, options: Options) -> Vec<[f64; 3]> {
    let items = Program::new(text.as_bytes(), options);
    items
        .filter_map(
            |item| match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
                ItemKind::Move { segment, .. } => {
                    let end = segment.end();
                    Some([0, 1, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0))
                }
                _ => None,
            },
        )
        .collect()
}

fn ends(text: &str) -> Vec<[f64; 3]> {
    ends_with(text, options())
}

fn last(text: &str) -> [f64; 3] {
    *ends(text).last().expect("a move")
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
    for diagnostic in &report.diagnostics {
        let says_how = !diagnostic.help.is_empty() && !diagnostic.reason.is_empty();
        assert!(says_how, "{diagnostic}");
    }
}

#[test]
fn what_nothing_was_assigned_to_leaves_its_word_out() {
    assert_eq!(last("G0 X5 Y7\n#1=#0\nX#1 Y9\nX#100 Z4"), [5.0, 9.0, 4.0]);
    assert_eq!(
        last("G0 X5\n#2=#1+5\n#3=[#1*5]+2\nX#2 Y#3"),
        [5.0, 2.0, 0.0]
    );
    let jump = |condition: &str| last(&format!("IF [{condition}] GOTO 9\nG0 Y1\nN9 G0 X1"));
    for (condition, holds) in [
        ("#100 EQ #0", true),
        ("#100 EQ 0", false),
        ("#100 NE 0", true),
        ("#100 GE 0", true),
        ("#100 GT 0", false),
    ] {
        assert_eq!(jump(condition)[1] == 0.0, holds, "{condition}");
    }
    finds("#0=1", &["1:1 parameter"]);
}

#[test]
fn operators_and_functions_are_those_of_the_control() {
    for (value, expected) in [
        ("13 AND 6", 4.0),
        ("13 OR 6", 15.0),
        ("13 XOR 6", 11.0),
        // AND is as strong as a product, OR as a sum.
        ("1+3 AND 2", 3.0),
        ("-7 MOD 5", -2.0),
        ("FIX[-2.8]", -2.0),
        ("FUP[-2.2]", -3.0),
        ("POW[2,3]", 8.0),
        ("ATAN[1]", 45.0),
        ("ATAN[-1]/[1]", 315.0),
        ("ATAN[1,-1]", 135.0),
        ("ROUND[ASIN[-.5]]", 330.0),
        ("ASIN[-1]", 270.0),
        ("ROUND[ASIN[.5]]", 30.0),
        ("ROUND[ACOS[-.5]]", 120.0),
        ("ROUND[1.23456]", 1.0),
    ] {
        assert_eq!(last(&format!("#1={value}\nG0 X#1"))[0], expected, "{value}");
    }
    // In a word ROUND rounds to the least increment.
    assert_eq!(last("G0 X[ROUND[1.23456]]")[0], 1.235);
}

#[test]
fn angles_are_below_zero_where_the_control_has_them_so() {
    let mut signed = options();
    signed.fanuc.arctangent = Arctangent::Signed;
    for (value, expected) in [
        ("ATAN[-1]/[1]", -45.0),
        ("ASIN[-.5]", -30.0),
        ("ASIN[-1]", -90.0),
    ] {
        let text = format!("#1=ROUND[{value}]\nG0 X#1");
        let all = ends_with(&text, signed.clone());
        assert_eq!(all.last().expect("a move")[0], expected, "{value}");
    }
}

#[test]
fn macros_take_all_arguments_and_are_called_behind_moves() {
    let text =
        "G65 P9 I1. J2. K3. I4. J5. K6. I7.\nM30\nO9\nG0 X#4 Y#5 Z#6\nX#7 Y#8 Z#9\nX#10\nM99";
    assert_eq!(
        ends(text),
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 5.0, 6.0]]
    );
    // The later of two words for #7 counts.
    assert_eq!(last("G65 P9 I3. I4. D5.\nM30\nO9\nG0 X#7\nM99")[0], 5.0);
    let text = "G66 P9 Z-3.\nG0 X1\nX2\nG67\nX3\nM30\nO9\nG0 Z#26\nZ0\nM99";
    let ways: Vec<_> = ends(text).iter().map(|[x, _, z]| [*x, *z]).collect();
    let hole = |x| [[x, 0.0], [x, -3.0], [x, 0.0]];
    assert_eq!(ways[..6], [hole(1.0), hole(2.0)].concat());
    assert_eq!(ways[6], [3.0, 0.0]);
    assert_eq!(
        last("G0 X5 M98 P9\nM30\nO9\nG91 G0 Y2\nM99"),
        [5.0, 2.0, 0.0]
    );
    assert_eq!(last("G91\nM98 P00030009\nM30\nO0009\nG0 X5\nM99")[0], 15.0);
    assert_eq!(
        last("M98 P9\nG0 X99\nN5 G0 Y1\nM30\nO9\nG0 X3\nM99 P5"),
        [3.0, 1.0, 0.0]
    );
    assert_eq!(last("M97 P50 L2\nM30\nN50 G91 G0 X1\nM99")[0], 2.0);
    finds("G0 X1\nM99", &["2:1 not-supported"]);
    finds("G66 P9\nG66 P9\nM30\nO9\nM99", &["2:1 not-supported"]);
}

#[test]
fn alarms_stop_with_their_text() {
    let report = check("#3000=12(MISSING TOOL)".as_bytes(), options());
    let alarm = &report.diagnostics[0];
    assert_eq!(alarm.code.as_str(), "alarm");
    assert!(
        alarm.message.contains("12: MISSING TOOL"),
        "{}",
        alarm.message
    );
    let mut program =
        Program::new("#3006=1(TURN THE PART)\nG0 X1".as_bytes(), options()).with_remarks();
    let first = program.next().expect("an item").expect("a sound program");
    assert_eq!(first.kind, ItemKind::Event(Event::ProgramStop(0)));
    let remarks = program.take_remarks();
    assert_eq!(
        (remarks[0].kind, remarks[0].text.as_str()),
        (RemarkKind::Stop, "TURN THE PART")
    );
}

#[test]
fn system_variables_are_read_and_written() {
    assert_eq!(last("G91\n#1=#4003\nG90\nG0 X#1")[0], 91.0);
    // The same of the block that is executed.
    assert_eq!(last("G91\n#1=#4203\nG90\nG0 X#1")[0], 91.0);
    assert_eq!(last("#10=#4003\nG91\nG0 X5\nX5\nG#10\nX3")[0], 3.0);
    assert_eq!(
        last("T1\nS1200\nG43 H1\nF500\n#1=#4109/100\n#2=#4119/100\n#3=#4120+#4111\nG0 X#1 Y#2 Z#3"),
        [5.0, 12.0, 12.0]
    );
    // With the length of the tool, and without.
    assert_eq!(
        last("G43 H1 G0 Z2\n#1=#5003\n#2=#5043\n#3=#5083\nG0 X#1 Y#2\nG49 Z#3"),
        [2.0, 12.0, 10.0]
    );
    // The fourth axis of this machine is A.
    assert_eq!(last("G0 A7\n#1=#5024\nX#1")[0], 7.0);
    assert_eq!(last("#5201=3.\n#5221=10.\nG54 G0 X1")[0], 14.0);
    assert_eq!(last("#7001=8.\nG54.1 P1\nG0 X1")[0], 9.0);
    for text in [
        "G0 X#2001",
        "G0 X#5405",
        "G0 X#3001",
        "G0 X#200",
        "#4001=1",
        "#<a>=1",
    ] {
        let report = check(text.as_bytes(), options());
        assert_eq!(report.diagnostics[0].code.as_str(), "parameter", "{text}");
    }
    let memory = |offset_memory| {
        let fanuc = FanucParameters {
            offset_memory,
            ..FanucParameters::default()
        };
        let options = Options { fanuc, ..options() };
        ends_with("G10 L11 P1 R0.5\nG0 X#2001 Y#2201", options)[0]
    };
    assert_eq!(memory(OffsetMemory::C), [0.5, 10.0, 0.0]);
    assert_eq!(memory(OffsetMemory::Haas), [10.0, 0.5, 0.0]);
}

#[test]
fn a_haas_says_by_a_setting_whether_d_is_a_diameter() {
    let of = |offset_memory| {
        let mut options = options();
        options.fanuc.offset_memory = offset_memory;
        options
    };
    for (text, expected) in [
        ("G10 L12 P1 R4.", "1:5 not-supported"),
        ("G10 L13 P1 R.1", "1:5 not-supported"),
        ("G0 X#2401", "1:5 parameter"),
        ("#2601=.1", "1:1 parameter"),
    ] {
        let report = check(text.as_bytes(), of(OffsetMemory::Haas));
        assert_eq!(listed(&report), [expected], "{text}");
        assert!(
            report.diagnostics[0].reason.contains("setting 40"),
            "{text}"
        );
    }
    let sets = "G10 L12 P1 R4.\nG0 X#13001";
    assert_eq!(ends_with(sets, of(OffsetMemory::C)), [[4.0, 0.0, 0.0]]);
    let length = "G10 L10 P1 R4.\nG0 X#2001";
    assert_eq!(ends_with(length, of(OffsetMemory::Haas)), [[4.0, 0.0, 0.0]]);
}

#[test]
fn offsets_are_set_as_the_control_sets_them() {
    assert_eq!(
        last("G10 L2 P1 X10\nG91 G10 L2 P1 X5\nG90 G54 G0 X0")[0],
        15.0
    );
    assert_eq!(last("G10 L2 P0 X3\nG10 L2 P2 X10\nG55 G0 X1")[0], 14.0);
    // Nothing moves, and G54 stays.
    assert_eq!(last("G0 X5\nG10 L20 P1 X10\nG54 G0 X1")[0], 1.0);
    assert_eq!(
        last("G10 L20 P1 X30 Y20\nG54.1 P1 G0 X1 Y1"),
        [31.0, 21.0, 0.0]
    );
    // P is the number of the offset in a cycle, too, and no dwell; that of the cycle stays.
    let drilled = "G10 L20 P1 X30\nG0 Z9\nG99 G82 X1 Y0 Z-5 R2 P100 F100\nG54.1 P1 X2\nG54 P1 X3";
    let dwells: Vec<f64> = Program::new(drilled.as_bytes(), options())
        .filter_map(|item| match item.expect("a sound program").kind {
            ItemKind::Dwell(seconds) => Some(seconds),
            _ => None,
        })
        .collect();
    assert_eq!(dwells, [0.1, 0.1, 0.1]);
    assert_eq!(last(drilled), [33.0, 0.0, 2.0]);
    assert_eq!(
        last("G10 L10 P1 R20.\nG10 L11 P1 R0.5\nG0 G43 H1 Z0")[2],
        20.5
    );
    assert_eq!(last("G44 H1 G0 Z20")[2], 10.0);
    // Radius 5 beside the contour, then one millimetre more.
    let beside = |wear: &str| {
        ends(&format!(
            "G10 L12 P1 R5.\n{wear}\nG0 Y-20\nG41 D1 G1 Y-10\nY20\nG40 X-30"
        ))[1][0]
    };
    assert_eq!(beside(""), -5.0);
    assert_eq!(beside("G10 L13 P1 R1."), -6.0);
    finds("G54.1 P7", &["1:1 not-supported"]);
    finds("G10 L1 P1 R1", &["1:5 not-supported"]);
    finds("G30 P3 Z0", &["1:5 not-supported"]);
    finds("G43 Z5", &["1:1 missing-word"]);
}

#[test]
fn coordinates_are_turned_scaled_and_mirrored() {
    assert_eq!(last("G68 X10 Y0 R90.\nG0 X12 Y0"), [10.0, 2.0, 0.0]);
    assert_eq!(last("G68 X0 Y0 R90.\nG69\nG0 X12 Y0"), [12.0, 0.0, 0.0]);
    // In G91 R is added.
    assert_eq!(
        last("G68 X0 Y0 R30.\nG91 G68 R60.\nG90 G0 X10 Y0"),
        [0.0, 10.0, 0.0]
    );
    let absolute = Options {
        fanuc: FanucParameters {
            rotations_are_absolute: true,
            ..options().fanuc
        },
        ..options()
    };
    let found = ends_with("G68 X0 Y0 R30.\nG91 G68 R90.\nG90 G0 X10 Y0", absolute);
    assert_eq!(found, [[0.0, 10.0, 0.0]]);
    assert_eq!(last("G51 X10 Y0 P2000\nG0 X15 Y3"), [20.0, 6.0, 0.0]);
    assert_eq!(last("G51 X10 Y0 P2.\nG0 X15 Y3"), [20.0, 6.0, 0.0]);
    assert_eq!(last("G51 X0 Y0 I-1. J1.\nG0 X15 Y3"), [-15.0, 3.0, 0.0]);
    // What has no word is about the place of the tool, whatever was in force before: X 20 after the first
    // scale, 25 after the second.
    assert_eq!(
        last("G51 X0 Y0 P2.\nG0 X10 Y3\nG51 Y0 P5.\nX21"),
        [25.0, 6.0, 0.0]
    );
    assert_eq!(
        last("G51 X0 Y0 P2.\nG0 X10 Y0\nG68 R90.\nX11 Y0"),
        [20.0, 2.0, 0.0]
    );
    assert_eq!(last("G51.1 X20\nG0 X5 Y1\nG50.1 X0\nX5"), [5.0, 1.0, 0.0]);
    assert_eq!(ends("G51.1 X20\nG0 X5 Y1")[0], [35.0, 1.0, 0.0]);
    // A mirror image turns the other way round, about the image of the centre: (15, 1) is turned to (9, 5),
    // and mirrored to (31, 5).
    let mirrored = ends("G51.1 X20\nG68 X10 Y0 R90.\nG0 X15 Y1");
    assert!((mirrored[0][0] - 31.0).abs() < 1e-9 && (mirrored[0][1] - 5.0).abs() < 1e-9);
    assert_eq!(
        last("G51.1 X20\nG68 X10 Y0 R90.\nG0 X15 Y1\nG69\nG50.1\nX5 Y1"),
        [5.0, 1.0, 0.0]
    );
    finds("G68 X0 Y0 R90.\nG51.1 X20", &["2:1 not-supported"]);
    finds("G51.1 X20\nG51 X0 Y0 P2.\nG50.1", &["3:1 not-supported"]);
    assert_eq!(last("G51 X0 Y0 P2.\nG50.1\nG0 X5"), [10.0, 0.0, 0.0]);
    finds("G68 R90.\nG52 X1", &["2:1 not-supported"]);
    finds("G51 X0", &["1:1 missing-word"]);
}

#[test]
fn radius_and_angle_are_a_place() {
    let holes = ends("G16\nG0 X50 Y0\nY90.\nG15\nX1 Y1");
    assert_eq!(holes, [[50.0, 0.0, 0.0], [0.0, 50.0, 0.0], [1.0, 1.0, 0.0]]);
    // In G91 about where the tool is; the angle is added.
    assert_eq!(last("G0 X10 Y10\nG16\nG91 X5 Y90.\nY90."), [5.0, 10.0, 0.0]);
}

/// The bolt circle of the manual, with two of its blocks written as one.
#[test]
fn an_angle_that_is_repeated_stays_on_its_circle() {
    let circle = "G17 G16 G90\nG81 X100. Y30. Z-20. R-5. F200.\n";
    let near = |text: &str, [x, y]: [f64; 2]| {
        let end = last(text);
        assert!(
            (end[0] - x).abs() < 1e-9 && (end[1] - y).abs() < 1e-9,
            "{text}: {end:?}"
        );
    };
    near(&format!("{circle}G91 Y120.\nY120."), [0.0, -100.0]);
    near(&format!("{circle}G91 Y120. K2"), [0.0, -100.0]);
    // What follows counts from the last of them.
    near(&format!("{circle}G91 Y60. K2\nY120."), [0.0, -100.0]);
    // A radius is from where the tool is, each time.
    near(
        "G17 G16 G90\nG81 X10. Y0. Z-20. R-5. F200.\nG91 X10. K2",
        [30.0, 0.0],
    );
}

fn length(text: &str) -> f64 {
    let items = Program::new(text.as_bytes(), options());
    items
        .map(
            |item| match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
                ItemKind::Move { segment, .. } => segment.length(),
                _ => 0.0,
            },
        )
        .sum()
}

#[test]
fn corners_are_broken_between_straight_moves() {
    let made = length("G1 X20 ,R5.\nY20\nX0");
    assert!((made - (50.0 + 2.5 * PI)).abs() < 1e-9, "{made}");
    let chamfer = length("G1 X20 ,C2.\nY20");
    assert!(
        (chamfer - (36.0 + 8.0_f64.sqrt())).abs() < 1e-9,
        "{chamfer}"
    );
    // In G91 the next move counts from the corner.
    assert_eq!(last("G91 G1 X20 ,R5.\nY20\nX-5"), [15.0, 20.0, 0.0]);
    // Two corners, one behind the other, and a comment between the moves.
    let both = length("G1 X20 ,C2.\n(A)\nY20 ,R5.\nX0");
    let by_hand = 18.0 + 8.0_f64.sqrt() + 13.0 + 2.5 * PI + 15.0;
    assert!((both - by_hand).abs() < 1e-9, "{both}");
    finds("G1 X20 ,R5.\nM8\nY20", &["2:1 not-supported"]);
    finds("G1 X20 ,R25.\nY20", &["2:1 invalid-value"]);
    finds("G1 X20 ,R5.\nZ20", &["2:1 not-supported"]);
}

#[test]
fn numbers_without_a_point_are_told_apart() {
    finds("G0 X1500", &["1:4 ambiguous-word"]);
    finds("G0 X1500.", &[]);
    let with = |point, text: &str| {
        let fanuc = FanucParameters {
            point,
            ..FanucParameters::default()
        };
        ends_with(text, Options { fanuc, ..options() })[0][0]
    };
    assert_eq!(with(PointInput::Increment, "G0 X1500"), 1.5);
    assert_eq!(with(PointInput::Increment, "G0 X5."), 5.0);
    assert_eq!(with(PointInput::Calculator, "G0 X1500"), 1500.0);
}

#[test]
fn a_program_begins_in_g0_and_g80_leaves_the_code_from_before_the_cycles() {
    assert_eq!(last("X5"), [5.0, 0.0, 0.0]);
    assert_eq!(last("G1 X1\nG81 X2 Z-1 R1\nG80 X5"), [5.0, 0.0, 0.0]);
    // Z5, then across, to R, to the bottom and out.
    assert_eq!(ends("G0 Z5\nG81 Z-1 R1 K0\nX5").len(), 5);
    assert_eq!(
        ends("PART ONE OF TWO\n%\nO1\nG0 X1\n%\nbehind it")[0][0],
        1.0
    );
    assert_eq!(last("/2 G0 X5\nG0 Z1 /4 X9"), [9.0, 0.0, 1.0]);
    let deleted = Options {
        block_delete: true,
        ..options()
    };
    assert_eq!(
        ends_with("/2 G0 X5\nG0 Z1 /4 X9", deleted),
        [[0.0, 0.0, 1.0]]
    );
}

#[test]
fn the_tip_is_followed_on_machines_with_five_axes_alone() {
    finds("G43.4 H1", &["1:1 not-supported"]);
    finds("G68.2 X1 J30", &["1:1 not-supported"]);
    finds("G254", &["1:1 not-supported"]);
}

#[test]
fn polar_words_wait_for_both_a_radius_and_an_angle() {
    finds("G0 X10. Y0\nG16 Y90.", &["2:5 polar"]);
    finds("G0 X10.\nG16\nG91 Y90.", &["3:5 polar"]);
    finds("G0 Y10.\nG16 X5.", &["2:5 polar"]);
    // G15 forgets them; a block without either goes nowhere.
    finds("G16 G0 X5. Y9.\nG15\nG16 Y90.", &["3:5 polar"]);
    assert_eq!(last("G16 G0 Z3.\nX5. Y0.\nY90."), [0.0, 5.0, 3.0]);
}

#[test]
fn a_contour_that_the_tool_does_not_fit_into_is_told_once() {
    let text = "G18 G0 Z3.564 X-18.091\nG41 D2 G1 Z0. X0. F2000\nG1 Z-30.423 X17.183\nG1 Z-63.25 X-2.186\n\
        G2 Z-56.581 X-9.983 R15.\nG1 Z-36.821 X14.023\nG2 Z-5.938 X-11.398 K15.4416 I-12.7104\n\
        G1 Z-11.919 X-47.295\nG40 G1 Z-0.082 X-61.433\nM30";
    let mut tools = ToolTable::new();
    let wide = Tool {
        diameter_mm: 16.0,
        ..Tool::default()
    };
    tools.set(2, wide);
    let options = Options {
        tools: Some(Arc::new(tools)),
        ..options()
    };
    let found = listed(&check(text.as_bytes(), options));
    assert!(
        found.len() == 1 && found[0].ends_with(" gouge"),
        "{found:?}"
    );
}
