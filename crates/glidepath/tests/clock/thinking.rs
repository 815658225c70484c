//! A planner that thinks for long between two moves is not taken for dead.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use glidepath_gcode::{Options, check};
use std::process::{Command, Output};
use std::time::Instant;

/// The time after which a planner that gives no sign of life is lost, s.
const PATIENCE_T: f64 = 2.0;
/// How long it is to think, s of a processor that does nothing else.
const THINKS_T: f64 = 3.0;
/// A loop without a move may not have more than a million lines, so they are long ones.
const ROUNDS: u32 = 300_000;
/// What a line holds.
const MOST_TERMS: u32 = 3_000;

/// A loop between two moves that takes long and makes no frame. The motion rests in a dwell in front of it, so
/// the first move is planned, and driven, before the second one is known.
fn thinking(rounds: u32, terms: u32) -> String {
    let sum: String = (0..terms).map(|k| format!(" + SIN[{k} + #1]")).collect();
    format!(
        "G21 G90 F12000\nG1 X150\nG4 P0.3\n#1 = 0\no1 repeat [{rounds}]\n#1 = [#1{sum}]\no1 endrepeat\nG1 X0\nM2\n"
    )
}

/// Terms in a line that take this host so long.
fn terms() -> u32 {
    let text = thinking(500, 100);
    let begun = Instant::now();
    let report = check(text.as_bytes(), Options::default());
    assert!(report.diagnostics.is_empty(), "{:?}", report.diagnostics);
    let of_term_t = begun.elapsed().as_secs_f64() / (500.0 * 100.0);
    let terms = THINKS_T / of_term_t / f64::from(ROUNDS);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and what a line holds"
    )]
    let terms = terms.clamp(1.0, f64::from(MOST_TERMS)) as u32;
    terms
}

fn run(terms: u32) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("thinking.ngc");
    std::fs::write(&file, thinking(ROUNDS, terms)).unwrap();
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(["run", file.to_str().unwrap(), "--best-effort", "--json"])
        .output()
        .unwrap()
}

#[test]
fn the_motion_goes_on_when_the_planner_has_thought() {
    let mut terms = terms();
    loop {
        let output = run(terms);
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert_eq!(output.status.code(), Some(0), "{said}");
        // Who judges the motion thinks as long.
        assert_eq!(told["lost_setpoints"], 0, "{said}");
        let waited_t = told["time_lost_s"]["starvation"].as_f64().unwrap();
        // Without signs of life it would have been lost.
        if waited_t > PATIENCE_T {
            return;
        }
        // It was measured beside others, and then it was alone.
        assert!(terms < MOST_TERMS, "{said}");
        terms = (2 * terms).min(MOST_TERMS);
    }
}
