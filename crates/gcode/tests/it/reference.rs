//! Tests with small programs, move by move, against what an independent interpreter made of them.
//!
//! `tests/data/gcode/reference.json` holds random programs with canned cycles, cutter radius
//! compensation, tool lengths and every kind of offset, in inches, each with the moves LinuxCNC 2.9
//! made of it, in machine coordinates with four decimals.

#![allow(clippy::expect_used, reason = "a test")]

use std::fs;
use std::sync::Arc;

use glidepath_gcode::{Options, Program, Threading, ToolTable};
use glidepath_geometry::Segment;
use glidepath_program::{Item, ItemKind, Limits, Rate};
use serde_json::Value;

const INCH: f64 = 25.4;
/// Their coordinates have four decimals; sums of rounded offsets are worse.
const TOLERANCE: f64 = 3e-4;

/// The tools of the reference: inches there, mm here.
const TOOLS: &str = "T1 P1 D12.7 Z50.8\nT2 P2 D6.35 Z38.1 X2.54\nT3 P3 D10.16 Z25.4 Q2\n\
    T4 P4 D-7.62 Z12.7\nT5 P5 D0 Z76.2\nT6 P6 D5.08 Z25.4 X25.4 Q3\n";

/// Programs judged or moved otherwise than by the reference, each with the reason.
const OTHER: [(&str, &str); 1] = [(
    "offset-45",
    "G30 X in a rotated system: here the axis X goes to its reference, there X and Y",
)];

/// Kind and end of a move, inches; centre of an arc, in machine X Y Z.
#[derive(Debug, Clone, PartialEq)]
struct Move {
    kind: char,
    end: [f64; 3],
    center: Option<[f64; 2]>,
    turn: f64,
}

fn ours(text: &str) -> (Option<String>, Vec<Move>) {
    let tools = ToolTable::parse(TOOLS.as_bytes()).expect("a tool table");
    let options = Options {
        tools: Some(Arc::new(tools)),
        ..Options::default()
    };
    let mut moves = Vec::new();
    for item in Program::new(text.as_bytes(), options) {
        let Item { kind, .. } = match item {
            Ok(item) => item,
            Err(diagnostic) => return (Some(diagnostic.to_string()), moves),
        };
        let ItemKind::Move { segment, rate, .. } = kind else {
            continue;
        };
        let end = segment.end() / INCH;
        let mut made = Move {
            kind: if rate == Rate::Rapid { 'T' } else { 'F' },
            end: [end[0], end[1], end[2]],
            center: None,
            turn: 0.0,
        };
        if let Segment::Arc(arc) = &segment {
            made.kind = 'A';
            made.center = Some(arc.center.map(|c| c / INCH));
            made.turn = arc.sweep_rad.signum();
        }
        moves.push(made);
    }
    (None, moves)
}

fn theirs(program: &Value) -> Vec<Move> {
    let mut moves = Vec::new();
    for entry in program["moves"].as_array().expect("moves") {
        let kind = entry[0]
            .as_str()
            .and_then(|k| k.chars().next())
            .expect("a kind");
        let at = |i: usize| entry[i].as_f64().unwrap_or(f64::NAN);
        if !matches!(kind, 'T' | 'F' | 'A') {
            continue;
        }
        moves.push(Move {
            kind,
            end: [at(1), at(2), at(3)],
            center: (kind == 'A').then(|| [at(4), at(5)]),
            turn: if kind == 'A' { at(7).signum() } else { 0.0 },
        });
    }
    moves
}

/// Leaves out straight moves too short to be seen in the reference.
fn seen(moves: Vec<Move>) -> Vec<Move> {
    let mut at = [0.0; 3];
    moves
        .into_iter()
        .filter(|m| {
            let short = m
                .end
                .iter()
                .zip(at)
                .all(|(a, b)| (a - b).abs() <= TOLERANCE);
            let keep = m.kind == 'A' || !short;
            if keep {
                at = m.end;
            }
            keep
        })
        .collect()
}

