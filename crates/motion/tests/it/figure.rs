//! The figure of a motion with either effort: long lines are straight, and events where they belong.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::planned::{moves, numbered, plan};
use crate::support::{FREE, at, efforts};
use glidepath_audit::shape::{BEYOND_MM, ShapeAudit};
use glidepath_audit::{Audit, AuditSettings, ViolationKind};
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

/// At a corner of ten degrees the motion turns back before it is at the vertex, and is nearest to it before or after
/// what its path position says: there events were half as far off again as the tolerance.
#[test]
fn an_event_at_a_sharp_corner_happens_where_the_motion_is_nearest() {
    let corners = [
        [
            at(-10.1641, 48.6575),
            at(-20.6390, 63.7633),
            at(-14.7740, 52.4753),
        ],
        [at(2.2208, 0.4989), at(3.1563, 0.3175), at(2.8273, 0.1910)],
        [at(0.0, 0.0), at(15.0, 5.0), at(1.0, 1.5)],
    ];
    for (settings, points) in efforts()
        .into_iter()
        .flat_map(|settings| corners.map(|points| (settings, points)))
    {
        let points = points.map(|point| point - points[0]);
        let [first, second]: [ItemKind; 2] =
            moves(&points, 45.0, FREE).try_into().expect("two moves");
        let event = ItemKind::Event(Event::SpindleSpeed(700.0));
        let items = numbered(vec![first, event, second]);
        let frames = plan(&items, settings, usize::MAX);
        let mut audit = Audit::new(&AuditSettings::from(&settings));
        items.iter().for_each(|item| audit.program(item));
        frames.iter().for_each(|frame| audit.frame(frame));
        let report = audit.finish();
        assert_eq!(report.events, 1);
        let nearest = frames.windows(2).map(|pair| {
            let (from, to) = (pair[0].position, pair[1].position);
            (0..=20)
                .map(|k| (from + (to - from) * (f64::from(k) / 20.0) - points[1]).norm())
                .fold(f64::INFINITY, f64::min)
        });
        let nearest_mm = nearest.fold(f64::INFINITY, f64::min);
        // Between two frames the motion is no straight line in time.
        let off_mm = report.max_event_off_mm;
        assert!(
            off_mm <= nearest_mm + 0.003,
            "{:?}: {off_mm} mm, {nearest_mm} at best",
            settings.effort
        );
    }
}

/// Rows of short lines with a step between: the spline that is laid through them swung about the coordinate of a row.
#[test]
fn an_axis_that_a_row_leaves_alone_is_still() {
    let (mut points, mut y) = (vec![at(0.0, 0.0)], 0.0);
    for row in 0..4 {
        for k in 1..=100 {
            let x = 0.05 * f64::from(if row % 2 == 0 { k } else { 100 - k });
            let mut point = at(x, y);
            point[2] = 0.3 * (2.0 * x).sin();
            points.push(point);
        }
        y += 0.02;
        let mut stepped = points[points.len() - 1];
        stepped[1] = y;
        points.push(stepped);
    }
    for settings in efforts() {
        let items = numbered(moves(&points, 30.0, FREE));
        let frames = plan(&items, settings, usize::MAX);
        let mut audit = Audit::new(&AuditSettings::from(&settings));
        items.iter().for_each(|item| audit.program(item));
        frames.iter().for_each(|frame| audit.frame(frame));
        let report = audit.finish();
        assert!(report.is_clean(), "{report:#?}");
        let moved = report
            .tremors
            .iter()
            .filter(|tremor| matches!(tremor.kind, ViolationKind::NotStill { .. }));
        assert_eq!(
            moved.count(),
            0,
            "{:?}: {:?}",
            settings.effort,
            report.tremors
        );
    }
}

/// A line of 5.9 mm on which a table turns by 50°: the tolerance beside it was used from end to end, and the table was
/// up to 0.14° off the angle that belongs to its place.
#[test]
fn a_long_line_is_straight_where_a_table_turns() {
    let point = |x: f64, angle: f64| {
        let mut point = at(x, 0.0);
        point[3] = angle;
        point
    };
    let curve = (0..40_i32).map(|k| point(0.0265 * f64::from(k), -0.65 * f64::from(k)));
    let mut points: Vec<_> = curve.collect();
    let begins = points[points.len() - 1];
    points.push(begins + point(-5.856, 49.98));
    let end = points[points.len() - 1];
    for settings in efforts() {
        let items = numbered(moves(&points, 12.0, FREE));
        let frames = plan(&items, settings, usize::MAX);
        let line = end - begins;
        let mut judged = 0;
        for frame in frames
            .iter()
            .filter(|frame| frame.line as usize == points.len() - 1)
        {
            let passed = frame.position - begins;
            let share = passed.dot(&line) / line.dot(&line);
            if (0.25..=0.75).contains(&share) {
                let beside_mm = (passed - line * share).norm();
                assert!(beside_mm <= BEYOND_MM, "{:?}: {beside_mm}", settings.effort);
                judged += 1;
            }
        }
        assert!(judged > 20, "{judged}");
    }
}
