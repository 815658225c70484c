//! The helpers of the command's tests: how it is called, and what it said.

#![allow(dead_code, reason = "every test file uses a part of it")]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use serde_json::Value;
use std::process::{Child, Command, Output};
use std::time::{Duration, Instant};

/// The command, to its end.
pub(crate) fn glidepath(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(args)
        .output()
        .unwrap()
}

/// The one object of `--json`.
pub(crate) fn object(output: &Output) -> Value {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let value: Value = serde_json::from_str(&text).expect(&text);
    assert!(value.is_object(), "{text}");
    value
}

/// Waits for a process; kills it and fails when that takes too long.
pub(crate) fn finish(mut child: Child, patience: Duration) -> Output {
    let started = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if started.elapsed() > patience {
            child.kill().unwrap();
            panic!("the process hangs: {:?}", child.wait_with_output());
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}
