//! Tests of the flow of FANUC's programs: where they end, blocks beside calls, arguments, loops.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, FanucParameters, Machine, OffsetMemory, Options, PointInput, Program,
    Tool, ToolTable, check,
};
use glidepath_geometry::Axis;
use glidepath_program::ItemKind;

use crate::support::listed;

/// Tools 1 and 2, 10 and 20 mm long, with a diameter of 6 and 10 mm.
pub(crate) fn options() -> Options {
    let mut tools = ToolTable::new();
    for (number, diameter_mm) in [(1, 6.0), (2, 10.0)] {
        let mut tool = Tool {
            diameter_mm,
            ..Tool::default()
        };
        tool.offset[2] = 10.0 * f64::from(number);
        tools.set(number, tool);
    }
    Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z]),
        ..Options::default()
    }
}

pub(crate) fn ends_with(text: &str, options: Options) -> Vec<[f64; 3]> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => {
                let end = segment.end();
                Some([0, 1, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0))
            }
            _ => None,
        })
        .collect()
}

pub(crate) fn ends(text: &str) -> Vec<[f64; 3]> {
    ends_with(text, options())
}

fn last(text: &str) -> [f64; 3] {
    *ends(text).last().expect("a move")
}

#[track_caller]
pub(crate) fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
    for diagnostic in &report.diagnostics {
        let says_how = !diagnostic.help.is_empty() && !diagnostic.reason.is_empty();
        assert!(says_how, "{diagnostic}");
    }
}

fn counting(text: &str) -> [f64; 3] {
    let fanuc = FanucParameters {
        point: PointInput::Increment,
        ..FanucParameters::default()
    };
    let all = ends_with(text, Options { fanuc, ..options() });
    *all.last().expect("a move")
}

#[test]
fn a_program_ends_where_the_next_one_begins() {
    for next in ["O0002", ":0002", "O<PART>", "<PART>"] {
        let text = format!("%\nO0001\nG0 X1\n{next}\nG0 X6\n%");
        assert_eq!(ends(&text), [[1.0, 0.0, 0.0]], "{next}");
    }
    // Without a number of its own, and with statements alone in front.
    assert_eq!(last("G0 X1\nO2\nX6"), [1.0, 0.0, 0.0]);
    assert_eq!(ends("O1\nM98 P2\nO2\nG0 X6\nM99"), [[6.0, 0.0, 0.0]]);
    // Its own number is no other program, whatever stands in front of it.
    assert_eq!(
        last("(TITLE)\n%\nO1 (PART)\n(MADE TODAY)\nG0 X1"),
        [1.0, 0.0, 0.0]
    );
}

#[test]
fn a_subprogram_that_does_not_return_is_refused() {
    let call = "M98 P2\nG0 X9\nM30\n";
    assert_eq!(last(&format!("{call}O2\nG0 X5\nM99\n%")), [9.0, 0.0, 0.0]);
    // The rest of the program was left out without a word.
    for (end, at) in [("", 5), ("%", 6), ("(END)\n\n", 7), ("O3\nM99", 6)] {
        let text = format!("{call}O2\nG0 X5\n{end}");
        let report = check(text.as_bytes(), options());
        assert_eq!(
            listed(&report),
            [format!("{at}:1 flow-structure")],
            "{text}"
        );
    }
    // M30 ends all of it, wherever it stands.
    assert_eq!(last(&format!("{call}O2\nG0 X5\nM30")), [5.0, 0.0, 0.0]);
}

#[test]
fn a_number_is_that_of_one_program() {
    let subs = "\nM30\nO2\nG0 X6\nM99\nO3\nM99\nO2\nG0 X7\nM99";
    finds(&format!("O1\nM98 P2{subs}"), &["2:1 ambiguous-word"]);
    finds(&format!("O1\nG65 P2{subs}"), &["2:1 ambiguous-word"]);
    // Nothing depends on which of them is meant where nothing calls it.
    finds(&format!("O1\nM98 P3{subs}"), &[]);
    // Not the third repetition of another program either.
    let subs = "\nM30\nO30002\nM99\nO30002\nM99\nO2\nG0 X1\nM99";
    finds(&format!("O1\nM98 P30002{subs}"), &["2:1 ambiguous-word"]);
}

