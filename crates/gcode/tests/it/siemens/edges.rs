//! Tests of edges of tools (D), and of flat D numbers. Values are computed by hand.

use std::sync::Arc;

use glidepath_gcode::{Dialect, Options, Program, SiemensParameters, ToolTable, check};
use glidepath_program::ItemKind;

use super::options;
use crate::support::listed;

/// Tool 2 has three edges: 20, 25 and 30 mm long, 8, 4 and 12 mm thick; the third is 1 mm beside.
const TABLE: &[u8] = b"T1 Z10 D6 ;MILL\nT2 Z20 D8 ;GROOVER\nT2 E2 Z25 D4\nT2 E3 X1 Z30 D12\n";

fn edges() -> Options {
    Options {
        tools: Some(Arc::new(ToolTable::parse(TABLE).expect("a table"))),
        ..options()
    }
}

fn flat() -> Options {
    Options {
        siemens: SiemensParameters {
            flat_d_numbers: true,
            ..SiemensParameters::default()
        },
        ..edges()
    }
}

/// The ends of all moves, to the nanometre.
fn places(text: &str, options: Options) -> Vec<[f64; 3]> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        })
        .map(|end| [0, 1, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0))
        .collect()
}

fn along(axis: usize, text: &str, options: Options) -> Vec<f64> {
    let all = places(text, options).into_iter();
    all.map(|place| place[axis]).collect()
}

#[track_caller]
fn finds(text: &str, options: Options, expected: &[&str]) {
    let report = check(text.as_bytes(), options);
    assert_eq!(listed(&report), expected, "{text}");
    for diagnostic in &report.diagnostics {
        assert!(!diagnostic.reason.is_empty() && !diagnostic.help.is_empty());
    }
}

#[test]
fn d_takes_the_length_of_that_edge() {
    assert_eq!(
        along(2, "T2 M6\nG0 Z1\nD2 Z1\nD3 Z1\nD1 Z1\nD0 Z1", edges()),
        [21.0, 26.0, 31.0, 21.0, 1.0]
    );
    assert_eq!(along(2, "T=\"GROOVER\" M6 D2\nG0 Z1", edges()), [26.0]);
    assert_eq!(places("T2 M6 D3\nG0 X2 Z1", edges()), [[3.0, 0.0, 31.0]]);
    // A tool change that names no edge takes the first one.
    assert_eq!(along(2, "T2 M6 D2\nT2 M6\nG0 Z1", edges()), [21.0]);
    // Before M6 D is an edge of the tool that is still in the spindle.
    assert_eq!(along(2, "T2 D2\nM6\nG0 Z1\nD2 Z1", edges()), [21.0, 26.0]);
    finds("T2 M6\nD4", edges(), &["2:1 unknown-tool"]);
    finds("T1 M6\nD2", edges(), &["2:1 unknown-tool"]);
}

#[test]
fn compensation_takes_the_radius_of_the_edge() {
    let beside = |text: &str, options| {
        let text = text.replace("G41", "G0 Y-20\nG1 G41 X0 Y-10 F100");
        along(0, &format!("{text}\nY20"), options).last().copied()
    };
    assert_eq!(beside("T2 M6 D2\nG41", edges()), Some(-2.0));
    // D of the same block, which is 1 mm beside the others.
    assert_eq!(beside("T2 M6\nG41 D3", edges()), Some(-5.0));
    assert_eq!(beside("T2 M6 D2\nT1 M6\nG41", edges()), Some(-3.0));
    assert_eq!(beside("T2 M6 D2\nG41 T1 M6", edges()), Some(-3.0));
    assert_eq!(beside("T2 M6 D0\nG41", edges()), Some(0.0));
    // On the contour it stays the same edge.
    let start = "T2 M6 D2\nG0 Y-20\nG1 G41 X0 Y-10 F100\nY20";
    assert_eq!(
        along(0, &format!("{start} D2\nY30"), edges()).last(),
        Some(&-2.0)
    );
    for other in ["D1", "D3", "D0"] {
        let text = format!("{start} {other}\nY30\nG40 X-20");
        finds(&text, edges(), &["4:5 cutter-radius"]);
    }
    assert_eq!(
        along(2, &format!("{start}\nG40 X-20 D0\nZ1"), edges()).last(),
        Some(&1.0)
    );
}

#[test]
fn cycles_take_the_radius_of_the_edge() {
    let widest = |edge: &str| {
        let pocket = "POCKET4(5,0,2,-4,20,0,0,4,0,0,300,100,2,2,1)";
        let text = format!("T2 M6 {edge}\nG0 X0 Y0 Z10\nF100\n{pocket}");
        let all = places(&text, edges()).into_iter();
        all.map(|[x, y, _]| x.hypot(y)).fold(0.0, f64::max)
    };
    // The edge of the pocket is 20 from its middle.
    assert!((widest("D1") - 16.0).abs() < 1e-6);
    assert!((widest("D2") - 18.0).abs() < 1e-6);
    finds(
        "T2 M6 D0\nF100\nPOCKET4(5,0,2,-4,20,0,0,4,0,0,300,100,2,2,1)",
        edges(),
        &["3:1 canned-cycle"],
    );
}

