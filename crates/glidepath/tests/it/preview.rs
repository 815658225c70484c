//! Tests of `preview`: curve files in, regions out.
#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/data/method")
        .join(name)
}

fn glidepath(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(arguments)
        .output()
        .expect("glidepath runs")
}

fn preview(method: &str, more: &[&str]) -> Value {
    let file = data("butterfly.json");
    let mut arguments = vec![
        "preview",
        file.to_str().expect("UTF-8"),
        "--method",
        method,
        "--json",
    ];
    arguments.extend([
        "--feed",
        "6000",
        "--period-us",
        "1000",
        "--chord-error",
        "0.001",
    ]);
    arguments.extend(more);
    let output = glidepath(&arguments);
    assert!(output.status.success(), "{output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn the_report_has_regions_minima_and_counts() {
    let report = preview("certified", &[]);
    let regions = report["regions"].as_array().expect("regions");
    assert_eq!(regions.len(), 10);
    assert!(report["wall_s"].as_f64().expect("time") >= 0.0);
    let sharpest = &regions[1]["minima"][0];
    assert!((sharpest["rho_mm"].as_f64().expect("rho") - 0.023_120_695_866).abs() < 1e-9);
    assert!((sharpest["speed_cap_mm_s"].as_f64().expect("cap") - 13.452_344).abs() < 1e-5);
    assert!((sharpest["s_mm"].as_f64().expect("s") - 97.467_567_458_5).abs() < 1e-8);
    for key in ["start_u", "end_u", "start_s_mm", "end_s_mm"] {
        assert!(regions[1][key].is_number(), "{key}");
    }
    let count = |report: &Value| report["points_evaluated"].as_u64().expect("count");
    let traditional = preview("traditional", &[]);
    let patent = preview("advance-retreat", &[]);
    assert!(count(&report) < count(&patent) && count(&patent) < count(&traditional));
}

#[test]
fn the_growth_of_steps_is_configured() {
    let folder = tempfile::tempdir().expect("folder");
    let config = folder.path().join("eager.toml");
    let mill = include_str!("../../../../config/mill.toml")
        .replace("max_growth = 8.0", "max_growth = 64.0");
    std::fs::write(&config, mill).expect("written");
    let eager = preview(
        "advance-retreat",
        &["--config", config.to_str().expect("UTF-8")],
    );
    let careful = preview("advance-retreat", &[]);
    let regions = |report: &Value| report["regions"].as_array().expect("regions").len();
    assert_eq!(regions(&careful), 10);
    assert!(regions(&eager) < 10, "long steps pass over regions");
}

#[test]
fn the_plot_is_written() {
    let folder = tempfile::tempdir().expect("folder");
    let plot = folder.path().join("plot.svg");
    preview("certified", &["--plot", plot.to_str().expect("UTF-8")]);
    let svg = std::fs::read_to_string(plot).expect("a plot");
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
}

#[test]
fn a_bad_curve_file_is_rejected_with_its_place() {
    let folder = tempfile::tempdir().expect("folder");
    let file = folder.path().join("bad.toml");
    let text = "degree = 1\ncontrol_points = [[0, 0], [1, 0]]\nknots = [0, 0, 1, 0.5]\n";
    std::fs::write(&file, text).expect("written");
    let file = file.to_str().expect("UTF-8");
    let output = glidepath(&["preview", file]);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(text.contains("bad.toml:3:19"), "{text}");
    assert!(text.contains("sort the knots"), "{text}");
    let output = glidepath(&["preview", file, "--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["findings"][0]["line"], 3);
    let output = glidepath(&["preview", "nowhere.toml"]);
    assert_eq!(output.status.code(), Some(2));
}
