//! Real programs, compared with what an independent interpreter made of them.
//!
//! Runs where the environment variable `GLIDEPATH_CORPUS` names the directory of the programs and
//! their `EXPECTED.json`; says so and passes where it does not.

#![expect(clippy::print_stderr, reason = "a skipped test says so")]

use std::fs;
use std::path::PathBuf;

use glidepath_gcode::{Options, Report, check};
use serde_json::Value;

/// Programs judged otherwise than by the reference, each with the reason.
const OTHER_VERDICT: [(&str, bool, &str); 3] = [
    (
        "malformed/bom-crlf.nc",
        true,
        "a UTF-8 byte order mark is harmless",
    ),
    (
        "malformed/o-missing-endsub.ngc",
        false,
        "the reference misses the program end only",
    ),
    (
        "malformed/nul-bytes.nc",
        false,
        "the reference loses the block behind the NUL bytes",
    ),
];

/// Figures that differ from the reference, each with the reason.
const OTHER_FIGURES: [(&str, &str, &str); 5] = [
    (
        "axes/4axis-rotary-xza-51k.ngc",
        "final A",
        "G92 renames the place, it moves nothing",
    ),
    (
        "malformed/tiny-moves.nc",
        "straight feeds",
        "moves of a picometre are merged",
    ),
    (
        "malformed/tiny-moves.nc",
        "feed length",
        "moves of a picometre are merged",
    ),
    (
        "tp-regress/machinekit-412.ngc",
        "box A",
        "its box starts at 0 before G92, in shifted A",
    ),
    (
        "tp-regress/tkalcevic-realtime-error.ngc",
        "box A",
        "as in machinekit-412",
    ),
];

fn corpus() -> Option<PathBuf> {
    let directory = std::env::var_os("GLIDEPATH_CORPUS").map(PathBuf::from);
    if directory.is_none() {
        eprintln!("skipped: GLIDEPATH_CORPUS is not set");
    }
    directory
}

/// The text of a line outside its comments, upper case, without blanks.
fn bare(line: &[u8]) -> Vec<u8> {
    let mut depth = false;
    let mut text = Vec::new();
    for &byte in line {
        match byte {
            b'(' => depth = true,
            b')' => depth = false,
            b';' if !depth => break,
            b' ' | b'\t' => {}
            _ if depth => {}
            _ => text.push(byte.to_ascii_uppercase()),
        }
    }
    text
}

/// Ranges of G and M numbers, times ten, that exist and are not supported.
const UNSUPPORTED_G: [(f64, f64); 6] = [
    (50.0, 73.0),
    (330.0, 399.0),
    (410.0, 439.0),
    (730.0, 769.0),
    (810.0, 899.0),
    (950.0, 960.0),
];
const UNSUPPORTED_M: [(f64, f64); 5] = [
    (190.0, 190.0),
    (500.0, 539.0),
    (610.0, 689.0),
    (700.0, 739.0),
    (980.0, 990.0),
];

