//! Another user of the host before the mirror: what it may not touch, and what its worst does to mirror and machine.
//!
//! Shared memory is the test's own here, as the worst that another user can do is for every program of the host.

use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use glidepath_testing::{can_be_another_user, is_crowded, skip};
use glidepath_tests::{Instance, Process, Tape, Watchdog};
use rustix::process::Signal;
use serde_json::Value;

use super::{ANSWER, ANSWER_CROWDED, PATIENCE, Seen, mirror, reader, root, start};
use crate::programs::long_program;

/// Set where `/dev/shm` is this test's own.
const OWN_MEMORY: &str = "GLIDEPATH_TEST_OWN_MEMORY";
const THIS: &str = "mirror::intruder::another_user_does_not_touch_the_mirror_nor_by_it_the_machine";
/// What the interpolator, its servo, mirror and readers need, several times.
const MEMORY: &str = "512m";
/// A file of iceoryx2 that all users may write.
const COUNTER: &str = "global_mgmt";

/// Whether the test is to go on; otherwise it was run where it can, or not at all, with a word about it.
fn has_own_memory() -> bool {
    if !can_be_another_user() {
        return false;
    }
    if std::env::var_os(OWN_MEMORY).is_some() {
        return true;
    }
    if Command::new("setpriv").arg("--version").output().is_err() {
        skip("another user of the host", "setpriv is not installed");
        return false;
    }
    let script =
        format!("mount -t tmpfs -o mode=1777,size={MEMORY} none /dev/shm && exec \"$0\" \"$@\"");
    let inside = |program: &Path, arguments: &[&str]| {
        Command::new("unshare")
            .args(["--mount", "--propagation", "private", "sh", "-c", &script])
            .arg(program)
            .args(arguments)
            .env(OWN_MEMORY, "")
            .output()
            .unwrap()
    };
    if !inside(Path::new("true"), &[]).status.success() {
        skip(
            "shared memory outside of an instance",
            "a file system cannot be mounted in a namespace here",
        );
        return false;
    }
    // What is built, is built by it, too.
    let (this, _reader) = (
        std::env::current_exe().unwrap(),
        glidepath_tests::onlooker(),
    );
    let output = inside(&this, &[THIS, "--exact", "--nocapture"]);
    let said = String::from_utf8_lossy(&output.stdout);
    let is_passed = output.status.success() && said.contains("1 passed");
    assert!(
        is_passed,
        "{said}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    false
}

/// A program of `nobody`.
fn as_nobody(instance: &Instance, arguments: &[&str]) -> Process {
    let nobody = ["--reuid=65534", "--regid=65534", "--clear-groups"];
    let arguments = [&nobody[..], arguments].concat();
    Process::start_other(Path::new("setpriv"), instance, &arguments)
}

/// A machine that moves for minutes, whose servo writes no file.
struct Machine<'a> {
    instance: &'a Instance,
    interpolator: Process,
    servo: Process,
    planner: Process,
}

impl<'a> Machine<'a> {
    fn start(instance: &'a Instance) -> (Self, Tape) {
        let program = instance.file("program.ngc", &long_program());
        let servo = Process::join(instance, &["servo", "--best-effort", "--json"]);
        let interpolator = Process::join(instance, &["interpolator", "--best-effort"]);
        let _ready = instance.wait_for_status(|_| true);
        let tape = Tape::start(instance);
        let planner = Process::join(instance, &["planner", &program]);
        let machine = Self {
            instance,
            interpolator,
            servo,
            planner,
        };
        machine.wait_for("running");
        (machine, tape)
    }

    /// Asks a command by the panel, which answers in time.
    fn ask(&self, command: &str) -> Value {
        let asked = Instant::now();
        let answer = Process::join(self.instance, &[command, "--json"]).wait();
        let (took, answer) = (asked.elapsed(), answer.expect(0).json());
        let most = if is_crowded() { ANSWER_CROWDED } else { ANSWER };
        assert!(took < most, "{command} took {took:?}");
        answer
    }

    fn wait_for(&self, state: &str) {
        let begun = Instant::now();
        while self.ask("status")["state"] != state {
            assert!(begun.elapsed() < PATIENCE / 4, "never {state}");
        }
    }

    fn assert_operated(&self) {
        let _held = self.ask("hold");
        self.wait_for("held");
        let _resumed = self.ask("resume");
        self.wait_for("running");
    }

