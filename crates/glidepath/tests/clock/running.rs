//! Tests of `glidepath run` and the processes it starts, for real: what is reported, what is
//! played, and that nothing is left behind.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::support::{finish, object};
use glidepath_link::LinkConfig;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// About a second of motion, with a stop on the way.
const SHORT: &str = "G21 G90\nG0 X1\nG1 X11 F3000\nY10\nM0\nX1\nG4 P0.1\nY0\nM2\n";
/// Minutes of motion.
const LONG: &str = "G21 G90 F600\no1 repeat [100]\nG1 X100\nX0\no1 endrepeat\nM2\n";
/// A watchdog, not a measurement: the longest any of these may take on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(120);

fn glidepath(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
    command
        .args(args)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// An instance of this test alone.
fn instance(name: &str) -> String {
    format!("t-{name}-{}", std::process::id())
}

fn run(args: &[&str]) -> Output {
    finish(glidepath(args).spawn().unwrap(), PATIENCE)
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What an instance left.
fn leftovers(instance: &str) -> Option<PathBuf> {
    let directory = LinkConfig::new(instance).directory();
    directory.exists().then_some(directory)
}

/// Position, velocity and acceleration of every row that is not idle, as text.
fn states(csv: &str) -> Vec<String> {
    let states = csv.lines().skip(1).filter_map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        (cells[3] != "idle").then(|| cells[6..].join(","))
    });
    let mut states: Vec<String> = states.collect();
    // At rest the same state is repeated, for as long as the processes take to start or to go on.
    states.dedup();
    states
}

/// Waits until the machine of an instance moves.
fn wait_for_motion(instance: &str) {
    let started = Instant::now();
    loop {
        let output = run(&["status", "--instance", instance, "--json"]);
        if output.status.success() && object(&output)["feed_mm_s"].as_f64().unwrap() > 1.0 {
            return;
        }
        assert!(
            started.elapsed() < PATIENCE,
            "the machine does not move: {}",
            stderr(&output)
        );
    }
}

/// Sends a signal by its name.
fn signal(name: &str, pid: u32) {
    let status = Command::new("kill")
        .args(["-s", name, &pid.to_string()])
        .status()
        .unwrap();
    assert!(status.success());
}

#[test]
fn run_plays_what_plan_plans_and_reports_every_key_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let program = file(folder.path(), "short.ngc", SHORT);
    let name = instance("short");
    let (planned, played, plot) = ("planned.csv", "played.csv", "plot.svg");
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let output = run(&[
        "run",
        &program,
        "--best-effort",
        "--json",
        "--instance",
        &name,
        "--setpoints",
        &path(played),
        "--plot",
        &path(plot),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("line 5: program stop"),
        "{}",
        stderr(&output)
    );
    assert_eq!(leftovers(&name), None);
    let report = object(&output);
    for key in [
        "lines",
        "segments",
        "samples",
        "period_s",
        "cycle_time_s",
        "path_length_mm",
        "tolerance_mm",
        "max_deviation_mm",
        "max_velocity_ratio",
        "max_acceleration_ratio",
        "max_jerk_ratio",
        "plan_wall_s",
        "segments_per_s",
        "peak_rss_bytes",
        "ticks",
        "missed_ticks",
        "lost_setpoints",
    ] {
        assert!(report[key].is_number(), "{key}: {}", report[key]);
    }
    for key in ["lateness_us", "work_us"] {
        for quantile in ["p50", "p99", "p999", "max"] {
            assert!(report[key][quantile].is_number(), "{key} {quantile}");
        }
    }
    // How smooth what was played is.
    for part in ["whole", "at_feed"] {
        let figures = &report["smoothness"][part];
        assert!(figures["periods"].as_u64() > Some(10), "{part}: {figures}");
        assert!(figures["axes"]["X"]["rms_jerk"].is_number(), "{figures}");
    }
    assert!(report["smoothness_finding_count"].is_number());
    assert!(report["realtime"]["fifo"].is_boolean());
    assert_eq!(report["final_position"]["Y"], 0.0);
    assert_eq!(report["violation_count"], 0, "{}", report["violations"]);
    assert!(
        std::fs::read_to_string(path(plot))
            .unwrap()
            .starts_with("<svg")
    );

    let output = run(&["plan", &program, "--setpoints", &path(planned)]);
    assert_eq!(output.status.code(), Some(0));
    let read = |name: &str| std::fs::read_to_string(path(name)).unwrap();
    let (planned, played) = (states(&read(planned)), states(&read(played)));
    if report["lost_setpoints"] == 0 {
        assert_eq!(planned, played);
    }
    assert_eq!(planned.last(), played.last());
}

