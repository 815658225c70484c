//! Tests of how FANUC's programs begin in shops: the line of the percent sign, units that are not said, headers that end
//! what is in force, calls of blocks by their number. Values are computed by hand.

use glidepath_gcode::{Dialect, FanucParameters, Machine, Options, Units, check};
use glidepath_geometry::Axis;

use crate::fanuc_calls::{ends, ends_with, options};
use crate::support::listed;

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
}

fn lathe() -> Options {
    Options {
        machine: Machine::new(&[Axis::X, Axis::Z]),
        ..options()
    }
}

fn beginning_in(units: Option<Units>) -> Options {
    Options {
        fanuc: FanucParameters {
            units_at_start: units,
            ..FanucParameters::default()
        },
        ..options()
    }
}

#[test]
fn units_that_nothing_says_are_told() {
    let lacks_units = |text: &str, options: Options| check(text.as_bytes(), options).lacks.units;
    let text = "G90 G0 X1.\nM30\n";
    assert!(lacks_units(text, beginning_in(None)));
    assert!(!lacks_units(text, beginning_in(Some(Units::Millimetre))));
    assert!(!lacks_units("G20 G90 G0 X1.\nM30\n", beginning_in(None)));
    // What moves nothing is the same in both.
    assert!(!lacks_units(
        "S1000 M3\nG21\nG0 X1.\nM30\n",
        beginning_in(None)
    ));
    assert!(lacks_units(
        "G0 X1.\nG20\nG0 X1.\nM30\n",
        beginning_in(None)
    ));
    let linuxcnc = Options {
        dialect: Dialect::LinuxCnc,
        ..beginning_in(None)
    };
    assert!(!lacks_units(text, linuxcnc));
}

#[test]
fn a_control_may_begin_in_inches() {
    let ends = |text: &str, units| ends_with(text, beginning_in(units));
    assert_eq!(ends("G0 X2. Y1.", Some(Units::Inch)), [[50.8, 25.4, 0.0]]);
    assert_eq!(ends("G21 G0 X2.", Some(Units::Inch)), [[2.0, 0.0, 0.0]]);
    assert_eq!(ends("G0 X2. Y1.", None), [[2.0, 1.0, 0.0]]);
}

#[test]
fn a_header_ends_a_scale_and_a_turn_in_one_block() {
    let turned = "G68 X0 Y0 R90.\n";
    let scaled = "G51 X0 Y0 P2.\n";
    assert_eq!(ends(&format!("{turned}G0 X10.")), [[0.0, 10.0, 0.0]]);
    for head in ["G50 G69", "G69 G50", "G00 G17 G40 G49 G50 G69 G80 G90"] {
        for before in ["", turned, scaled] {
            let text = format!("{before}{head}\nG0 X10.");
            assert_eq!(ends(&text), [[10.0, 0.0, 0.0]], "{text}");
        }
    }
    // An end beside what begins.
    let text = format!("{scaled}G50 G68 X0 Y0 R90.\nG0 X10.");
    assert_eq!(ends(&text), [[0.0, 10.0, 0.0]]);
    let text = format!("{turned}G69 G51 X0 Y0 P2.\nG0 X10.");
    assert_eq!(ends(&text), [[20.0, 0.0, 0.0]]);
    let text = format!("{turned}G69 G51.1 X0\nG0 X10.");
    assert_eq!(ends(&text), [[-10.0, 0.0, 0.0]]);
    finds(
        "G51 X0 Y0 P2. G68 X0 Y0 R90.",
        &["1:15 modal-group-conflict"],
    );
    finds("G69 G68 X0 Y0 R90.", &["1:5 modal-group-conflict"]);
}

#[test]
fn a_cycle_of_a_lathe_without_an_axis_cuts_nothing() {
    let ends = |text: &str| ends_with(text, lathe());
    let head = "G21 G18 G40 G80 G90 G99\nT0100 G97 S500 M3\n";
    let found = ends(&format!("{head}G0 X50. Z2.\nG1 Z-5. F.2"));
    assert_eq!(found, [[25.0, 0.0, 2.0], [25.0, 0.0, -5.0]]);
    // The cycle is in force, and needs both ends of its pass.
    let report = check("G99\nG0 X50. Z2.\nG90\nX40. F.2\n".as_bytes(), lathe());
    assert_eq!(listed(&report), ["4:1 missing-word"]);
    let cut = ends("G99 S500 M3\nG0 X50. Z2.\nG90\nX40. Z-5. F.2");
    let way = [[20.0, 2.0], [20.0, -5.0], [25.0, -5.0], [25.0, 2.0]];
    assert_eq!(cut[1..], way.map(|[x, z]| [x, 0.0, z]));
}

#[test]
fn blocks_of_the_program_are_called_by_m98_with_q() {
    let text = "G91\nG0 X1.\nM98 Q100 L2\nX1.\nM30\nN100 Y2.\nM99\n";
    let called = [
        [1.0, 0.0, 0.0],
        [1.0, 2.0, 0.0],
        [1.0, 4.0, 0.0],
        [2.0, 4.0, 0.0],
    ];
    assert_eq!(ends(text), called);
    finds("M98 Q100\nM30\n", &["1:1 unknown-subroutine"]);
    finds(
        "M98 P5 Q100\nM30\nO5\nN100 X1\nM99\n",
        &["1:1 not-supported"],
    );
}

#[test]
fn a_depth_without_a_point_that_no_pass_has_is_refused() {
    let program = |first: &str| {
        format!(
            "G21 G99\nG97 S1000 M3\nG0 X60. Z2.\n{first}\nG71 P100 Q101 U.4 W.1 F.2\nN100 G0 X20.\n\
             G1 Z-30.\nN101 X60.\nM30\n"
        )
    };
    let found = |first: &str| listed(&check(program(first).as_bytes(), lathe()));
    assert_eq!(found("G71 U400 R500")[0], "4:5 ambiguous-word");
    assert_eq!(found("G71 U2. R500")[0], "4:9 ambiguous-word");
    assert!(found("G71 U2 R1").is_empty());
    assert!(found("G71 U40. R1.").is_empty());
}

#[test]
fn the_line_of_the_percent_sign_may_have_a_text() {
    assert_eq!(ends("%O0003\nO0003\nG0 X1.\nM30\n%\n"), [[1.0, 0.0, 0.0]]);
}
