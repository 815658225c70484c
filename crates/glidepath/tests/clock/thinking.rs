//! A planner that thinks for long between two moves is not taken for dead.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use std::process::Command;

/// Some millions of lines between two moves, which make no frame. The first move is long enough to be begun
/// before the second one is known.
const THINKING: &str = "G21 G90 F3000\nG1 X60\n#1 = 0\no1 repeat [12]\no2 repeat [450000]\n\
                        #1 = [#1 + 1]\no2 endrepeat\nG4 P0\no1 endrepeat\nG1 X120\nM2\n";

#[test]
fn the_motion_goes_on_when_the_planner_has_thought() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("thinking.ngc");
    std::fs::write(&file, THINKING).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(["run", file.to_str().unwrap(), "--best-effort", "--json"])
        .output()
        .unwrap();
    let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("\"final_position\""), "{said}");
}
