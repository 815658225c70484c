//! The watchdog, which ends a test that hangs.

use std::process::Command;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

/// What processes are told of the test that started them, and tell those that they start.
const OF_TEST: &str = "GLIDEPATH_OF_TEST";
/// What a test is left, whose processes are gone, to find that out.
const LAST: Duration = Duration::from_secs(150);

/// While it lives, the clock runs. If it is not dropped in time, the processes of its test are killed, by which that
/// fails; if it hangs all the same, the test binary aborts, and no process is left.
#[derive(Debug)]
pub struct Watchdog(#[allow(dead_code, reason = "dropping it stops the clock")] Sender<()>);

impl Watchdog {
    /// Starts the clock. The time is generous: it is there for tests that would never end.
    #[must_use]
    pub fn new(patience: Duration) -> Self {
        let (alive, watched) = channel();
        let name = test();
        std::thread::spawn(move || {
            if watched.recv_timeout(patience) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            eprintln!("{name} hangs: no end after {patience:?}; its processes are killed");
            kill(&|test| test == name);
            if watched.recv_timeout(LAST) == Err(RecvTimeoutError::Timeout) {
                eprintln!("{name} hangs, and has no processes any more");
                kill(&|_| true);
                std::process::abort();
            }
        });
        Self(alive)
    }
}

/// The test of this thread.
fn test() -> String {
    std::thread::current().name().unwrap_or("a test").to_owned()
}

/// Makes a process, and those that it starts, known as one of the test of this thread.
pub fn of_this_test(command: &mut Command) -> &mut Command {
    command.env(OF_TEST, format!("{}:{}", std::process::id(), test()))
}

/// Kills every process of a test of this binary that is one of those.
fn kill(is_one: &dyn Fn(&str) -> bool) {
    let mark = format!("{OF_TEST}={}:", std::process::id());
    let entries = std::fs::read_dir("/proc").into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    for pid in names.filter_map(|name| name.parse().ok()) {
        let variables = std::fs::read(format!("/proc/{pid}/environ")).unwrap_or_default();
        let variables = String::from_utf8_lossy(&variables).into_owned();
        let mut variables = variables.split('\0');
        let test = variables.find_map(|variable| variable.strip_prefix(&mark));
        if let Some(pid) = Pid::from_raw(pid)
            && test.is_some_and(is_one)
        {
            // One that has just ended cannot be killed, and need not be.
            let _killed = kill_process(pid, Signal::KILL);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_that_hangs_loses_its_processes_and_no_other_does() {
        let _watchdog = Watchdog::new(Duration::from_millis(50));
        let mut command = Command::new("sleep");
        let mut other = command.arg("1000").spawn().unwrap();
        let mut own = of_this_test(&mut command).spawn().unwrap();
        assert!(!own.wait().unwrap().success());
        assert!(other.try_wait().unwrap().is_none());
        other.kill().unwrap();
        let _killed = other.wait().unwrap();
    }
}
