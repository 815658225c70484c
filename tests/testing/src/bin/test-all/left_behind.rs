//! Processes that tests have left behind.

use std::io;
use std::time::Duration;

use rustix::process::{Pid, Signal, WaitOptions, getpid, kill_process, set_child_subreaper, wait};

/// Between two looks at what is ending.
const POLL: Duration = Duration::from_millis(10);

/// From now on, processes whose parent ends are children of this one.
pub(crate) fn come_to_this_process() -> io::Result<()> {
    Ok(set_child_subreaper(Some(getpid()))?)
}

/// Ends all processes that are left, with what they have started, and tells what they were. Not before the last process
/// that is meant to run has ended.
pub(crate) fn end_all() -> Vec<String> {
    let mut names = Vec::new();
    let mut killed = Vec::new();
    loop {
        // One that has ended is a child until it was waited for.
        while let Ok(Some((pid, _))) = wait(WaitOptions::NOHANG) {
            killed.retain(|known| *known != pid);
        }
        let children = children();
        if children.is_empty() {
            return names;
        }
        for pid in children {
            if !killed.contains(&pid) {
                names.push(format!("{pid:?} {}", command_line(pid)));
                killed.push(pid);
                // One that has just ended cannot be killed, and need not be.
                let _killed = kill_process(pid, Signal::KILL);
            }
        }
        std::thread::sleep(POLL);
    }
}

/// The children of this process. Not every kernel lists them by their parent.
fn children() -> Vec<Pid> {
    let own = getpid();
    let entries = std::fs::read_dir("/proc").into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let pids = names.filter_map(|name| Pid::from_raw(name.parse().ok()?));
    pids.filter(|pid| parent(*pid) == Some(own)).collect()
}

/// The parent of a process: the second word behind its name, which may have spaces and brackets.
fn parent(pid: Pid) -> Option<Pid> {
    let path = format!("/proc/{}/stat", pid.as_raw_nonzero());
    let stat = std::fs::read_to_string(path).ok()?;
    let (_, behind) = stat.rsplit_once(')')?;
    Pid::from_raw(behind.split_whitespace().nth(1)?.parse().ok()?)
}

fn command_line(pid: Pid) -> String {
    let path = format!("/proc/{}/cmdline", pid.as_raw_nonzero());
    let bytes = std::fs::read(path).unwrap_or_default();
    let words = String::from_utf8_lossy(&bytes).replace('\0', " ");
    words.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;
    use std::time::Instant;

    #[test]
    #[allow(clippy::unwrap_used, reason = "a test")]
    fn what_a_child_leaves_behind_is_ended_and_named() {
        come_to_this_process().unwrap();
        let line = "sleep 1000 & sleep 1000 & exit 0";
        let mut shell = Command::new("sh").args(["-c", line]).spawn().unwrap();
        assert!(shell.wait().unwrap().success());
        // One that has not begun its program yet is called as the shell is, and one that is about to has no name.
        let begun = || {
            let names = children().into_iter().map(command_line);
            names.filter(|name| name == "sleep 1000").count()
        };
        let until = Instant::now() + Duration::from_secs(60);
        while begun() < 2 && Instant::now() < until {
            std::thread::sleep(POLL);
        }
        let mut names = end_all();
        names.retain(|name| name.contains("sleep 1000"));
        assert_eq!(names.len(), 2, "{names:?}");
        assert!(children().is_empty());
    }
}
