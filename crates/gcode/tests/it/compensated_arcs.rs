//! Tests of arcs beside a contour whose coordinates are rounded: they end where they say.

#![allow(clippy::expect_used, reason = "a test")]

use core::f64::consts::{PI, TAU};
use glidepath_gcode::{Connections, Options, Program};
use glidepath_geometry::{Arc, Segment};
use glidepath_program::ItemKind;

/// Arcs of a program.
fn arcs(text: &str) -> Vec<Arc> {
    let options = Options {
        connections: Connections::Simulated,
        default_feed_mm_min: Some(600.0),
        ..Options::default()
    };
    let items = Program::new(text.as_bytes(), options);
    let segments = items.filter_map(|item| match item.expect("a sound program").kind {
        ItemKind::Move { segment, .. } => Some(segment),
        _ => None,
    });
    segments
        .filter_map(|segment| match segment {
            Segment::Arc(arc) => Some(arc),
            _ => None,
        })
        .collect()
}

/// How far apart the end of an arc and what its sweep leads to are, mm.
fn gap_mm(arc: &Arc) -> f64 {
    let [x, y] = arc.center;
    let angle = |at: &glidepath_geometry::AxisVector| (at[1] - y).atan2(at[0] - x);
    let off = angle(&arc.end) - angle(&arc.start) - arc.sweep_rad;
    let off = (off + PI).rem_euclid(TAU) - PI;
    off.abs() * (arc.end[0] - x).hypot(arc.end[1] - y)
}

#[test]
fn arcs_beside_a_rounded_contour_end_where_they_say() {
    let mut seen = 0;
    for misfit_um in [-5.0, -2.1, -1.0, -0.3, 0.0, 0.3, 1.0, 1.9, 2.1, 5.0] {
        let y = 1e-3 * misfit_um;
        for (side, d) in [("G41.1", 4.0), ("G42.1", 3.0)] {
            for behind in [
                "G2 X-10 Y10 R10",
                "G3 X-10 Y-10 R10",
                "G2 X-5 Y5 R5\nG2 X0 Y10 R5.0004",
                "G3 X-5 Y-5 R5\nG1 Y-20\nG3 X5 Y-30 R10.0003",
            ] {
                let text = format!(
                    "G90 G17 G61\nG0 X40 Y0\n{side} D{d} G1 X20 Y0\nX0 Y{y}\n{behind}\nG40 G1 X80 Y80\nM2\n"
                );
                for arc in arcs(&text) {
                    seen += 1;
                    let gap_mm = gap_mm(&arc);
                    assert!(gap_mm < 1e-9, "{gap_mm}: {arc:?} of\n{text}");
                }
            }
        }
    }
    assert!(seen > 80, "{seen}");
}
