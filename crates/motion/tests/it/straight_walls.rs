//! A straight wall behind an arc or a dense run stays straight where the feed gains nothing by leaving it.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::support::{FREE, at, mill};
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_motion::Planner;
use glidepath_program::{Item, ItemKind, Rate};

/// The report, and the motion.
fn driven(segments: &[Segment], feed_v: f64) -> (AuditReport, Vec<AxisVector>) {
    let settings = mill();
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    let mut planner = Planner::new(settings, segments[0].start());
    let mut motion = Vec::new();
    for (line, &segment) in (1..).zip(segments) {
        let (rate, mode) = (Rate::Feed(feed_v), FREE);
        let item = Item {
            block: 0,
            line,
            kind: ItemKind::Move {
                segment,
                rate,
                mode,
            },
        };
        audit.program(&item);
        planner.push(&item).expect("a valid item");
    }
    planner.finish();
    while let Some(frame) = planner.pop_frame().expect("a motion") {
        audit.frame(&frame);
        motion.push(frame.position);
    }
    let report = audit.finish();
    assert!(report.is_clean(), "{report:#?}");
    (report, motion)
}

#[test]
fn beside_a_tangent_arc() {
    let radius_mm = 9.4125;
    let arc = Arc {
        start: at(-radius_mm, 70.0),
        end: at(radius_mm, 70.0),
        plane: Plane::Xy,
        center: [0.0, 70.0],
        sweep_rad: -core::f64::consts::PI,
    };
    let slot = [
        Segment::line(at(-radius_mm, 2.0), arc.start),
        Segment::Arc(arc),
        Segment::line(arc.end, at(radius_mm, 2.0)),
    ];
    for feed_v in [2.0, 7.5, 20.0] {
        let (report, motion) = driven(&slot, feed_v);
        let wall = motion.iter().filter(|at| at[1] < 69.0);
        let off_mm = wall.fold(0.0, |most: f64, at| most.max(at[0].abs() - radius_mm));
        assert!(off_mm < 1e-4, "{feed_v} mm/s: {off_mm} mm off the wall");
        assert_eq!(report.tremor_count, 0, "{:?}", report.tremors);
        // No slower than the program says, but for the two ends and the transitions.
        let path_t = (2.0 * 68.0 + core::f64::consts::PI * radius_mm) / feed_v;
        let lost_t = report.cycle_time_s - path_t;
        assert!(lost_t < 0.06, "{feed_v} mm/s: {lost_t} s lost");
    }
}

#[test]
fn beside_a_dense_run() {
    // A corner rounded by CAM, in chords that turn by 8° to 23°, then a wall.
    let corner = [
        (0.0, 6.0),
        (0.0, 0.141),
        (0.024, 0.1),
        (0.049, 0.059),
        (0.084, 0.027),
        (0.127, 0.007),
        (0.174, 0.0),
    ];
    for length_mm in [8.0, 26.0] {
        let mut points = corner.map(|(x, y)| at(x, y)).to_vec();
        points.push(at(0.174 + length_mm, 0.0));
        let chords: Vec<_> = (points.windows(2))
            .map(|ends| Segment::line(ends[0], ends[1]))
            .collect();
        let (report, motion) = driven(&chords, 8.333);
        let wall = motion.iter().filter(|at| at[0] > 1.6);
        let off_mm = wall.fold(0.0, |most: f64, at| most.max(at[1].abs()));
        assert!(off_mm < 1e-5, "{length_mm} mm: {off_mm} mm off the wall");
        assert_eq!(report.tremor_count, 0, "{:?}", report.tremors);
    }
}
