//! A small arc at a slow feed is round: the motion does not dive into it half-way to gain a little time.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::planned::{numbered, plan};
use crate::support::{FREE, at, optimal};
use core::f64::consts::{PI, TAU};
use glidepath_audit::{Audit, AuditReport, AuditSettings, ViolationKind};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::{Item, ItemKind, Limits, Rate, Settings};

/// A line along X, an arc about a centre further along, and a line along X again.
fn driven(radius_mm: f64, sweep_rad: f64, feed_v: f64) -> (AuditReport, Vec<AxisVector>) {
    let center = at(10.0 + radius_mm, 0.0);
    let end = center + at(sweep_rad.cos(), sweep_rad.sin()) * -radius_mm;
    let arc = Arc {
        start: at(10.0, 0.0),
        end,
        plane: Plane::Xy,
        center: [center[0], center[1]],
        sweep_rad,
    };
    let segments = [
        Segment::line(at(0.0, 0.0), arc.start),
        Segment::Arc(arc),
        Segment::line(end, end + at(10.0, 0.0)),
    ];
    let moves = segments.map(|segment| ItemKind::Move {
        segment,
        rate: Rate::Feed(feed_v),
        mode: FREE,
    });
    judged(&numbered(moves.to_vec()), optimal())
}

/// What the auditor says of the motion, and its positions.
fn judged(items: &[Item], settings: Settings) -> (AuditReport, Vec<AxisVector>) {
    let frames = plan(items, settings, usize::MAX);
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    items.iter().for_each(|item| audit.program(item));
    frames.iter().for_each(|frame| audit.frame(frame));
    let motion = frames.iter().map(|frame| frame.position);
    (audit.finish(), motion.collect())
}

#[test]
fn a_small_arc_at_a_slow_feed_is_round_in_its_middle() {
    let mut found = Vec::new();
    for radius_mm in [0.4, 0.5, 0.7, 1.0, 1.5] {
        for feed_v in [3.0, 5.0, 8.0] {
            for sweep_rad in [-PI, -0.75 * PI] {
                let (report, motion) = driven(radius_mm, sweep_rad, feed_v);
                assert!(report.is_clean(), "{report:#?}");
                let center = at(10.0 + radius_mm, 0.0);
                // The corners at both ends are rounded on their inner side, to three tenths of the smallest arc.
                let middle = motion
                    .iter()
                    .map(|position| position - center)
                    .filter(|away| {
                        let passed_rad = away[1].atan2(-away[0]);
                        passed_rad > 0.3 * sweep_rad.abs() && passed_rad < 0.7 * sweep_rad.abs()
                    });
                let off_mm = middle.fold(0.0_f64, |most, away| {
                    most.max((away.norm() - radius_mm).abs())
                });
                let jerks = report.tremors.iter().map(|tremor| match tremor.kind {
                    ViolationKind::Unsteady { over_j, .. } => over_j,
                    _ => 0.0,
                });
                let over_j = jerks.fold(0.0, f64::max);
                found.push((radius_mm, feed_v, sweep_rad, off_mm, over_j));
            }
        }
    }
    // A fifth of the tolerance, an eighth of the jerk.
    let bad: Vec<_> = found
        .iter()
        .filter(|(.., off_mm, over_j)| *off_mm > 0.004 || *over_j > 5000.0)
        .collect();
    assert!(bad.is_empty(), "{bad:#?}");
}

/// Where the feed is slow and the tolerance wide, velocity across the path has a price. Across the chords that an arc
/// is cut into it made a polygon of the circle: 1.3 µm off, with a jerk of 19 000 mm/s³ where the circle has 700.
#[test]
fn a_slow_circle_on_a_light_machine_is_no_polygon() {
    let radius_mm = 1.2;
    let turn = Segment::Arc(Arc {
        start: at(0.0, 0.0),
        end: at(0.0, 0.0),
        plane: Plane::Xy,
        center: [-radius_mm, 0.0],
        sweep_rad: TAU,
    });
    let turns = (0..3).map(|_| ItemKind::Move {
        segment: turn,
        rate: Rate::Feed(10.0),
        mode: FREE,
    });
    let settings = Settings {
        limits: Limits::uniform(100.0, 1e4, 1e6),
        tolerance_mm: 0.05,
        ..optimal()
    };
    let (report, motion) = judged(&numbered(turns.collect()), settings);
    assert!(report.is_clean(), "{report:#?}");
    assert_eq!(report.tremor_count, 0, "{:#?}", report.tremors);
    let off_mm = |position: &AxisVector| {
        let away = position - at(-radius_mm, 0.0);
        (away.norm() - radius_mm).abs()
    };
    // All but its first and last twentieth of a turn.
    let left_out = motion.len() / 60;
    let middle = &motion[left_out..motion.len() - left_out];
    let most_mm = middle.iter().map(off_mm).fold(0.0, f64::max);
    assert!(most_mm <= 1e-3, "{most_mm} mm off");
}

/// A path that rests where a circle ends is as round at its end as before: the shortest motion of all cut it there by
/// some micrometres, to rest a period sooner.
#[test]
fn a_circle_stays_round_up_to_the_rest_behind_it() {
    for (radius_mm, feed_v) in [(0.663, 10.0), (1.2, 10.0)] {
        let turn = Segment::Arc(Arc {
            start: at(0.0, 0.0),
            end: at(0.0, 0.0),
            plane: Plane::Xy,
            center: [-radius_mm, 0.0],
            sweep_rad: -TAU,
        });
        let turns = (0..2).map(|_| ItemKind::Move {
            segment: turn,
            rate: Rate::Feed(feed_v),
            mode: FREE,
        });
        let (report, _) = judged(&numbered(turns.collect()), optimal());
        assert!(report.is_clean(), "{report:#?}");
        assert_eq!(report.tremor_count, 0, "{radius_mm}: {:#?}", report.tremors);
    }
}

/// A hole that is milled in circles, with a plunge before each: where one window of the planner followed another at the
/// feed, the motion went over to a radius 1.5 µm larger within six periods.
#[test]
fn circles_with_plunges_between_them_are_cut_without_a_mark() {
    let radius_mm = 3.0;
    let high = |z: f64| AxisVector::z() * z;
    let begin = at(radius_mm, 0.0);
    let mut segments = vec![
        (Segment::line(at(0.0, 0.0), high(5.0)), 200.0),
        (Segment::line(high(5.0), begin + high(5.0)), 200.0),
    ];
    let mut from = begin + high(5.0);
    for z in [-0.8, -1.6, -2.4] {
        let there = begin + high(z);
        segments.push((Segment::line(from, there), 5.0));
        let turn = Arc {
            start: there,
            end: there,
            plane: Plane::Xy,
            center: [0.0, 0.0],
            sweep_rad: TAU,
        };
        segments.push((Segment::Arc(turn), 20.0));
        from = there;
    }
    let moves = segments
        .into_iter()
        .map(|(segment, feed_v)| ItemKind::Move {
            segment,
            rate: Rate::Feed(feed_v),
            mode: FREE,
        });
    let (report, _) = judged(&numbered(moves.collect()), optimal());
    assert!(report.is_clean(), "{report:#?}");
    assert_eq!(report.tremor_count, 0, "{:#?}", report.tremors);
}
