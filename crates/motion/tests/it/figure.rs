//! The figure of a motion with either effort: long lines are straight, and events where they belong.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::planned::{moves, numbered, plan};
use crate::support::{FREE, at, efforts};
use glidepath_audit::shape::{BEYOND_MM, ShapeAudit};
use glidepath_audit::{Audit, AuditSettings};
use glidepath_program::{Event, ItemKind};

/// Lines of six millimetres that turn by a little more than a degree each: a curve through all of them was inside the
/// tolerance, and 15 µm beside every one.
#[test]
fn long_lines_that_turn_a_little_are_straight() {
    let mut points = vec![at(0.0, 0.0)];
    let mut heading_rad = 0.0_f64;
    let mut place = at(0.0, 0.0);
    for k in 0..12 {
        place += at(heading_rad.cos(), heading_rad.sin()) * (5.5 + 0.2 * f64::from(k % 5));
        points.push(place);
        heading_rad += 0.02;
    }
    for settings in efforts() {
        let items = numbered(moves(&points, 60.0, FREE));
        let frames = plan(&items, settings, usize::MAX);
        let judged_by = AuditSettings::from(&settings);
        let (mut audit, mut shape) = (Audit::new(&judged_by), ShapeAudit::new(&judged_by));
        for item in &items {
            audit.program(item);
            shape.program(item);
        }
        for frame in &frames {
            audit.frame(frame);
            shape.next(&frame.position, frame.line);
        }
        let report = audit.finish();
        assert!(report.is_clean() && report.is_complete, "{report:#?}");
        let beside = shape.finish().beside;
        assert!(
            beside.distance_mm <= BEYOND_MM,
            "{:?}: {beside:?}",
            settings.effort
        );
    }
}

/// What stands at a corner happens where the motion comes nearest to it, and not where it leaves the line before.
#[test]
fn an_event_at_a_corner_happens_where_that_is_rounded() {
    for settings in efforts() {
        for corner in [at(20.0, 20.0), at(30.0, 3.0), at(12.0, 16.0)] {
            let vertex = at(20.0, 0.0);
            let [first, second]: [ItemKind; 2] = moves(&[at(0.0, 0.0), vertex, corner], 50.0, FREE)
                .try_into()
                .expect("two moves");
            let event = ItemKind::Event(Event::SpindleSpeed(700.0));
            let items = numbered(vec![first, event, second]);
            let frames = plan(&items, settings, usize::MAX);
            let mut audit = Audit::new(&AuditSettings::from(&settings));
            items.iter().for_each(|item| audit.program(item));
            frames.iter().for_each(|frame| audit.frame(frame));
            let report = audit.finish();
            assert_eq!(report.events, 1);
            // The auditor takes the way of a period for straight: √2·a·T²/8 is between.
            let most_mm = settings.tolerance_mm + 0.006;
            let off_mm = report.max_event_off_mm;
            assert!(off_mm <= most_mm, "{:?}: {off_mm} mm", settings.effort);
        }
    }
}
