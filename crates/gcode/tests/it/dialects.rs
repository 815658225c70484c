//! Tests of programs of other controls.

#![allow(
    clippy::expect_used,
    clippy::float_cmp,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test"
)]

use std::fs;
use std::sync::Arc;

use crate::support::listed;
use glidepath_gcode::{
    Connections, Dialect, Firmware, MCodes, Machine, Options, Program, Report, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, PathMode, Rate};
use glidepath_testing::corpus;

fn options(dialect: Dialect) -> Options {
    Options {
        dialect,
        extruder: Some(Axis::U),
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        ..Options::default()
    }
}

/// X of every move, and U behind a slash where it is not zero; dwells in seconds.
fn path(dialect: Dialect, text: &str) -> Vec<String> {
    let items = Program::new(text.as_bytes(), options(dialect));
    items
        .filter_map(|item| match item.expect("a sound program").kind {
            ItemKind::Move { segment, .. } => {
                let [x, u] = [0, 6].map(|axis| (segment.end()[axis] * 1e3).round() / 1e3);
                Some(if u == 0.0 {
                    format!("{x}")
                } else {
                    format!("{x}/{u}")
                })
            }
            ItemKind::Dwell(seconds) => Some(format!("dwell {seconds}")),
            ItemKind::Event(_) => None,
        })
        .collect()
}

#[track_caller]
fn finds(dialect: Dialect, text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options(dialect));
    assert_eq!(listed(&report), expected, "{text}");
}

#[test]
fn the_extruder_is_an_axis_with_modes_of_its_own() {
    let text = "M82\nG92 E0\nG1 X1 E2 F600\nG1 X2 E3\nM83\nX3 E1\nG92 E0\nG1 E0.5\nG91\nX1 E1";
    assert_eq!(
        path(Dialect::Marlin, text),
        ["1/2", "2/3", "3/4", "3/4.5", "4/5.5"]
    );
    // Behind M83 G90 means one thing to Marlin and another to Klipper.
    let text = "M83\nG90\nG1 X1 E2 F600\nG1 X2 E3";
    finds(
        Dialect::Marlin,
        text,
        &["3:7 ambiguous-word", "4:7 ambiguous-word"],
    );
    let extruded = |firmware: Option<Firmware>, text: &str| {
        let options = Options {
            firmware,
            ..options(Dialect::Marlin)
        };
        let items = Program::new(text.as_bytes(), options);
        let ends = items.filter_map(|item| match item.expect("a sound program").kind {
            ItemKind::Move { segment, .. } => Some(segment.end()[6]),
            _ => None,
        });
        ends.last()
    };
    assert_eq!(extruded(Some(Firmware::Marlin), text), Some(3.0));
    assert_eq!(extruded(Some(Firmware::Klipper), text), Some(5.0));
    // Whoever has commands with names is Klipper.
    let named = format!("SET_FAN_SPEED FAN=a SPEED=1\n{text}");
    assert_eq!(extruded(None, &named), Some(5.0));
    finds(Dialect::LinuxCnc, "G1 X1 E1", &["1:7 unknown-word"]);
    let none = Options {
        extruder: None,
        ..options(Dialect::Marlin)
    };
    let report = check(b"G1 X1 E1".as_slice(), none);
    assert_eq!(report.diagnostics[0].code.as_str(), "axis-not-configured");
}

/// A printer of which nothing is connected.
fn unconnected_printer() -> Options {
    Options {
        connections: Connections::None,
        extruder: None,
        ..options(Dialect::Marlin)
    }
}

