//! Tests of bringing a machine to rest when the host has nothing left: no memory for files, no
//! descriptors, no shared memory at all.
//!
//! What takes a file system of its own is skipped, and says so, unless root runs it.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test; failures are panics"
)]

use crate::support::finish;
use serde_json::Value;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(60);
/// Minutes of motion.
const LONG: &str = "G21 G90 F600\no1 repeat [100]\nG1 X100\nX0\no1 endrepeat\nM2\n";

/// The place where a machine runs: with a file system in memory that is its own and small, or with
/// that of the host.
struct Host {
    folder: tempfile::TempDir,
    /// Keeps the file system, in a namespace that everything else is started in.
    namespace: Option<Child>,
}

impl Host {
    fn shared() -> Self {
        let folder = tempfile::tempdir_in("/dev/shm").unwrap();
        let namespace = None;
        Self { folder, namespace }
    }

    /// `None`, and a word about it, where that is not possible.
    fn with_memory(size: &str) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let script = format!("mount -t tmpfs -o size={size} none /dev/shm && echo up && read end");
        let mut keeper = Command::new("unshare")
            .args(["--mount", "--propagation", "private", "sh", "-c", &script])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut output = BufReader::new(keeper.stdout.take().unwrap());
        output.read_line(&mut line).unwrap();
        if line != "up\n" {
            keeper.wait().unwrap();
            glidepath_testing::skip(
                "a small file system",
                "a file system cannot be mounted in a namespace here",
            );
            return None;
        }
        let namespace = Some(keeper);
        Some(Self { folder, namespace })
    }

    /// A process in this place.
    fn start(&self, program: &str, args: &[&str]) -> Child {
        let mut command = match &self.namespace {
            None => Command::new(program),
            Some(keeper) => {
                let mut command = Command::new("nsenter");
                let target = format!("--target={}", keeper.id());
                command.args(["--mount", &target, "--", program]);
                command
            }
        };
        let runtime = match &self.namespace {
            None => self.folder.path(),
            Some(_) => Path::new("/dev/shm"),
        };
        command
            .args(args)
            .env("XDG_RUNTIME_DIR", runtime)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command.spawn().unwrap()
    }

    fn glidepath(&self, args: &[&str]) -> Child {
        self.start(env!("CARGO_BIN_EXE_glidepath"), args)
    }

    fn run(&self, args: &[&str]) -> Output {
        finish(self.glidepath(args), PATIENCE)
    }

    fn status(&self) -> Value {
        let output = self.run(&["status", "--json"]);
        assert!(output.status.success(), "{output:?}");
        serde_json::from_slice(&output.stdout).unwrap()
    }

    fn wait_for(&self, what: &str, wanted: impl Fn(&Value) -> bool) {
        let started = Instant::now();
        loop {
            let output = self.run(&["status", "--json"]);
            let status = serde_json::from_slice(&output.stdout);
            if output.status.success() && wanted(&status.unwrap()) {
                return;
            }
            assert!(started.elapsed() < PATIENCE, "never {what}: {output:?}");
        }
    }

    fn program(&self) -> PathBuf {
        let path = self.folder.path().join("long.ngc");
        std::fs::write(&path, LONG).unwrap();
        path
    }

    /// An interpolator and a planner, in motion.
    fn machine_in_motion(&self) -> Machine {
        let interpolator = self.glidepath(&["interpolator", "--best-effort", "--json"]);
        self.wait_for("idle", |status| status["state"] == "idle");
        let planner = self.glidepath(&["planner", self.program().to_str().unwrap()]);
        let machine = Machine {
            interpolator: Some(interpolator),
            planner,
        };
        self.wait_for("in motion", is_moving);
        machine
    }

    /// Takes all of the memory that a file system has, to the last page.
    fn fill_memory(&self) {
        for block in ["1M", "4k"] {
            let (from, to) = ("if=/dev/zero", format!("of=/dev/shm/filler.{block}"));
            let more = ["oflag=append", "conv=notrunc"];
            let args = [from, &to, &format!("bs={block}"), more[0], more[1]];
            let filled = finish(self.start("dd", &args), PATIENCE);
            let error = String::from_utf8_lossy(&filled.stderr).into_owned();
            assert!(error.contains("No space left"), "{error}");
        }
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        if let Some(keeper) = &mut self.namespace {
            drop(keeper.stdin.take());
            keeper.wait().unwrap();
        }
    }
}