/// Of rapid moves in a row only the last: between the holes of cycles the reference goes slantwise,
/// where we rise first and go down last.
fn last_rapids(moves: Vec<Move>) -> Vec<Move> {
    let next_is_rapid = |i: usize| moves.get(i + 1).is_some_and(|next| next.kind == 'T');
    let kept = (0..moves.len()).filter(|&i| moves[i].kind != 'T' || !next_is_rapid(i));
    kept.map(|i| moves[i].clone()).collect()
}

/// True if the contour of a program with compensation has a corner that is nearly none, or nearly a
/// reversal: there the reference goes on as if it were one exactly, and we do not.
fn has_flat_corner(text: &str) -> bool {
    const FLAT_RAD: f64 = 0.055;
    const NONE_RAD: f64 = 1e-4;
    let contour: String = text
        .lines()
        .filter(|line| !line.starts_with("g41") && !line.starts_with("g42"))
        .flat_map(|line| [line, "\n"])
        .collect();
    let plane = if text.contains("g18") { [2, 0] } else { [0, 1] };
    let mut last: Option<f64> = None;
    Program::new(contour.as_bytes(), Options::default()).any(|item| {
        let Ok(Item {
            kind: ItemKind::Move { segment, .. },
            ..
        }) = item
        else {
            return false;
        };
        let angle = |s: f64| {
            let direction = segment.jet(s).d1;
            let [a, b] = plane.map(|axis| direction[axis]);
            (a.hypot(b) > 1e-9).then(|| b.atan2(a))
        };
        let (Some(start), Some(end)) = (angle(0.0), angle(segment.length())) else {
            return false;
        };
        let turn = last.map(|last| (start - last).sin().atan2((start - last).cos()).abs());
        last = Some(end);
        turn.is_some_and(|turn| {
            let reversal = core::f64::consts::PI - turn;
            (NONE_RAD..FLAT_RAD).contains(&turn) || reversal < FLAT_RAD
        })
    })
}

fn same(a: &Move, b: &Move) -> bool {
    a.kind == b.kind
        && a.turn.total_cmp(&b.turn).is_eq()
        && a.end
            .iter()
            .zip(b.end)
            .all(|(p, q)| (p - q).abs() <= TOLERANCE)
}

#[test]
fn moves_are_those_of_the_reference() {
    let path = std::env::var("GLIDEPATH_REFERENCE").unwrap_or_else(|_| {
        concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../tests/data/gcode/reference.json"
        )
        .to_owned()
    });
    let text = fs::read_to_string(path).expect("the reference");
    let programs: Value = serde_json::from_str(&text).expect("JSON");
    let programs = programs.as_array().expect("a list");
    let (mut failures, mut left_out) = (Vec::new(), 0);
    for program in programs {
        let name = program["name"].as_str().expect("a name");
        let text = program["text"].as_str().expect("a text");
        if name.starts_with("radius") && has_flat_corner(text) {
            left_out += 1;
            continue;
        }
        if OTHER.iter().any(|(other, _)| *other == name) {
            continue;
        }
        let (diagnostic, moves) = ours(text);
        let accepted = program["accepted"] == true;
        if diagnostic.is_none() != accepted {
            failures.push(format!(
                "{name}: {diagnostic:?}, expected {}\n{text}",
                program["error"]
            ));
        } else if accepted {
            let (mut moves, mut expected) = (seen(moves), seen(theirs(program)));
            if name.starts_with("cycle") {
                (moves, expected) = (last_rapids(moves), last_rapids(expected));
            }
            let first = moves.iter().zip(&expected).position(|(a, b)| !same(a, b));
            if moves.len() != expected.len() || first.is_some() {
                let at = first.unwrap_or(moves.len().min(expected.len()));
                failures.push(format!(
                    "{name}: move {at} is\n  {:?}, expected\n  {:?}\n{text}",
                    moves.get(at),
                    expected.get(at)
                ));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} of {}:\n{}",
        failures.len(),
        programs.len(),
        failures.join("\n")
    );
    assert!(programs.len() - left_out >= 200, "{left_out} left out");
}