#[test]
fn the_reference_position_is_gone_to_by_named_axes() {
    finds("G91 G28", &["1:5 ambiguous-word"]);
    finds("G91 G30", &["1:5 ambiguous-word"]);
    let fanuc = FanucParameters {
        offset_memory: OffsetMemory::Haas,
        ..FanucParameters::default()
    };
    let options = Options { fanuc, ..options() };
    assert_eq!(
        ends_with("G0 X5 Y6 Z7\nG28", options).last(),
        Some(&[0.0, 0.0, 0.0])
    );
}

#[test]
fn the_block_of_a_call_is_executed_before_it() {
    let sub = "\nM30\nO100\nG0 Y3\nM99";
    for call in [
        "G0 M98 P100 X6",
        "M98 P100 G0 X6",
        "X6 M98 P100",
        "M98 X6 P100 L1 (HOLES)",
        "N10 M98 P100 X6;",
    ] {
        let text = format!("{call}{sub}");
        assert_eq!(ends(&text), [[6.0, 0.0, 0.0], [6.0, 3.0, 0.0]], "{call}");
    }
    // One block: G53 is of its X.
    let text = format!("G10 L2 P1 X50\nG54 G0 X0\nG53 M98 P100 X6{sub}");
    assert_eq!(ends(&text)[1], [6.0, 0.0, 0.0]);
    // Of H other controls make something else, and Q begins inside the program.
    finds(&format!("M98 P100 H5{sub}"), &["1:10 unused-word"]);
    finds(&format!("M98 P100 Q5{sub}"), &["1:1 not-supported"]);
    // An empty L is none.
    assert_eq!(last(&format!("M98 P100 L#100{sub}")), [0.0, 3.0, 0.0]);
}

#[test]
fn g66_calls_its_macro_behind_the_blocks_of_subprograms() {
    let subs = "\nM30\nO8\nG0 X5\nM99\nO7\nX7\nM99\nO9\nG91 G0 Y#25\nG90\nM99";
    let text = format!("G66 P9 Y1.\nM98 P8\nG67\nM98 P8{subs}");
    assert_eq!(ends(&text), [[5.0, 0.0, 0.0], [5.0, 1.0, 0.0]]);
    // The blocks of a macro are its own.
    let text = format!("G66 P9 Y1.\nG65 P7\nG67{subs}");
    assert_eq!(ends(&text), [[7.0, 0.0, 0.0]]);
    finds(
        &format!("G66 P9 Y1.\nM98 P8 X1{subs}"),
        &["2:1 not-supported"],
    );
}

/// Programs of a Haas have numbers of five digits.
#[test]
fn a_number_of_a_haas_is_no_count() {
    let text = "M98 P21000\nM30\nO1000\nG91 G0 X3\nM99";
    assert_eq!(last(text), [6.0, 0.0, 0.0]);
    let haas = Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..options()
    };
    let found = check(text.as_bytes(), haas);
    assert_eq!(listed(&found), ["1:1 unknown-subroutine"]);
}

/// As posts write them into the first line of a program.
#[test]
fn g67_stands_beside_other_codes() {
    let sub = "\nM30\nO9\nG91 G0 Y#25\nG90\nM99";
    let head = "N1 G17 G40 G49 G67 G69 G80 G90";
    assert_eq!(ends(&format!("{head}\nG0 X1{sub}")), [[1.0, 0.0, 0.0]]);
    // No macro is called behind its move.
    let text = format!("G66 P9 Y1.\nG0 X1\nG67 G0 X2 (END){sub}");
    assert_eq!(
        ends(&text),
        [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 1.0, 0.0]]
    );
    finds(&format!("G67 M98 P9{sub}"), &["1:5 not-supported"]);
}

#[test]
fn arguments_count_as_coordinates_do() {
    let call = |words: &str, variable: u32| {
        counting(&format!("G65 P9 {words}\nM30\nO9\nG0 X#{variable}\nM99"))[0]
    };
    for (word, variable) in [
        ("A", 1),
        ("B", 2),
        ("C", 3),
        ("I", 4),
        ("J", 5),
        ("K", 6),
        ("Q", 17),
        ("R", 18),
        ("U", 21),
        ("V", 22),
        ("W", 23),
        ("X", 24),
        ("Y", 25),
        ("Z", 26),
    ] {
        assert_eq!(call(&format!("{word}5000"), variable), 5.0, "{word}");
        assert_eq!(call(&format!("{word}-5000."), variable), -5000.0, "{word}");
        assert_eq!(call(&format!("{word}[2+3]"), variable), 5.0, "{word}");
    }
    for (word, variable) in [
        ("D", 7),
        ("E", 8),
        ("F", 9),
        ("H", 11),
        ("M", 13),
        ("S", 19),
    ] {
        assert_eq!(call(&format!("{word}50"), variable), 50.0, "{word}");
    }
    let inches = counting("G20\nG65 P9 X5000\nM30\nO9\nG0 X#24\nM99");
    assert_eq!(inches[0], 12.7);
    // Not said: as coordinates.
    finds(
        "G65 P9 X5000\nM30\nO9\nG0 X#24\nM99",
        &["1:8 ambiguous-word"],
    );
    finds("G65 P9 S5000\nM30\nO9\nG0 X1\nM99", &[]);
}

