//! The real processes: what one program does alone, and what they do together.

use std::path::Path;
use std::time::Duration;

use glidepath_link::{MachineState, Transport};
use glidepath_tests::{Instance, Process, SetpointFile, Watchdog};
use rustix::process::Signal;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(240);

/// About two seconds of motion: lines, corners, an arc, a dwell, an event.
const PROGRAM: &str = "\
G21 G90 G64 P0.02 F6000
G0 X10 Y10 Z1
G1 X40
G3 X50 Y20 I0 J10
G1 Y40 Z0
G4 P0.05
S1000 M3
G1 X30 Y35
X10 Y40
X0 Y0 Z0
M2
";

/// Back and forth for as long as any test needs.
fn long_program() -> String {
    let mut text = "G21 G90 F3000\n".to_owned();
    for _ in 0..200 {
        text.push_str("G1 X50 Y10\nX0 Y0\n");
    }
    text
}

/// The setpoints `plan` computes.
fn planned(instance: &Instance, program: &str) -> SetpointFile {
    let csv = instance.path("plan.csv");
    let _report = Process::start(instance, &["plan", program, "--setpoints", &csv, "--json"])
        .wait()
        .expect(0);
    let setpoints = SetpointFile::read(Path::new(&csv));
    assert!(!setpoints.is_still(), "an empty plan proves nothing");
    setpoints
}

/// Interpolator and mock servo, as services would run them.
struct Services<'a> {
    instance: &'a Instance,
    interpolator: Process,
    servo: Process,
    csv: String,
}

impl<'a> Services<'a> {
    fn start(instance: &'a Instance) -> Self {
        let csv = instance.path("servo.csv");
        let servo = Process::join(instance, &["servo", "--setpoints", &csv, "--json"]);
        let interpolator = Process::join(instance, &["interpolator", "--best-effort"]);
        let services = Self {
            instance,
            interpolator,
            servo,
            csv,
        };
        let _idle = services.wait_for(MachineState::Idle);
        services
    }

    /// Waits for a state of the machine, and for the position to be told.
    fn wait_for(&self, state: MachineState) -> glidepath_link::Status {
        self.wait(|status| status.state == state.code())
    }

    fn wait(&self, wanted: impl Fn(&glidepath_link::Status) -> bool) -> glidepath_link::Status {
        let transport = self.instance.connect();
        let mut source = transport.status_source().unwrap();
        loop {
            if let Some(status) = source.take().unwrap().filter(&wanted) {
                return status;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Ends both; returns what the servo received, and its report.
    fn end(self) -> (SetpointFile, Value) {
        let _interpolator = self.interpolator.end().expect(0);
        let report = self.servo.end().expect(0).json();
        (SetpointFile::read(Path::new(&self.csv)), report)
    }
}

#[test]
fn a_run_is_the_plan_bit_for_bit() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let csv = instance.path("run.csv");
    let run = [
        "run",
        &program,
        "--best-effort",
        "--setpoints",
        &csv,
        "--json",
    ];
    let report = Process::start(&instance, &run).wait().expect(0).json();
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
}

#[test]
fn file_pipe_and_feed_give_the_same_setpoints() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let planned = planned(&instance, &program);
    let ways: [(&str, Way); 3] = [
        ("file", play_file),
        ("pipe", play_pipe),
        ("feed", play_feed),
    ];
    for (name, way) in ways {
        let services = Services::start(&instance);
        way(&instance, &program);
        let (received, report) = services.end();
        assert_eq!(report["lost_setpoints"], 0, "{name}: {report:#}");
        assert_eq!(received.moving(), planned.moving(), "{name}");
    }
}

/// A way to have a program executed.
type Way = fn(&Instance, &str);

fn play_file(instance: &Instance, program: &str) {
    let _output = Process::join(instance, &["planner", program])
        .wait()
        .expect(0);
}

fn play_pipe(instance: &Instance, program: &str) {
    let mut planner = Process::join(instance, &["planner", "-"]);
    planner.feed(&std::fs::read_to_string(program).unwrap());
    let _output = planner.wait().expect(0);
}

fn play_feed(instance: &Instance, program: &str) {
    let planner = Process::join(instance, &["planner", "--listen"]);
    let _output = Process::join(instance, &["feed", program]).wait().expect(0);
    let _listener = planner.end().expect(0);
}

#[test]
fn an_interrupted_run_leaves_nothing_behind() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let csv = instance.path("run.csv");
    let run = Process::join(
        &instance,
        &[
            "run",
            &program,
            "--best-effort",
            "--setpoints",
            &csv,
            "--json",
        ],
    );
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
    assert!(!SetpointFile::read(Path::new(&csv)).is_still());
}

