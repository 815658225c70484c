//! Tests of places and states that printers' programs keep, and offsets of Klipper.

use glidepath_gcode::{Connections, Dialect, Machine, Options, Program, check};
use glidepath_geometry::{Axis, Segment};
use glidepath_program::{Event, ItemKind, Rate};

use crate::support::listed;

fn options() -> Options {
    Options {
        dialect: Dialect::Marlin,
        extruder: Some(Axis::U),
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z, Axis::U]),
        ..Options::default()
    }
}

/// X, Y, Z and the extruder at the end of every move, and its feed, mm/min.
fn moves(text: &str) -> Vec<([f64; 4], f64)> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                let feed = match rate {
                    Rate::Feed(feed_v) => (feed_v * 60.0).round(),
                    _ => 0.0,
                };
                Some(([end[0], end[1], end[2], end[6]], feed))
            }
            _ => None,
        })
        .collect()
}

fn last(text: &str) -> [f64; 4] {
    moves(text).last().expect("a move").0
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    assert_eq!(
        listed(&check(text.as_bytes(), options())),
        expected,
        "{text}"
    );
}

#[test]
fn a_place_is_kept_and_gone_back_to() {
    let text = "G1 X10 Y5 Z1 E2 F1200\nG60 S0\nG1 X50 E3\nG61 S0 F1800\nG1 X11 E4";
    let all = moves(text);
    // The extruder does not move back: it has the coordinate from before.
    assert_eq!(all[2], ([10.0, 5.0, 1.0, 3.0], 1800.0));
    // F was that of the move alone, and E goes on from 2.
    assert_eq!(all[3], ([11.0, 5.0, 1.0, 5.0], 1200.0));
    // Some axes, beside the place; other places.
    let text = "G1 X10 Y5 Z1\nG60 S3\nG1 X50 Y50 Z50\nG60\nG1 X0 Y0 Z0\nG61 S3 X1 Z0";
    assert_eq!(last(text), [11.0, 0.0, 1.0, 0.0]);
    assert_eq!(last(&format!("{text}\nG61")), [50.0, 50.0, 50.0, 0.0]);
    finds("G61 S1", &["1:1 parameter"]);
    finds("G60 S-1", &["1:5 invalid-value"]);
}

#[test]
fn offsets_of_klipper_count_from_the_next_move_on() {
    assert_eq!(
        last("G1 X1 Z1\nSET_GCODE_OFFSET Z=0.2\nG1 X2 Z1"),
        [2.0, 0.0, 1.2, 0.0]
    );
    // It is set, or added; with MOVE the tool goes there.
    let text = "SET_GCODE_OFFSET Z=0.2\nSET_GCODE_OFFSET Z_ADJUST=0.1\nG1 Z1\nSET_GCODE_OFFSET Z=0\nG1 Z1 X1";
    let zs: Vec<f64> = moves(text).into_iter().map(|(end, _)| end[2]).collect();
    assert!((zs[0] - 1.3).abs() < 1e-12 && (zs[1] - 1.0).abs() < 1e-12);
    let all = moves("G1 Z1\nSET_GCODE_OFFSET Z=0.5 MOVE=1 MOVE_SPEED=10\nG1 X5");
    assert_eq!(all[1], ([0.0, 0.0, 1.5, 0.0], 600.0));
    assert_eq!(all[2].0, [5.0, 0.0, 1.5, 0.0]);
    finds("SET_GCODE_OFFSET Z=abc", &["1:18 malformed-number"]);
    finds("SET_GCODE_OFFSET Z", &["1:18 missing-number"]);
    finds("SET_GCODE_OFFSET E=1", &["1:18 unused-word"]);
    finds("SET_GCODE_OFFSET Z=1 MOVE_SPEED=0", &["1:22 bad-feed"]);
}

