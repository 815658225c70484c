//! The processes `run` starts: this program again, with another subcommand.

use rustix::process::{Pid, Signal, kill_process};
use std::ffi::OsStr;
use std::io;
use std::os::unix::process::CommandExt as _;
use std::process::{Child, ChildStdout, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long a process may take to end when asked.
const PATIENCE: Duration = Duration::from_secs(5);
const POLL: Duration = Duration::from_millis(5);

/// One of them. Dropping it ends it, at the latest by force.
#[derive(Debug)]
pub(super) struct Process {
    name: &'static str,
    child: Child,
}

impl Process {
    /// Starts `glidepath NAME ARGS…`. Standard output can be read from [`Process::take_output`];
    /// standard error is shared with this process.
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
        Ok(Self { name, child })
    }

    pub(super) const fn name(&self) -> &'static str {
        self.name
    }

    /// What the process writes to standard output; `None` the second time.
    pub(super) const fn take_output(&mut self) -> Option<ChildStdout> {
        self.child.stdout.take()
    }

    /// How it ended, if it has.
    pub(super) fn ended(&mut self) -> io::Result<Option<ExitStatus>> {
        self.child.try_wait()
    }

    /// Asks it to end, and waits until it has: by force if it does not listen.
    pub(super) fn end(&mut self) -> io::Result<ExitStatus> {
        let asked = Instant::now();
        while asked.elapsed() < PATIENCE {
            if let Some(status) = self.child.try_wait()? {
                return Ok(status);
            }
            // Again and again: a process that has only just started may not have its handler yet,
            // but then the signal ends it all the same.
            if asked.elapsed() < POLL {
                self.signal(Signal::TERM);
            }
            std::thread::sleep(POLL);
        }
        self.child.kill()?;
        self.child.wait()
    }

    fn signal(&self, signal: Signal) {
        // The child is not waited for yet, so the number is still its own.
        let pid = i32::try_from(self.child.id()).ok().and_then(Pid::from_raw);
        if let Some(pid) = pid {
            // Fails only if it has just ended.
            let _ = kill_process(pid, signal);
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Nobody is left to tell.
        let _ = self.end();
    }
}
