//! The numbers of errors, as grbl 1.1 has them (`report.h`, `gcode.c`).

use super::*;

#[test]
fn settings_are_written_back_as_they_were_read_and_not_otherwise() {
    let mut desk = Desk::new();
    for (line, answer) in [
        ("$10=511", "ok"),
        ("$1=255", "ok"),
        ("$110=12000.000", "ok"),
        ("$110=12001", "error:3"),
        ("$1=254", "error:3"),
        ("$99=1", "error:3"),
    ] {
        let said = desk.says(format!("{line}\n").as_bytes());
        assert_eq!(answers(&said), [answer], "{line}");
    }
}

#[test]
fn a_coordinate_system_is_not_turned_by_a_sender() {
    let mut desk = Desk::new();
    let said = desk.says(b"G10 L2 P1 R5\nG10 L2 P1 X5\nG2 X1 R5\nG10 L1 P1 R5\n");
    assert_eq!(answers(&said), ["error:20", "ok", "ok", "ok"]);
}
