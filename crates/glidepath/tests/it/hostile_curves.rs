//! Tests of hostile curve files: those made to hang the command or to fill memory are refused, and
//! slow feeds are followed, in memory that does not depend on the feed.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use std::path::Path;
use std::process::Command;

const ARCH: &str = "kind = \"nurbs\"\nfeed = 3000.0\ndegree = 3\n\
    control_points = [[0.0, 0.0], [0.0, 20.0], [30.0, 20.0], [30.0, 0.0]]\n\
    weights = [1.0, 0.5, 2.0, 1.0]\nknots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]\n";

const LINE: &str = "kind = \"parametric\"\nx = \"t\"\ny = \"0*t\"\nz = \"0*t\"\nfrom = 0\nto = 10\n\
    feed = 3000.0\n";

/// Exit code and all that is said, in four minutes of a processor and a gigabyte at most.
fn bounded(folder: &Path, args: &str) -> (i32, String) {
    let command = format!(
        "ulimit -v 1500000; ulimit -t 240; exec timeout 3600 {} {args}",
        env!("CARGO_BIN_EXE_glidepath")
    );
    let output = Command::new("sh")
        .current_dir(folder)
        .args(["-c", &command])
        .output()
        .unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    (output.status.code().unwrap_or(-1), text)
}

#[test]
fn numbers_beyond_their_range_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let knots = "[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]";
    let ended = |end: &str| format!("[0.0, 0.0, 0.0, 0.0, {end}, {end}, {end}, {end}]");
    for (text, from, to, told) in [
        (
            ARCH,
            "[0.0, 20.0]",
            "[0.0, 1e15]".to_owned(),
            "control point 1 is farther",
        ),
        (
            ARCH,
            "[0.0, 20.0]",
            "[0.0, 1000001.0]".to_owned(),
            "control point 1 is farther",
        ),
        (ARCH, "0.5", "1e150".to_owned(), "weight 1 is 1"),
        (ARCH, "0.5", "1e-150".to_owned(), "weight 1 is 0.0"),
        (ARCH, knots, ended("1e-150"), "the knots go from 0 to 0.0"),
        (ARCH, knots, ended("1e300"), "knot 4 is 1"),
        (
            ARCH,
            "3000.0",
            "1e-9".to_owned(),
            "feed = 0.000000001 mm/min is out of range",
        ),
        (
            ARCH,
            "3000.0",
            "inf".to_owned(),
            "feed = inf mm/min is out of range",
        ),
        (
            ARCH,
            "degree",
            "tolerance = 1e-9\ndegree".to_owned(),
            "tolerance = 0.000000001 mm",
        ),
        (
            LINE,
            "3000.0",
            "1e-9".to_owned(),
            "feed = 0.000000001 mm/min is out of range",
        ),
        (
            LINE,
            "from",
            "chord = 1e-12\nfrom".to_owned(),
            "chord = 0.000000000001 mm",
        ),
        (
            LINE,
            "to = 10",
            "to = 1e300".to_owned(),
            "have no bound near t = 0",
        ),
    ] {
        let text = text.replacen(from, &to, 1);
        std::fs::write(folder.path().join("c.toml"), &text).unwrap();
        let (code, said) = bounded(folder.path(), "check c.toml --json");
        assert_eq!(code, 1, "{text}{said}");
        assert!(said.contains(told), "{text}{said}");
    }
}

#[test]
fn numbers_at_the_ends_of_their_ranges_come_to_an_end() {
    let folder = tempfile::tempdir().unwrap();
    let knots = "[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]";
    let ended = |end: &str| format!("[0.0, 0.0, 0.0, 0.0, {end}, {end}, {end}, {end}]");
    for (from, to) in [
        ("[0.0, 20.0]", "[0.0, 1e6]".to_owned()),
        ("[0.0, 20.0]", "[-1e6, 1e6, 1e6]".to_owned()),
        ("0.5, 2.0", "1e6, 1e-6".to_owned()),
        ("0.5, 2.0", "1e-6, 1e-6".to_owned()),
        (knots, ended("1e-9")),
        (knots, ended("1e9")),
    ] {
        let text = ARCH.replacen(from, &to, 1);
        std::fs::write(folder.path().join("c.toml"), &text).unwrap();
        let (code, said) = bounded(folder.path(), "plan c.toml");
        assert!(code == 0 || code == 1, "{code} {text}{said}");
    }
}