#[test]
fn variables_show_and_set_every_edge() {
    let shown = "T2 M6 D2\nG0 X=$P_TOOLNO*10+$P_TOOL\nX=$P_TOOLR\nX=$P_TOOLL[1]\nX=$TC_DP3[2,3]+$TC_DP6[2,2]";
    assert_eq!(along(0, shown, edges()), [22.0, 2.0, 25.0, 32.0]);
    let set = "$TC_DP3[2,2]=27\n$TC_DP6[2,2]=3\nT2 M6 D2\nG0 Z1\nZ=$P_TOOLR\nD1 Z1";
    assert_eq!(along(2, set, edges()), [28.0, 30.0, 21.0]);
    let new = "$TC_DP1[7,1]=120\n$TC_DP3[7,1]=50\n$TC_DP3[7,2]=60\nT7 M6 D2\nG0 Z1\nD1 Z1";
    assert_eq!(along(2, new, edges()), [61.0, 51.0]);
    finds("$TC_DP1[2,2]=0", edges(), &["1:1 not-supported"]);
    finds("$TC_DP3[2,0]=5", edges(), &["1:1 not-supported"]);
    finds("$TC_DP3[2]=5", edges(), &["1:1 not-supported"]);
    finds("R1=$TC_DP3[2,4]", edges(), &["1:4 not-supported"]);
}

#[test]
fn flat_d_numbers_are_lines_of_the_table() {
    assert_eq!(
        along(2, "T1 M6 D2\nG0 Z1\nD1 Z1\nD2 Z1\nT2 M6\nZ1\nD0 Z1", flat()),
        [21.0, 11.0, 21.0, 11.0, 1.0]
    );
    let beside = "T1 M6 D2\nG0 Y-20\nG1 G41 X0 Y-10 F100\nY20";
    assert_eq!(along(0, beside, flat()).last(), Some(&-4.0));
    let set = "$TC_DP3[777]=7\n$TC_DP6[777]=3\nT1 M6 D777\nG0 Z1\nZ=$P_TOOL\nZ=$TC_DP6[2]+$P_TOOLR";
    assert_eq!(along(2, set, flat()), [8.0, 784.0, 14.0]);
    finds("T1 M6\nD3", flat(), &["2:1 unknown-tool"]);
    finds("$TC_DP3[1,1]=5", flat(), &["1:1 not-supported"]);
    finds("G1 G41 X0 Y-10 F100", flat(), &["1:4 missing-word"]);
    // Without a line of D1 a tool change has to leave the offsets alone.
    let table = b"T5 Z5\nT8 Z18\n";
    let others = |edge_after_change| Options {
        tools: Some(Arc::new(ToolTable::parse(table).expect("a table"))),
        siemens: SiemensParameters {
            edge_after_change,
            ..flat().siemens
        },
        ..flat()
    };
    finds("T8\nM6\nD8", others(true), &["2:1 unknown-tool"]);
    assert_eq!(along(2, "T5\nM6\nD8\nG0 Z1", others(false)), [19.0]);
}

#[test]
fn other_languages_take_the_first_edge() {
    let read = |dialect| Options { dialect, ..edges() };
    for dialect in [Dialect::LinuxCnc, Dialect::Fanuc] {
        let text = "G90 G21\nT2 M6\nG43 H2\nG0 Z1.\n";
        assert_eq!(along(2, text, read(dialect)), [21.0]);
    }
    // What it changes is the first edge, too.
    let text = "G10 L1 P2 Z33 R5\nT2 M6 G43\nG0 Z1";
    assert_eq!(along(2, text, read(Dialect::LinuxCnc)), [34.0]);
}

#[test]
fn the_next_program_begins_with_the_edge_in_force() {
    let mut first = Program::new("T2 M6 D2\n".as_bytes(), edges());
    assert!(first.by_ref().all(|item| item.is_ok()));
    let text = serde_json::to_string(&first.in_force()).expect("text");
    let again = serde_json::from_str(&text).expect("the same");
    for in_force in [first.in_force(), again] {
        let next = Options {
            in_force: Some(in_force),
            ..edges()
        };
        let text = "G0 Y-20 Z1\nG1 G41 X0 Y-10 F100\nY20";
        let found = places(text, next);
        assert_eq!(found.first(), Some(&[0.0, -20.0, 26.0]));
        assert_eq!(found.last(), Some(&[-2.0, 20.0, 26.0]));
    }
    // Where the change was not made, the edge before is the one in force.
    let mut first = Program::new("T2 M6 D2\nT1 M6\n".as_bytes(), edges());
    assert!(first.by_ref().all(|item| item.is_ok()));
    let next = Options {
        in_force: Some(first.in_force().before_tool_change()),
        ..edges()
    };
    assert_eq!(along(0, "G0 X=$P_TOOL*10+$P_TOOLR", next), [22.0]);
}