/// True if the program uses words that are not supported: then there is nothing to compare.
fn out_of_scope(bytes: &[u8]) -> bool {
    let lines = bytes.split(|b| *b == b'\n' || *b == b'\r').map(bare);
    let end = |line: &Vec<u8>| [&b"M2"[..], b"M02", b"M30"].contains(&line.as_slice());
    lines.take_while(|line| !end(line)).any(|line| {
        line.iter().enumerate().any(|(at, &byte)| {
            let rest = &line[at + 1..];
            let digits = rest
                .iter()
                .take_while(|b| b.is_ascii_digit() || **b == b'.')
                .count();
            let number: Option<f64> = std::str::from_utf8(&rest[..digits])
                .ok()
                .and_then(|t| t.parse().ok());
            let tenths = number.map(|n| (n * 10.0).round());
            let among = |ranges: &[(f64, f64)]| {
                tenths.is_some_and(|t| ranges.iter().any(|(low, high)| (*low..=*high).contains(&t)))
            };
            match byte {
                b'G' => among(&UNSUPPORTED_G),
                b'M' => among(&UNSUPPORTED_M),
                _ => false,
            }
        })
    })
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

/// Every difference between the report and the expectation.
fn differences(report: &Report, expected: &Value) -> Vec<String> {
    let mut all = Vec::new();
    let totals = &report.totals;
    let (counts, zero) = (&expected["counts"], &expected["zero_length_moves"]);
    let moving = |name: &str| counts[name].as_i64().unwrap_or(0) - zero[name].as_i64().unwrap_or(0);
    for (what, ours, theirs) in [
        (
            "straight feeds",
            totals.straight_feeds,
            moving("straight_feeds"),
        ),
        ("arcs", totals.arcs, counts["arcs"].as_i64().unwrap_or(0)),
        ("rapids", totals.rapids, moving("traverses")),
        (
            "dwells",
            totals.dwells,
            counts["dwells"].as_i64().unwrap_or(0),
        ),
    ] {
        if i64::from(ours) != theirs {
            all.push(format!("{what}: {ours}, expected {theirs}"));
        }
    }
    for (what, ours, key) in [
        ("feed length", totals.feed_length_mm, "feed_length_mm"),
        ("rapid length", totals.rapid_length_mm, "rapid_length_mm"),
        ("feed time", totals.feed_time_s, "feed_time_s"),
    ] {
        let theirs = number(&expected[key]);
        if expected[key].is_number() && (ours - theirs).abs() > 1e-6 * theirs.abs().max(1.0) {
            all.push(format!("{what}: {ours}, expected {theirs}"));
        }
    }
    for (axis, letter) in "XYZABCUVW".chars().enumerate() {
        let theirs = number(&expected["final_mm_deg"][letter.to_string()]);
        let ours = report.final_position[axis];
        if (ours - theirs).abs() > 1e-6 {
            all.push(format!("final {letter}: {ours}, expected {theirs}"));
        }
        if let (Some(theirs), Some((low, high))) = (
            expected["box_all_moves"][letter.to_string()].as_array(),
            totals.bounding_box,
        ) {
            for (ours, theirs) in [(low[axis], &theirs[0]), (high[axis], &theirs[1])] {
                if (ours - number(theirs)).abs() > 1e-5 {
                    all.push(format!("box {letter}: {ours}, expected {theirs}"));
                }
            }
        }
    }
    all
}

#[test]
fn programs_go_where_the_reference_goes() {
    let Some(directory) = corpus() else { return };
    let text = fs::read_to_string(directory.join("EXPECTED.json")).expect("the expectations");
    let expectations: Value = serde_json::from_str(&text).expect("JSON");
    let (mut compared, mut failures) = (0, Vec::new());
    for expected in expectations["programs"]
        .as_array()
        .expect("a list of programs")
    {
        let name = expected["file"].as_str().expect("a file name");
        let bytes = fs::read(directory.join(name)).expect("a program of the list");
        if expected["linuxcnc_applicable"] == false || out_of_scope(&bytes) {
            continue;
        }
        let report = check(bytes.as_slice(), Options::default());
        let other = OTHER_VERDICT.iter().find(|(file, ..)| *file == name);
        let accepted = expected["accepted"] == true || expected["missing_program_end"] == true;
        let verdict = other.map_or(accepted, |(_, verdict, _)| *verdict);
        compared += 1;
        println!("{name}: {}", if verdict { "accepted" } else { "rejected" });
        if report.is_accepted() != verdict {
            let first = report.diagnostics.first();
            failures.push(format!("{name}: accepted is not {verdict}; {first:?}"));
        } else if verdict && other.is_none() {
            let found = differences(&report, expected);
            let known = |found: &&String| {
                OTHER_FIGURES
                    .iter()
                    .any(|(file, what, _)| *file == name && found.starts_with(what))
            };
            let unknown = found.iter().filter(|found| !known(found));
            failures.extend(unknown.map(|difference| format!("{name}: {difference}")));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(compared >= 69, "only {compared} programs compared");
}

/// Line and kind of every finding in the damaged programs.
const FINDINGS: [(&str, &[(u32, &str)]); 18] = [
    (
        "arcs-bad.nc",
        &[
            (4, "arc-radius-too-small"),
            (5, "arc-radius-mismatch"),
            (6, "arc-full-circle-with-radius"),
            (7, "arc-without-center"),
            (8, "arc-zero-radius"),
            (9, "arc-offset-outside-plane"),
        ],
    ),
    (
        "comment-unclosed.nc",
        &[
            (4, "unclosed-comment"),
            (6, "nested-comment"),
            (7, "unclosed-comment"),
        ],
    ),
    (
        "feed-bad.nc",
        &[
            (2, "missing-feed"),
            (3, "bad-feed"),
            (4, "missing-feed"),
            (5, "bad-feed"),
            (6, "missing-feed"),
            (8, "missing-feed"),
        ],
    ),
    (
        "inf-coord.nc",
        &[(4, "malformed-number"), (5, "malformed-number")],
    ),
    ("linuxcnc-bad-no-feed-rate.ngc", &[(2, "missing-feed")]),
    ("linuxcnc-bad-no-ijr.ngc", &[(2, "arc-without-center")]),
    ("long-line-100k.nc", &[(4, "line-too-long")]),
    ("moves-after-m2.nc", &[]),
    (
        "nan-arc.gcode",
        &[(6, "malformed-number"), (7, "malformed-number")],
    ),
    ("nan-lower-nospace.nc", &[(5, "malformed-number")]),
    ("nul-bytes.nc", &[(5, "nul-byte")]),
    (
        "numbers-bad.nc",
        &[
            (4, "malformed-number"),
            (5, "malformed-number"),
            (6, "malformed-number"),
            (7, "malformed-number"),
            (8, "missing-number"),
            (9, "malformed-number"),
            (10, "malformed-number"),
        ],
    ),
    (
        "numbers-huge.nc",
        &[
            (4, "number-out-of-range"),
            (5, "number-out-of-range"),
            (7, "number-out-of-range"),
        ],
    ),
    (
        "scientific-notation.nc",
        &[
            (4, "malformed-number"),
            (5, "malformed-number"),
            (6, "malformed-number"),
        ],
    ),
    (
        "unicode-minus.nc",
        &[
            (4, "non-ascii-character"),
            (5, "non-ascii-character"),
            (6, "non-ascii-character"),
        ],
    ),
    (
        "unknown-words.nc",
        &[
            (4, "unknown-g-code"),
            (5, "unknown-m-code"),
            (6, "unused-word"),
            (7, "not-supported"),
            (8, "not-supported"),
            (9, "bad-character"),
            (10, "bad-character"),
            (11, "bad-character"),
            (12, "unknown-m-code"),
        ],
    ),
    ("utf16le.nc", &[(1, "wrong-encoding")]),
    (
        "words-duplicate.nc",
        &[
            (4, "duplicate-word"),
            (5, "modal-group-conflict"),
            (6, "modal-group-conflict"),
            (7, "modal-group-conflict"),
        ],
    ),
];

#[test]
fn damaged_programs_get_the_findings_they_deserve() {
    let Some(directory) = corpus() else { return };
    for (name, expected) in FINDINGS {
        let bytes = fs::read(directory.join("malformed").join(name)).expect("a damaged program");
        let report = check(bytes.as_slice(), Options::default());
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .map(|d| (d.line, d.code.as_str()))
            .collect();
        assert_eq!(found, expected, "{name}");
        for d in &report.diagnostics {
            assert!(
                !d.message.is_empty() && !d.reason.is_empty(),
                "{name}: {d:?}"
            );
        }
    }
}

#[test]
fn every_file_is_judged_without_a_panic() {
    let Some(directory) = corpus() else { return };
    let mut pending = vec![directory];
    let mut files = 0;
    while let Some(path) = pending.pop() {
        if path.is_dir() {
            pending.extend(
                fs::read_dir(path)
                    .expect("a directory")
                    .flatten()
                    .map(|e| e.path()),
            );
        } else {
            let bytes = fs::read(&path).expect("a file");
            let report = check(bytes.as_slice(), Options::default());
            if path.ends_with("random-bytes.nc") {
                assert!(!report.is_accepted() && report.totals.bounding_box.is_none());
            }
            files += 1;
        }
    }
    assert!(files > 100);
}
