//! The processes `run` starts: this program again, with another subcommand.

use crate::command::failure::Failure;
use crate::exit::Exit;
use crate::report::Planning;
use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;
use std::ffi::OsStr;
use std::io::{self, Read as _};
use std::os::unix::process::{CommandExt as _, ExitStatusExt as _};
use std::process::{Child, ChildStdout, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long a process may take to end when asked: the interpolator brings the machine to rest
/// first.
const PATIENCE: Duration = Duration::from_secs(10);
const POLL: Duration = Duration::from_millis(5);

/// One of them. Dropping it ends it, at the latest by force.
#[derive(Debug)]
pub(super) struct Process {
    name: &'static str,
    child: Child,
    ended: Option<ExitStatus>,
}

impl Process {
    /// Starts `glidepath NAME ARGS…`. Standard error is shared with this process.
    ///
    /// The process is its own process group: Ctrl-C reaches this process alone, which then ends the
    /// others in the right order. It ends by itself if this process dies.
    pub(super) fn start<S: AsRef<OsStr>>(
        name: &'static str,
        args: impl IntoIterator<Item = S>,
    ) -> io::Result<Self> {
        let child = Command::new(std::env::current_exe()?)
            .arg(name)
            .args(args)
            .args(["--end-with", &std::process::id().to_string()])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .process_group(0)
            .spawn()?;
        Ok(Self {
            name,
            child,
            ended: None,
        })
    }

    /// What the process writes to standard output; `None` the second time.
    pub(super) const fn take_output(&mut self) -> Option<ChildStdout> {
        self.child.stdout.take()
    }

    /// Checks that the process has not ended.
    pub(super) fn must_live(&mut self) -> Result<(), Failure> {
        match self.poll().map_err(Failure::Process)? {
            None => Ok(()),
            Some(status) => Err(self.failure(status)),
        }
    }

    /// True if the process has done its work; false if it is still at it.
    pub(super) fn is_done(&mut self) -> Result<bool, Failure> {
        match self.poll().map_err(Failure::Process)? {
            None => Ok(false),
            Some(status) if status.success() => Ok(true),
            Some(status) => Err(self.failure(status)),
        }
    }

    /// The failure of a process that lives, but does nothing.
    pub(super) fn silent(&self) -> Failure {
        Failure::ProcessEnded {
            name: self.name,
            reason: "it does not start to work".to_owned(),
            exit: Exit::Fault,
        }
    }

    /// The failure of a servo that has stopped by itself.
    pub(super) fn stopped(&self, why: &str) -> Failure {
        Failure::ProcessEnded {
            name: self.name,
            reason: format!("it stopped by itself, and played nothing more: {why}"),
            exit: Exit::Fault,
        }
    }

    /// What a planner that has ended reports.
    pub(super) fn planning(&mut self) -> Result<Planning, Failure> {
        let report = self.report();
        let whole = |key: &str| report[key].as_u64();
        let planning = || {
            Some(Planning {
                lines: whole("lines")?,
                segments: whole("segments")?,
                plan_wall_s: report["plan_wall_s"].as_f64()?,
                peak_rss_bytes: whole("peak_rss_bytes"),
            })
        };
        planning().ok_or_else(|| Failure::ProcessEnded {
            name: self.name,
            reason: "its report cannot be read".to_owned(),
            exit: Exit::Fault,
        })
    }

    /// Asks it to end, and waits until it has: by force if it does not listen.
    pub(super) fn end(&mut self) -> io::Result<ExitStatus> {
        let asked = Instant::now();
        let mut signalled = false;
        while asked.elapsed() < PATIENCE {
            if let Some(status) = self.poll()? {
                return Ok(status);
            }
            if !signalled {
                self.signal(Signal::TERM);
                signalled = true;
            }
            std::thread::sleep(POLL);
        }
        self.child.kill()?;
        self.child.wait()
    }

    /// Asks it to end, and gives what it reports.
    pub(super) fn finish(mut self) -> Result<Value, Failure> {
        let status = self.end().map_err(Failure::Process)?;
        if status.success() {
            Ok(self.report())
        } else {
            Err(self.failure(status))
        }
    }

    fn poll(&mut self) -> io::Result<Option<ExitStatus>> {
        if self.ended.is_none() {
            self.ended = self.child.try_wait()?;
        }
        Ok(self.ended)
    }

    fn signal(&self, signal: Signal) {
        // The child is not waited for yet, so the number is still its own.
        let pid = i32::try_from(self.child.id()).ok().and_then(Pid::from_raw);
        if let Some(pid) = pid {
            // Fails only if it has just ended.
            let _ = kill_process(pid, signal);
        }
    }

    /// The JSON object on standard output of a process that has ended; null if there is none.
    fn report(&mut self) -> Value {
        let mut text = String::new();
        let read = self
            .take_output()
            .map(|mut output| output.read_to_string(&mut text));
        match read {
            Some(Ok(_)) => serde_json::from_str(&text).unwrap_or(Value::Null),
            _ => Value::Null,
        }
    }

    /// Why it ended.
    fn failure(&mut self, status: ExitStatus) -> Failure {
        let report = self.report();
        let exit = match status.code() {
            Some(1) => Exit::Rejected,
            Some(3) => Exit::Configuration,
            Some(4) => Exit::NotRealTime,
            Some(6) => Exit::Unchecked,
            _ => Exit::Fault,
        };
        // What clears a fault is of no use here: the machine ends with this run.
        let fault = report["fault"].as_str();
        let fault = fault.map(|fault| format!("the machine stopped by a fault: {fault}"));
        let error = report["error"].as_str().map(str::to_owned);
        let reason = match (fault.or(error), status.code(), status.signal()) {
            (Some(error), ..) => error,
            (None, Some(code), _) => format!("exit code {code}"),
            (None, None, Some(signal)) => format!("killed by signal {signal}"),
            (None, None, None) => "it ended without a code".to_owned(),
        };
        Failure::ProcessEnded {
            name: self.name,
            reason,
            exit,
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Nobody is left to tell.
        let _ = self.end();
    }
}
