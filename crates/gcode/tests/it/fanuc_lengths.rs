//! Tests of tool lengths on FANUC's mills where Z counts in increments: ends by hand.

use std::sync::Arc;

use glidepath_gcode::{Connections, Dialect, Machine, Options, Program, Tool, ToolTable};
use glidepath_geometry::Axis;
use glidepath_program::ItemKind;

/// Tools 1 and 2, 10 and 20 mm long.
fn options() -> Options {
    let mut tools = ToolTable::new();
    for number in [1, 2] {
        let mut tool = Tool::default();
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

/// Z of the machine at the end of every move.
fn heights(text: &str) -> Vec<f64> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some((segment.end()[2] * 1e6).round() / 1e6 + 0.0),
            _ => None,
        })
        .collect()
}

#[test]
fn a_change_of_the_length_is_added_to_the_next_increment() {
    for (text, expected) in [
        ("G91 G43 H1 G0 Z5", vec![15.0]),
        ("G91 G44 H1 G0 Z5", vec![-5.0]),
        // Without Z it waits for the next one, whatever moves between.
        ("G91 G43 H1\nG0 X5\nZ5\nZ1", vec![0.0, 15.0, 16.0]),
        ("G43 H1 G0 Z5\nG91 G49 Z-5", vec![15.0, 0.0]),
        ("G43 H1 G0 Z5\nG91 H2 Z5", vec![15.0, 30.0]),
        ("G43 H1 G0 Z5\nG91 G49\nG43 H2 Z1", vec![15.0, 26.0]),
        // On and off again is no change.
        ("G43 H1 G0 Z5\nG49\nG43 H1\nG91 Z1", vec![15.0, 16.0]),
        // A Z of G90 makes it as well.
        ("G43 H1\nG90 G0 Z5\nG91 Z1", vec![15.0, 16.0]),
        ("G43 H1\nG0 Z5\nG1 Z4\nG91 Z1", vec![15.0, 14.0, 15.0]),
        // In inches.
        ("G20\nG91 G43 H1 G0 Z1", vec![35.4]),
    ] {
        assert_eq!(heights(text), expected, "{text}");
    }
}

#[test]
fn arcs_and_cycles_count_from_there_too() {
    // A helix.
    let helix = heights("G91 G43 H1\nG2 X10 Y0 Z-2 I5 J0");
    assert_eq!(helix, [8.0]);
    // The initial level is 10 + 5: R is 3 below it, the bottom 4 below R; it comes back to it.
    let hole = heights("G0 Z5\nG91 G43 H1 G81 R-3 Z-4");
    assert_eq!(hole, [5.0, 12.0, 8.0, 15.0]);
}

/// The initial level is the place of the program, although Z has not made the length yet.
#[test]
fn a_cycle_comes_back_to_the_level_of_the_program() {
    for (text, expected) in [
        (
            "G90 G0 Z10\nG43 H1\nG98 G81 X10 Z-5 R2 F600\nX20",
            vec![10.0, 10.0, 12.0, 5.0, 20.0, 20.0, 12.0, 5.0, 20.0],
        ),
        // In the block of the cycle.
        (
            "G0 Z10\nG43 H1 G98 G81 Z-5 R2 F600",
            vec![10.0, 12.0, 5.0, 20.0],
        ),
        // H alone.
        (
            "G43 H1 G0 Z5\nH2\nG98 G81 Z-3 R2 F600",
            vec![15.0, 22.0, 17.0, 25.0],
        ),
        // A shorter tool.
        (
            "G43 H2 G0 Z5\nG49\nG98 G81 Z-3 R2 F600",
            vec![25.0, 2.0, -3.0, 5.0],
        ),
        (
            "G0 Z5\nG91 G43 H1\nG98 G81 R-3 Z-4",
            vec![5.0, 12.0, 8.0, 15.0],
        ),
    ] {
        assert_eq!(heights(text), expected, "{text}");
    }
}

#[test]
fn the_way_to_the_reference_position_begins_where_the_tool_is() {
    assert_eq!(
        heights("G43 H1 G0 Z5\nG91 G28 Z0 G49\nZ-2"),
        [15.0, 0.0, -2.0]
    );
    assert_eq!(
        heights("G43 H1 G0 Z5\nG49\nG91 G28 Z0\nZ-2"),
        [15.0, 0.0, -2.0]
    );
    // A place of the machine is one.
    assert_eq!(
        heights("G43 H1 G0 Z5\nG49\nG53 Z7\nG91 Z-2"),
        [15.0, 7.0, 5.0]
    );
}
