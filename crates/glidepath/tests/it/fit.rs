//! Tests of `fit`: programs of short lines in, curves out.
#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

fn glidepath(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(arguments)
        .output()
        .expect("glidepath runs")
}

fn json(arguments: &[&str]) -> Value {
    let output = glidepath(arguments);
    assert!(output.status.success(), "{output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A program with a dense wave, a circle and a second wave at another feedrate.
fn program(folder: &Path) -> String {
    let mut text = String::from("G21 G90 G64\nS8000 M3\nG0 X0 Y0\nF1200\n");
    let wave = |text: &mut String, from: i32, to: i32| {
        for i in from..=to {
            let x = f64::from(i) * 0.1;
            writeln!(text, "G1 X{x:.4} Y{:.4}", 5.0 * (x / 4.0).sin()).expect("text");
        }
    };
    wave(&mut text, 1, 300);
    text += "G4 P0.5\nG3 I3 J0\nF600\n";
    wave(&mut text, 301, 500);
    text += "M5\nM2\n";
    let path = folder.join("waves.ngc");
    std::fs::write(&path, text).expect("written");
    path.to_str().expect("UTF-8").to_owned()
}

#[test]
fn runs_become_curves_and_the_program_can_be_run() {
    let folder = tempfile::tempdir().expect("folder");
    let program = program(folder.path());
    let smooth = folder.path().join("smooth.ngc");
    let smooth = smooth.to_str().expect("UTF-8");
    let report = json(&[
        "fit",
        &program,
        "--tolerance",
        "0.005",
        "--output",
        smooth,
        "--json",
    ]);
    let runs = report["runs"].as_array().expect("runs");
    assert_eq!(runs.len(), 2);
    assert!(report["max_error_mm"].as_f64().expect("error") <= 0.005);
    assert!(runs.iter().all(|run| run["within_tolerance"] == true));
    let points = report["control_points"].as_u64().expect("count");
    assert!(points < 100, "{points} control points for 500 points");

    let text = std::fs::read_to_string(smooth).expect("a program");
    assert_eq!(text.matches("G6.2").count(), 2, "{text}");
    // Both programs go the same way: as far, at the same feed, to the same place.
    let before = json(&["check", &program, "--json"]);
    let after = json(&["check", smooth, "--json"]);
    let of = |report: &Value, key: &str| report["programs"][0][key].as_f64().expect("a number");
    for key in ["feed_length_mm", "rapid_length_mm"] {
        let (before, after) = (of(&before, key), of(&after, key));
        assert!(
            (after - before).abs() < 1e-3 * (1.0 + before),
            "{key}: {after} for {before}"
        );
    }
    assert_eq!(
        of(&before, "dwells").to_bits(),
        of(&after, "dwells").to_bits()
    );
    let plan = |path: &str| json(&["plan", path, "--json"]);
    let (before, after) = (plan(&program), plan(smooth));
    let time = |report: &Value| report["cycle_time_s"].as_f64().expect("time");
    assert!(time(&after) < 1.05 * time(&before), "{after} {before}");
}

#[test]
fn one_run_becomes_a_curve_file_that_preview_reads() {
    let folder = tempfile::tempdir().expect("folder");
    let mut text = String::from("G0 X10\nF600\n");
    for i in 1..=400 {
        let angle = f64::from(i) / 200.0;
        writeln!(
            text,
            "G1 X{:.4} Y{:.4}",
            10.0 * angle.cos(),
            10.0 * angle.sin()
        )
        .expect("text");
    }
    let program = folder.path().join("bow.ngc");
    std::fs::write(&program, text).expect("written");
    let program = program.to_str().expect("UTF-8");
    let curve = folder.path().join("bow.toml");
    let curve = curve.to_str().expect("UTF-8");
    let plot = folder.path().join("bow.svg");
    let plot = plot.to_str().expect("UTF-8");
    json(&[
        "fit",
        program,
        "--tolerance",
        "0.01",
        "--output",
        curve,
        "--plot",
        plot,
        "--json",
    ]);
    assert!(Path::new(plot).exists());
    let report = json(&["preview", curve, "--json"]);
    assert!((report["length_mm"].as_f64().expect("length") - 20.0).abs() < 0.01);
    assert!((report["feed_mm_min"].as_f64().expect("feed") - 600.0).abs() < 1e-9);
}

#[test]
fn searches_repeat_themselves() {
    let folder = tempfile::tempdir().expect("folder");
    let program = program(folder.path());
    let run = |seed: &str| {
        let arguments = [
            "fit",
            &program,
            "--tolerance",
            "0.01",
            "--method",
            "foraging",
            "--seed",
            seed,
            "--json",
        ];
        let output = glidepath(&arguments);
        // As published, the search comes to no curve within the tolerance.
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        let mut report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let beyond = report["beyond_tolerance"].as_u64().expect("a number");
        assert!(beyond > 0, "{report}");
        report["wall_s"] = Value::Null;
        report
    };
    let once = run("5");
    assert_eq!(once, run("5"));
    assert_ne!(once["max_error_mm"], run("6")["max_error_mm"]);
    assert_eq!(once["runs"][0]["parts"][0]["search"]["iterations"], 496);
}

/// The waves are in the plane: no method leaves it, and no curve file is beyond its tolerance.
#[test]
fn a_search_stays_in_the_plane_of_the_program_and_within_the_tolerance_or_says_so() {
    let folder = tempfile::tempdir().expect("folder");
    let path = folder.path().join("wave.ngc");
    let mut text = String::from("G21 G90 G64\nG0 X0 Y0 Z-0.3\nF1200\n");
    for i in 1..=300 {
        let x = f64::from(i) * 0.1;
        writeln!(text, "G1 X{x:.4} Y{:.4}", 5.0 * (x / 4.0).sin()).expect("text");
    }
    std::fs::write(&path, text).expect("written");
    let program = path.to_str().expect("UTF-8");
    let curve = folder.path().join("wave.toml");
    let curve = curve.to_str().expect("UTF-8");
    let fit = |tolerance: &str| {
        let arguments = ["fit", program, "--tolerance", tolerance];
        let rest = ["--method", "foraging", "--output", curve];
        glidepath(&[arguments, rest].concat())
    };
    let output = fit("0.0001");
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.contains("more than the tolerance of 0.0001 mm"),
        "{said}"
    );
    assert!(!Path::new(curve).exists());
    let output = fit("0.5");
    assert!(output.status.success(), "{output:?}");
    let csv = folder.path().join("wave.csv");
    let csv = csv.to_str().expect("UTF-8");
    let planned = glidepath(&["plan", curve, "--setpoints", csv]);
    assert!(planned.status.success(), "{planned:?}");
    let rows = std::fs::read_to_string(csv).expect("rows");
    let mut rows = rows.lines();
    let header = rows.next().expect("a header");
    let z = header.split(',').position(|name| name == "vel_Z");
    let z = z.expect("a column of Z");
    let feed = rows.filter(|row| row.split(',').nth(4).is_none_or(|feed| feed != "0"));
    // Behind the approach, which goes down to it.
    let speed = |row: &str| row.split(',').nth(z).and_then(|v| v.parse::<f64>().ok());
    let cut = feed.skip_while(|row| speed(row) == Some(0.0));
    let cut = cut.skip_while(|row| speed(row) != Some(0.0));
    assert!(cut.clone().count() > 100);
    for row in cut {
        assert_eq!(speed(row), Some(0.0), "{row}");
    }
}

#[test]
fn what_cannot_be_done_is_said() {
    let folder = tempfile::tempdir().expect("folder");
    let program = program(folder.path());
    let output = glidepath(&[
        "fit",
        &program,
        "--tolerance",
        "0.01",
        "--output",
        "two.toml",
    ]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(
        text.contains("2 runs cannot be written as one curve"),
        "{text}"
    );
    let output = glidepath(&["fit", &program, "--tolerance", "0"]);
    assert_eq!(output.status.code(), Some(2));
    let output = glidepath(&["fit", &program, "--tolerance", "1", "--output", "curve.dxf"]);
    assert_eq!(output.status.code(), Some(2));
}
