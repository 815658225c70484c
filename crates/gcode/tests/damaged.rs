//! Damaged programs, each with the findings it deserves.
//!
//! Runs where the environment variable `GLIDEPATH_CORPUS` names the directory of the programs; says
//! so and passes where it does not.

#![expect(clippy::print_stderr, reason = "a skipped test says so")]

use std::fs;
use std::path::PathBuf;

use glidepath_gcode::{Options, check};

fn corpus() -> Option<PathBuf> {
    let directory = std::env::var_os("GLIDEPATH_CORPUS").map(PathBuf::from);
    if directory.is_none() {
        eprintln!("skipped: GLIDEPATH_CORPUS is not set");
    }
    directory
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
            (7, "missing-number"),
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
