//! The contract of the command line, with the real binary: exit codes, JSON keys, the CSV header.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use crate::support::{glidepath, object};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PART: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/part.ngc");
const MILL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mill.toml");
const SQUARE: &str = "G21 G90\nG0 X1\nG1 X11 F3000\nY10\nX1\nY0\nG4 P0.1\nM2\n";

fn exit(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A file with this text in a folder that lasts as long as the test.
fn file(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn every_command_explains_itself_with_an_example() {
    let top = String::from_utf8(glidepath(&["--help"]).stdout).unwrap();
    for command in [
        "run",
        "plan",
        "check",
        "interpolator",
        "planner",
        "servo",
        "feed",
        "config",
        "status",
        "hold",
        "resume",
        "override",
        "abort",
        "bench",
        "doctor",
        "jitter",
    ] {
        assert!(top.contains(&format!("\n  {command} ")), "{command}");
        let help = String::from_utf8(glidepath(&[command, "--help"]).stdout).unwrap();
        assert!(
            help.contains(&format!(": glidepath {command}")),
            "{command}: {help}"
        );
    }
}

#[test]
fn usage_errors_end_with_2() {
    for args in [
        &["plan"][..],
        &["plan", "missing.ngc"],
        &["frobnicate"],
        &["check", PART, "--nonsense"],
        &["planner", PART, "--listen"],
        &["override", "201"],
        &["override", "fast"],
        &["hold", "--instance", "../x"],
    ] {
        let output = glidepath(args);
        assert_eq!(exit(&output), 2, "{args:?}: {}", stderr(&output));
        assert!(
            !output.stderr.is_empty() && output.stdout.is_empty(),
            "{args:?}"
        );
    }
}

/// A shell that works on one machine names it once.
#[test]
fn the_environment_names_the_machine_where_the_command_line_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let config = file(folder.path(), "m.toml", "[axis.X]\nmax_velocty = 1\n");
    let checked = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
        let command = command.args(["check", PART]).args(more);
        let command = command.env("GLIDEPATH_CONFIG", &config);
        command.output().unwrap()
    };
    assert_eq!(exit(&checked(&[])), 3);
    assert_eq!(exit(&checked(&["--config", MILL])), 0);

    let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
    let command = command.env("XDG_RUNTIME_DIR", folder.path());
    let command = command.env("GLIDEPATH_INSTANCE", "mill-7");
    let told = stderr(&command.arg("status").output().unwrap());
    assert!(told.contains("\"mill-7\""), "{told}");
}

#[test]
fn a_refused_configuration_ends_with_3_and_shows_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let config = file(folder.path(), "m.toml", "[axis.X]\nmax_velocty = 1\n");
    let config = config.to_str().unwrap();
    let output = glidepath(&["check", PART, "--config", config]);
    assert_eq!(exit(&output), 3);
    let text = stderr(&output);
    assert!(text.contains("m.toml:2:1"), "{text}");
    assert!(text.contains("did you mean `max_velocity`?"), "{text}");
    let output = glidepath(&["plan", PART, "--config", config, "--json"]);
    assert_eq!(exit(&output), 3);
    let object = object(&output);
    assert_eq!(object["exit_code"], 3);
    assert_eq!(object["findings"][0]["line"], 2);
    assert_eq!(
        exit(&glidepath(&["check", PART, "--config", "missing.toml"])),
        3
    );
}

/// A table is read as a whole or not at all: tools beyond what is read would be missing unseen.
#[test]
fn a_tool_table_that_is_too_long_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let part = file(
        folder.path(),
        "part.ngc",
        "G21 G90 F600\nT7 M6\nG43 G1 X1\nM2\n",
    );
    let line = format!(";{}\n", "x".repeat(1023));
    for (lines, code) in [(4000, 0), (4200, 2)] {
        let text = line.repeat(lines) + "T7 P7 Z5.0\n";
        let table = file(folder.path(), "tool.tbl", &text);
        let args = ["check", part.to_str().unwrap(), "--tool-table"];
        let output = glidepath(&[&args[..], &[table.to_str().unwrap()]].concat());
        assert_eq!(exit(&output), code, "{}", stderr(&output));
        let is_told = stderr(&output).contains("it has more than 4194304 bytes");
        assert_eq!(is_told, code == 2, "{}", stderr(&output));
    }
    let args = ["check", part.to_str().unwrap(), "--tool-table", "/dev/zero"];
    assert_eq!(exit(&glidepath(&args)), 2);
}

