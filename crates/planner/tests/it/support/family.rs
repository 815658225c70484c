//! Programs of the families, and whole plans before the auditor.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use core::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Cursor;
use std::path::Path;

use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_gcode::{Options, Program};
use glidepath_geometry::AxisVector;
use glidepath_motion::Planner;
use glidepath_program::{Frame, Settings};

/// The text of a program of `tests/data/families`.
pub(crate) fn family(name: &str) -> String {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../tests/data/families/{name}.ngc"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// What programs made here begin with.
pub(crate) const HEADER: &str = "G21 G90 G94 G17 G64 P0.02 F6000\n";

/// Turns about one circle, through the origin.
pub(crate) fn circles_of_chords(radius_mm: f64, turns: u32, chord_mm: f64) -> String {
    let mut text = HEADER.to_owned();
    let chords = (TAU * radius_mm / chord_mm).round();
    let mut k = 1.0;
    while k <= chords * f64::from(turns) {
        let (sin, cos) = (TAU * k / chords).sin_cos();
        let (x, y) = (radius_mm * (cos - 1.0), radius_mm * sin);
        writeln!(text, "G1 X{x:.5} Y{y:.5}").expect("a string");
        k += 1.0;
    }
    text
}

/// Plans a program, which keeps every limit and its tolerance; `each` is given the frames.
pub(crate) fn audited(
    name: &str,
    text: &str,
    settings: Settings,
    mut each: impl FnMut(&Frame),
) -> AuditReport {
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    let mut planner = Planner::new(settings, AxisVector::zeros());
    for item in Program::new(Cursor::new(text), Options::default()) {
        let item = item.unwrap_or_else(|diagnostic| panic!("{name}: {}", diagnostic.message));
        planner.push(&item).expect("a valid item");
        audit.program(&item);
    }
    planner.finish();
    while let Some(frame) = planner.pop_frame().expect("a motion") {
        audit.frame(&frame);
        each(&frame);
    }
    let report = audit.finish();
    assert!(
        report.is_clean() && report.is_complete,
        "{name}, {settings:?}: {report:#?}"
    );
    report
}
