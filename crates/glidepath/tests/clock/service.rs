//! The interpolator as a service: what it tells the manager, what rights it needs, and who else may
//! talk to it.
//!
//! What takes another user is skipped, and says so, unless root runs it.
#![allow(clippy::unwrap_used, reason = "a test; failures are panics")]

use serde_json::Value;
use std::os::unix::fs::PermissionsExt as _;
use std::os::unix::net::UnixDatagram;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(60);
/// User and group `nobody`.
const NOBODY: [&str; 3] = ["--reuid=65534", "--regid=65534", "--clear-groups"];

/// A runtime directory that everybody may enter, with a copy of the program that everybody may run.
struct Host {
    folder: tempfile::TempDir,
}

impl Host {
    fn new() -> Self {
        let folder = tempfile::tempdir_in("/dev/shm").unwrap();
        let open = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(folder.path(), open).unwrap();
        // By another process: a program is busy while anybody has it open for writing, and a child
        // that another test has just forked would have it open, too.
        let copied = Command::new("cp")
            .arg(env!("CARGO_BIN_EXE_glidepath"))
            .arg(folder.path().join("program"))
            .status();
        assert!(copied.unwrap().success());
        Self { folder }
    }

    fn program(&self) -> PathBuf {
        self.folder.path().join("program")
    }

    fn command(&self) -> Command {
        self.prepared(Command::new(self.program()))
    }

    /// As nobody, with more arguments for `setpriv`.
    fn as_nobody(&self, rights: &[&str]) -> Command {
        let mut command = Command::new("setpriv");
        command.args(NOBODY).args(rights).arg(self.program());
        self.prepared(command)
    }

    fn prepared(&self, mut command: Command) -> Command {
        command
            .env("XDG_RUNTIME_DIR", self.folder.path())
            .env_remove("NOTIFY_SOCKET")
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }
}

/// Ends the process with the test, however that ends.
struct Service(Option<Child>);

impl Service {
    fn start(mut command: Command) -> Self {
        let command = command.args(["interpolator", "--best-effort", "--json"]);
        Self(Some(command.spawn().unwrap()))
    }

    /// Ends it as a manager does.
    fn end(mut self) -> Output {
        let child = self.0.take().unwrap();
        let pid = rustix::process::Pid::from_child(&child);
        rustix::process::kill_process(pid, rustix::process::Signal::TERM).unwrap();
        child.wait_with_output().unwrap()
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        if let Some(mut child) = self.0.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Repeats a command until it succeeds.
fn until_success(mut command: impl FnMut() -> Command) -> Output {
    let started = Instant::now();
    loop {
        let output = command().output().unwrap();
        if output.status.success() {
            return output;
        }
        assert!(started.elapsed() < PATIENCE, "{output:?}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn can_be_nobody() -> bool {
    if !glidepath_testing::can_be_another_user() {
        return false;
    }
    let has_setpriv = Command::new("setpriv").arg("--version").output().is_ok();
    if !has_setpriv {
        glidepath_testing::skip("another user of the host", "setpriv is not installed");
    }
    has_setpriv
}

#[test]
fn the_manager_is_told_of_readiness_life_and_end() {
    let host = Host::new();
    let path = host.folder.path().join("manager");
    let socket = UnixDatagram::bind(&path).unwrap();
    socket.set_read_timeout(Some(PATIENCE)).unwrap();
    let hear = || {
        let mut buffer = [0; 64];
        let length = socket.recv(&mut buffer).unwrap();
        String::from_utf8_lossy(&buffer[..length]).into_owned()
    };
    let mut command = host.command();
    command
        .env("NOTIFY_SOCKET", &path)
        .env("WATCHDOG_USEC", "300000");
    let service = Service::start(command);
    assert_eq!(hear(), "READY=1");
    for _ in 0..3 {
        assert_eq!(hear(), "WATCHDOG=1");
    }
    let output = service.end();
    assert!(output.status.success(), "{output:?}");
    let last = std::iter::from_fn(|| Some(hear())).find(|word| word != "WATCHDOG=1");
    assert_eq!(last.as_deref(), Some("STOPPING=1"));
}

#[test]
fn another_user_neither_reads_nor_commands() {
    if !can_be_nobody() {
        return;
    }
    let host = Host::new();
    let service = Service::start(host.command());
    let status = |mut command: Command| {
        command.arg("status");
        command
    };
    until_success(|| status(host.command()));
    let root = host.folder.path().join("glidepath");
    assert_eq!(mode(&root), 0o700);
    for arguments in [&["status"][..], &["hold"], &["abort"]] {
        let output = host.as_nobody(&[]).args(arguments).output().unwrap();
        assert!(!output.status.success(), "{arguments:?}: {output:?}");
    }
    let instances = std::fs::read_dir(&root).unwrap();
    for instance in instances {
        assert_eq!(mode(&instance.unwrap().path()), 0o700);
    }
    let output = service.end();
    assert!(output.status.success(), "{output:?}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["state"], "idle", "{report:#}");
}

fn mode(path: &Path) -> u32 {
    std::fs::metadata(path).map_or(0, |data| data.permissions().mode() & 0o777)
}

#[test]
fn two_capabilities_are_enough_for_real_time() {
    if !can_be_nobody() {
        return;
    }
    let host = Host::new();
    let own = host.folder.path().join("run");
    std::fs::create_dir(&own).unwrap();
    std::os::unix::fs::chown(&own, Some(65_534), Some(65_534)).unwrap();
    let rights = [
        "--inh-caps=-all,+sys_nice,+ipc_lock",
        "--ambient-caps=-all,+sys_nice,+ipc_lock",
        "--bounding-set=-all,+sys_nice,+ipc_lock",
    ];
    let as_service = || {
        let mut command = host.as_nobody(&rights);
        command.env("XDG_RUNTIME_DIR", &own);
        command
    };
    let service = Service::start(as_service());
    until_success(|| {
        let mut command = as_service();
        command.arg("status");
        command
    });
    let output = service.end();
    assert!(output.status.success(), "{output:?}");
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let granted = &report["realtime"];
    // The idle states of the processors are a device's permission, which deploy/udev gives.
    for item in ["fifo", "memory_locked", "prefaulted"] {
        assert_eq!(granted[item], true, "{item}: {output:?}");
    }
}
