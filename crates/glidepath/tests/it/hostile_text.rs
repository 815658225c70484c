//! Tests of hostile text: that of others (programs, names of files, keys) never reaches a terminal
//! or a log as it is.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::support::{glidepath, object};
use glidepath_link::is_printable;
use std::process::Output;

/// Clears the screen, renames the terminal, changes colours by one character, turns text round.
const HOSTILE: &str = "\x1b[2J\x1b]0;owned\x07\u{9b}31m\u{202e}gpj";

fn must_be_safe(what: &str, output: &Output) {
    for stream in [&output.stdout, &output.stderr] {
        let text = String::from_utf8(stream.clone()).unwrap();
        assert!(text.chars().all(is_printable), "{what}: {text:?}");
    }
    assert!(
        !(output.stdout.is_empty() && output.stderr.is_empty()),
        "{what} says nothing"
    );
}

#[test]
fn nothing_that_a_terminal_obeys_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let good = file(
        &format!("good{HOSTILE}.ngc"),
        &format!("({HOSTILE})\nG21 G90 F600\n(MSG,{HOSTILE})\nG1 X1\nM2\n"),
    );
    let bad = file(
        &format!("bad{HOSTILE}.ngc"),
        &format!("G21 G90 F600\nG1 X1 ({HOSTILE}) Q{HOSTILE}\no<{HOSTILE}> call\nM2\n"),
    );
    let in_toml = |c: char| format!("\\u{:04x}", u32::from(c));
    let key: String = HOSTILE.chars().map(in_toml).collect();
    let machine = file(
        &format!("machine{HOSTILE}.toml"),
        &format!("[axis.X]\n\"{key}\" = 1\n"),
    );
    let raw = file("raw.toml", &format!("# {HOSTILE}\n[axis.X\nmax = 1\n"));
    let curve = file("curve.toml", &format!("name = \"{HOSTILE}\"\n"));
    let absent = format!("absent{HOSTILE}.ngc");
    for args in [
        &["check", &good, &bad][..],
        &["plan", &good],
        &["plan", &bad],
        &["plan", &absent],
        &["plan", &curve],
        &["plan", &good, &bad, &absent],
        &["plan", &good, "--config", &machine],
        &["config", "--check", &machine],
        &["config", "--check", &raw],
        &["config", "--explain", HOSTILE],
        &["status", "--instance", HOSTILE],
        &[HOSTILE],
        &["mdi", HOSTILE, "--instance", "hostile-text"],
        &["jog", HOSTILE],
    ] {
        must_be_safe(&format!("{args:?}"), &glidepath(args));
    }
    for args in [
        &["plan", &good, "--json"][..],
        &["check", &bad, "--json"],
        &["config", "--check", &machine, "--json"],
        &["plan", &absent, "--json"],
    ] {
        let output = glidepath(args);
        must_be_safe(&format!("{args:?}"), &output);
        // What it means stays.
        assert!(object(&output).to_string().contains("\u{202e}"), "{args:?}");
    }
}
