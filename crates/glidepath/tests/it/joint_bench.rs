//! Times of programs for machines whose joints are not their axes, beside the least times that are known of them.
//!
//! `optima.json` has for each program the time of the best motion that a search without end found inside the
//! tolerance (on either side of corners, axes unlimited), and that of exact stops at all corners. Joints of a plan
//! are judged by the command itself, which refuses one in which a joint is beyond its limit.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use super::support::{glidepath, object};
use std::collections::BTreeMap;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/bench/joints");
/// Most that a plan takes, of the least time: on either side of corners, on their inner side, along the path.
const EITHER_R: f64 = 1.08;
const INNER_R: f64 = 1.11;
const FAST_R: f64 = 1.4;
/// A plan takes whole periods.
const PERIOD_S: f64 = 0.004;

/// What is known of a program.
#[derive(Debug, serde::Deserialize)]
struct Row {
    machine: String,
    optimum_s: f64,
    stops_s: f64,
}

/// How long a plan takes, s.
fn planned_s(name: &str, row: &Row, corners: &str, effort: &str) -> f64 {
    let machine = format!("{FOLDER}/machines/{}.toml", row.machine);
    let machine = std::fs::read_to_string(machine).unwrap();
    let corners = format!("[path]\ncorners = \"{corners}\"");
    let folder = tempfile::tempdir().unwrap();
    let config = folder.path().join("machine.toml");
    std::fs::write(&config, machine.replace("[path]", &corners)).unwrap();
    let program = format!("{FOLDER}/programs/{name}.ngc");
    let config = config.to_str().unwrap();
    let output = glidepath(&[
        "plan", &program, "--config", config, "--effort", effort, "--json",
    ]);
    assert!(output.status.success(), "{name}, {corners}, {effort}");
    let report = object(&output);
    let ratio = |name: &str| report[name].as_f64().unwrap();
    let jerk_r = ratio("max_joint_jerk_ratio");
    assert!(jerk_r > 0.9 && jerk_r <= 1.0, "{name}: {jerk_r}");
    assert_eq!(report["smoothness_finding_count"], 0, "{name}, {effort}");
    ratio("cycle_time_s")
}

#[test]
fn joints_are_used_nearly_as_far_as_they_can() {
    let rows = std::fs::read_to_string(format!("{FOLDER}/optima.json")).unwrap();
    let rows: BTreeMap<String, Row> = serde_json::from_str(&rows).unwrap();
    assert_eq!(rows.len(), 12);
    let checks = [
        ("either", "optimal", EITHER_R),
        ("inner", "optimal", INNER_R),
        ("inner", "fast", FAST_R),
    ];
    for (name, row) in &rows {
        for (corners, effort, most_r) in checks {
            let time_s = planned_s(name, row, corners, effort);
            let ratio = time_s / row.optimum_s;
            eprintln!("{name:12} {corners:6} {effort:7} {time_s:.3} s {ratio:.3}");
            assert!(ratio <= most_r, "{name}, {corners}, {effort}: {ratio}");
            let stops_s = row.stops_s + 2.0 * PERIOD_S;
            assert!(
                effort == "fast" || time_s <= stops_s,
                "{name}, {corners}: {time_s} s, with stops {stops_s}"
            );
        }
    }
}
