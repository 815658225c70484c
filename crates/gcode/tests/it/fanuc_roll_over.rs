//! Tests of rotary axes of a FANUC that roll over (parameter 1008: ROAx 1, RABx 0).

use glidepath_gcode::{Dialect, FanucParameters, Machine, Options, Program, check};
use glidepath_geometry::Axis;
use glidepath_program::ItemKind;

use crate::support::listed;

fn options() -> Options {
    Options {
        dialect: Dialect::Fanuc,
        machine: Machine::new(&[Axis::X, Axis::Y, Axis::Z, Axis::A]),
        fanuc: FanucParameters {
            rolls_over: true,
            ..FanucParameters::default()
        },
        ..Options::default()
    }
}

/// By how much A turns in each move, to a micro-degree.
fn turns(text: &str, options: Options) -> Vec<f64> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => {
                let [from, to] = [segment.start(), segment.end()].map(|place| place[3]);
                Some(((to - from) * 1e6).round() / 1e6)
            }
            _ => None,
        })
        .collect()
}

/// The example of FANUC's manual (rotary axis roll-over): what A turns by, and the coordinates that it has then.
const MANUAL: &str =
    "G90 G0 A0\nN1 G90 A-150.0\nN2 G90 A540.0\nN3 G90 A-620.0\nN4 G91 A380.0\nN5 G91 A-840.0";

#[test]
fn the_example_of_the_manual() {
    assert_eq!(
        turns(MANUAL, options()),
        [-150.0, -30.0, -80.0, 380.0, -840.0]
    );
    let coordinates = [210.0, 180.0, 100.0, 120.0, 0.0];
    for (lines, coordinate) in (2..=6).zip(coordinates) {
        let text: Vec<&str> = MANUAL.lines().take(lines).collect();
        // The variable of the fourth axis, as a place of X.
        let text = format!("{}\n#100=#5004\nG90 X#100", text.join("\n"));
        let end = check(text.as_bytes(), options()).final_position[0];
        assert!((end - coordinate).abs() < 1e-6, "{text}: {end}");
    }
    // Off: to the angle that is written.
    let off = Options {
        fanuc: FanucParameters::default(),
        ..options()
    };
    assert_eq!(turns(MANUAL, off), [-150.0, 690.0, -1160.0, 380.0, -840.0]);
}

#[test]
fn half_a_turn_is_made_with_rising_angles() {
    assert_eq!(turns("G0 A180.\nA0\nA180.", options()), [180.0; 3]);
    assert_eq!(
        turns("G0 A350.\nA10.\nA370.\nX5", options()),
        [-10.0, 20.0, 0.0]
    );
}

/// In every kind of move: at feed, with other axes, of the machine, in cycles, with a work offset.
#[test]
fn every_absolute_angle_goes_the_shorter_way() {
    for way in ["G1 F100", "G0 X5", "G1 X5 F100", "G53 G0"] {
        let found = turns(&format!("G0 A350.\n{way} A10."), options());
        assert_eq!(found, [-10.0, 20.0], "{way}");
    }
    let found = turns("G0 Z5\nG0 A350.\nG81 A10. Z-1 R1 F100", options());
    assert_eq!(found[..3], [0.0, -10.0, 20.0]);
    let found = turns("G10 L2 P2 A90.\nG55 G0 A350.\nG54 A350.\nG55 A0", options());
    assert_eq!(found, [80.0, -90.0, 100.0]);
    let found = turns("G91 G0 A350.\nA20.", options());
    assert_eq!(found, [350.0, 20.0]);
}

#[test]
fn the_way_to_the_reference_position_has_to_be_said() {
    let finds = |text: &str| listed(&check(text.as_bytes(), options()));
    assert_eq!(finds("G0 A90.\nG91 G28 A0"), ["2:9 ambiguous-word"]);
    assert_eq!(finds("G91 G0 A360.\nG28 A0"), [""; 0]);
    assert_eq!(finds("G0 A90.\nG90 G28 A0"), [""; 0]);
}