    /// Ends everything; no setpoint may be missing or wrong.
    fn end(self, tape: Tape) {
        let _aborted = self.ask("abort");
        self.wait_for("idle");
        let _stopped = self.planner.wait();
        let wrong = tape.judge();
        assert_eq!(wrong, Vec::<String>::new());
        let _interpolator = self.interpolator.end().expect(0);
        let report = self.servo.end().expect(0).json();
        assert_eq!(report["lost_setpoints"], 0, "{report}");
    }
}

#[test]
fn another_user_does_not_touch_the_mirror_nor_by_it_the_machine() {
    if !has_own_memory() {
        return;
    }
    let instance = Instance::for_processes();
    let _watchdog = Watchdog::new(PATIENCE);
    // So near does no installation let others come.
    std::fs::set_permissions(instance.directory(), PermissionsExt::from_mode(0o755)).unwrap();
    let program = program_of(&instance);
    let _length = std::fs::copy(glidepath_tests::onlooker(), &program).unwrap();
    let (machine, tape) = Machine::start(&instance);
    let mut victim = mirror(&instance);
    let mut onlooker = reader(&instance);

    what_it_joins(&instance, &program);
    what_it_finds(&instance, &machine);
    machine.assert_operated();
    assert!(victim.runs() && onlooker.runs());

    memory_that_is_full(&instance, &machine, &onlooker);
    assert!(onlooker.runs() && victim.runs(), "it is not ended by that");

    counter_that_is_damaged(&instance, &machine);
    assert!(victim.runs() && onlooker.runs(), "those that run go on");
    let report = victim.end().expect(0).json();
    assert_eq!(report["lost_setpoints"], 0, "{report}");
    let seen = Seen::of(&onlooker.wait().expect(0));
    assert!(seen.is_gapless(), "{:?}", seen.gaps);
    machine.end(tape);
}

/// It gets hold of nothing but of what is for all, and finds what it looks for.
fn what_it_finds(instance: &Instance, machine: &Machine<'_>) {
    let script = instance.file("intruder.sh", include_str!("intruder.sh"));
    let (root, link) = (root(instance), instance.config().root.clone());
    let arguments = ["sh", &script, &root, link.to_str().unwrap()];
    let intruder = as_nobody(instance, &arguments);
    machine.assert_operated();
    let said = intruder.wait().expect(0).stdout;
    let (of_all, mut others): (Vec<_>, Vec<_>) =
        said.lines().partition(|line| line.contains(COUNTER));
    // Reading and writing are what its mode allows; its folder keeps it from being removed.
    let is_allowed = |line: &&str| {
        ["read", "write", "truncate"]
            .iter()
            .any(|it| line.starts_with(it))
    };
    assert!(
        !of_all.is_empty() && of_all.iter().all(is_allowed),
        "{of_all:?}"
    );
    others.sort_unstable();
    others.dedup();
    assert_eq!(others, ["done"]);
}

fn program_of(instance: &Instance) -> String {
    instance.path("reader")
}

/// It neither reads the services nor publishes there.
fn what_it_joins(instance: &Instance, program: &str) {
    let (name, root) = (&instance.config().instance, root(instance));
    let output = as_nobody(instance, &[program, name, &root]).wait();
    assert!(!output.status.success(), "{output:#?}");
    assert!(!output.stdout.contains("ready"), "{output:#?}");
}

/// It fills the memory that all share.
fn memory_that_is_full(instance: &Instance, machine: &Machine<'_>, onlooker: &Process) {
    let filler = "cat /dev/zero > /dev/shm/filler";
    let full = as_nobody(instance, &["sh", "-c", filler]).wait();
    assert!(full.stderr.contains("No space"), "{full:#?}");
    machine.assert_operated();
    // What a reader that stands still has not read yet is in memory that was not used before. The mirror keeps 4 s of it:
    // nothing else is done meanwhile, whatever the host has to do.
    onlooker.signal(Signal::STOP);
    std::thread::sleep(Duration::from_secs(2));
    onlooker.signal(Signal::CONT);
    let gone = as_nobody(instance, &["rm", "/dev/shm/filler"]).wait();
    let _gone = gone.expect(0);
}

/// It damages the counter, which is for all: nothing starts any more, and it is told why.
fn counter_that_is_damaged(instance: &Instance, machine: &Machine<'_>) {
    let damage = "for it in /dev/shm/iox2_*global_mgmt; do head -c 16 /dev/zero > $it; done";
    let damaged = as_nobody(instance, &["sh", "-c", damage]).wait();
    let _damaged = damaged.expect(0);
    machine.assert_operated();
    let told = start(instance).wait();
    assert!(!told.status.success(), "{told:#?}");
    assert!(format!("{told:?}").contains(COUNTER), "{told:#?}");
}
