//! A planner that thinks for long between two moves is not taken for dead.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use std::process::Command;

/// The time after which a planner that gives no sign of life is lost, s.
const PATIENCE_T: f64 = 2.0;

/// A loop between two moves that takes seconds and makes no frame. The motion rests in a dwell in front of it, so the
/// first move is planned, and driven, before the second one is known. A loop without a move may not have more than a
/// million lines, so they are long ones.
fn thinking() -> String {
    let sum: String = (0..70).map(|k| format!(" + SIN[{k} + #1]")).collect();
    format!(
        "G21 G90 F12000\nG1 X150\nG4 P0.3\n#1 = 0\no1 repeat [300000]\n#1 = [#1{sum}]\no1 endrepeat\nG1 X0\nM2\n"
    )
}

#[test]
fn the_motion_goes_on_when_the_planner_has_thought() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("thinking.ngc");
    std::fs::write(&file, thinking()).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(["run", file.to_str().unwrap(), "--best-effort", "--json"])
        .output()
        .unwrap();
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    // Without signs of life it would have been lost.
    let waited_t = told["time_lost_s"]["starvation"].as_f64();
    assert!(
        waited_t.is_some_and(|waited_t| waited_t > PATIENCE_T),
        "{said}"
    );
    // Who judges the motion thinks as long.
    assert!(said.contains("\"lost_setpoints\": 0"), "{said}");
}