#[test]
fn a_run_whose_child_dies_ends_as_a_fault_and_leaves_nothing_behind() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    for victim in ["interpolator", "planner", "servo"] {
        let run = Process::join(&instance, &["run", &program, "--best-effort", "--json"]);
        wait_for_motion(&instance);
        let children = children_of(run.id());
        let killed = children
            .iter()
            .find(|pid| command_of(**pid).contains(&victim.to_owned()));
        kill(*killed.unwrap());
        let _output = run.wait().expect(5);
        for child in children {
            assert!(
                !Path::new(&format!("/proc/{child}")).exists(),
                "{victim}: {child} is left"
            );
        }
        assert_eq!(instance.shared_memory(), Vec::<String>::new(), "{victim}");
    }
}

#[test]
fn a_malformed_program_is_rejected_without_motion() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("broken.ngc", "G1 X10 F3000\nG1 X1O Y5\nG1 X20\nG777\n");
    let services = Services::start(&instance);
    let output = Process::join(&instance, &["planner", &program])
        .wait()
        .expect(1);
    for place in ["broken.ngc:2:6", "broken.ngc:4:1"] {
        assert!(output.stderr.contains(place), "{place}: {output:#?}");
    }
    let (received, _) = services.end();
    assert!(received.is_still(), "something moved");
    let run = Process::start(&instance, &["run", &program, "--best-effort", "--json"]);
    let output = run.wait().expect(1);
    assert!(output.stderr.contains("broken.ngc:2:6") || output.stdout.contains("broken.ngc"));
}

#[test]
fn an_error_in_a_pipe_stops_the_motion_before_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let good = "G21 G90 F6000\nG1 X10 Y5\nG1 X20\n";
    let planned = planned(&instance, &instance.file("good.ngc", good));
    let services = Services::start(&instance);
    let mut planner = Process::join(&instance, &["planner", "-"]);
    planner.feed(&format!("{good}G1 X\nG1 X0 Y0\n"));
    let output = planner.wait().expect(1);
    assert!(output.stderr.contains(":4:4"), "{output:#?}");
    assert_eq!(services.end().0.moving(), planned.moving());
}

#[test]
fn a_killed_planner_leaves_the_machine_at_rest_and_a_new_one_goes_on() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 150);
    planner.signal(Signal::KILL);
    let _killed = planner.wait();
    let status = services.wait_for(MachineState::Faulted);
    assert!(
        status.position[0] > 0.0 && status.position[0] < 50.0,
        "{status:#?}"
    );
    // On the line from X0 Y0 to X50 Y10.
    let off = status.position[1] - status.position[0] / 5.0;
    assert!(off.abs() < 0.02, "{off} mm off the path");
    let shown = Process::join(&instance, &["status", "--json"])
        .wait()
        .expect(0)
        .json();
    assert!(
        shown.to_string().contains("planner"),
        "the cause is not told: {shown:#}"
    );
    let home = instance.file("home.ngc", "G21 G90 F6000\nG1 X0 Y0\n");
    let _output = Process::join(&instance, &["planner", &home])
        .wait()
        .expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.position.map(f64::abs).map(f64::to_bits), [0; 9]);
    let (_, report) = services.end();
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
}

#[test]
fn a_second_client_is_refused_and_a_killed_one_is_forgotten() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let home = instance.file("home.ngc", "G21 G90 F6000\nG1 X0 Y0\n");
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", "--listen"]);
    let first = Process::join(&instance, &["feed", &program]);
    let _moving = services.wait(|status| status.frames_executed > 150);
    let second = Process::join(&instance, &["feed", &home]).wait();
    assert_ne!(second.status.code(), Some(0), "{second:#?}");
    first.signal(Signal::KILL);
    let _killed = first.wait();
    let _abort = Process::join(&instance, &["abort"]).wait().expect(0);
    let _idle = services.wait_for(MachineState::Idle);
    let _third = Process::join(&instance, &["feed", &home]).wait().expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.position.map(f64::abs).map(f64::to_bits), [0; 9]);
    let _listener = planner.end().expect(0);
    let _received = services.end();
}

#[test]
fn a_second_planner_is_refused_and_does_not_disturb_the_first() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let planned = planned(&instance, &program);
    let services = Services::start(&instance);
    let first = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 50);
    let second = Process::join(&instance, &["planner", &program]).wait();
    assert!(!second.status.success(), "{second:#?}");
    assert!(second.stderr.contains("another planner"), "{second:#?}");
    let _first = first.wait().expect(0);
    assert_eq!(services.end().0.moving(), planned.moving());
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
    let pid = rustix::process::Pid::from_raw(pid.try_into().unwrap()).unwrap();
    rustix::process::kill_process(pid, Signal::KILL).unwrap();
}