#[test]
fn a_slow_feed_takes_no_more_memory_than_another() {
    let folder = tempfile::tempdir().unwrap();
    // Five minutes for a quarter of a millimetre, and twenty-five.
    let small = ARCH.replace("20.0", "0.1").replace("30.0", "0.15");
    let plan = |feed: &str| {
        let slow = small.replace("3000.0", feed);
        std::fs::write(folder.path().join("c.toml"), slow).unwrap();
        let (code, said) = bounded(folder.path(), "plan c.toml --json");
        assert_eq!(code, 0, "{said}");
        let object: serde_json::Value = serde_json::from_str(&said).unwrap();
        let number = |key: &str| object[key].as_f64().unwrap();
        (number("cycle_time_s"), number("peak_rss_bytes") / 1e6)
    };
    let ((cycle_t, megabytes), (slow_t, slow_megabytes)) = (plan("0.05"), plan("0.01"));
    assert!((280.0..330.0).contains(&cycle_t), "{cycle_t}");
    assert!(slow_t > 4.5 * cycle_t, "{slow_t}");
    assert!(
        slow_megabytes < megabytes + 60.0,
        "{megabytes} and {slow_megabytes} MB"
    );
    let program = "G21 G90 F.05\nG5.2 P1 L3\nX.1 Y.1 P1\nX.2 Y0 P1\nG5.3\nM2\n";
    std::fs::write(folder.path().join("c.ngc"), program).unwrap();
    let (code, said) = bounded(folder.path(), "plan c.ngc");
    assert_eq!(code, 0, "{said}");
}

#[test]
fn a_curve_without_an_end_in_sight_says_how_far_it_is_checked() {
    let folder = tempfile::tempdir().unwrap();
    let text = "kind = \"parametric\"\nx = \"cos(t)\"\ny = \"sin(t)\"\nz = \"0*t\"\nfrom = 0\n\
        to = \"2*pi\"\nlaps = 100000\nfeed = 3000.0\n";
    std::fs::write(folder.path().join("c.toml"), text).unwrap();
    let (code, said) = bounded(folder.path(), "check c.toml");
    assert_eq!(code, 6, "{said}");
    assert_eq!(bounded(folder.path(), "plan c.toml").0, 6);
}

#[test]
fn what_has_no_end_is_no_program() {
    let folder = tempfile::tempdir().unwrap();
    for device in ["/dev/zero", "/dev/urandom"] {
        let (code, said) = bounded(folder.path(), &format!("check {device}"));
        assert_eq!(code, 2, "{said}");
        assert!(said.contains("it is a device, no program"), "{said}");
    }
    let (code, said) = bounded(folder.path(), "audit /dev/zero");
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("neither a recording nor a CSV"), "{said}");
    let header = "tick,time_s,line,state,feed_mm_s,path_mm\n";
    std::fs::write(
        folder.path().join("t.csv"),
        header.to_owned() + &"1".repeat(9 << 20),
    )
    .unwrap();
    let (code, said) = bounded(folder.path(), "audit t.csv");
    assert_eq!(code, 2);
    assert!(said.contains("row 2 is no setpoint") && said.len() < 100_000);
    let record = "record r.mcap --instance endless --seconds 0.1 --program /dev/zero";
    let (code, said) = bounded(folder.path(), record);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("it is a device, no program"), "{said}");
    assert_eq!(bounded(folder.path(), "check /dev/null").0, 0);
    std::fs::write(folder.path().join("long.ngc"), vec![b'G'; 20 << 20]).unwrap();
    let (code, said) = bounded(folder.path(), "check long.ngc");
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("no line end within 16777216 bytes"), "{said}");
}
