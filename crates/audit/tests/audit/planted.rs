//! Tests with planted faults: those at random places of good motions are found.

use crate::{PERIOD, TOLERANCE, audit, item, point, polygon, sample, settings, walk};
use glidepath_audit::{Audit, AuditReport, AuditSettings, ViolationKind};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::{Item, Limits};
use proptest::prelude::*;

/// A staircase of long sides: each turns left or right by 30° to 150°.
fn staircase() -> impl Strategy<Value = Vec<AxisVector>> {
    prop::collection::vec((1.0..6.0_f64, 30.0..150.0_f64, any::<bool>()), 3..12).prop_map(|sides| {
        let mut at = AxisVector::zeros();
        let mut heading = 0.0_f64;
        let mut points = vec![at];
        for (length, turn, left) in sides {
            at += point(heading.cos(), heading.sin()) * length;
            points.push(at);
            heading += if left { turn } else { -turn }.to_radians();
        }
        points
    })
}

fn is_off(report: &AuditReport) -> bool {
    report.violations.iter().any(|violation| {
        matches!(
            violation.kind,
            ViolationKind::Deviation { .. } | ViolationKind::Lost | ViolationKind::Incomplete
        )
    })
}

/// An index into something of a length, from a share in 0…1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "small"
)]
fn pick(share: f64, from: usize, to: usize) -> usize {
    from + ((to - from) as f64 * share) as usize
}

