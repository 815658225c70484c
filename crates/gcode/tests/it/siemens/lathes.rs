//! Tests of lathes of SINUMERIK: diameters, feeds by the spindle, threads. X is a radius here.

use std::sync::Arc;

use glidepath_gcode::{Machine, Options, Program, Threading, Tool, ToolTable, check};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Limits, PHASE_STEPS, Rate};

use super::options;
use crate::support::listed;

fn lathe() -> Options {
    let mut tools = ToolTable::new();
    let mut tool = Tool::default();
    (tool.offset[0], tool.offset[2]) = (1.0, 5.0);
    tools.set(4, tool);
    Options {
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Z]),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..options()
    }
}

fn moves(text: &str) -> Vec<([f64; 2], Rate)> {
    Program::new(text.as_bytes(), lathe())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                Some((
                    [0, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0),
                    rate,
                ))
            }
            _ => None,
        })
        .collect()
}

fn last(text: &str) -> f64 {
    moves(text).last().expect("a move").0[0]
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), lathe());
    assert_eq!(listed(&report), expected, "{text}");
}

#[test]
fn increments_and_diameters_go_together() {
    let at_10 = "G18 DIAMON\nG0 X20 Z0\n";
    for (words, radius) in [
        ("X=IC(10)", 15.0),
        ("X=AC(10)", 5.0),
        ("G91 X10", 15.0),
        ("G91 X=AC(10)", 5.0),
        ("G91 X=IC(10)", 15.0),
        ("X=DIC(10)", 15.0),
        ("X=RIC(10)", 20.0),
        ("X=DAC(10)", 5.0),
        ("X=RAC(10)", 10.0),
        ("G91 X=RAC(12)", 12.0),
    ] {
        assert_eq!(last(&format!("{at_10}{words}")), radius, "DIAMON {words}");
    }
    let at_10 = "G18 DIAMOF\nG0 X10 Z0\n";
    for (words, radius) in [
        ("X=IC(10)", 20.0),
        ("X=DAC(10)", 5.0),
        ("X=DIC(10)", 15.0),
        ("X=RAC(12)", 12.0),
        ("X=RIC(10)", 20.0),
    ] {
        assert_eq!(last(&format!("{at_10}{words}")), radius, "DIAMOF {words}");
    }
    // Diameters in G90, radii in G91.
    let at_10 = "G18 DIAM90\nG0 X20 Z0\n";
    for (words, radius) in [
        ("X30", 15.0),
        ("G91 X10", 20.0),
        ("X=IC(10)", 20.0),
        ("G91 X=AC(10)", 5.0),
        ("G91 X=IC(10)", 20.0),
        ("G91 X1\nG90 X30", 15.0),
        ("DIAMOF X3", 3.0),
    ] {
        assert_eq!(last(&format!("{at_10}{words}")), radius, "DIAM90 {words}");
    }
    // What the line itself says of diameters counts.
    let at_10 = "G18\nG0 X10 Z0\n";
    for (words, radius) in [
        ("DIAMON X=IC(10)", 15.0),
        ("DIAMON X=RAC(10)", 10.0),
        ("DIAM90 X=IC(10)", 20.0),
    ] {
        assert_eq!(last(&format!("{at_10}{words}")), radius, "{words}");
    }
    assert_eq!(last("G18 DIAMON\nG0 X20 Z0\nDIAMOF X=IC(10)"), 20.0);
    finds("G18 DIAMON\nG0 Z=DAC(3)", &["2:6 invalid-value"]);
}

#[test]
fn the_cutting_speed_makes_the_feed_one_of_the_spindle() {
    // 0.2 mm a turn; at a radius of 10 mm 200 m/min are more than the limit of 1200.
    let rate = |text: &str| moves(text).last().expect("a move").1;
    let per_minute = Rate::Feed(0.2 / 60.0);
    let by_spindle = Rate::PerRevolution {
        feed_v: 0.2 * 1200.0 / 60.0,
        most_v: f64::INFINITY,
    };
    let is_near = |found: Rate, wanted: Rate| match (found, wanted) {
        (Rate::Feed(a), Rate::Feed(b)) => (a - b).abs() < 1e-9,
        (Rate::PerRevolution { feed_v, .. }, Rate::PerRevolution { feed_v: by, .. }) => {
            (feed_v - by).abs() < 1e-9
        }
        _ => false,
    };
    let head = "G18 LIMS=1200 M4\nG0 X10 Z0\n";
    for (text, wanted) in [
        ("G96 S200\nG1 Z-5 F0.2", by_spindle),
        ("G96 S200 F0.2\nG1 Z-5", by_spindle),
        ("G96 S200\nG97 S1200\nG1 Z-5 F0.2", by_spindle),
        ("G961 S200\nG1 Z-5 F0.2", per_minute),
        ("G96 S200\nG971 S1200\nG1 Z-5 F0.2", per_minute),
        ("G96 S200 G94\nG1 Z-5 F0.2", per_minute),
        // G97 begins a feed per revolution, too, and its speed has the limit of LIMS.
        ("G97 S1200\nG1 Z-5 F0.2", by_spindle),
        ("G97 S2000\nG1 Z-5 F0.2", by_spindle),
        ("LIMS=500\nG973 S1200\nG1 Z-5 F0.2", by_spindle),
        ("G95\nG972 S1200\nG1 Z-5 F0.2", by_spindle),
    ] {
        let found = rate(&format!("{head}{text}"));
        assert!(is_near(found, wanted), "{text}: {found:?}");
    }
}

