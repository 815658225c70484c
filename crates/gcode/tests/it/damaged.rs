//! Tests of damaged programs, each with the diagnostics it deserves.
//!
//! Runs where the environment variable `GLIDEPATH_CORPUS` names the directory of the programs; says
//! so and passes where it does not.

#![allow(clippy::expect_used, reason = "a test")]

use std::fs;

use glidepath_gcode::{MAX_LINE_BYTES, Options, check};
use glidepath_testing::corpus;

/// A diagnostic: its line, its kind, and the text it points at, as the n-th such text of the line.
type Diagnostic = (u32, &'static str, &'static str, usize);

/// Every diagnostic in the damaged programs. Text and number say where a reader of the file would
/// point: the column is looked up in the file, not taken from a report.
const FINDINGS: [(&str, &[Diagnostic]); 30] = [
    (
        "arcs-bad.nc",
        &[
            (4, "arc-radius-too-small", "R1", 1),
            (5, "arc-radius-mismatch", "I3", 1),
            (6, "arc-full-circle-with-radius", "R5", 1),
            (7, "arc-without-center", "G2", 1),
            (8, "arc-zero-radius", "I0", 1),
            (9, "arc-offset-outside-plane", "K5", 1),
        ],
    ),
    (
        "comment-unclosed.nc",
        &[
            (4, "unclosed-comment", "(", 1),
            (6, "nested-comment", "(", 2),
            (7, "unclosed-comment", "(", 1),
        ],
    ),
    (
        "feed-bad.nc",
        &[
            (2, "missing-feed", "G1", 1),
            (4, "missing-feed", "G1", 1),
            (5, "bad-feed", "F-100", 1),
            (6, "missing-feed", "G1", 1),
            (8, "missing-feed", "G1", 1),
        ],
    ),
    (
        "inf-coord.nc",
        &[
            (4, "malformed-number", "inf", 1),
            (5, "malformed-number", "-inf", 1),
        ],
    ),
    (
        "linuxcnc-bad-a-in-canned-cycle.ngc",
        &[(3, "canned-cycle", "a90", 1)],
    ),
    (
        "linuxcnc-bad-bad-arc-big-imperial-center-format.ngc",
        &[(6, "arc-radius-mismatch", "i[", 1)],
    ),
    (
        "linuxcnc-bad-bad-arc-small-metric-center-format.ngc",
        &[(6, "arc-radius-mismatch", "i[", 1)],
    ),
    ("linuxcnc-bad-ccomp-gouging.ngc", &[(6, "gouge", "g1", 1)]),
    (
        "linuxcnc-bad-exists-2.ngc",
        &[(2, "expression", "EXISTS", 1)],
    ),
    ("linuxcnc-bad-exists-5.ngc", &[(2, "expression", "<foo", 1)]),
    (
        "linuxcnc-bad-g64-m19-r-ambiguous.ngc",
        &[(2, "not-connected", "m19", 1)],
    ),
    ("linuxcnc-bad-nested.ngc", &[(6, "flow-structure", "O2", 1)]),
    (
        "linuxcnc-bad-no-feed-rate.ngc",
        &[(2, "missing-feed", "g1", 1)],
    ),
    (
        "linuxcnc-bad-no-ijr.ngc",
        &[(2, "arc-without-center", "g2", 1)],
    ),
    (
        "linuxcnc-bad-probe-no-axes.ngc",
        &[(2, "missing-word", "g38.2", 1)],
    ),
    (
        "math-bad.ngc",
        &[
            (2, "arithmetic", "/", 1),
            (4, "arithmetic", "SQRT", 1),
            (6, "parameter", "#99999", 1),
            (7, "parameter", "#0", 1),
            (8, "expression", "+", 1),
            (9, "expression", "[", 2),
        ],
    ),
    ("moves-after-m2.nc", &[]),
    (
        "nan-arc.gcode",
        &[
            (6, "malformed-number", "NaN", 1),
            (7, "malformed-number", "NaN", 1),
        ],
    ),
    ("nan-lower-nospace.nc", &[(5, "malformed-number", "nan", 1)]),
    ("nul-bytes.nc", &[(5, "nul-byte", "\0", 1)]),
    (
        "numbers-bad.nc",
        &[
            (4, "malformed-number", "1.2.3", 1),
            (5, "malformed-number", "--5", 1),
            (6, "malformed-number", "+-5", 1),
            (7, "malformed-number", "5-", 1),
            (8, "missing-number", "X", 1),
            (9, "malformed-number", ".", 1),
            (10, "malformed-number", "1,5", 1),
        ],
    ),
    (
        "numbers-huge.nc",
        &[
            (4, "number-out-of-range", "999", 1),
            (5, "number-out-of-range", "999", 1),
            (7, "number-out-of-range", "1000", 1),
        ],
    ),
    (
        "nurbs-bad.ngc",
        &[
            (6, "spline", "P0", 1),
            // G5.2 is in force below, though the block above was refused.
            (7, "spline", "P-1", 1),
        ],
    ),
    ("o-infinite-loop.ngc", &[(3, "endless-loop", "#1", 1)]),
    ("o-missing-endsub.ngc", &[(1, "flow-structure", "o100", 1)]),
    ("o-recursion.ngc", &[(2, "call-depth", "o100", 1)]),
    (
        "scientific-notation.nc",
        &[
            (4, "malformed-number", "1.5e", 1),
            (5, "malformed-number", "-1.19", 1),
            (6, "malformed-number", "1E3", 1),
        ],
    ),
    (
        "unicode-minus.nc",
        &[
            (4, "non-ascii-character", "\u{2212}", 1),
            (5, "non-ascii-character", "\u{a0}", 1),
            (6, "non-ascii-character", "\u{ff11}", 1),
        ],
    ),
    (
        "unknown-words.nc",
        &[
            (4, "unknown-g-code", "G999", 1),
            (5, "unknown-m-code", "M9999", 1),
            (6, "unused-word", "Q5", 1),
            (7, "missing-number", "@", 1),
            (8, "not-supported", "$", 1),
            (9, "bad-character", "!", 1),
            (10, "bad-character", "?", 1),
            (11, "bad-character", "~", 1),
            (12, "unknown-m-code", "M117", 1),
        ],
    ),
    (
        "words-duplicate.nc",
        &[
            (4, "duplicate-word", "X", 2),
            (5, "modal-group-conflict", "G", 2),
            (6, "modal-group-conflict", "M", 2),
            (7, "modal-group-conflict", "G", 2),
        ],
    ),
];

