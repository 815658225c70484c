//! Tests of the first move behind G68 of a FANUC that names one coordinate (parameter 11600#5, AX1).

use glidepath_gcode::{FanucParameters, Options, RotationStart};

use crate::fanuc_calls::{ends_with, finds, options};

/// Where the last move of a program ends.
fn last(text: &str, rotation_start: RotationStart) -> [f64; 3] {
    let options = Options {
        fanuc: FanucParameters {
            rotation_start,
            ..options().fanuc
        },
        ..options()
    };
    *ends_with(text, options).last().expect("a move")
}

/// The example of FANUC's manual, as which both settings are told.
const MANUAL: &str = "G90 G0 X0 Y0\nG1 X10. Y10. F2000\nG68 X0 Y0 R45.\nY14.14213562";

#[test]
fn the_coordinate_left_out_is_as_before_or_as_rotated() {
    // (10, 14.142) turned by 45°: ((10 − 14.142)/√2, (10 + 14.142)/√2).
    let as_before = last(MANUAL, RotationStart::AsBefore);
    assert_eq!(as_before, [-2.928_932, 17.071_068, 0.0]);
    assert_eq!(last(MANUAL, RotationStart::AsRotated), [0.0, 20.0, 0.0]);
    finds(MANUAL, &["4:1 ambiguous-word"]);
}

#[test]
fn the_first_hole_of_a_cycle_is_a_first_move() {
    let holes = "G0 X10. Y0 Z10.\nG68 X0 Y0 R90.\nG81 X20. Z-5. R2. F100";
    assert_eq!(last(holes, RotationStart::AsBefore)[..2], [0.0, 20.0]);
    assert_eq!(last(holes, RotationStart::AsRotated)[..2], [10.0, 20.0]);
    finds(holes, &["3:5 ambiguous-word"]);
}

#[test]
fn it_is_asked_only_where_it_matters() {
    // In the centre both are the same; the second move has a first one; and G91 goes from where the tool is.
    for text in [
        "G0 X3. Y4.\nG68 X3. Y4. R30.\nX10.",
        "G0 X3. Y4.\nG68 X0 Y0 R30.\nX10. Y1.\nX20.",
        "G0 X3. Y4.\nG68 X0 Y0 R30.\nG91 X10.",
        "G0 X3. Y4.\nG68 X0 Y0 R30.\nZ5.\nX10. Y1.",
        "G0 X3. Y4.\nG68 X0 Y0 R30.\nG69\nX10.",
    ] {
        finds(text, &[]);
    }
    finds(
        "G0 X3. Y4.\nG68 X0 Y0 R30.\nZ5.\nX10.",
        &["4:1 ambiguous-word"],
    );
}

#[test]
fn the_axis_across_the_plane_has_no_part_in_the_centre() {
    finds("G68 X5. Y0 Z5. R90.", &["1:12 unused-word"]);
    finds("G18\nG68 X5. Z0 Y5. R90.", &["2:12 unused-word"]);
}
