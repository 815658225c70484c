//! A machine whose drives answer, at which lines of the manual are typed. What a line takes to be
//! there (the service, power, an M code that waits) is there before it is typed.

use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use glidepath_link::{Ipc, LinkConfig, MachineState, Status, Transport as _};
use glidepath_tests::{Operated, Process, glidepath};
use rustix::process::{Pid, Signal, kill_process};

use super::Shell;

/// The instance of whoever names none.
const INSTANCE: &str = "default";
const PATIENCE: Duration = Duration::from_secs(60);
/// How long a command that goes on until Ctrl-C is left alone once it minds that.
const LOOKED_AT: Duration = Duration::from_millis(250);
/// What goes on until Ctrl-C.
const LASTING: [&str; 4] = [
    "glidepath live",
    "glidepath grbl",
    "glidepath record",
    "glidepath status --watch",
];
/// What is not typed here, and why.
const ELSEWHERE: [(&str, &str); 1] = [(
    "glidepath jog",
    "takes the keys of a terminal: tests/e2e/jog.rs",
)];

pub(super) struct Machine<'a> {
    shell: &'a Shell<'a>,
    folder: PathBuf,
    link: LinkConfig,
    interpolator: Option<Process>,
    servo: Option<Process>,
    service: Option<Process>,
}

impl<'a> Machine<'a> {
    pub(super) fn new(shell: &'a Shell<'a>) -> Self {
        let instance = shell.instance;
        let mut link = instance.config().clone();
        INSTANCE.clone_into(&mut link.instance);
        let changes = [
            ("homing = \"none\"", "homing = \"drive\""),
            // On the way to a line the tool goes to the top of its travel, and down at feed.
            (
                "[axis.Z]\nmin_position = -500.0\nmax_position = 500.0",
                "[axis.Z]\nmin_position = -500.0\nmax_position = 20.0",
            ),
        ];
        let configured = Operated::new(instance, &changes, "\n[m_codes.M6]\ntimeout_s = 60\n");
        let folder = instance.directory().join("machine");
        std::fs::create_dir(&folder).unwrap();
        std::fs::copy(configured.config(), folder.join("mill.toml")).unwrap();
        std::fs::write(folder.join("part.ngc"), super::part()).unwrap();
        std::fs::create_dir(folder.join("programs")).unwrap();
        Self {
            shell,
            folder,
            link,
            interpolator: None,
            servo: None,
            service: None,
        }
    }

    /// Types a line; tells what went wrong. Where the host kept the drives from their setpoints, it is typed again.
    pub(super) fn type_line(&mut self, line: &str) -> Result<(), String> {
        for _ in 0..3 {
            match self.type_once(line) {
                Err(why) if why.contains("the drives heard no setpoints") => self.ready(),
                done => return done,
            }
        }
        self.type_once(line)
    }

    fn type_once(&mut self, line: &str) -> Result<(), String> {
        // The port of the page, or of senders, may be another's on this host.
        let served = ["glidepath live", "glidepath grbl"];
        let served = served.iter().find(|served| line.starts_with(**served));
        let takes_port = !line.contains("--port") && !line.contains("--pty");
        let with_port = served.map(|it| line.replacen(it, &format!("{it} --port 0"), 1));
        let line = with_port.as_deref().filter(|_| takes_port).unwrap_or(line);
        let command = line.split(" #").next().unwrap_or(line).trim();
        if ELSEWHERE.iter().any(|(other, _)| *other == command) {
            return Ok(());
        }
        if command.ends_with('&') {
            // What is started here is what every other line needs: it is there.
            self.has(command);
            return Ok(());
        }
        let awaited = if command.contains("--resume") {
            self.serve();
            drop(self.stopped_by("abort").wait());
            None
        } else {
            self.prepare(command)
        };
        let result = if LASTING.iter().any(|lasting| command.starts_with(lasting)) {
            self.look_at(line)
        } else if command.contains("--from-line") {
            self.answer(command)
        } else {
            let output = self.shell.run(&self.folder, line);
            told(output.status.success(), &output)
        };
        if command == "glidepath step" {
            self.wait(|status| status.state == MachineState::ProgramStop.code());
            self.operate(&["resume"]);
        }
        // What waited goes on, or has failed, as it was told.
        drop(awaited.map(Process::wait));
        if command.ends_with("abort --signal") {
            drop(self.interpolator.take().map(Process::wait));
            drop(self.service.take());
        }
        result
    }

