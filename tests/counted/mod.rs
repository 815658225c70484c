//! The count of instructions of a test that runs itself under callgrind, as another process: a
//! figure that other load on the host does not change.

use glidepath_testing::skip;
use std::process::Command;

/// What is skipped where they cannot be counted.
const COUNTS: &str = "counts of instructions";

/// True, and says why, where instructions of optimised code cannot be counted.
pub(crate) fn cannot_count() -> bool {
    if cfg!(debug_assertions) {
        skip(
            COUNTS,
            "they are of optimised code, as of cargo test --release",
        );
        return true;
    }
    let is_missing = Command::new("valgrind").arg("--version").output().is_err();
    if is_missing {
        skip(COUNTS, "valgrind is not installed");
    }
    is_missing
}

/// A number in the environment; none in the process that counts.
#[allow(dead_code, reason = "not every test has a process to be counted whole")]
pub(crate) fn number(name: &str) -> Option<u32> {
    std::env::var(name).ok()?.parse().ok()
}

/// Instructions of a test of this binary, with numbers in its environment.
#[allow(dead_code, reason = "not every test has a process to be counted whole")]
pub(crate) fn counted(test: &str, numbers: &[(&str, u32)]) -> u64 {
    let numbers = numbers
        .iter()
        .map(|(name, value)| (name, value.to_string()));
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture"])
        .envs(numbers)
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8_lossy(&output.stderr);
    let mut lines = text.lines();
    let line = lines.find_map(|line| line.split_once("Collected :"));
    let (_, count) = line.unwrap();
    count.trim().parse().unwrap()
}
