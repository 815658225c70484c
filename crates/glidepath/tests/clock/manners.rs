//! Tests of what commands say: one object whatever happens, what they wait for, and what they
//! noticed.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::support::glidepath;
use serde_json::Value;
use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::channel;
use std::time::Duration;

struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let pid = self.0.id().to_string();
        Command::new("kill").arg(pid).status().ok();
        self.0.wait().ok();
    }
}

/// The first line that has some words, of what a command says that goes on until it is ended.
fn first_line_with(words: &str, args: &[&str]) -> String {
    let child = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut child = Ended(child);
    let lines = BufReader::new(child.0.stderr.take().unwrap()).lines();
    let (sender, said) = channel();
    std::thread::spawn(move || {
        lines
            .map_while(Result::ok)
            .try_for_each(|line| sender.send(line))
    });
    let mut all = String::new();
    while let Ok(line) = said.recv_timeout(Duration::from_secs(60)) {
        if line.contains(words) {
            return line;
        }
        all += &line;
    }
    panic!("it does not say \"{words}\": {all}");
}

#[test]
fn usage_errors_are_objects_too() {
    for args in [
        &["plan", "--json"][..],
        &["frobnicate", "--json"],
        &["check", "x.ngc", "--json", "--nonsense"],
        &["override", "--json", "201"],
        &["plan", "missing.ngc", "--json"],
    ] {
        let output = glidepath(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        let object: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(object["exit_code"], 2, "{args:?}");
        assert!(!object["error"].as_str().unwrap().is_empty(), "{args:?}");
    }
    // Help is no error.
    let help = glidepath(&["plan", "--help", "--json"]);
    assert_eq!(help.status.code(), Some(0));
    assert!(String::from_utf8(help.stdout).unwrap().contains("Usage:"));
}

#[test]
fn a_program_that_just_ends_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.ngc");
    let check = |text: &str, args: &[&str]| {
        std::fs::write(&file, text).unwrap();
        let args = [&["check", file.to_str().unwrap()][..], args].concat();
        glidepath(&args)
    };
    let cut = "G21 G90 F600\nG1 X10\nG1 Y1";
    for (text, is_warned) in [
        (cut.to_owned(), true),
        (format!("%\n{cut}\n"), true),
        (format!("{cut}\nM2\n"), false),
        (format!("{cut}\nM30"), false),
        (format!("%\n{cut}\n%\n"), false),
    ] {
        let output = check(&text, &["--json"]);
        assert_eq!(output.status.code(), Some(0));
        let object: Value = serde_json::from_slice(&output.stdout).unwrap();
        let warnings = object["programs"][0]["warnings"].as_array().unwrap();
        assert_eq!(!warnings.is_empty(), is_warned, "{text}");
        let said = String::from_utf8(check(&text, &[]).stderr).unwrap();
        assert_eq!(
            said.contains("without M2, M30"),
            is_warned,
            "{text}: {said}"
        );
    }
    // Programs of printers have no such end.
    let output = check(cut, &["--dialect", "marlin", "--json"]);
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        object["programs"][0]["warnings"].as_array().unwrap().len(),
        0
    );
}

#[test]
fn a_fanuc_program_whose_units_nobody_says_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let mill = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mill.toml");
    let mill = std::fs::read_to_string(mill).unwrap();
    let text = mill.replace("\nunits = \"unsaid\"", "\nunits = \"inch\"");
    assert_ne!(text, mill);
    let inches = file("inch.toml", &text);
    let unsaid = file("unsaid.nc", "O1\nG90 G94\nG1 X2. F10.\nM30\n");
    let said = file("said.nc", "O1\nG20 G90 G94\nG1 X2. F10.\nM30\n");
    let told = |args: &[&str]| {
        let output = glidepath(&[args, &["--dialect", "fanuc"]].concat());
        assert_eq!(output.status.code(), Some(0), "{args:?}: {output:?}");
        let words = String::from_utf8(output.stderr).unwrap();
        let length = String::from_utf8(output.stdout).unwrap();
        (words.contains("before G20 or G21"), length)
    };
    let (is_warned, length) = told(&["check", &unsaid]);
    assert!(
        is_warned && length.contains(" 2.000 mm at feed"),
        "{length}"
    );
    assert!(told(&["plan", &unsaid]).0);
    assert!(!told(&["check", &said]).0);
    let (is_warned, length) = told(&["check", &unsaid, "--config", &inches]);
    assert!(
        !is_warned && length.contains("50.800 mm at feed"),
        "{length}"
    );
}

#[test]
fn a_program_without_feedrate_is_refused_unless_somebody_chose_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.ngc");
    std::fs::write(&file, "G21 G90\nG1 X10\nM2\n").unwrap();
    let file = file.to_str().unwrap();
    let output = glidepath(&["check", file]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("missing-feed"), "{said}");
    let mill = include_str!("../../../../config/mill.toml");
    let chosen = mill.replace("# default_feed", "default_feed");
    assert_ne!(chosen, mill, "as shipped nobody has chosen one");
    let config = folder.path().join("mill.toml");
    std::fs::write(&config, chosen).unwrap();
    let output = glidepath(&["check", file, "--config", config.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn whoever_waits_says_for_what() {
    let own = format!("manners-{}", std::process::id());
    let line = first_line_with("waiting", &["servo", "--instance", &own]);
    assert!(
        line.contains("waiting for setpoints of the instance"),
        "{line}"
    );
    let line = first_line_with("standard input", &["planner", "-", "--instance", &own]);
    assert!(line.contains("reading standard input"), "{line}");
}

#[test]
fn a_fault_is_reset_by_that_name() {
    let own = format!("reset-{}", std::process::id());
    let start = |args: &[&str], input: Stdio| {
        let child = Command::new(env!("CARGO_BIN_EXE_glidepath"))
            .args(args)
            .args(["--instance", &own])
            .stdin(input)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        Ended(child.unwrap())
    };
    let ask = |args: &[&str]| {
        let output = glidepath(&[args, &["--instance", &own, "--json"]].concat());
        let object: Value = serde_json::from_slice(&output.stdout).unwrap();
        (output.status.code(), object)
    };
    let wait_for = |state: &str| {
        for _ in 0..400 {
            let (_, status) = ask(&["status"]);
            if status["state"] == state {
                return status;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("never {state}");
    };
    let _interpolator = start(&["interpolator", "--best-effort"], Stdio::null());
    wait_for("idle");
    assert_eq!(ask(&["reset"]).0, Some(5), "nothing to reset");
    // A planner that dies under way leaves a fault.
    let mut planner = start(&["planner", "-"], Stdio::piped());
    let mut input = planner.0.stdin.take().unwrap();
    let moves = "G1 X10\nG1 X0\n".repeat(1000);
    input
        .write_all(format!("G21 G90 F600\n{moves}").as_bytes())
        .unwrap();
    wait_for("running");
    planner.0.kill().unwrap();
    let status = wait_for("faulted");
    let reset = format!("glidepath reset --instance {own}");
    assert_eq!(status["fault_is_cleared_by"], reset.as_str());
    // One that resumes nothing leaves it to whoever looks at it.
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other.ngc");
    std::fs::write(&other, "G21 G90 F600\nG1 X1\nM2\n").unwrap();
    let refused = ask(&["planner", other.to_str().unwrap(), "--resume"]);
    assert_eq!(refused.0, Some(5), "{}", refused.1);
    assert_eq!(ask(&["status"]).1["state"], "faulted");
    assert_eq!(ask(&["reset"]).0, Some(0));
    let status = wait_for("idle");
    assert!(status["fault"].is_null() && status["fault_is_cleared_by"].is_null());
}
