//! Tests of `glidepath run` and `glidepath plan`.

use std::path::Path;
use std::time::Duration;

use glidepath_link::Transport;
use glidepath_testing::leave_out;
use glidepath_tests::{Instance, Process, SetpointFile, Watchdog, planned};
use rustix::process::Signal;

use crate::programs::{PROGRAM, long_program, recorded};

const PATIENCE: Duration = Duration::from_secs(240);

#[test]
fn a_run_is_the_plan_bit_for_bit() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let csv = instance.path("run.csv");
    let run = recorded(&program, &csv);
    let output = Process::start(&instance, &run).wait();
    if let Some(why) = output.ended_by_host() {
        return leave_out("a run beside load", &why);
    }
    let report = output.expect(0).json();
    let received = SetpointFile::read(Path::new(&csv));
    assert_eq!(received.moving(), planned(&instance, &program).moving());
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
    assert_eq!(report["segments"], 7, "{report:#}");
    assert!(
        report["max_deviation_mm"].as_f64().unwrap() <= 0.02,
        "{report:#}"
    );
    for ratio in [
        "max_velocity_ratio",
        "max_acceleration_ratio",
        "max_jerk_ratio",
    ] {
        assert!(report[ratio].as_f64().unwrap() <= 1.0 + 1e-6, "{report:#}");
    }
    // With the rows at rest before it.
    let judged = ["audit", &csv, "--program", &program];
    let _clean = Process::start(&instance, &judged).wait().expect(0);
}

#[test]
fn an_interrupted_run_leaves_nothing_behind() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let csv = instance.path("run.csv");
    let run = Process::join(&instance, &recorded(&program, &csv));
    wait_for_motion(&instance);
    let children = children_of(run.id());
    assert_eq!(children.len(), 3, "interpolator, planner and servo");
    run.signal(Signal::INT);
    let _output = run.wait().expect(130);
    for child in children {
        assert!(
            !Path::new(&format!("/proc/{child}")).exists(),
            "process {child} is left"
        );
    }
    assert_eq!(instance.shared_memory(), Vec::<String>::new());
    // Neither the file nor what was written beside its place.
    let folder = Path::new(&csv).parent().unwrap();
    let left = std::fs::read_dir(folder).unwrap();
    let names = left.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let written: Vec<_> = names.filter(|name| name.contains("run.csv")).collect();
    assert_eq!(written, Vec::<String>::new());
}

#[test]
fn a_run_whose_child_dies_ends_as_a_fault_and_leaves_nothing_behind_but_what_was_played() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    for victim in ["interpolator", "planner", "servo"] {
        let (csv, plot) = (instance.path("died.csv"), instance.path("died.svg"));
        let run = [&recorded(&program, &csv)[..], &["--plot", &plot]].concat();
        let run = Process::join(&instance, &run);
        wait_for_motion(&instance);
        let children = children_of(run.id());
        let killed = children
            .iter()
            .find(|pid| command_of(**pid).contains(&victim.to_owned()));
        kill(*killed.unwrap());
        let told = run.wait().expect(5).json();
        for child in children {
            assert!(
                !Path::new(&format!("/proc/{child}")).exists(),
                "{victim}: {child} is left"
            );
        }
        // What was played is there, and says that it is a part.
        let received = SetpointFile::read(Path::new(&csv));
        assert!(!received.moving().is_empty(), "{victim}");
        let picture = std::fs::read_to_string(&plot).unwrap();
        assert!(picture.contains("ended before its end"), "{victim}");
        assert_eq!(told["ended_early"], true, "{victim}: {told:#}");
        assert!(told["line"].as_u64() > Some(0), "{victim}: {told:#}");
        assert!(told["position"]["X"].is_number(), "{victim}: {told:#}");
        assert!(
            told["played"]["samples"].as_u64() > Some(50),
            "{victim}: {told:#}"
        );
        let error = told["error"].as_str().unwrap();
        assert!(
            error.contains("with the machine at X ") && error.contains("died.csv"),
            "{error}"
        );
        std::fs::remove_file(&csv).unwrap();
        std::fs::remove_file(&plot).unwrap();
        assert_eq!(instance.shared_memory(), Vec::<String>::new(), "{victim}");
    }
}