#[test]
fn check_lists_all_findings_of_all_programs() {
    let folder = tempfile::tempdir().unwrap();
    let bad = file(
        folder.path(),
        "bad.ngc",
        "G21 G90\nG1 X1.2.3 F600\nG1 X5 Q\nM2\n",
    );
    let bad = bad.to_str().unwrap();
    let output = glidepath(&["check", PART, bad]);
    assert_eq!(exit(&output), 1);
    let text = stderr(&output);
    assert!(
        text.contains("bad.ngc:2:5") && text.contains("bad.ngc:3:7"),
        "{text}"
    );
    assert!(text.contains(" 2 │ G1 X1.2.3 F600\n"), "{text}");
    assert!(text.contains("·     ──┬──\n"), "the word is marked: {text}");

    let output = glidepath(&["check", PART, bad, "--json"]);
    assert_eq!(exit(&output), 1);
    let object = object(&output);
    assert_eq!(object["findings"], 2);
    assert_eq!(object["programs"][0]["accepted"], true);
    let finding = &object["programs"][1]["findings"][0];
    assert_eq!(
        (&finding["line"], &finding["column"]),
        (&2.into(), &5.into())
    );
    assert_eq!(finding["code"], "malformed-number");
    for key in ["program", "length", "message", "reason", "help", "source"] {
        assert!(!finding[key].is_null(), "{key}");
    }
    assert_eq!(exit(&glidepath(&["check", PART])), 0);
}

#[test]
fn plan_refuses_a_program_with_findings() {
    let folder = tempfile::tempdir().unwrap();
    let bad = file(folder.path(), "bad.ngc", "G1 X10 F600\nG1 X9999\n");
    let csv = folder.path().join("out.csv");
    let args = [
        "plan",
        bad.to_str().unwrap(),
        "--setpoints",
        csv.to_str().unwrap(),
    ];
    let output = glidepath(&args);
    assert_eq!(exit(&output), 1);
    assert!(
        stderr(&output).contains("bad.ngc:2:"),
        "{}",
        stderr(&output)
    );
    assert!(!csv.exists(), "nothing was planned");
    let output = glidepath(&[&args[..], &["--json"]].concat());
    assert_eq!(object(&output)["exit_code"], 1);
}

#[test]
fn plan_reports_every_key_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let square = file(folder.path(), "square.ngc", SQUARE);
    let csv = folder.path().join("out.csv");
    let svg = folder.path().join("out.svg");
    let args = [
        "plan",
        square.to_str().unwrap(),
        "--setpoints",
        csv.to_str().unwrap(),
        "--plot",
        svg.to_str().unwrap(),
        "--json",
    ];
    let output = glidepath(&args);
    assert_eq!(exit(&output), 0, "{}", stderr(&output));
    let object = object(&output);
    for key in [
        "lines",
        "segments",
        "samples",
        "period_s",
        "cycle_time_s",
        "path_length_mm",
        "tolerance_mm",
        "max_deviation_mm",
        "max_beyond_travel_mm",
        "max_velocity_ratio",
        "max_acceleration_ratio",
        "max_jerk_ratio",
        "plan_wall_s",
        "segments_per_s",
        "peak_rss_bytes",
    ] {
        assert!(object[key].is_number(), "{key}: {}", object[key]);
    }
    assert_eq!(object["program"], square.to_str().unwrap());
    assert_eq!(object["lines"], 8);
    assert_eq!(object["segments"], 5);
    assert_eq!(object["period_s"], 0.004);
    assert!((object["path_length_mm"].as_f64().unwrap() - 41.0).abs() < 1e-9);
    assert_eq!(
        object["final_position"],
        serde_json::json!({ "X": 1.0, "Y": 0.0, "Z": 0.0 })
    );
    assert!(object["max_deviation_mm"].as_f64().unwrap() <= 0.02);
    assert!(object["max_jerk_ratio"].as_f64().unwrap() <= 1.0 + 1e-6);

    let text = std::fs::read_to_string(&csv).unwrap();
    let mut rows = text.lines();
    assert_eq!(
        rows.next().unwrap(),
        "tick,time_s,line,state,feed_mm_s,path_mm,pos_X,vel_X,acc_X,pos_Y,vel_Y,acc_Y,\
         pos_Z,vel_Z,acc_Z"
    );
    assert_eq!(
        rows.clone().count() as u64,
        object["samples"].as_u64().unwrap()
    );
    for (tick, row) in rows.enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        assert_eq!(cells.len(), 15);
        assert_eq!(cells[0], tick.to_string());
    }
    assert!(std::fs::read_to_string(svg).unwrap().starts_with("<svg"));
}

#[test]
fn plan_tells_what_is_not_smooth() {
    let folder = tempfile::tempdir().unwrap();
    let config = std::fs::read_to_string(MILL).unwrap();
    let fast = config.replace("effort = \"optimal\"", "effort = \"fast\"");
    assert_ne!(config, fast);
    let fast = file(folder.path(), "fast.toml", &fast);
    let fast = fast.to_str().unwrap();
    for config in [MILL, fast] {
        let output = glidepath(&["plan", PART, "--json", "--config", config]);
        assert_eq!(exit(&output), 0, "findings are no violations");
        let report = object(&output);
        let count = report["smoothness_finding_count"].as_u64().unwrap();
        let told = report["smoothness_findings"].as_array().unwrap();
        assert_eq!(told.len() as u64, count.min(20));
        assert!(config == MILL || count == 0, "{told:?}");
    }
}