    fn has(&mut self, command: &str) {
        if command.starts_with("glidepath interpolator") {
            self.on();
        } else {
            let is_known = command.starts_with("glidepath planner --listen");
            let unknown = "mark its block as not run, or teach this test to start it";
            assert!(is_known, "{command}: {unknown}");
            self.serve();
        }
    }

    /// Makes what the line takes to be there; gives what it answers to.
    fn prepare(&mut self, command: &str) -> Option<Process> {
        let word = command.split_whitespace().nth(1).unwrap_or_default();
        match word {
            "replay" => {
                end(&mut self.service);
                end(&mut self.interpolator);
            }
            "enable" => {
                self.on();
                if self.status().state != MachineState::Off.code() {
                    self.operate(&["disable"]);
                }
            }
            "planner" => {
                end(&mut self.service);
                self.ready();
            }
            "mdi" | "run-file" | "feed" => self.serve(),
            "resume" | "step" => {
                self.serve();
                return Some(self.stopped_by("hold"));
            }
            "jog" => {
                self.ready();
                self.operate(&["override", "--jog", "100"]);
            }
            "acknowledge" => {
                self.serve();
                let asks = self.start(&["mdi", "M6"]);
                self.wait(|status| status.state == MachineState::Awaiting.code());
                return Some(asks);
            }
            _ => self.ready(),
        }
        None
    }

    fn start(&self, arguments: &[&str]) -> Process {
        let config = self.folder.join("mill.toml");
        let config = ["--config", config.to_str().unwrap()];
        Process::start(self.shell.instance, &[arguments, &config].concat())
    }

    fn operate(&self, arguments: &[&str]) {
        drop(self.start(arguments).wait().expect(0));
    }

    /// Processes are there, and drives answer.
    fn on(&mut self) {
        if self.servo.is_none() {
            self.servo = Some(self.start(&["servo"]));
        }
        if self.interpolator.is_none() {
            self.interpolator = Some(self.start(&["interpolator", "--best-effort"]));
            self.wait(|status| {
                status.state == MachineState::Off.code() && status.feedback_age_ns < 12_000_000
            });
        }
    }

    /// The machine has power, is home and at rest.
    fn ready(&mut self) {
        self.on();
        let begun = Instant::now();
        loop {
            let needed = match self.status().state() {
                Ok(MachineState::Idle) => return,
                Ok(MachineState::Off) => Some("enable"),
                Ok(MachineState::NotHomed) => Some("home"),
                Ok(MachineState::Faulted) => Some("reset"),
                Ok(MachineState::Held | MachineState::ProgramStop) => Some("abort"),
                _ => None,
            };
            // What was asked for just now may still be under way, and is then refused.
            let done = needed.map(|command| self.start(&[command]).wait().status.success());
            if needed == Some("reset") && done == Some(false) {
                // Drives that a busy host has left far behind take over where they stand.
                drop(self.start(&["disable"]).wait());
            }
            std::thread::sleep(Duration::from_millis(20));
            assert!(begun.elapsed() < PATIENCE, "{:#?}", self.status());
        }
    }

    fn serve(&mut self) {
        self.ready();
        if self.service.is_none() {
            self.service = Some(self.start(&["planner", "--listen"]));
            // It is there when it answers.
            let begun = Instant::now();
            while self.start(&["mdi", "G90"]).wait().status.code() != Some(0) {
                assert!(begun.elapsed() < PATIENCE, "the service does not answer");
                // A busy host may have kept the drives from saying where they are.
                self.ready();
            }
        }
    }

