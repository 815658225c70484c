//! Times of programs for machines whose joints are not their axes, beside the least times that are known of them.
//!
//! `optima.json` has for each program the time of the best motion that a search without end found inside the
//! tolerance (on either side of corners, axes unlimited), and that of exact stops at all corners. Joints of a plan
//! are judged by the command itself, which refuses one in which a joint is beyond its limit.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
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
    let program = std::fs::read_to_string(format!("{FOLDER}/programs/{name}.ngc")).unwrap();
    time_of(name, &program, row, corners, effort)
}

/// The same for another program of its machine.
fn time_of(name: &str, program: &str, row: &Row, corners: &str, effort: &str) -> f64 {
    let machine = format!("{FOLDER}/machines/{}.toml", row.machine);
    let machine = std::fs::read_to_string(machine).unwrap();
    let corners = format!("[path]\ncorners = \"{corners}\"");
    let folder = tempfile::tempdir().unwrap();
    let config = folder.path().join("machine.toml");
    std::fs::write(&config, machine.replace("[path]", &corners)).unwrap();
    let file = folder.path().join("program.ngc");
    std::fs::write(&file, program).unwrap();
    let (program, config) = (file.to_str().unwrap(), config.to_str().unwrap());
    let output = glidepath(&[
        "plan", program, "--config", config, "--effort", effort, "--json",
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
                time_s <= stops_s,
                "{name}, {corners}, {effort}: {time_s} s, with stops {stops_s}"
            );
        }
    }
}

/// What takes longer than a few seconds is planned as it comes, and no other way is there to choose.
#[test]
fn long_programs_are_as_fast_as_short_ones() {
    let rows = std::fs::read_to_string(format!("{FOLDER}/optima.json")).unwrap();
    let rows: BTreeMap<String, Row> = serde_json::from_str(&rows).unwrap();
    // These end where they begin, so that the time of each round is known.
    for name in ["cx_square20", "hx_square20", "ld_square20"] {
        let row = &rows[name];
        let once = std::fs::read_to_string(format!("{FOLDER}/programs/{name}.ngc")).unwrap();
        let moves: Vec<&str> = once.lines().filter(|line| line.starts_with("G1")).collect();
        let head: Vec<&str> = once
            .lines()
            .take_while(|line| !line.starts_with("G1"))
            .collect();
        let rounds = (12.0 / row.optimum_s).ceil();
        let mut text = head.join("\n");
        for _ in 0..rounds as usize {
            text = format!("{text}\n{}", moves.join("\n"));
        }
        text.push_str("\nM2\n");
        let time_s = time_of(name, &text, row, "inner", "optimal");
        let ratio = time_s / (rounds * row.optimum_s);
        eprintln!("{name:12} {rounds} rounds {time_s:.3} s {ratio:.3}");
        assert!(ratio <= INNER_R, "{name}: {ratio}");
        let fast_s = time_of(name, &text, row, "inner", "fast");
        assert!(
            time_s <= fast_s,
            "{name}: {time_s} s, along the path {fast_s}"
        );
    }
}
