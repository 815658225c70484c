//! A small arc at a slow feed is round: the motion does not dive into it half-way to gain a little time.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::planned::{numbered, plan};
use crate::support::{FREE, at, optimal};
use core::f64::consts::PI;
use glidepath_audit::{Audit, AuditReport, AuditSettings, ViolationKind};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::{ItemKind, Rate};

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
    let items = numbered(moves.to_vec());
    let settings = optimal();
    let frames = plan(&items, settings, usize::MAX);
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
