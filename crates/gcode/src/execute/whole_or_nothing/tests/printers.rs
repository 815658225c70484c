//! Refused blocks of printers' programs.

use glidepath_geometry::Axis;

use crate::execute::whole_or_nothing::tests::{Table, machine, try_all};
use crate::setup::options::Options;
use crate::syntax::dialect::Dialect;

#[test]
fn of_a_printer() {
    try_all(&Table {
        options: || Options {
            extruder: Some(Axis::U),
            ..machine(Dialect::Marlin, &[Axis::X, Axis::Y, Axis::Z, Axis::U])
        },
        before: &[
            "G0 X1 Y1 Z1",
            "M82\nG1 X5 E3 F600\nG60 S1",
            "M83\nG91\nG1 X5 E3\nSAVE_GCODE_STATE NAME=A",
            "SET_GCODE_OFFSET Z=1\nG92 E5\nG20",
        ],
        words: "\
            G90 | G91 | G20 | G21 | M82 | M83 | G92 E0 | G92 X5 | G60 S2 | G4 P1 | M104 S200 | \
            M106 S5 | M400 | M117 HELLO | F100 | G28 | G17 | T0 | M3 S10",
        wrong: "G1 X9999 F100 | G0 E9999 | G1 X1.2.3 | Q7 | M999 | G2 X9 Y9 R1 | T1",
        blocks: "\
            G61 S7 | G61 S1 X9999 | G61 S1 F100 Z9999 | G60 S300 | SET_GCODE_OFFSET Z=1 X=2 Q=3 | \
            SET_GCODE_OFFSET Z=9999 MOVE=1 | SET_GCODE_OFFSET X=1 Y=1 MOVE=1 MOVE_SPEED=0 | \
            SAVE_GCODE_STATE NAME= | RESTORE_GCODE_STATE NAME=B | \
            RESTORE_GCODE_STATE NAME=A MOVE=1 MOVE_SPEED=0 | RESTORE_GCODE_STATE NAME=A Q=1 | \
            PRINT_START BED=60 | G1 E5 Z9999 | G5 X9999 Y1 P1 Q1 I1 J1 | M220 S50 | M221 S50 | \
            M200 D1 | G29 | G1 F0 X1 | N5 G1 X1*7",
        behind: "G1 X2 Y1 E1 F500\nG91 E2\nG90\nG61 S2\nG61 S1\nRESTORE_GCODE_STATE NAME=A\nG0 X0 Y0 Z5\nG1 X1 E5\nG92 E0\nG1 X0 E1",
    });
}
