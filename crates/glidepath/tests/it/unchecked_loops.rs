//! A program whose loops go on for too long to be checked to their end does not look as if it had
//! been: what stands behind is wrong here, and nobody may find out only when the machine is there.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use serde_json::Value;
use std::process::{Command, Output};

/// More than twenty million lines, and behind them a move out of the travel.
const LONG: &str = "G21 G90 F600\n#1 = 0\no1 repeat [23]\no2 repeat [450000]\n#1 = [#1 + 1]\n\
                    o2 endrepeat\nG4 P0\no1 endrepeat\nG1 X5000\nM2\n";

fn glidepath(args: &[&str], program: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long.ngc");
    std::fs::write(&file, program).unwrap();
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .arg(args[0])
        .arg(file)
        .args(&args[1..])
        .output()
        .unwrap()
}

fn said(output: &Output) -> (i32, String) {
    let text = [&*output.stdout, &*output.stderr].concat();
    let text = String::from_utf8(text).unwrap();
    (output.status.code().unwrap(), text)
}

#[test]
fn a_check_that_gave_up_says_so_with_a_code_of_its_own() {
    let (code, text) = said(&glidepath(&["check"], LONG));
    assert_eq!(code, 6, "{text}");
    assert!(text.contains("not checked beyond line "), "{text}");
    assert!(text.contains("no findings as far as it was checked"));
    let output = glidepath(&["check", "--json"], LONG);
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
    let program = &object["programs"][0];
    assert_eq!(program["accepted"], false);
    assert_eq!(program["checked_to_end"], false);
    let line = program["not_checked_beyond_line"].as_u64().unwrap();
    assert!((3..=8).contains(&line), "{line}");
    // One that was found wrong before is refused for that.
    let (code, _) = said(&glidepath(&["check"], &LONG.replace("F600", "F600 X1.2.3")));
    assert_eq!(code, 1);
}

#[test]
fn nothing_runs_unchecked_unless_told() {
    for command in ["run", "plan"] {
        let (code, text) = said(&glidepath(&[command, "--json"], LONG));
        assert_eq!(code, 6, "{command}: {text}");
        assert!(text.contains("--allow-unchecked"), "{command}: {text}");
    }
    // Then each line is judged when it comes to it.
    let (code, text) = said(&glidepath(&["plan", "--allow-unchecked"], LONG));
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("not checked beyond line "), "{text}");
    assert!(text.contains("line 9"), "{text}");
}
