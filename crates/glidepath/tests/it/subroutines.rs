//! Tests of subroutines in files of their own, with the real binary: where they are looked for, and
//! findings in them.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn glidepath(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .current_dir(folder)
        .args(args)
        .output()
        .unwrap()
}

/// Moves of a checked program, or its findings: place, code and reason.
fn checked(folder: &Path, args: &[&str]) -> Result<u64, (String, String, String)> {
    let output = glidepath(folder, &[&["check", "--json"], args].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    let value: Value = serde_json::from_str(&text).expect(&text);
    let program = &value["programs"][0];
    let Some(finding) = program["findings"].get(0) else {
        return Ok(program["straight_moves"].as_u64().unwrap());
    };
    let string = |key: &str| finding[key].as_str().unwrap().to_owned();
    let place = format!(
        "{}:{}:{}",
        string("file"),
        finding["line"],
        finding["column"]
    );
    Err((place, string("code"), string("reason")))
}

fn write(path: &Path, text: &str) {
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text).unwrap();
}

/// `o<side> sub` with so many moves.
fn side(moves: usize) -> String {
    let lines: String = (1..=moves).map(|x| format!("G1 X{x} F600\n")).collect();
    format!("o<side> sub\n{lines}o<side> endsub\n")
}

#[test]
fn files_are_looked_for_beside_the_program_and_on_the_search_path() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(&at.join("jobs/a.ngc"), "G21 G90\no<side> call\nM2\n");
    let missing = checked(at, &["jobs/a.ngc", "--subroutine-path", "first"]).unwrap_err();
    assert_eq!(missing.0, "jobs/a.ngc:2:1");
    assert_eq!(missing.1, "unknown-subroutine");
    assert!(
        missing.2.ends_with("no side.ngc in jobs, first"),
        "{}",
        missing.2
    );

    write(&at.join("third/side.ngc"), &side(3));
    write(
        &at.join("machine/own.toml"),
        &glidepath_config().replace(
            "[program]\n",
            "[program]\nsubroutine_path = [\"../third\"]\n",
        ),
    );
    let config = ["jobs/a.ngc", "--config", "machine/own.toml"];
    assert_eq!(checked(at, &config), Ok(3));
    write(&at.join("first/side.ngc"), &side(1));
    write(&at.join("second/side.ngc"), &side(2));
    let path = ["--subroutine-path", "second", "--subroutine-path", "first"];
    assert_eq!(checked(at, &[&config[..], &path[..]].concat()), Ok(2));
    write(&at.join("jobs/side.ngc"), &side(4));
    assert_eq!(checked(at, &[&config[..], &path[..]].concat()), Ok(4));

    let planned = glidepath(at, &["plan", "jobs/a.ngc", "--json"]);
    assert!(planned.status.success(), "{planned:?}");
    let fitted = glidepath(at, &["fit", "jobs/a.ngc", "--tolerance", "0.01"]);
    assert!(!String::from_utf8_lossy(&fitted.stderr).contains("subroutine"));
}

/// The built-in mill.
fn glidepath_config() -> String {
    include_str!("../../../../config/mill.toml").to_owned()
}

#[test]
fn findings_show_the_file_they_are_in() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(&at.join("a.ngc"), "G21 G90\no<side> call\nM2\n");
    write(
        &at.join("side.ngc"),
        "\no<side> sub\nG1 X1 F0\no<side> endsub\n",
    );
    let finding = checked(at, &["a.ngc"]).unwrap_err();
    assert_eq!(
        (finding.0.as_str(), finding.1.as_str()),
        ("side.ngc:3:7", "bad-feed")
    );
    let output = glidepath(at, &["plan", "a.ngc"]);
    assert_eq!(output.status.code(), Some(1));
    let shown = String::from_utf8(output.stderr).unwrap();
    assert!(shown.contains("side.ngc:3:7"), "{shown}");
    assert!(shown.contains("G1 X1 F0"), "{shown}");
}

#[test]
fn a_folder_is_looked_past_and_a_pipe_is_no_subroutine() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(&at.join("a.ngc"), "o<side> call\n");
    std::fs::create_dir(at.join("side.ngc")).unwrap();
    let (place, code, _) = checked(at, &["a.ngc"]).unwrap_err();
    assert_eq!(
        (place.as_str(), code.as_str()),
        ("a.ngc:1:1", "unknown-subroutine")
    );
    std::fs::remove_dir(at.join("side.ngc")).unwrap();
    let made = Command::new("mkfifo").arg(at.join("side.ngc")).status();
    assert!(made.unwrap().success());
    let (place, code, _) = checked(at, &["a.ngc"]).unwrap_err();
    assert_eq!(
        (place.as_str(), code.as_str()),
        ("a.ngc:1:1", "read-failed")
    );
}
