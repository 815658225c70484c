//! A wall clock that jumps, as one does that a person or a time server sets.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Stands before the clock of the C library in a process that loads it first. The wall clock it tells is up to six
/// days off, to either side, and by another time every tenth of a second; the steady clock is as it was. Waits of the
/// kernel are not touched.
const SOURCE: &str = r"
#define _GNU_SOURCE
#include <stdint.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

int clock_gettime(clockid_t id, struct timespec *time)
{
    int failed = (int)syscall(SYS_clock_gettime, id, time);
    if (!failed && id == CLOCK_REALTIME) {
        struct timespec steady;
        syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &steady);
        uint64_t tenths = (uint64_t)steady.tv_sec * 10 + (uint64_t)steady.tv_nsec / 100000000;
        uint64_t random = (tenths * UINT64_C(0x9E3779B97F4A7C15)) >> 44;
        time->tv_sec += (time_t)random - (1 << 19);
    }
    return failed;
}
";

/// Makes it in a directory, by the compiler that Rust links with. What a process has to load first.
pub(crate) fn make(directory: &Path) -> PathBuf {
    let source = directory.join("wall_clock.c");
    std::fs::write(&source, SOURCE).unwrap();
    let library = directory.join("wall_clock.so");
    let made = Command::new("cc")
        .args(["-shared", "-fPIC", "-O1", "-Wall", "-Werror", "-o"])
        .args([&library, &source])
        .status()
        .unwrap();
    assert!(made.success(), "the clock that jumps does not build");
    library
}
