//! Tests of `glidepath setup`: what is answered becomes a machine, and nothing is written that is not asked for.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::support::glidepath;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn answered(file: &Path, answers: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(["setup", file.to_str().expect("a name")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(answers.as_bytes()).expect("it reads");
    drop(stdin);
    child.wait_with_output().expect("it ends")
}

#[test]
fn answers_make_a_machine_and_the_first_steps_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("router.toml");
    // A comma and a word that is none are asked for again.
    let answers = format!(
        "router\nethercat\nswitches\n1200,5\n1200.5\nmiddle\nlow\n9000 mm/min\n\nyes{}",
        "\n".repeat(30)
    );
    let output = answered(&file, &answers);
    let told = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{told}");
    for words in [
        "no comma",
        "answer one of: low, high",
        "glidepath ethercat scan",
        "glidepath jog X1",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    let text = std::fs::read_to_string(&file).expect("it is written");
    for line in [
        "max_position = 1200.5\n",
        "max_velocity = 150.0\n",
        "gantry_difference = 0.5\n",
        "search_velocity = -15.0\n",
        "[home.J3]\n",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    let name = file.to_str().expect("a name");
    assert_eq!(
        glidepath(&["config", "--check", name]).status.code(),
        Some(0)
    );

    let again = answered(&file, "");
    assert_eq!(again.status.code(), Some(2));
    let told = String::from_utf8_lossy(&again.stderr);
    assert!(told.contains("is there already"), "{told}");
    assert_eq!(std::fs::read_to_string(&file).expect("a file"), text);
}

#[test]
fn answers_that_end_write_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("machine.toml");
    let output = answered(&file, "mill\nsimulated\n");
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("no answer to \"Travel of X, mm\": nothing is written"),
        "{told}"
    );
    assert!(!file.exists());
}

#[test]
fn all_that_is_suggested_is_a_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("mill.toml");
    let name = file.to_str().expect("a name");
    let output = glidepath(&["setup", name, "--suggested"]);
    assert_eq!(output.status.code(), Some(0));
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(!told.contains("[500]"), "nothing is asked: {told}");
    assert_eq!(
        glidepath(&["config", "--check", name]).status.code(),
        Some(0)
    );
}