#[test]
fn printers_have_checksums_functions_and_slow_rapids() {
    assert_eq!(
        path(Dialect::Marlin, "N3 G1 X7*100\nG4 P500\nG4 S2\n"),
        ["7", "dwell 0.5", "dwell 2"]
    );
    finds(Dialect::Marlin, "N3 G1 X8*100", &["1:9 checksum"]);
    let report = check(
        b"M104 S200\nM117 X1 it goes (on\nM82\nG29".as_slice(),
        unconnected_printer(),
    );
    let found: Vec<_> = report
        .diagnostics
        .iter()
        .map(|d| (d.line, d.code.as_str()))
        .collect();
    assert_eq!(found, [(1, "not-connected"), (4, "not-supported")]);
    // With an extruder they are events, but for those that wait: somebody has to say for what.
    let printer = Options {
        extruder: Some(Axis::U),
        ..unconnected_printer()
    };
    let text =
        b"M104 S200\nM106 S255 ; fan\nM107\nM220 S100\nM109 S200\nM220 S50\nM200 D1.75\nM206 X5";
    let report = check(text.as_slice(), printer.clone());
    assert_eq!(
        listed(&report),
        [
            "5:1 not-connected",
            "6:6 not-supported",
            "7:6 not-supported",
            "8:1 not-supported"
        ]
    );
    let mut m_codes = MCodes::default();
    m_codes.declare(109, 109);
    let waiting = Options {
        m_codes: Arc::new(m_codes),
        ..printer
    };
    let text = b"M104 S200\nM109 S200\nM117 Layer 1; of 2\nM84";
    let mut program = Program::new(text.as_slice(), waiting).with_remarks();
    let events: Vec<_> = program
        .by_ref()
        .map(|item| item.expect("a sound program").kind)
        .collect();
    let codes = [104, 109, 117, 84].map(|code| ItemKind::Event(Event::MCode(code)));
    assert_eq!(events, codes);
    assert_eq!(program.take_remarks()[0].text, "Layer 1");
    let item = Program::new(b"G0 X1 F60".as_slice(), options(Dialect::Marlin)).next();
    let kind = item.expect("a move").expect("a sound program").kind;
    assert!(matches!(kind, ItemKind::Move { rate: Rate::Feed(v), .. } if (v - 1.0).abs() < 1e-12));
}

#[test]
fn macro_statements_jump_and_loop() {
    let text = "%\n:0001 (MAIN)\n#1=0\nWHILE [#1 LT 3] DO 1\n#1=#1+1\nIF [#1 EQ 2] THEN #2=10\nG0 X[#1+#2]\nEND 1\n\
                IF [#1 EQ 3] GOTO 20\nX99\nN20 X5\nM30\n%\n";
    assert_eq!(path(Dialect::Fanuc, text), ["1", "12", "13", "5"]);
    // Back to the beginning, and forward to a block behind.
    let text = "N1 #1=#1+1\nG0 X#1\nIF [#1 LT 3] GOTO 1\nGOTO 99\nX50\nN99\n";
    assert_eq!(path(Dialect::Fanuc, text), ["1", "2", "3"]);
}

#[test]
fn subprograms_have_parameters_and_repeat() {
    let text = "O1\nG65 P9010 X2 A5 L2\nM98 P20\nG0 X0\nM30\nO20\nG91 G0 X1\nG90\nM99\nO9010\nG0 X[#24*10+#1]\nX#1\nM99\n";
    assert_eq!(path(Dialect::Fanuc, text), ["25", "5", "25", "5", "6", "0"]);
    finds(Dialect::Fanuc, "G65 P7", &["1:1 unknown-subroutine"]);
    finds(Dialect::Fanuc, "O1\nM98 P1\nM99", &["2:1 call-depth"]);
    finds(Dialect::Fanuc, "G0 X1\nGOTO 5\nX2", &["2:5 flow-structure"]);
    finds(Dialect::Fanuc, "IF [1 EQ 1] X1", &["1:13 flow-structure"]);
    finds(
        Dialect::Fanuc,
        "WHILE [0 EQ 1] DO 1\nX1",
        &["1:6 flow-structure"],
    );
}

#[test]
fn words_that_mean_something_else_on_a_fanuc() {
    assert_eq!(
        path(Dialect::Fanuc, "G04 P1500\nG4 X2.5"),
        ["dwell 1.5", "dwell 2.5"]
    );
    assert_eq!(
        path(Dialect::Fanuc, "G0 X5\nG0 G91 G28 X0\nG90 X3"),
        ["5", "0", "3"]
    );
    assert_eq!(path(Dialect::Fanuc, "G05.1 Q1 R5\nG0 X1\nG05 P0"), ["1"]);
    assert_eq!(
        path(Dialect::Fanuc, "G91 G99 G82 X1 Z-1 R1 P500 K2").len(),
        9
    );
    // The radius may be called H, but for a block that has a length.
    finds(Dialect::Fanuc, "G42 H7 G1 X1", &["1:5 unknown-tool"]);
    finds(Dialect::Fanuc, "G42 H7 D7 G1 X1", &["1:8 unknown-tool"]);
    finds(Dialect::LinuxCnc, "G42 H7 G1 X1 F9", &["1:5 unused-word"]);
    finds(Dialect::Fanuc, "G43.4 H1 Z5", &["1:1 not-supported"]);
    finds(Dialect::Fanuc, "N1 G0 X1 X2", &["1:10 duplicate-word"]);
}