#[test]
fn the_limit_of_the_speed_holds_for_revolutions_too() {
    let speeds = |text: &str| -> Vec<f64> {
        Program::new(text.as_bytes(), lathe())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Event(Event::SpindleSpeed(speed)) => Some(speed),
                _ => None,
            })
            .collect()
    };
    assert_eq!(speeds("LIMS=300\nG97 S500 M3"), [300.0]);
    assert_eq!(
        speeds("G97 S500 M3\nLIMS=300\nLIMS=400\nLIMS=900\nS200"),
        [500.0, 300.0, 400.0, 500.0, 200.0]
    );
    // Where neither G96 nor G97 is in force, and behind G971 to G973, there is no limit.
    assert_eq!(speeds("LIMS=300\nS500 M3"), [500.0]);
    assert_eq!(speeds("LIMS=300\nG971 S500 M3"), [500.0]);
    assert_eq!(
        speeds("G97 S500 LIMS=300 M3\nG973\nG97"),
        [300.0, 500.0, 300.0]
    );
    // G94 and G95 are of the group of G96: they end it, at the speed that there is.
    let cutting = "G18\nG0 X100 Z0\nG96 S100 LIMS=3000 M3";
    assert_eq!(
        speeds(&format!("{cutting}\nG95 S800\nG1 X5 F0.1")).last(),
        Some(&800.0)
    );
    assert_eq!(
        speeds(&format!("{cutting}\nG94\nG1 X5 F100")),
        speeds(cutting)
    );
    finds("LIMS=0", &["1:1 invalid-value"]);
    finds("LIMS=-5", &["1:1 invalid-value"]);
}

#[test]
fn t_is_the_turret() {
    assert_eq!(moves("G18 T4 D1\nG0 X20 Z0")[0].0, [21.0, 5.0]);
    assert_eq!(moves("G18 T4\nG0 X20 Z0\nD0\nG0 X20 Z0")[1].0, [20.0, 0.0]);
}

#[test]
fn threads_have_the_lead_of_the_longer_way() {
    let begun = |text: &str| -> Vec<(f64, u32)> {
        Program::new(text.as_bytes(), lathe())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Event(Event::Synchronise { pitch_mm, phase }) => Some((pitch_mm, phase)),
                _ => None,
            })
            .collect()
    };
    let head = "G18 S500 M3\nG0 X20 Z5\n";
    assert_eq!(
        begun(&format!("{head}G33 Z-20 K2 SF=90")),
        [(2.0, PHASE_STEPS / 4)]
    );
    // 25 along Z and 5 along X: 2 mm of Z with each turn.
    let taper = begun(&format!("{head}G33 X25 Z-20 K2"))[0].0;
    assert!(
        (taper - 2.0 * 650.0_f64.sqrt() / 25.0).abs() < 1e-12,
        "{taper}"
    );
    let face = begun(&format!("{head}G33 X60 Z0 I2"))[0].0;
    assert!(
        (face - 2.0 * 1625.0_f64.sqrt() / 40.0).abs() < 1e-12,
        "{face}"
    );
    finds(&format!("{head}G33 X25 Z-20 I2"), &["3:14 invalid-value"]);
    finds(&format!("{head}G33 X25 Z-20 K2 I2"), &["3:17 unused-word"]);
}

#[test]
fn cycles_count_radii_where_the_tool_stands() {
    let mill_turn = || Options {
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z]),
        ..lathe()
    };
    let xs = |text: &str| -> Vec<f64> {
        Program::new(text.as_bytes(), mill_turn())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Move { segment, .. } => {
                    Some((segment.end()[0] * 1e6).round() / 1e6 + 0.0)
                }
                _ => None,
            })
            .collect()
    };
    let head = "S500 M3 DIAMON\nG0 X40 Y5 Z50 F100\n";
    // The tool stays at its radius of 20, and X is a diameter again behind the cycle.
    let bored = xs(&format!("{head}CYCLE86(20,0,2,-10,,0,3,0,0,0,0)\nX50"));
    assert_eq!(bored, [20.0, 20.0, 20.0, 20.0, 25.0]);
    let text = head.replace("DIAMON", "DIAM90");
    let bored = xs(&format!(
        "{text}CYCLE86(20,0,2,-10,,0,3,0,0,0,0)\nX50\nG91 X1"
    ));
    assert_eq!(bored, [20.0, 20.0, 20.0, 20.0, 25.0, 26.0]);
    let finds = |text: &str, expected: &[&str]| {
        let report = check(text.as_bytes(), mill_turn());
        assert_eq!(listed(&report), expected, "{text}");
    };
    for cycle in [
        "MCALL CYCLE81(20,0,2,-10)\nHOLES1(0,0,0,10,10,2)",
        "G19\nCYCLE81(50,40,2,20)",
    ] {
        finds(&format!("{head}{cycle}"), &["4:1 canned-cycle"]);
    }
}

/// A lathe begins in G18, whose cycles are along Y: who has none is told of the plane, and not of a word.
#[test]
fn holes_on_the_face_are_in_g17() {
    let text = "G0 X0 Z5 F100 S500 M3\nCYCLE81(10,0,2,-20)";
    let report = check(text.as_bytes(), lathe());
    assert_eq!(listed(&report), ["2:1 canned-cycle"]);
    assert!(report.diagnostics[0].help.contains("G17"));
    let ends: Vec<f64> = moves(&format!("G17 {text}"))
        .iter()
        .map(|(end, _)| end[1])
        .collect();
    assert_eq!(ends, [5.0, 2.0, -20.0, 10.0]);
}
