//! Tests of hostile jobs: what is handed to the planner's service does not take the service away
//! from others, and a service that does not answer does not keep whoever asked it.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::support::finish;
use rustix::process::{Pid, Signal, kill_process};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Far longer than a refusal takes, and than an answer is waited for behind an interrupt.
const PATIENCE: Duration = Duration::from_secs(40);

struct Machine {
    /// Where its processes meet. They are killed, and would leave their shared memory elsewhere.
    runtime: tempfile::TempDir,
    interpolator: Child,
    planner: Child,
}

impl Machine {
    fn start() -> Self {
        let runtime = tempfile::tempdir_in("/dev/shm").unwrap();
        let start = |args: &[&str]| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
            let command = command.args(args).env("XDG_RUNTIME_DIR", runtime.path());
            let command = command.stdin(Stdio::null()).stdout(Stdio::null());
            command.stderr(Stdio::null()).spawn().unwrap()
        };
        let interpolator = start(&["interpolator", "--best-effort"]);
        let planner = start(&["planner", "--listen"]);
        let machine = Self {
            runtime,
            interpolator,
            planner,
        };
        let started = Instant::now();
        while !machine.ask(&["mdi", "G0 X0"]).status.success() {
            assert!(started.elapsed() < PATIENCE, "no service");
        }
        machine
    }

    fn begin(&self, args: &[&str]) -> Child {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
        let command = command
            .args(args)
            .env("XDG_RUNTIME_DIR", self.runtime.path());
        let command = command.stdin(Stdio::null()).stdout(Stdio::piped());
        command.stderr(Stdio::piped()).spawn().unwrap()
    }

    fn ask(&self, args: &[&str]) -> Output {
        finish(self.begin(args), PATIENCE)
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        for child in [&mut self.planner, &mut self.interpolator] {
            child.kill().ok();
            child.wait().ok();
        }
    }
}

/// A pipe is waited for until somebody writes, or whoever waits is asked to end.
#[test]
fn nobody_is_kept_by_a_pipe_into_which_nobody_writes() {
    let folder = tempfile::tempdir().unwrap();
    let fifo = folder.path().join("fifo");
    let made = Command::new("mkfifo").arg(&fifo).status().unwrap();
    assert!(made.success());
    for command in [
        "replay", "audit", "check", "plan", "run", "planner", "feed", "live", "preview",
    ] {
        let mut asked = Command::new(env!("CARGO_BIN_EXE_glidepath"));
        let asked = asked.arg(command).arg(&fifo);
        let asked = asked.stdin(Stdio::null()).stdout(Stdio::piped());
        let mut asked = asked.stderr(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(500));
        assert!(
            asked.try_wait().unwrap().is_none(),
            "{command} does not wait"
        );
        kill_process(Pid::from_child(&asked), Signal::TERM).unwrap();
        finish(asked, PATIENCE);
    }
}

fn refused(output: &Output, file: &Path) {
    let said = String::from_utf8_lossy(&output.stderr);
    // A folder is no program, and is told before anything is asked for.
    let (code, why) = if file.is_dir() {
        (2, "it is a folder, no program")
    } else {
        (1, "no ordinary file")
    };
    assert_eq!(
        output.status.code(),
        Some(code),
        "{}: {said}",
        file.display()
    );
    assert!(said.contains(why), "{said}");
}

/// Whether a process has a handler for SIGTERM.
fn minds_signals(child: &Child) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let mut lines = status.lines();
    let caught = lines.find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    let caught = u64::from_str_radix(caught.trim(), 16).unwrap();
    caught & 1 << (Signal::TERM.as_raw() - 1) != 0
}

#[test]
fn no_job_takes_the_service_away() {
    let machine = Machine::start();
    let folder = tempfile::tempdir().unwrap();
    let fifo = folder.path().join("fifo");
    let made = Command::new("mkfifo").arg(&fifo).status().unwrap();
    assert!(made.success());
    for file in [Path::new("/dev/zero"), &fifo, folder.path()] {
        refused(&machine.ask(&["run-file", file.to_str().unwrap()]), file);
        let output = machine.ask(&["mdi", "G0 X1"]);
        assert!(output.status.success(), "{}: {output:?}", file.display());
    }
    // A service that is stopped answers nobody.
    let planner = Pid::from_child(&machine.planner);
    kill_process(planner, Signal::STOP).unwrap();
    let asked = machine.begin(&["mdi", "G0 X2"]);
    let begun = Instant::now();
    while !minds_signals(&asked) {
        assert!(begun.elapsed() < PATIENCE, "it minds no signal");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(500));
    kill_process(Pid::from_child(&asked), Signal::TERM).unwrap();
    let output = finish(asked, PATIENCE);
    kill_process(planner, Signal::CONT).unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains("has not said yet that it has"), "{said}");
}