fn is_moving(status: &Value) -> bool {
    status["feed_mm_s"].as_f64().unwrap() > 1.0
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Ended with the test, however that ends.
struct Machine {
    interpolator: Option<Child>,
    planner: Child,
}

impl Machine {
    fn pid(&self) -> u32 {
        self.interpolator.as_ref().unwrap().id()
    }

    /// What the interpolator says when it has ended.
    fn ended(mut self) -> Value {
        let output = finish(self.interpolator.take().unwrap(), PATIENCE);
        assert!(output.status.success(), "{output:?}");
        serde_json::from_slice(&output.stdout).unwrap()
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        for child in self.interpolator.iter_mut().chain([&mut self.planner]) {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

#[test]
fn a_machine_is_held_and_aborted_with_no_free_page() {
    let Some(host) = Host::with_memory("64m") else {
        return;
    };
    let mut machine = host.machine_in_motion();
    host.fill_memory();
    for (command, state) in [("hold", "held"), ("resume", "running"), ("abort", "idle")] {
        let output = host.run(&[command]);
        assert!(output.status.success(), "{command}: {output:?}");
        host.wait_for(state, |status| status["state"] == state);
    }
    assert!(!is_moving(&host.status()));
    // What the planner had is free when it has ended.
    machine.planner.wait().unwrap();
    host.fill_memory();
    // Who wants more than a command is told what there is no room for, and dies of nothing.
    for process in ["servo", "planner"] {
        let program = host.program();
        let output = match process {
            "servo" => host.run(&["servo"]),
            _ => host.run(&["planner", program.to_str().unwrap()]),
        };
        assert_eq!(output.status.code(), Some(5), "{process}: {output:?}");
        let text = stderr(&output);
        assert!(text.contains("/dev/shm/glidepath/default"), "{text}");
        // The first thing for which a page is lacking may be small: what an ended process left is given back by
        // whoever comes next.
        let bytes = text
            .split_once("no room for ")
            .and_then(|(_, rest)| rest.split_once(" bytes"))
            .and_then(|(count, _)| count.parse::<u64>().ok());
        assert!(bytes.is_some_and(|count| count > 0), "{process}: {text}");
        assert!(text.contains("df -h"), "{text}");
    }
    // That is enough.
    let free = ["-s", "-1M", "/dev/shm/filler.1M"];
    assert!(
        finish(host.start("truncate", &free), PATIENCE)
            .status
            .success()
    );
    let short = host.folder.path().join("short.ngc");
    std::fs::write(&short, "G21 G90 F6000\nG1 X1\nM2\n").unwrap();
    let output = host.run(&["planner", short.to_str().unwrap()]);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(host.status()["state"], "idle");
    assert!(host.run(&["abort", "--signal"]).status.success());
    assert_eq!(machine.ended()["state"], "idle");
}

#[test]
fn an_interpolator_that_has_no_room_does_not_start() {
    let Some(host) = Host::with_memory("64m") else {
        return;
    };
    host.fill_memory();
    // Directories take no page: it gets as far as its first file.
    let output = host.run(&["interpolator", "--best-effort"]);
    assert_eq!(output.status.code(), Some(5), "{output:?}");
    let text = stderr(&output);
    assert!(text.contains("/dev/shm/glidepath/default"), "{text}");
    assert!(text.contains("no room"), "{text}");
}

/// Runs a program with six descriptors, of which three are its streams: what this process has
/// inherited itself, from whatever started the tests, does not count.
const FEW_DESCRIPTORS: &str = r#"
    for open in /proc/$$/fd/*; do
        number=${open##*/}
        if [ "$number" -gt 2 ]; then eval "exec $number>&-"; fi
    done
    ulimit -n 6
    exec "$0" "$@"
"#;

#[test]
fn a_machine_is_held_and_aborted_without_descriptors() {
    let host = Host::shared();
    let machine = host.machine_in_motion();
    // The interpolator cannot open one more file.
    let descriptors = std::fs::read_dir(format!("/proc/{}/fd", machine.pid())).unwrap();
    let limit = format!("--nofile={}", descriptors.count());
    let pid = format!("--pid={}", machine.pid());
    assert!(
        finish(host.start("prlimit", &[&pid, &limit]), PATIENCE)
            .status
            .success()
    );
    for (command, state) in [("hold", "held"), ("resume", "running"), ("abort", "idle")] {
        // Nor has the operator's process more than its three streams and three more.
        let program = env!("CARGO_BIN_EXE_glidepath");
        let output = finish(
            host.start("bash", &["-c", FEW_DESCRIPTORS, program, command]),
            PATIENCE,
        );
        assert!(output.status.success(), "{command}: {output:?}");
        host.wait_for(state, |status| status["state"] == state);
    }
    drop(machine);
}

#[test]
fn a_machine_is_held_while_others_hang_in_their_commands() {
    let host = Host::shared();
    let machine = host.machine_in_motion();
    // All but one of the places are taken by processes that are never done.
    let places: Vec<_> = std::fs::read_dir(host.folder.path().join("glidepath/default"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.file_name()
                .unwrap()
                .as_encoded_bytes()
                .starts_with(b"panel.")
        })
        .filter(|path| path.extension().unwrap() != "status")
        .collect();
    assert_eq!(places.len(), 8);
    let files: Vec<_> = places[1..]
        .iter()
        .map(|path| std::fs::File::options().write(true).open(path).unwrap())
        .collect();
    for file in &files {
        file.try_lock().unwrap();
    }
    assert!(host.run(&["hold"]).status.success());
    let last = std::fs::File::options()
        .write(true)
        .open(&places[0])
        .unwrap();
    last.lock().unwrap();
    let output = host.run(&["abort"]);
    assert_eq!(output.status.code(), Some(5), "{output:?}");
    assert!(
        stderr(&output).contains("glidepath abort --signal"),
        "{output:?}"
    );
    assert!(host.run(&["abort", "--signal"]).status.success());
    assert_eq!(machine.ended()["state"], "idle");
}

#[test]
fn abort_by_signal_needs_no_file_of_the_panel() {
    let host = Host::shared();
    let machine = host.machine_in_motion();
    let directory = host.folder.path().join("glidepath/default");
    for entry in std::fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        // Without the names by which it is found, an interpolator would end by itself.
        let keep = ["interpolator.lock", "lock"].map(std::ffi::OsStr::new);
        if path.is_file() && !keep.contains(&path.file_name().unwrap()) {
            std::fs::remove_file(path).unwrap();
        }
    }
    let output = host.run(&["hold"]);
    assert_eq!(output.status.code(), Some(5), "{output:?}");
    assert!(
        stderr(&output).contains("glidepath abort --signal"),
        "{output:?}"
    );
    let output = host.run(&["abort", "--signal", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["signalled"], machine.pid());
    assert_eq!(machine.ended()["state"], "idle");
}

#[test]
fn nobody_is_signalled_in_the_place_of_an_interpolator_that_died() {
    let host = Host::shared();
    let mut machine = host.machine_in_motion();
    let mut killed = machine.interpolator.take().unwrap();
    killed.kill().unwrap();
    // Not waited for yet: the number is still taken, by a process that is no interpolator any more.
    let started = Instant::now();
    while stderr(&host.run(&["abort", "--signal"])).contains("signalled") {
        assert!(started.elapsed() < PATIENCE);
    }
    let output = host.run(&["abort", "--signal"]);
    assert_eq!(output.status.code(), Some(5), "{output:?}");
    assert!(
        stderr(&output).contains("no interpolator runs"),
        "{output:?}"
    );
    killed.wait().unwrap();
    let output = host.run(&["hold"]);
    assert!(
        stderr(&output).contains("no interpolator runs"),
        "{output:?}"
    );
}
