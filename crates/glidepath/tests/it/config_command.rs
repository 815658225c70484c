//! Tests of `glidepath config`, and what `plan` overrides of the configuration, with the real
//! binary.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use crate::support::{finish, glidepath, object};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn the_default_is_a_configuration() {
    let folder = tempfile::tempdir().unwrap();
    let printed = glidepath(&["config", "--default"]);
    assert_eq!(printed.status.code(), Some(0));
    let path = file(folder.path(), "default.toml", &stdout(&printed));
    let checked = glidepath(&["config", "--check", &path]);
    assert_eq!(checked.status.code(), Some(0), "{}", stderr(&checked));
    assert!(stdout(&checked).ends_with(": no findings; a machine with the axes X Y Z\n"));
    let json = object(&glidepath(&["config", "--default", "--json"]));
    assert_eq!(json["configuration"], Value::String(stdout(&printed)));
}

#[test]
fn keys_are_explained() {
    let one = glidepath(&["config", "--explain", "axis.Z.max_jerk"]);
    assert_eq!(one.status.code(), Some(0));
    let text = stdout(&one);
    assert!(
        text.starts_with("axis.X.max_jerk\n  how fast the acceleration may change."),
        "{text}"
    );
    let range = "  0.001 to 10000000000 mm/s³ or °/s³; has to be given\n";
    assert!(text.contains(range), "{text}");
    let all = stdout(&glidepath(&["config", "--explain"]));
    assert!(all.contains("\nmachine.hexapod.half_angle\n"), "{all}");
    assert!(all.contains("  0.00001 to 10 mm; default 0.02\n"), "{all}");
    let json = object(&glidepath(&[
        "config",
        "--explain",
        "path.effort",
        "--json",
    ]));
    let key = &json["keys"][0];
    assert_eq!(key["key"], "path.effort");
    assert_eq!(key["takes"]["of"], serde_json::json!(["optimal", "fast"]));
    assert_eq!(key["left_out"]["value"], "\"optimal\"");

    let unknown = glidepath(&["config", "--explain", "path.tolerence"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(
        stderr(&unknown)
            .contains("there is no key `path.tolerence`; did you mean `path.tolerance`?"),
        "{}",
        stderr(&unknown)
    );
}

#[test]
fn a_check_tells_everything_and_its_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(
        folder.path(),
        "m.toml",
        "[axis.X]\nmax_speed = 1\n[path]\ntolerance = 20\n",
    );
    let checked = glidepath(&["config", "--check", &path, "--json"]);
    assert_eq!(checked.status.code(), Some(3));
    let found = object(&checked);
    let keys: Vec<_> = found["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|f| &f["key"])
        .collect();
    assert!(keys.contains(&&Value::from("path.tolerance")), "{found}");
    assert!(keys.contains(&&Value::from("axis.X.max_speed")), "{found}");
    let absent = glidepath(&["config", "--check", "/nowhere/m.toml"]);
    assert_eq!(absent.status.code(), Some(3));
}

#[test]
fn exactly_one_thing_is_asked_of_the_configuration() {
    for args in [
        &["config"][..],
        &["config", "--default", "--explain"],
        &["config", "--json"],
    ] {
        assert_eq!(glidepath(args).status.code(), Some(2), "{args:?}");
    }
}

#[test]
fn effort_and_tolerance_override_the_configuration() {
    let folder = tempfile::tempdir().unwrap();
    let program = "G21 G90\nG1 X10 F6000\nY10\nX20\nY20\nM2\n";
    let part = file(folder.path(), "part.ngc", program);
    let cycle_s = |args: &[&str]| {
        let args = [&["plan", &part, "--json"], args].concat();
        let planned = glidepath(&args);
        assert_eq!(planned.status.code(), Some(0), "{}", stderr(&planned));
        let object = object(&planned);
        (
            object["cycle_time_s"].as_f64().expect("a time"),
            object["max_deviation_mm"].as_f64().expect("a deviation"),
        )
    };
    let (usual_s, usual_mm) = cycle_s(&[]);
    let (wide_s, wide_mm) = cycle_s(&["--tolerance", "0.5"]);
    let (fast_s, fast_mm) = cycle_s(&["--effort", "fast"]);
    assert!(
        wide_s < usual_s && wide_mm > 0.02 && wide_mm <= 0.5,
        "{wide_s} {wide_mm}"
    );
    assert!(
        fast_s > usual_s && fast_mm <= 0.02 && usual_mm <= 0.02,
        "{fast_s} {usual_s}"
    );
    for (option, value, told) in [
        ("--tolerance", "0", "give 0.00001 to 10 mm"),
        ("--tolerance", "wide", "give a number of mm"),
        ("--effort", "best", "give \"optimal\" or \"fast\""),
    ] {
        let refused = glidepath(&["plan", &part, option, value]);
        assert_eq!(refused.status.code(), Some(2));
        assert!(stderr(&refused).contains(told), "{}", stderr(&refused));
    }
}

/// A file that is converted must not keep whoever converts it waiting at a pipe it names.
#[test]
fn what_is_included_is_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let made = Command::new("mkfifo")
        .arg(folder.path().join("pipe"))
        .status()
        .unwrap();
    assert!(made.success());
    for (control, text) in [
        ("from-linuxcnc", "[EMC]\n#INCLUDE pipe\n"),
        ("from-linuxcnc", "[EMC]\n#INCLUDE /dev/zero\n"),
        ("from-klipper", "[include pipe]\n"),
    ] {
        let path = file(folder.path(), "machine.ini", text);
        let child = Command::new(env!("CARGO_BIN_EXE_glidepath"))
            .args(["config", control, &path])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let output = finish(child, Duration::from_secs(20));
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let told = stderr(&output);
        assert!(told.contains("it is no ordinary file"), "{told}");
    }
}