#[test]
fn states_are_kept_and_brought_back() {
    let text = "G90\nM82\nG1 X10 Y5 Z1 E2 F1200\nSAVE_GCODE_STATE NAME=pause\nG91\nG1 Z10 E-1 F600\nG1 X-5\nRESTORE_GCODE_STATE NAME=pause MOVE=1 MOVE_SPEED=50\nG1 X11 E3";
    let all = moves(text);
    // X, Y and Z go back at 50 mm/s; what was extruded stays.
    assert_eq!(all[3], ([10.0, 5.0, 1.0, 1.0], 3000.0));
    // G90, M82 and F are those from before; E counts from 2 where the extruder is.
    assert_eq!(all[4], ([11.0, 5.0, 1.0, 2.0], 1200.0));
    finds("RESTORE_GCODE_STATE NAME=a", &["1:1 parameter"]);
    finds("SAVE_GCODE_STATE NAME=", &["1:1 missing-word"]);
}

#[test]
fn words_follow_each_other_without_blanks() {
    assert_eq!(last("M82\nG1X20Y10E1.5F600"), [20.0, 10.0, 0.0, 1.5]);
    assert_eq!(last("M83\ng1x20e-2f600"), [20.0, 0.0, 0.0, -2.0]);
    finds("G1 X20e-2e1 F600", &["1:10 duplicate-word"]);
}

#[test]
fn flags_and_checks_of_printers_are_read() {
    // All axes go; nothing is levelled.
    assert_eq!(last("G1 X10 Y5 Z1\nG28 W")[..3], [0.0; 3]);
    assert_eq!(
        last("M862.3 P \"MK3S\" ; model\nM862.1 P0.4\nG1 X1")[0],
        1.0
    );
    finds("M862", &[]);
    finds("M863.1", &["1:1 unknown-m-code"]);
    finds("M600", &["1:1 not-supported"]);
    finds("M207 S1", &["1:1 not-supported"]);
}

#[test]
fn another_extruder_than_the_first_is_refused() {
    let text = "M83\nG1 X1 E1 F600\nT1\nG1 X2 E1";
    finds(text, &["3:1 not-supported"]);
    assert_eq!(last("M83\nT0\nG1 X2 E1 F600"), [2.0, 0.0, 0.0, 1.0]);
    // Heaters of other tools move nothing.
    finds("M104 T1 S200\nM218 T1 X20\nG1 X1", &[]);
}

#[test]
fn a_printer_goes_home_as_its_words_say() {
    // The place is known: O leaves it.
    assert_eq!(last("G1 X10 Y5 Z1\nG28 O"), [10.0, 5.0, 1.0, 0.0]);
    assert_eq!(last("G1 X10 Y5 Z1\nG28 O X"), [10.0, 5.0, 1.0, 0.0]);
    // R: up to Z5 first, then X alone; never down.
    let ends: Vec<[f64; 4]> = moves("G1 X10 Y5 Z1\nG28 R5 X")
        .into_iter()
        .map(|all| all.0)
        .collect();
    assert_eq!(ends[1..], [[10.0, 5.0, 5.0, 0.0], [0.0, 5.0, 5.0, 0.0]]);
    assert_eq!(last("G1 X10 Y5 Z9\nG28 R5 X"), [0.0, 5.0, 9.0, 0.0]);
    // A letter of G61 without a number is the place itself.
    let text = "G1 X10 Y5 Z1\nG60 S1\nG1 X50 Y9\nG61 X S1 Z2";
    assert_eq!(last(text), [10.0, 9.0, 3.0, 0.0]);
    finds("G1 O", &["1:4 flow-structure"]);
}

#[test]
fn settings_of_the_firmware_are_events() {
    for text in [
        "M420 S1",
        "M851 Z-1.2",
        "M211 S0",
        "M217 S10",
        "M555 X1 Y1 W2 H2",
        "M25",
    ] {
        finds(&format!("{text}\nG1 X1"), &[]);
    }
    let stops = |text: &str| {
        Program::new(text.as_bytes(), options())
            .filter(|item| {
                let kind = item.as_ref().expect("a sound program").kind;
                matches!(kind, ItemKind::Event(Event::ProgramStop(_)))
            })
            .count()
    };
    assert_eq!(stops("G1 X1\nM25\nG1 X2"), 1);
}