#[test]
fn a_loop_of_a_macro_that_does_nothing_ends() {
    let text = "N1 #1=1\nGOTO 1\n";
    finds(Dialect::Fanuc, text, &["1:1 endless-loop"]);
}

#[test]
fn r_parameters_and_tolerances() {
    let text = "R1=2\nR2=R1*(3+1)\nN5 G0 X=R2 Y=SIN(30)\nG1 X=-R1+1 F=R2*10\nM30\n";
    assert_eq!(path(Dialect::Siemens, text), ["8", "-1"]);
    let tolerance = |text: &str| {
        Program::new(text.as_bytes(), options(Dialect::Siemens))
            .find_map(|item| match item.expect("a sound program").kind {
                ItemKind::Move { mode, .. } => Some(mode),
                _ => None,
            })
            .expect("a move")
    };
    let within = |mm: Option<f64>| PathMode::Continuous { tolerance_mm: mm };
    assert_eq!(tolerance("CYCLE832(0.05,1)\nG0 X1"), within(Some(0.05)));
    assert_eq!(tolerance("G641 ADIS=0.25\nG0 X1"), within(Some(0.25)));
    assert_eq!(tolerance("G642\nG0 X1"), within(None));
    assert_eq!(tolerance("G60\nG0 X1"), PathMode::ExactStop);
    finds(
        Dialect::Siemens,
        "G0 X1\nN10 G1 X=DC(5)",
        &["2:10 invalid-value"],
    );
    finds(Dialect::Siemens, "G0 X=R1+5 X2", &["1:11 duplicate-word"]);
    finds(
        Dialect::Siemens,
        "TRAORI\nG1 X=5/0",
        &["1:1 not-supported", "2:7 arithmetic"],
    );
}

fn judge(directory: &std::path::Path, name: &str) -> (Dialect, Report) {
    let bytes = fs::read(directory.join(name)).expect("a program");
    let dialect = Dialect::detect(&bytes, &Machine::unlimited()).dialect;
    (dialect, check(bytes.as_slice(), options(dialect)))
}

#[test]
fn programs_of_other_controls_are_read_or_refused_by_name() {
    let Some(directory) = corpus() else { return };
    for (name, dialect, straight_moves) in [
        ("print/octocat-e.gcode", Dialect::Marlin, 25_000),
        ("print/screw-arcs-e.gcode", Dialect::Marlin, 5_000),
    ] {
        let (found, report) = judge(&directory, name);
        assert_eq!(found, dialect, "{name}");
        assert!(
            report.is_accepted(),
            "{name}: {:?}",
            report.diagnostics.first()
        );
        let made = report.totals.straight_feeds;
        assert!(made > straight_moves, "{name}: {made}");
    }
    let mut others = Vec::new();
    for (name, dialect, line, code) in [
        ("fanuc/haas-macro.nc", Dialect::Fanuc, 7, "parameter"),
        ("fanuc/fanuc0m-comp.nc", Dialect::Fanuc, 7, "unknown-tool"),
        (
            "dialect-authored/fanuc-5axis-g051.nc",
            Dialect::Fanuc,
            7,
            "not-supported",
        ),
        (
            "dialect-authored/sinumerik-cycle832.mpf",
            Dialect::Siemens,
            3,
            "unknown-tool",
        ),
        (
            "siemens/sinumerik840d.nc",
            Dialect::Siemens,
            24,
            "unknown-subroutine",
        ),
        (
            "siemens/sinumerik-synact.mpf",
            Dialect::Siemens,
            1,
            "flow-structure",
        ),
    ] {
        let (found, report) = judge(&directory, name);
        assert_eq!(found, dialect, "{name}");
        let first = report.diagnostics.first().expect("a diagnostic");
        if (first.line, first.code.as_str()) != (line, code) {
            others.push(format!("{name}: {first}"));
        }
        assert!(
            !first.help.is_empty() || !first.reason.is_empty(),
            "{name}: {first}"
        );
    }
    assert!(others.is_empty(), "{}", others.join("\n"));
}