#[test]
fn plan_tells_what_binds_and_where_time_is_lost() {
    let report = object(&glidepath(&["plan", PART, "--json"]));
    let shares = report["binding"].as_object().unwrap();
    let sum: f64 = shares.values().filter_map(Value::as_f64).sum();
    assert!(
        (sum - 1.0).abs() < 1e-9 && shares.contains_key("feed"),
        "{shares:?}"
    );
    let slowest = report["slowest"].as_array().unwrap();
    assert_eq!(slowest.len(), 10);
    let lost = |place: &Value| place["lost_s"].as_f64().unwrap();
    assert!(
        slowest
            .windows(2)
            .all(|pair| lost(&pair[0]) >= lost(&pair[1]))
    );
    for place in slowest {
        assert!(
            place["line"].as_u64() > Some(0) && place["limit"].is_string(),
            "{place}"
        );
        assert!(
            place["speed_mm_s"].as_f64() < place["feed_mm_s"].as_f64(),
            "{place}"
        );
    }
}

#[test]
fn bench_compares_programs_with_their_catalogue() {
    let folder = tempfile::tempdir().unwrap();
    file(folder.path(), "one.ngc", "G1 X20 F6000\nY20\nM2\n");
    let catalogue = r#"{ "bench": [{ "file": "one.ngc", "profile": "mill",
        "exact_stop_s": { "j=40000": 0.6 }, "linuxcnc": [],
        "anchors": [{ "tolerance_mm": 0.02, "jerk": 4e4, "tube_s": 0.5 }] }] }"#;
    let output = glidepath(&["bench", folder.path().to_str().unwrap()]);
    assert_eq!(
        (exit(&output), stderr(&output).contains("bench.json")),
        (2, true)
    );
    file(folder.path(), "bench.json", catalogue);
    let output = glidepath(&["bench", folder.path().to_str().unwrap(), "--json"]);
    assert_eq!(exit(&output), 0, "{}", stderr(&output));
    let row = object(&output)["programs"][0].clone();
    let time = row["cycle_time_s"].as_f64().unwrap();
    assert!((0.5..0.62).contains(&time), "{row}");
    let ratio = row["over_tube"].as_f64().unwrap();
    assert!((ratio - time / 0.5).abs() < 1e-12, "{row}");
    assert!(
        row["over_copp"].is_null() && row["violation_count"] == 0,
        "{row}"
    );
}

/// A corner that is rounded on its inner side is further from the motion than any setpoint is from the program.
#[test]
fn the_deviation_is_the_same_in_report_header_and_strip() {
    let folder = tempfile::tempdir().unwrap();
    let text = "G21 G90 G17\nG0 Z2\nG0 X10 Y10\nG1 Z-1 F600\nX30 F6000\nY30\nX10\nY10\nG0 Z2\nM2\n";
    let program = file(folder.path(), "square.ngc", text);
    let svg = folder.path().join("square.svg");
    let mill = std::fs::read_to_string(MILL).unwrap();
    for corners in ["either", "inner"] {
        let machine = mill.replace("corners = \"either\"", &format!("corners = \"{corners}\""));
        let machine = file(folder.path(), "mill.toml", &machine);
        let [program, svg, machine] = [&program, &svg, &machine].map(|path| path.to_str().unwrap());
        let output = glidepath(&[
            "plan", program, "--config", machine, "--json", "--plot", svg, "--force",
        ]);
        assert_eq!(exit(&output), 0, "{output:?}");
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let deviation_mm = report["max_deviation_mm"].as_f64().unwrap();
        assert!(deviation_mm > 0.015, "{corners}: {deviation_mm} mm");
        let drawn = std::fs::read_to_string(svg).unwrap();
        for told in [
            format!("deviation {deviation_mm:.4} of 0.02 mm"),
            format!("peak {:.1} µm", 1e3 * deviation_mm),
            format!("{:.1} % of the tolerance", 5e3 * deviation_mm),
        ] {
            assert!(drawn.contains(&told), "{corners}: no {told:?}");
        }
    }
}

#[test]
fn plan_tells_people_where_the_plot_is() {
    let folder = tempfile::tempdir().unwrap();
    let square = file(folder.path(), "square.ngc", SQUARE);
    let svg = folder.path().join("out.svg");
    let output = glidepath(&[
        "plan",
        square.to_str().unwrap(),
        "--plot",
        svg.to_str().unwrap(),
    ]);
    assert_eq!(exit(&output), 0);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("cycle time") && text.contains(svg.to_str().unwrap()),
        "{text}"
    );
}

#[test]
fn the_same_program_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let square = file(folder.path(), "square.ngc", SQUARE);
    let plan = |name: &str| {
        let csv = folder.path().join(name);
        let args = [
            "plan",
            square.to_str().unwrap(),
            "--setpoints",
            csv.to_str().unwrap(),
        ];
        assert_eq!(exit(&glidepath(&args)), 0);
        std::fs::read(csv).unwrap()
    };
    assert_eq!(plan("a.csv"), plan("b.csv"));
}

#[test]
fn a_file_that_cannot_be_written_is_told_before_planning() {
    let output = glidepath(&["plan", PART, "--setpoints", "/no/such/folder/out.csv"]);
    assert_eq!(exit(&output), 2);
    assert!(stderr(&output).contains("/no/such/folder/out.csv"));
}