/// The column of the n-th such text in a line of a file, from 1, in bytes.
fn column(bytes: &[u8], line: u32, text: &str, n: usize) -> u32 {
    let index = usize::try_from(line - 1).expect("a line number");
    let line = bytes
        .split(|byte| *byte == b'\n')
        .nth(index)
        .expect("the line");
    let starts = line.windows(text.len()).enumerate();
    let mut found = starts.filter(|(_, window)| *window == text.as_bytes());
    let (at, _) = found.nth(n - 1).expect("the text in the line");
    u32::try_from(at + 1).expect("a column")
}

#[test]
fn damaged_programs_get_the_diagnostics_they_deserve() {
    let Some(directory) = corpus() else { return };
    let mut wrong = Vec::new();
    for (name, expected) in FINDINGS {
        let bytes = fs::read(directory.join("malformed").join(name)).expect("a damaged program");
        let report = check(bytes.as_slice(), Options::default());
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .map(|d| (d.line, d.column, d.code.as_str()))
            .collect();
        let expected: Vec<_> = expected
            .iter()
            .map(|&(line, code, text, n)| (line, column(&bytes, line, text, n), code))
            .collect();
        if found != expected {
            wrong.push(format!("{name}: {found:?}, expected {expected:?}"));
        }
        for d in &report.diagnostics {
            assert!(
                !d.message.is_empty() && !d.reason.is_empty(),
                "{name}: {d:?}"
            );
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Two diagnostics that no text stands for: where the line is cut, and the first byte of the file.
#[test]
fn a_line_too_long_and_a_wrong_encoding_are_told_where_they_begin() {
    let Some(directory) = corpus() else { return };
    let first = |name: &str| {
        let bytes = fs::read(directory.join("malformed").join(name)).expect("a damaged program");
        let report = check(bytes.as_slice(), Options::default());
        assert_eq!(report.diagnostics.len(), 1, "{name}");
        let diagnostic = report.diagnostics.first().expect("a diagnostic");
        (diagnostic.line, diagnostic.column, diagnostic.code.as_str())
    };
    let beyond = u32::try_from(MAX_LINE_BYTES + 1).expect("a column");
    assert_eq!(first("long-line-100k.nc"), (4, beyond, "line-too-long"));
    assert_eq!(first("utf16le.nc"), (1, 1, "wrong-encoding"));
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
