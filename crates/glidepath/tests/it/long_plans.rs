//! Programs that take long: refused at once beyond a bound, and planned in constant memory below it.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::support::{glidepath, object};

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
        // Half an hour fills what is planned ahead; then four times as much.
        let (short, long) = (peak("s.ngc", &program(1)), peak("l.ngc", &program(4)));
        let grown = long.saturating_sub(short);
        assert!(grown < 16 << 20, "{effort}: {short} and {long} bytes");
    }
}

/// A move and a dwell of ten minutes, so often.
fn program(times: usize) -> String {
    let there = "G1 X20 F2\nG4 P600\nG1 X0\n";
    format!("G21 G90\n{}M2\n", there.repeat(times))
}
