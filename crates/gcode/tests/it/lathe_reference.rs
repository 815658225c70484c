//! Tests of lathe cycles, move by move, against what an independent interpreter made of them.
//!
//! `tests/data/gcode/lathe_reference.json` holds random profiles with the moves LinuxCNC 2.9 made
//! of them, X and Z with four decimals: kind, end, and of arcs the centre and the sense.

#![allow(clippy::expect_used, reason = "a test")]

use std::fs;

use glidepath_gcode::{Options, Program};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind, Rate};
use serde_json::Value;

/// Programs moved otherwise than by LinuxCNC, each with the reason.
const OTHER: [(&str, &str); 11] = [
    (
        "lathe-1006",
        "an arc of 1 µm about a corner is left out there",
    ),
    (
        "lathe-1018",
        "an arc of 10 µm about a corner is left out there",
    ),
    (
        "lathe-1044",
        "there the contour comes nearer to the profile than D",
    ),
    (
        "lathe-1046",
        "there the side that is cut depends on which way the profile leads",
    ),
    (
        "lathe-1058",
        "there a start nearer to the profile than D is accepted",
    ),
    (
        "lathe-1059",
        "there the side that is cut depends on which way the profile leads",
    ),
    (
        "lathe-1008",
        "there the way back from a finishing pass leads through the part",
    ),
    (
        "lathe-1045",
        "there the way back from a finishing pass leads through the part",
    ),
    (
        "lathe-1047",
        "there the way back from a finishing pass leads through the part",
    ),
    (
        "lathe-1049",
        "there the way back from a finishing pass comes nearer to the profile than it",
    ),
    (
        "lathe-1075",
        "a wall alone: there G70 goes to it by way of a point beside the start",
    ),
];

/// Kind, end, and of an arc its centre and sense; X before Z.
type Move = (char, [f64; 2], [f64; 3]);

fn ours(text: &str) -> Vec<Move> {
    let mut moves = Vec::new();
    for item in Program::new(text.as_bytes(), Options::default()) {
        let Item { kind, .. } = item.expect("a sound program");
        let ItemKind::Move { segment, rate, .. } = kind else {
            continue;
        };
        let end = [segment.end()[0], segment.end()[2]];
        moves.push(match &segment {
            Segment::Arc(arc) => {
                let [z, x] = arc.center;
                let radius = |end: AxisVector| (end[2] - z).hypot(end[0] - x);
                let apart = radius(segment.start()) - radius(segment.end());
                assert!(apart.abs() < 1e-6, "{apart} mm between the radii of an arc");
                ('A', end, [x, z, arc.sweep_rad.signum()])
            }
            _ if rate == Rate::Rapid => ('T', end, [0.0; 3]),
            _ => ('F', end, [0.0; 3]),
        });
    }
    moves
}

fn theirs(program: &Value) -> Vec<Move> {
    let moves = program["moves"].as_array().expect("moves");
    let to_move = |entry: &Value| {
        let at = |i: usize| entry[i].as_f64().unwrap_or(0.0);
        let kind = entry[0].as_str().and_then(|kind| kind.chars().next());
        (kind.expect("a kind"), [at(1), at(2)], [at(3), at(4), at(5)])
    };
    moves.iter().map(to_move).collect()
}

/// Without moves too short to be seen, and with moves that go on along one line or circle joined:
/// the interpreters cut them at different places.
fn joined(moves: &[Move]) -> Vec<Move> {
    const SEEN_MM: f64 = 3e-4;
    let mut found: Vec<Move> = Vec::new();
    let mut places = vec![[0.0; 2]];
    for &(kind, end, circle) in moves {
        let at = places[places.len() - 1];
        let way = [end[0] - at[0], end[1] - at[1]];
        if way.iter().all(|v| v.abs() < SEEN_MM) {
            continue;
        }
        if let Some(last) = found.last_mut().filter(|last| last.0 == kind) {
            let before = places[places.len() - 2];
            let came = [at[0] - before[0], at[1] - before[1]];
            let longer = came[0].hypot(came[1]).max(way[0].hypot(way[1]));
            let aside = (came[0] * way[1] - came[1] * way[0]).abs() / longer;
            let straight = aside < SEEN_MM && came[0] * way[0] + came[1] * way[1] > 0.0;
            let one_circle = last.2.iter().zip(circle).all(|(p, q)| (p - q).abs() < 5e-4);
            if (kind == 'A' && one_circle) || (kind != 'A' && straight) {
                *last = (kind, end, circle);
                let index = places.len() - 1;
                places[index] = end;
                continue;
            }
        }
        found.push((kind, end, circle));
        places.push(end);
    }
    found
}

#[test]
fn moves_are_those_of_the_reference() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/gcode/lathe_reference.json"
    );
    let text = fs::read_to_string(path).expect("the reference");
    let programs: Value = serde_json::from_str(&text).expect("JSON");
    let programs = programs.as_array().expect("a list");
    let (mut compared, mut failures) = (0, Vec::new());
    for program in programs {
        let name = program["name"].as_str().expect("a name");
        if OTHER.iter().any(|(other, _)| *other == name) {
            continue;
        }
        compared += 1;
        let text = program["text"].as_str().expect("a text");
        let (made, expected) = (joined(&ours(text)), joined(&theirs(program)));
        // Centres of arcs of three decimals are known to a few micrometres.
        let same = |a: &Move, b: &Move| {
            let near = |p: f64, q: f64, most: f64| (p - q).abs() <= most;
            a.0 == b.0
                && a.1.iter().zip(b.1).all(|(p, q)| near(*p, q, 6e-4))
                && a.2.iter().zip(b.2).all(|(p, q)| near(*p, q, 2e-3))
        };
        let differs = made.iter().zip(&expected).position(|(a, b)| !same(a, b));
        if let Some(at) = differs.or((made.len() != expected.len()).then_some(0)) {
            let (ours, theirs) = (made.get(at), expected.get(at));
            failures.push(format!(
                "{name}: move {at} is {ours:?}, expected {theirs:?}\n{text}"
            ));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert_eq!(compared, 49);
}
