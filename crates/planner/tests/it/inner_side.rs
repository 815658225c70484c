//! Tests of corners between arcs and lines: the motion is on their inner side.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::support::family::audited;
use glidepath_audit::AuditSettings;
use glidepath_audit::shape::ShapeAudit;
use glidepath_gcode::{Options, Program};
use glidepath_program::{Corners, DirectionTolerance, Effort, Limits, Settings, Smoothing};
use std::io::Cursor;

/// How far a motion on a light machine is outside of a corner, mm, of 0.05 that the tolerance would allow.
fn outside_mm(text: &str) -> f64 {
    let settings = Settings {
        limits: Limits::uniform(100.0, 10_000.0, 1e6),
        tolerance_mm: 0.05,
        direction: DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: Corners::Inner,
        period_t: 0.004,
        effort: Effort::Optimal,
    };
    let mut shape = ShapeAudit::new(&AuditSettings::from(&settings));
    for item in Program::new(Cursor::new(text), Options::default()) {
        shape.program(&item.expect("a sound program"));
    }
    let _report = audited("inner side", text, settings, |frame| {
        shape.next(&frame.position, frame.line);
    });
    shape.finish().outside.distance_mm
}

/// A window that began at the corner, a hair beyond the border of the arc, took all of its offset along the arc for one
/// from the line behind the corner, and went 0.028 mm beyond that.
#[test]
fn a_line_behind_an_arc_is_not_left_to_the_outer_side() {
    let outside_mm =
        outside_mm("G21 G90 G94 G17 F4000\nG1 X-3 Y0\nG2 X4 Y0 I3.5 J0\nG1 X2 Y3.4641\nM2\n");
    assert!(outside_mm < 0.002, "{outside_mm}");
}
