//! Tests of programs that take long: refused at once beyond a bound, and planned in constant memory
//! below it.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::support::{glidepath, object};
use std::fs::File;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn months_of_motion_are_refused_at_once_with_a_way_round() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name).display().to_string();
        std::fs::write(&path, text).unwrap();
        path
    };
    let slow = file("slow.ngc", "G21 G90\nG1 X400 F0.001\nM2\n");
    let dwells = format!("G21 G90\n{}M2\n", "G4 P3600\n".repeat(10_000));
    let dwells = file("dwells.ngc", &dwells);
    for (program, takes) in [(&slow, "277.8 days"), (&dwells, "416.7 days")] {
        let output = glidepath(&["plan", program]);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{told}");
        for words in [takes, "7.0 days", "--longest"] {
            assert!(told.contains(words), "{words}: {told}");
        }
    }
    let short = file("short.ngc", "G21 G90\nG4 P5\nG1 X1 F600\nM2\n");
    let refused = glidepath(&["plan", &short, "--longest", "5s", "--json"]);
    assert_eq!(refused.status.code(), Some(1));
    let planned = glidepath(&["plan", &short, "--longest", "6s"]);
    assert_eq!(planned.status.code(), Some(0));
}

#[test]
fn memory_does_not_grow_with_the_length_of_a_plan() {
    let folder = tempfile::tempdir().unwrap();
    for effort in ["fast", "optimal"] {
        let peak = |name: &str, text: &str| {
            let path = folder.path().join(name).display().to_string();
            std::fs::write(&path, text).unwrap();
            let output = glidepath(&["plan", &path, "--effort", effort, "--json"]);
            assert_eq!(output.status.code(), Some(0));
            let report = object(&output);
            assert!(report["samples"].as_u64() > Some(100_000));
            report["peak_rss_bytes"].as_u64().unwrap()
        };
        // What is planned ahead, 40 MB at most, is little where the host has time to take it at once.
        let (short, long) = (peak("s.ngc", &program(1)), peak("l.ngc", &program(4)));
        let grown = long.saturating_sub(short);
        assert!(grown < 56 << 20, "{effort}: {short} and {long} bytes");
    }
}

/// A plan goes ahead of whoever takes it, and waits when it has come far enough.
#[test]
fn a_plan_that_nobody_takes_waits_in_bounded_memory() {
    let folder = tempfile::tempdir().unwrap();
    let (program, pipe) = (folder.path().join("slow.toml"), folder.path().join("pipe"));
    let curve = "kind = \"nurbs\"\nfeed = 0.01\ndegree = 3\n\
        control_points = [[0.0, 0.0], [0.0, 0.1], [0.15, 0.1], [0.15, 0.0]]\n\
        weights = [1.0, 0.5, 2.0, 1.0]\nknots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]\n";
    std::fs::write(&program, curve).unwrap();
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    // Open, so that it can be written to, and never read.
    let unread = File::options().read(true).write(true).open(&pipe).unwrap();
    let mut planner = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .arg("plan")
        .arg(&program)
        .arg("--force")
        .arg("--setpoints")
        .arg(&pipe)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let most_kib = || {
        let status = std::fs::read_to_string(format!("/proc/{}/status", planner.id())).unwrap();
        let line = status
            .lines()
            .find(|line| line.starts_with("VmHWM:"))
            .unwrap();
        line.split_whitespace()
            .nth(1)
            .unwrap()
            .parse::<u64>()
            .unwrap()
    };
    let (mut kib, mut since) = (0, Instant::now());
    while since.elapsed() < Duration::from_secs(3) {
        std::thread::sleep(Duration::from_millis(50));
        let now_kib = most_kib();
        if now_kib > kib {
            (kib, since) = (now_kib, Instant::now());
        }
    }
    assert_eq!(planner.try_wait().unwrap(), None, "it waits");
    planner.kill().unwrap();
    planner.wait().unwrap();
    drop(unread);
    assert!(kib < 110 << 10, "{kib} KiB");
}

/// A move and a dwell of ten minutes, so often.
fn program(times: usize) -> String {
    let there = "G1 X20 F2\nG4 P600\nG1 X0\n";
    format!("G21 G90\n{}M2\n", there.repeat(times))
}