#[test]
fn corners_count_as_coordinates_do() {
    let corner = |word: &str| {
        let fanuc = FanucParameters {
            point: PointInput::Increment,
            ..FanucParameters::default()
        };
        let text = format!("G1 X10000 {word}\nY10000");
        ends_with(&text, Options { fanuc, ..options() })
    };
    let broken = [[8.0, 0.0, 0.0], [10.0, 2.0, 0.0], [10.0, 10.0, 0.0]];
    assert_eq!(corner(",C2000"), broken);
    assert_eq!(corner(",R2000"), broken);
    assert_eq!(corner(",C2."), broken);
    finds("G1 X10. ,C2000\nY10.", &["1:9 ambiguous-word"]);
}

#[test]
fn loops_are_numbered_and_conditions_have_comments() {
    let loop_of =
        |number: u32| format!("#1=0\nWHILE[#1 LT 2] DO{number}\n#1=#1+1\nEND{number}\nG0 X#1");
    assert_eq!(last(&loop_of(3))[0], 2.0);
    finds(&loop_of(4), &["2:18 flow-structure"]);
    finds(&loop_of(0), &["2:18 flow-structure"]);
    let jump = "#1=1\nIF [#1 EQ 1] (YES) GOTO 10 (NO)\nG0 X9\nN10 G0 X1";
    assert_eq!(ends(jump), [[1.0, 0.0, 0.0]]);
    assert_eq!(last("IF [1 EQ 1] (A) (B) THEN #1=4\nG0 X#1")[0], 4.0);
}

#[test]
fn a_loop_is_come_into_by_its_do() {
    finds(
        "GOTO 5\nWHILE[#1 LT 2] DO1\nN5 #1=1\nEND1\nG0 X1",
        &["4:4 flow-structure"],
    );
    // It may be left, begun again, and stand within a macro.
    let text = "#1=0\nN1 WHILE[#1 LT 5] DO1\n#1=#1+1\nIF[#1 EQ 2] GOTO 9\nEND1\nN9 IF[#1 LT 4] GOTO 1\nG0 X#1";
    assert_eq!(last(text)[0], 5.0);
    let nested = "#101=0\n#100=0\nWHILE[#100 LT 2] DO1\nG65 P9\n#100=#100+1\nEND1\nG0 X#101\nM30\nO9\n#1=0\nWHILE[#1 LT 3] DO1\n#1=#1+1\n#101=#101+1\nEND1\nM99";
    assert_eq!(last(nested)[0], 6.0);
}

#[test]
fn m_n_and_o_can_be_read() {
    assert_eq!(
        last("S100 M3\nN7 #1=#4113\n#2=#4114\nG0 X#1 Y#2"),
        [3.0, 7.0, 0.0]
    );
    // Of the block before: its number stays until another one.
    assert_eq!(last("N10 G0 X1\nN20 X#4114\nX[#4114+1]"), [21.0, 0.0, 0.0]);
    assert_eq!(
        ends("O1\nG65 P9\nG0 Y#4115\nM30\nO9\nG0 X#4115\nM99"),
        [[9.0, 0.0, 0.0], [9.0, 1.0, 0.0]]
    );
}

/// What is wrong with a number is said of what stands there.
#[test]
fn a_variable_without_a_value_is_named() {
    let message = |text: &str| {
        let report = check(text.as_bytes(), options());
        report.diagnostics[0].message.clone()
    };
    assert_eq!(message("GOTO #1"), "#1 has no value");
    assert_eq!(message("M98 P#100"), "#100 has no value");
    let older = "G65 H of custom macro A is not read";
    assert_eq!(message("G65 H2 P#100 Q#101 R#102"), older);
}
