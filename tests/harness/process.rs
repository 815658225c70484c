//! The processes of the program under test.

use std::io::{BufRead as _, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};

use crate::{Instance, glidepath, of_this_test};

/// How long a process may take for anything: far longer than it ever should.
const PATIENCE: Duration = Duration::from_secs(120);
const POLL: Duration = Duration::from_millis(5);

/// What a process left.
#[derive(Debug)]
pub struct Output {
    /// Its exit status.
    pub status: ExitStatus,
    /// What it wrote to standard output.
    pub stdout: String,
    /// What it wrote to standard error.
    pub stderr: String,
}

impl Output {
    /// Asserts that it ended with the exit code, and shows what it said if not.
    #[must_use]
    pub fn expect(self, code: i32) -> Self {
        assert_eq!(self.status.code(), Some(code), "{self:#?}");
        self
    }

    /// Why a run has ended early, if it was the host's doing: it kept the interpolator from ticks for so long that the
    /// servo stopped by itself, as it has to. `None` of every other end.
    #[must_use]
    pub fn ended_by_host(&self) -> Option<String> {
        if self.status.code() != Some(5) {
            return None;
        }
        let played = &self.json()["played"];
        let missed = played["missed_ticks"]
            .as_u64()
            .filter(|missed| *missed > 1)?;
        let is_silence = played["servo_stopped"] == "setpoints stayed away";
        is_silence.then(|| format!("the host kept the interpolator from {missed} ticks in a row"))
    }

    /// Standard output as one JSON object.
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        match serde_json::from_str(&self.stdout) {
            Ok(value) => value,
            Err(error) => panic!("not one JSON object ({error}): {self:#?}"),
        }
    }
}

/// A process under way. Dropping it kills it.
#[derive(Debug)]
pub struct Process {
    child: Child,
    stdout: Stream,
    stderr: Stream,
}

impl Process {
    /// Starts `glidepath` with arguments, in the runtime directory of the instance. What it writes
    /// is collected, so that it never waits for a reader.
    #[must_use]
    pub fn start(instance: &Instance, arguments: &[&str]) -> Self {
        Self::start_with(glidepath(), instance, arguments, Stdio::piped())
    }

    /// The same with another program.
    #[must_use]
    pub fn start_other(program: &Path, instance: &Instance, arguments: &[&str]) -> Self {
        Self::start_with(program, instance, arguments, Stdio::piped())
    }

    fn start_with(program: &Path, instance: &Instance, arguments: &[&str], input: Stdio) -> Self {
        let mut child = of_this_test(&mut Command::new(program))
            .args(arguments)
            .env("XDG_RUNTIME_DIR", instance.directory())
            .env("TMPDIR", instance.directory())
            .env("NO_COLOR", "1")
            .env_remove("GLIDEPATH_CONFIG")
            .env_remove("GLIDEPATH_INSTANCE")
            .envs(instance.wall_clock().map(|clock| ("LD_PRELOAD", clock)))
            .current_dir(instance.directory())
            .stdin(input)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let stdout = Stream::of(child.stdout.take().unwrap());
        let stderr = Stream::of(child.stderr.take().unwrap());
        Self {
            child,
            stdout,
            stderr,
        }
    }

    /// Starts one of the processes that meet in shared memory.
    #[must_use]
    pub fn join(instance: &Instance, arguments: &[&str]) -> Self {
        let name = &instance.config().instance;
        Self::start(instance, &[arguments, &["--instance", name]].concat())
    }

    /// Starts the planner's service; it takes jobs.
    #[must_use]
    pub fn service(instance: &Instance) -> Self {
        let service = Self::join(instance, &["planner", "--listen"]);
        service.wait_until_it_is_ready();
        service
    }

    /// As [`Process::join`], with a standard input of its own.
    #[must_use]
    pub fn join_with(instance: &Instance, arguments: &[&str], input: Stdio) -> Self {
        let name = &instance.config().instance;
        let arguments = [arguments, &["--instance", name]].concat();
        Self::start_with(glidepath(), instance, &arguments, input)
    }

    /// Writes to its standard input, and closes that.
    pub fn feed(&mut self, text: &str) {
        let mut stdin = self.child.stdin.take().unwrap();
        // A process that has ended early is found by its exit status.
        let _written = stdin.write_all(text.as_bytes());
    }

    /// Writes to its standard input, which stays open.
    pub fn write(&mut self, text: &str) {
        let mut stdin = self.child.stdin.as_ref().unwrap();
        // A process that has ended early is found by its exit status.
        let _written = stdin.write_all(text.as_bytes());
    }