#[test]
fn a_line_has_one_command() {
    for (text, place) in [
        ("G91 G1 Z5", "1:5"),
        ("M83 G91", "1:5"),
        ("G1 X5 M106 S255", "1:7"),
    ] {
        finds(text, &[&format!("{place} unused-word")]);
    }
    // To the firmware these are words of commands that move nothing.
    for (text, place) in [
        ("G1 X1\nG90 X5", "2:5"),
        ("G1 X1\nM82 E5", "2:5"),
        ("G1 X1\nT0 X5", "2:1"),
        ("G1 X1\nM25 X5", "2:5"),
    ] {
        finds(text, &[&format!("{place} unused-word")]);
    }
    finds(
        "N7 G1 X5\nG28 X Y\nG92 X0 E0\nM104 S200 T0\nG4 P1\nT0\nX6",
        &[],
    );
}

/// A printer that is at home knows where it is: what G92 said of an axis before is gone, and a nozzle that
/// went 4 mm below its bed showed it.
#[test]
fn an_axis_that_is_at_home_counts_from_there() {
    let text = "G90\nG1 X10 Y10 F3000\nG92 Z5\nG28 Z\nG1 Z1";
    assert_eq!(last(text), [10.0, 10.0, 1.0, 0.0]);
    let text = "G1 X10 Y10\nG92 X0 Y0\nG28 X\nG1 X5 Y1";
    assert_eq!(last(text), [5.0, 11.0, 0.0, 0.0], "of X alone");
    let text = "G1 X10 Y10\nG92 X0 Y0\nG28\nG1 X5 Y1";
    assert_eq!(last(text), [5.0, 1.0, 0.0, 0.0]);
    // What SET_GCODE_OFFSET said stays.
    let text = "SET_GCODE_OFFSET X=2\nG1 X10\nG92 X5\nG28 X\nG1 X5";
    assert_eq!(last(text), [7.0, 0.0, 0.0, 0.0]);
}

#[test]
fn circles_come_before_the_arc_and_a_circle_of_one_turn_is_one() {
    let turns = |text: &str| {
        let items = Program::new(text.as_bytes(), options());
        let lengths = items.filter_map(|item| match item.expect("it is read").kind {
            ItemKind::Move {
                segment: segment @ Segment::Arc(_),
                ..
            } => Some(segment.length()),
            _ => None,
        });
        lengths.sum::<f64>() / (20.0 * std::f64::consts::PI)
    };
    for circles in ["", " P0", " P1"] {
        let found = turns(&format!("G1 X10\nG3 I-10{circles}"));
        assert!((found - 1.0).abs() < 1e-9, "{circles}: {found}");
    }
    finds("G1 X10\nG3 I-10 P2", &["2:9 not-supported"]);
    let found = turns("G1 X10\nG3 X0 Y10 I-10 J0 P1");
    assert!((found - 1.25).abs() < 1e-9, "{found}");
    // Klipper takes no radius.
    finds(
        "SET_GCODE_OFFSET Z=0\nG2 X10 Y10 R10",
        &["2:12 not-supported"],
    );
    // Nor does it make arcs in increments.
    finds(
        "SET_GCODE_OFFSET Z=0\nG91\nG2 X10 Y10 I10 J0",
        &["3:1 not-supported"],
    );
}

/// Klipper's G4 has P alone, in milliseconds; Marlin's has S, too, in seconds.
#[test]
fn klipper_does_not_wait_by_s() {
    let waits = |text: &str| -> f64 {
        Program::new(text.as_bytes(), options())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Dwell(seconds) => Some(seconds),
                _ => None,
            })
            .sum()
    };
    let lacks = |text: &str| check(text.as_bytes(), options()).lacks.dwell;
    assert_eq!(waits("G4 S2\nG4 P500"), 2.5);
    assert!(!lacks("G4 S2\nG4 P500"));
    let klipper = "SET_PRESSURE_ADVANCE ADVANCE=0.05\n";
    assert_eq!(waits(&format!("{klipper}G4 S2\nG4 P500")), 0.5);
    assert!(lacks(&format!("{klipper}G4 S2")));
    assert!(!lacks(&format!("{klipper}G4 P500")));
}