    /// A program is on its way, and an operator stops it by this command.
    fn stopped_by(&mut self, command: &str) -> Process {
        self.operate(&["override", "5"]);
        let part = self.folder.join("part.ngc");
        let program = loop {
            let mut program = self.start(&["run-file", part.to_str().unwrap()]);
            let mut ended = false;
            self.wait(|status| {
                ended = !program.runs();
                ended || status.state == MachineState::Running.code() && status.line > 12
            });
            if !ended {
                break program;
            }
            // A busy host may have kept the drives from saying where they are.
            drop(program);
            self.ready();
        };
        self.operate(&[command]);
        self.operate(&["override", "100"]);
        program
    }

    fn wait(&self, mut wanted: impl FnMut(&Status) -> bool) -> Status {
        let transport = Ipc::connect(&self.link).unwrap();
        let mut source = transport.status_source().unwrap();
        let (begun, mut last) = (Instant::now(), None);
        loop {
            if let Some(status) = source.take().unwrap() {
                if wanted(&status) {
                    return status;
                }
                last = Some(status);
            }
            assert!(begun.elapsed() < PATIENCE, "never so: {last:#?}");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    fn status(&self) -> Status {
        self.wait(|_| true)
    }

    /// Has a look at what goes on until Ctrl-C, and presses that.
    fn look_at(&self, line: &str) -> Result<(), String> {
        let said = self.folder.join("said.txt");
        let file = File::create(&said).unwrap();
        let mut command = self.shell.command(&self.folder, "bash");
        command
            .args(["-c", &format!("exec {line}")])
            .stdin(Stdio::null());
        command.stdout(file.try_clone().unwrap()).stderr(file);
        let mut child = command.spawn().unwrap();
        let begun = Instant::now();
        while !takes_interrupts(&child) && begun.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(LOOKED_AT);
        let early = child.try_wait().unwrap();
        interrupt(&child);
        let status = child.wait().unwrap();
        let text = std::fs::read_to_string(&said).unwrap();
        if early.is_none() && matches!(status.code(), Some(0 | 130)) {
            Ok(())
        } else {
            Err(format!("{status}, early: {early:?}\n{text}"))
        }
    }

    /// Types at a terminal, where the operator is asked, and agrees.
    fn answer(&self, command: &str) -> Result<(), String> {
        let mut script = self.shell.command(&self.folder, "script");
        script.args(["-qefc", command, "/dev/null"]);
        script
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = script.spawn().unwrap();
        child.stdin.as_mut().unwrap().write_all(b"yes\n").unwrap();
        let output = child.wait_with_output().unwrap();
        told(output.status.success(), &output)
    }

    pub(super) fn end(mut self) {
        end(&mut self.service);
        end(&mut self.interpolator);
        end(&mut self.servo);
    }
}

fn told(is_good: bool, output: &std::process::Output) -> Result<(), String> {
    if is_good {
        Ok(())
    } else {
        Err(format!("{output:#?}"))
    }
}

/// True once the program is there in the place of the shell that became it, and minds Ctrl-C.
fn takes_interrupts(child: &Child) -> bool {
    let about = format!("/proc/{}", child.id());
    let is_there = std::fs::read_link(format!("{about}/exe")).is_ok_and(|exe| exe == *glidepath());
    let status = std::fs::read_to_string(format!("{about}/status")).unwrap_or_default();
    let mut caught = status
        .lines()
        .filter_map(|line| line.strip_prefix("SigCgt:"));
    let caught = caught.next().map(str::trim).unwrap_or_default();
    let caught = u64::from_str_radix(caught, 16).unwrap_or(0);
    is_there && caught & 1 << (Signal::INT.as_raw() - 1) != 0
}

fn interrupt(child: &Child) {
    let pid = Pid::from_raw(child.id().try_into().unwrap()).unwrap();
    // One that has ended is told of by its status.
    let _gone = kill_process(pid, Signal::INT);
}

fn end(process: &mut Option<Process>) {
    if let Some(process) = process.take() {
        drop(process.end());
    }
}
