//! Tests of `doctor` and `jitter` with the real binary, on whatever host the tests run.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use crate::support::{glidepath, object};
use serde_json::Value;
use std::process::Command;

#[test]
fn doctor_ends_with_what_it_found() {
    let output = glidepath(&["doctor", "--json"]);
    let object = object(&output);
    let checks = object["checks"].as_array().unwrap();
    let missing = checks.iter().any(|check| check["verdict"] == "missing");
    assert_eq!(object["fit"], !missing);
    assert_eq!(output.status.code(), Some(if missing { 4 } else { 0 }));
    for check in checks {
        assert_eq!(
            check["remedy"].is_null(),
            check["verdict"] == "ok",
            "{check}"
        );
    }
    let text = String::from_utf8(glidepath(&["doctor"]).stdout).unwrap();
    assert_eq!(text.lines().count(), checks.len() + 2, "{text}");
}

#[test]
fn jitter_measures_the_tick_and_draws() {
    let folder = tempfile::tempdir().unwrap();
    let plot = folder.path().join("jitter.svg");
    let path = plot.to_str().unwrap();
    let args = ["jitter", "--best-effort", "--seconds", "1"];
    let more = [
        "--period-us",
        "2000",
        "--full-tick",
        "--json",
        "--plot",
        path,
    ];
    let output = glidepath(&[&args[..], &more].concat());
    assert_eq!(output.status.code(), Some(0));
    let object = object(&output);
    assert_eq!(object["period_us"], 2000.0);
    assert_eq!(object["load"], "full tick");
    let ticks = object["ticks"].as_u64().unwrap();
    let moving = object["moving_ticks"].as_u64().unwrap();
    assert!(moving > 0 && moving <= ticks, "{moving} of {ticks}");
    let counted: u64 = object["histogram"]
        .as_array()
        .unwrap()
        .iter()
        .map(|bin| bin["count"].as_u64().unwrap())
        .sum();
    assert_eq!(counted, ticks);
    assert_eq!(object["cyclictest"], Value::Null);
    assert!(std::fs::read_to_string(plot).unwrap().starts_with("<svg"));
}

/// No host has so many processors.
const NO_CPU: [&str; 5] = ["jitter", "--seconds", "1", "--cpu", "1000"];

#[test]
fn jitter_goes_on_without_what_is_refused_only_if_it_may() {
    let refused = glidepath(&NO_CPU);
    assert_eq!(refused.status.code(), Some(4), "{refused:?}");
    assert!(refused.stdout.is_empty(), "{refused:?}");
    let said = String::from_utf8(refused.stderr).unwrap();
    assert!(said.contains("CPU"), "{said}");
    let object = object(&glidepath(&[&NO_CPU[..], &["--json"]].concat()));
    assert_eq!(object["exit_code"], 4);

    let measured = glidepath(&[&NO_CPU[..], &["--best-effort"]].concat());
    assert_eq!(measured.status.code(), Some(0), "{measured:?}");
    let said = String::from_utf8(measured.stderr).unwrap();
    assert!(said.contains("not granted"), "{said}");
}

#[test]
fn without_cyclictest_jitter_says_how_to_get_it() {
    let output = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(["jitter", "--best-effort", "--seconds", "1"])
        .arg("--against-cyclictest")
        .env("PATH", "/nonexistent")
        .output()
        .unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    if text.contains("not granted: SCHED_FIFO") {
        // Then cyclictest would refuse to run, and the measurement goes on without it.
        assert_eq!(output.status.code(), Some(0));
        assert!(text.contains("cyclictest was left out"), "{text}");
    } else {
        assert_eq!(output.status.code(), Some(2));
        assert!(text.contains("apt install rt-tests"), "{text}");
    }
}

#[test]
fn what_jitter_cannot_do_is_a_usage_error() {
    for args in [
        ["jitter", "--seconds", "0"],
        ["jitter", "--period-us", "10"],
        ["jitter", "--priority", "100"],
        ["jitter", "--cpu", "-1"],
    ] {
        assert_eq!(glidepath(&args).status.code(), Some(2), "{args:?}");
    }
}

#[test]
fn a_host_that_leaves_little_stack_still_moves_the_machine() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.ngc");
    std::fs::write(&file, "G21 G90 F3000\nG1 X5\nG1 X0\nM2\n").unwrap();
    let output = Command::new("sh")
        .current_dir(folder.path())
        .args([
            "-c",
            "ulimit -s 128; exec \"$0\" run part.ngc --best-effort",
        ])
        .arg(env!("CARGO_BIN_EXE_glidepath"))
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{text}");
}
