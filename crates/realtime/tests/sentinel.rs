//! The system call sentinel, in child processes, because it ends them.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use glidepath_realtime::{
    Clock, DeadlineTimer, Monotonic, SENTINEL_EXIT_CODE, forbid_system_calls,
};
use std::process::{Command, Output};

const ROLE: &str = "GLIDEPATH_SENTINEL_ROLE";

/// Runs a test of this binary again in a process of its own, with a role.
fn child(test: &str, role: &str) -> Output {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture", "--test-threads=1"])
        .env(ROLE, role)
        .output()
        .unwrap()
}

/// Ends the process without another system call than the allowed `exit_group`.
#[allow(
    unsafe_code,
    reason = "std::process::exit runs handlers that make system calls"
)]
fn exit(code: i32) -> ! {
    // SAFETY: `_exit` takes a number and does not return.
    unsafe { libc::_exit(code) }
}

#[test]
fn sleeping_and_reading_the_clock_are_allowed() {
    if std::env::var_os(ROLE).is_some() {
        let mut timer = DeadlineTimer::new(Monotonic, Monotonic.now_ns(), 1_000_000);
        forbid_system_calls().unwrap();
        for _ in 0..5 {
            timer.wait();
        }
        exit(42);
    }
    let output = child("sleeping_and_reading_the_clock_are_allowed", "child");
    assert_eq!(output.status.code(), Some(42), "{output:?}");
}

#[test]
fn anything_else_ends_the_process_and_is_named() {
    match std::env::var(ROLE).as_deref() {
        Ok("open") => {
            forbid_system_calls().unwrap();
            std::hint::black_box(std::fs::File::open("/dev/null")).ok();
            exit(42);
        }
        Ok("print") => {
            forbid_system_calls().unwrap();
            eprintln!("a log line");
            exit(42);
        }
        _ => {}
    }
    for (role, number) in [("open", libc::SYS_openat), ("print", libc::SYS_write)] {
        let output = child("anything_else_ends_the_process_and_is_named", role);
        assert_eq!(
            output.status.code(),
            Some(SENTINEL_EXIT_CODE),
            "{role}: {output:?}"
        );
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(
            text.contains(&format!("forbidden syscall {number:04}")),
            "{role}: {text}"
        );
    }
}
