//! The real-time sanitizer of LLVM: ends the process where a function that must not block
//! allocates, locks or calls the system. It takes the nightly compiler:
//!
//! ```text
//! RUSTFLAGS="-Zsanitizer=realtime --cfg glidepath_rtsan" cargo +nightly test -p glidepath-interpolator \
//!     --target x86_64-unknown-linux-gnu --target-dir target/rtsan --lib --test rtsan
//! ```
//!
//! The unit tests drive the work of a tick, which is marked, through start, motion, hold, resume,
//! override, starvation, steps, faults, reset and abort; the test here proves that the sanitizer is
//! on.
#![cfg(glidepath_rtsan)]
#![feature(sanitize)]
#![allow(clippy::unwrap_used, reason = "a test")]

use std::hint::black_box;
use std::process::Command;

/// Exit code of a process that the sanitizer ended.
const CAUGHT: i32 = 43;
const ROLE: &str = "GLIDEPATH_RTSAN_ROLE";

#[sanitize(realtime = "nonblocking")]
fn allocates() {
    black_box(vec![black_box(1_u8)]);
}

#[test]
fn an_allocation_is_caught() {
    if std::env::var_os(ROLE).is_some() {
        allocates();
        return;
    }
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "an_allocation_is_caught", "--nocapture"])
        .env(ROLE, "allocate")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(CAUGHT), "{output:?}");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(text.contains("RealtimeSanitizer"), "{text}");
}