proptest! {
    #[test]
    fn a_good_motion_is_clean(points in staircase(), step in 0.001..0.7_f64) {
        let report = audit(&polygon(&points), &walk(&points, step));
        prop_assert!(report.is_clean() && report.is_complete, "{:?}", report.violations);
        prop_assert!(report.max_deviation_mm <= 2e-6);
    }

    #[test]
    fn a_skipped_vertex(points in staircase(), step in 0.01..0.7_f64, share in 0.0..1.0_f64) {
        let index = pick(share, 1, points.len() - 1);
        let mut short = points.clone();
        short.remove(index);
        let report = audit(&polygon(&points), &walk(&short, step));
        prop_assert!(is_off(&report), "{report:?}");
    }

    #[test]
    fn two_swapped_vertices(points in staircase(), step in 0.01..0.7_f64, share in 0.0..1.0_f64) {
        prop_assume!(points.len() > 4);
        let index = pick(share, 1, points.len() - 2);
        prop_assume!((points[index] - points[index + 1]).norm() > 1.0);
        let mut swapped = points.clone();
        swapped.swap(index, index + 1);
        let report = audit(&polygon(&points), &walk(&swapped, step));
        prop_assert!(is_off(&report), "{report:?}");
    }

    #[test]
    fn a_side_run_three_times(points in staircase(), step in 0.01..0.7_f64, share in 0.0..1.0_f64) {
        let index = pick(share, 1, points.len());
        let mut again = points.clone();
        again.splice(index..index, [points[index], points[index - 1]]);
        let report = audit(&polygon(&points), &walk(&again, step));
        prop_assert!(is_off(&report), "{report:?}");
        // And a program that runs it three times, of which the motion makes one.
        let report = audit(&polygon(&again), &walk(&points, step));
        prop_assert!(is_off(&report), "{report:?}");
    }

    /// One sample beside its side by a little less or more than the tolerance.
    #[test]
    fn a_bulge(points in staircase(), share in 0.0..1.0_f64, place in 0.2..0.8_f64) {
        let index = pick(share, 1, points.len());
        let (a, b) = (points[index - 1], points[index]);
        let normal = point(a[1] - b[1], b[0] - a[0]).normalize();
        let inside = a + (b - a) * place;
        for (factor, off) in [(0.999, false), (1.01, true)] {
            let mut motion = walk(&points[..index], 0.05);
            motion.push(inside + normal * (TOLERANCE * factor));
            motion.extend(walk(&points[index..], 0.05));
            let report = audit(&polygon(&points), &motion);
            prop_assert_eq!(is_off(&report), off, "{:?}", report);
            prop_assert!((report.max_deviation_mm / (TOLERANCE * factor) - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn lost_samples(points in staircase(), share in 0.0..1.0_f64, count in 1..5_usize) {
        let motion = walk(&points, 0.1);
        prop_assume!(motion.len() > count + 3);
        let from = pick(share, 1, motion.len() - count - 1);
        let mut audit = Audit::new(&settings(Limits::UNLIMITED));
        for item in polygon(&points) {
            audit.program(&item);
        }
        for (tick, &position) in (0..).zip(&motion) {
            if tick < from || tick >= from + count {
                audit.sample(&sample(tick as u64, position));
            }
        }
        let report = audit.finish();
        let gaps: Vec<_> = report
            .violations
            .iter()
            .filter(|violation| matches!(violation.kind, ViolationKind::Gap { .. }))
            .map(|violation| violation.tick)
            .collect();
        prop_assert_eq!(gaps, vec![(from + count) as u64]);
    }

    /// A cubic in time has constant jerk: with that as the limit it is clean, with a hundred
    /// thousandth less it is not, and a sample displaced by as much as breaks the limit is found.
    #[test]
    fn a_limit_broken_by_a_hundred_thousandth(
        jerk in 10.0..1e5_f64, axis in 0..9_usize, at in 3..60_u32,
    ) {
        let judge = |limit: f64, displaced: f64| {
            let mut limits = Limits::uniform(1e12, 1e12, 1e12);
            limits.jerk[axis] = limit;
            let settings = AuditSettings { limits, period_t: PERIOD, tolerance_mm: TOLERANCE, direction: glidepath_program::DirectionTolerance::default(), corners: glidepath_program::Corners::default() };
            let mut audit = Audit::new(&settings);
            let mut worst = 0;
            for tick in 0..=60_u32 {
                let t = f64::from(tick) * PERIOD;
                let mut position = AxisVector::zeros();
                position[axis] = jerk * t * t * t / 6.0;
                if tick == at {
                    position[axis] += displaced;
                }
                audit.sample(&sample(u64::from(tick), position));
                worst = tick;
            }
            // Without its end, where the motion stops dead.
            let report = audit.finish();
            report
                .violations
                .iter()
                .filter(|v| matches!(v.kind, ViolationKind::Jerk { .. }) && v.tick <= u64::from(worst))
                .count()
        };
        prop_assert_eq!(judge(jerk * (1.0 + 1e-9), 0.0), 0);
        prop_assert!(judge(jerk * (1.0 - 1e-5), 0.0) > 0);
        prop_assert!(judge(jerk, 2e-5 * jerk * PERIOD.powi(3)) > 0);
    }

    /// Chords of an arc that are a little too long for the tolerance.
    #[test]
    fn chords_of_an_arc(radius in 1.0..50.0_f64, factor in prop_oneof![0.9..0.999_f64, 1.001..1.1]) {
        let angle = (8.0 * TOLERANCE * factor / radius).sqrt();
        let count = 7_u32;
        let at = |k: u32| {
            let angle = angle * f64::from(k);
            point(radius * angle.cos(), radius * angle.sin())
        };
        let arc = Arc {
            start: at(0),
            end: at(count),
            plane: Plane::Xy,
            center: [0.0, 0.0],
            sweep_rad: angle * f64::from(count),
        };
        let program: [Item; 1] = [item(1, Segment::Arc(arc))];
        let motion: Vec<_> = (0..=count).map(at).collect();
        let report = audit(&program, &motion);
        let sagitta = radius * (1.0 - (0.5 * angle).cos());
        prop_assert!((report.max_deviation_mm - sagitta).abs() < 2e-5 * TOLERANCE + 1e-6);
        prop_assume!((sagitta / TOLERANCE - 1.0).abs() > 1e-4);
        prop_assert_eq!(is_off(&report), sagitta > TOLERANCE);
    }
}