/// Words judged otherwise than LinuxCNC judges them, each with the reason.
const OTHER_WORDS: [(&str, &str); 20] = [
    ("G10 L0", "it would change the tool table in a file"),
    ("G43.2 Z1", "read here: later versions of LinuxCNC have it"),
    ("G87 X2 Z-1 R1 I1 J1 K1", "undefined there, by its manual"),
    ("G88 X2 Z-1 R1 P1", "undefined there, by its manual"),
    ("M50 P0", OVERRIDES),
    ("M51 P0", OVERRIDES),
    ("M52", OVERRIDES),
    ("M52 P1", OVERRIDES),
    ("M53", OVERRIDES),
    ("M53 P1", OVERRIDES),
    ("M99", "it would begin the program again for ever"),
    ("#5221=3", OFFSETS),
    ("#5161=1", OFFSETS),
    ("#5061=1", OFFSETS),
    ("o100 if [1 EQ 1]", "not ended"),
    ("#1=#<_current_pocket>", POCKETS),
    ("#1=#<_selected_pocket>", POCKETS),
    ("#1=#<_abs_u>", "read here, as those of the other axes"),
    (
        "#1=#<_retract_r_plane>",
        "programs begin with G98 here, which goes higher",
    ),
    (
        "#1=#<_retract_old_z>",
        "programs begin with G98 here, which goes higher",
    ),
];

const OVERRIDES: &str = "the operator's overrides are his";
const OFFSETS: &str = "G10, G28.1 and G92 set it";
const POCKETS: &str = "tools have no pockets here";

/// `tests/data/gcode/linuxcnc-codes.tsv`: words, whether LinuxCNC 2.9 reads them behind
/// `G21 G90 F100 S100 M3` and `G0 X1 Y1 Z1`, and the value of a parameter.
#[test]
fn every_word_that_linuxcnc_reads_is_read_or_listed() {
    let tools = ToolTable::parse(b"T1 P1 Z0 D2").expect("a tool table");
    let mut waits_for_the_spindle = glidepath_gcode::MCodes::default();
    waits_for_the_spindle.declare(19, 19);
    let options = Options {
        tools: Some(Arc::new(tools)),
        connections: glidepath_gcode::Connections::Simulated,
        orients: true,
        m_codes: Arc::new(waits_for_the_spindle),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..Options::default()
    };
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/gcode/linuxcnc-codes.tsv"
    );
    let table = fs::read_to_string(path).expect("the table");
    let (mut compared, mut others) = (0, Vec::new());
    for line in table.lines() {
        let mut fields = line.split('\t');
        let (words, verdict) = (fields.next().expect("words"), fields.next());
        // The value of a parameter is shown by where X goes.
        let shown = fields.next().map(|_| "G0 X#1\n").unwrap_or_default();
        let text = format!("G21 G90 F100 S100 M3\nG0 X1 Y1 Z1\n{words}\n{shown}M2\n");
        let report = glidepath_gcode::check(text.as_bytes(), options.clone());
        let wanted: Option<f64> = line
            .split('\t')
            .nth(2)
            .map(|v| v.parse().expect("a number"));
        let same = report.is_accepted() == (verdict == Some("read"))
            && wanted.is_none_or(|value| (report.final_position[0] - value).abs() < 1e-6);
        let listed = OTHER_WORDS.iter().any(|(other, _)| *other == words);
        if same == listed {
            let first = report.diagnostics.first();
            others.push(format!("{words}: theirs {verdict:?} {wanted:?}; {first:?}"));
        }
        for diagnostic in &report.diagnostics {
            assert!(
                !diagnostic.reason.is_empty() || !diagnostic.help.is_empty(),
                "{words}"
            );
        }
        compared += 1;
    }
    assert!(others.is_empty(), "{}", others.join("\n"));
    assert!(compared > 240, "{compared}");
}