    /// Closes its standard input.
    pub fn close(&mut self) {
        drop(self.child.stdin.take());
    }

    /// Starts one whose reader of standard output is gone after the first line, as behind `| head -1`; waits for
    /// its end.
    #[must_use]
    pub fn join_read_once(instance: &Instance, arguments: &[&str]) -> ExitStatus {
        let name = &instance.config().instance;
        let mut child = of_this_test(&mut Command::new(glidepath()))
            .args(arguments)
            .args(["--instance", name])
            .env("XDG_RUNTIME_DIR", instance.directory())
            .current_dir(instance.directory())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut reader = BufReader::new(child.stdout.take().unwrap());
        let _length = reader.read_line(&mut line).unwrap();
        drop(reader);
        let begun = Instant::now();
        loop {
            if let Some(status) = child.try_wait().unwrap() {
                return status;
            }
            if begun.elapsed() > PATIENCE {
                child.kill().unwrap();
                let _killed = child.wait();
                panic!("it goes on without a reader");
            }
            std::thread::sleep(POLL);
        }
    }

    /// Its process number.
    #[must_use]
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Sends it a signal.
    pub fn signal(&self, signal: Signal) {
        // Not waited for yet, so the number is still its own.
        let pid = Pid::from_raw(self.child.id().try_into().unwrap()).unwrap();
        kill_process(pid, signal).unwrap();
    }

    /// Whether it still runs.
    pub fn runs(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Waits for its end.
    #[must_use]
    pub fn wait(self) -> Output {
        self.wait_for(PATIENCE)
    }

    /// Waits for its end, which may take so long.
    #[must_use]
    pub fn wait_for(mut self, patience: Duration) -> Output {
        drop(self.child.stdin.take());
        let begun = Instant::now();
        let status = loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                break status;
            }
            if begun.elapsed() > patience {
                self.child.kill().unwrap();
                let (_, stdout, stderr) = (self.child.wait(), self.stdout.end(), self.stderr.end());
                panic!("no end after {patience:?}:\n{stdout}\n{stderr}");
            }
            std::thread::sleep(POLL);
        };
        Output {
            status,
            stdout: self.stdout.end(),
            stderr: self.stderr.end(),
        }
    }

    /// Asks it to end, as a service manager does, and waits for that.
    #[must_use]
    pub fn end(self) -> Output {
        self.signal(Signal::TERM);
        self.wait()
    }

    /// Waits until it has written some words to standard output.
    pub fn wait_until_it_says(&self, words: &str) {
        let begun = Instant::now();
        while !self.stdout.text().contains(words) {
            let said = self.stdout.text();
            assert!(begun.elapsed() < PATIENCE, "not {words:?}: {said}");
            std::thread::sleep(POLL);
        }
    }

    /// Waits for the JSON object that it writes to standard output first.
    #[must_use]
    pub fn wait_for_object(&self) -> serde_json::Value {
        self.wait_until_it_says("\n}");
        let said = self.stdout.text();
        match serde_json::from_str(said.trim()) {
            Ok(object) => object,
            Err(error) => panic!("no object ({error}): {said}"),
        }
    }

    /// Waits until it has told that it is ready. On a busy host that takes longer than clients wait for a service.
    pub fn wait_until_it_is_ready(&self) {
        let begun = Instant::now();
        while !self.stderr.text().contains(": ready: ") {
            let told = self.stderr.text();
            assert!(begun.elapsed() < PATIENCE, "not ready: {told}");
            std::thread::sleep(POLL);
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Nobody is left to tell.
        let _killed = self.child.kill();
        let _ended = self.child.wait();
    }
}

/// What a process writes, as far as it came.
#[derive(Debug)]
struct Stream {
    bytes: Arc<Mutex<Vec<u8>>>,
    thread: Option<JoinHandle<()>>,
}

impl Stream {
    fn of<R: Read + Send + 'static>(mut pipe: R) -> Self {
        let bytes = Arc::<Mutex<Vec<u8>>>::default();
        let into = Arc::clone(&bytes);
        let thread = std::thread::spawn(move || {
            let mut piece = [0; 4096];
            // Cut short, it is shown as far as it came.
            while let Ok(length @ 1..) = pipe.read(&mut piece) {
                into.lock().unwrap().extend_from_slice(&piece[..length]);
            }
        });
        Self {
            bytes,
            thread: Some(thread),
        }
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.bytes.lock().unwrap()).into_owned()
    }

    /// All of it, once there is no more.
    fn end(&mut self) -> String {
        self.thread.take().unwrap().join().unwrap();
        self.text()
    }
}