#[test]
fn a_run_ends_when_its_servo_stops_by_itself_and_says_why() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let csv = instance.path("stopped.csv");
    let run = Process::join(&instance, &recorded(&program, &csv));
    wait_for_motion(&instance);
    let children = children_of(run.id());
    let interpolator = children
        .iter()
        .find(|pid| command_of(**pid).contains(&"interpolator".to_owned()));
    // Longer than drives go on without a setpoint, and shorter than what is a fault of the interpolator's.
    send(*interpolator.unwrap(), Signal::STOP);
    std::thread::sleep(Duration::from_millis(60));
    send(*interpolator.unwrap(), Signal::CONT);
    let told = run.wait().expect(5).json();
    let error = told["error"].as_str().unwrap();
    assert!(
        error.contains("the servo ended: it stopped by itself"),
        "{error}"
    );
    assert_eq!(told["ended_early"], true, "{told:#}");
    let why = told["played"]["servo_stopped"].as_str().unwrap();
    assert!(error.contains(why), "{why}: {error}");
    let lines = long_program().lines().count() as u64;
    assert!(told["line"].as_u64().unwrap() < lines - 1, "{told:#}");
    assert_eq!(instance.shared_memory(), Vec::<String>::new());
}

#[test]
fn a_program_ten_times_as_long_takes_no_more_memory() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let peak_rss = |blocks: u32| {
        let mut text = "G21 G90 G64 P0.02 F6000\n".to_owned();
        for i in 0..blocks {
            let t = f64::from(i) * 0.01;
            text.push_str(&format!(
                "G1 X{:.4} Y{:.4}\n",
                50.0 * t.sin(),
                50.0 * (1.01 * t).cos()
            ));
        }
        let program = instance.file("dense.ngc", &text);
        let report = Process::start(&instance, &["plan", &program, "--json"]).wait();
        let report = report.expect(0).json();
        assert_eq!(report["segments"].as_u64(), Some(u64::from(blocks)));
        report["peak_rss_bytes"].as_f64().unwrap()
    };
    let (short, long) = (peak_rss(5_000), peak_rss(50_000));
    assert!(long < 1.3 * short, "{short} bytes, then {long}");
}

#[test]
fn a_malformed_program_is_not_run() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("broken.ngc", "G1 X10 F3000\nG1 X1O Y5\n");
    let csv = instance.path("run.csv");
    let run = ["run", &program, "--best-effort", "--setpoints", &csv];
    let output = Process::start(&instance, &run).wait().expect(1);
    assert!(output.stderr.contains("broken.ngc:2:6"), "{output:#?}");
    assert!(!Path::new(&csv).exists() || SetpointFile::read(Path::new(&csv)).is_still());
}

/// Waits until frames of an instance are executed.
fn wait_for_motion(instance: &Instance) {
    let transport = instance.connect();
    let mut source = transport.status_source().unwrap();
    while source
        .take()
        .unwrap()
        .is_none_or(|status| status.frames_executed < 100)
    {
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn children_of(pid: u32) -> Vec<u32> {
    let mut children = Vec::new();
    for thread in std::fs::read_dir(format!("/proc/{pid}/task")).unwrap() {
        let list = std::fs::read_to_string(thread.unwrap().path().join("children")).unwrap();
        children.extend(
            list.split_whitespace()
                .map(|child| child.parse::<u32>().unwrap()),
        );
    }
    children
}

fn command_of(pid: u32) -> Vec<String> {
    let line = std::fs::read(format!("/proc/{pid}/cmdline")).unwrap();
    line.split(|byte| *byte == 0)
        .map(|part| String::from_utf8_lossy(part).into_owned())
        .collect()
}

fn kill(pid: u32) {
    send(pid, Signal::KILL);
}

fn send(pid: u32, signal: Signal) {
    let pid = rustix::process::Pid::from_raw(pid.try_into().unwrap()).unwrap();
    rustix::process::kill_process(pid, signal).unwrap();
}