#[test]
fn a_rejected_program_starts_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let program = file(folder.path(), "bad.ngc", "G1 X1.2.3 F100\n");
    let output = run(&["run", &program, "--best-effort", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let report = object(&output);
    assert_eq!(report["exit_code"], 1);
    assert_eq!(report["findings"][0]["line"], 1);
}

/// Runs minutes of motion, which have begun.
fn run_long(folder: &Path, name: &str) -> Child {
    let program = file(folder, "long.ngc", LONG);
    let arguments = [
        "run",
        &program,
        "--best-effort",
        "--instance",
        name,
        "--json",
    ];
    let child = glidepath(&arguments).spawn().unwrap();
    wait_for_motion(name);
    child
}

#[test]
fn an_interrupted_run_ends_with_130_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let name = instance("interrupt");
    let child = run_long(folder.path(), &name);
    signal("INT", child.id());
    let output = finish(child, PATIENCE);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert_eq!(object(&output)["exit_code"], 130);
    assert_eq!(leftovers(&name), None);
    let output = run(&["status", "--instance", &name]);
    assert_eq!(output.status.code(), Some(5), "no interpolator is left");
    assert_eq!(leftovers(&name), None);
}

#[test]
fn the_death_of_a_process_ends_the_run_with_5_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let name = instance("death");
    let child = run_long(folder.path(), &name);
    let status = object(&run(&["status", "--instance", &name, "--json"]));
    signal(
        "KILL",
        u32::try_from(status["pid"].as_u64().unwrap()).unwrap(),
    );
    let output = finish(child, PATIENCE);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    let error = object(&output)["error"].as_str().unwrap().to_owned();
    assert!(error.contains("ended"), "{error}");
    assert_eq!(leftovers(&name), None);
}

#[test]
fn an_operator_holds_resumes_and_aborts() {
    let folder = tempfile::tempdir().unwrap();
    let program = file(folder.path(), "long.ngc", LONG);
    let name = instance("operator");
    let name = name.as_str();
    let interpolator = glidepath(&[
        "interpolator",
        "--best-effort",
        "--instance",
        name,
        "--json",
    ])
    .spawn()
    .unwrap();
    let planner = glidepath(&["planner", &program, "--instance", name, "--json"])
        .spawn()
        .unwrap();
    wait_for_motion(name);
    let tell = |args: &[&str]| {
        let output = run(&[args, &["--instance", name, "--json"]].concat());
        assert_eq!(
            output.status.code(),
            Some(0),
            "{args:?}: {}",
            stderr(&output)
        );
        object(&output)
    };
    let wait_for = |state: &str| {
        let started = Instant::now();
        while tell(&["status"])["state"] != state {
            assert!(started.elapsed() < PATIENCE, "never {state}");
        }
    };
    tell(&["hold"]);
    wait_for("held");
    assert_eq!(tell(&["status"])["feed_mm_s"], 0.0);
    tell(&["resume"]);
    wait_for("running");
    tell(&["override", "60"]);
    assert_eq!(tell(&["status"])["feed_override"], 0.6);
    tell(&["abort"]);
    let output = finish(planner, PATIENCE);
    assert_eq!(output.status.code(), Some(5));
    assert!(
        object(&output)["error"]
            .as_str()
            .unwrap()
            .contains("aborted")
    );
    wait_for("idle");
    signal("TERM", interpolator.id());
    let output = finish(interpolator, PATIENCE);
    assert_eq!(
        output.status.code(),
        Some(0),
        "SIGTERM is the regular end of a service"
    );
    assert_eq!(object(&output)["end_of_epoch"], "aborted");
    assert_eq!(leftovers(name), None);
}

#[test]
fn commands_without_an_interpolator_say_so() {
    let name = instance("nobody");
    for command in ["hold", "resume", "abort"] {
        let output = run(&[command, "--instance", &name]);
        assert_eq!(output.status.code(), Some(5), "{command}");
        assert!(
            stderr(&output).contains("no interpolator runs"),
            "{}",
            stderr(&output)
        );
    }
    assert_eq!(leftovers(&name), None);
}
