//! Tests of the ends of travel, at samples and between them.

use super::{PERIOD, TOLERANCE, kinds, point, polygon, sample};
use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample, ViolationKind};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Limits;

const JERK: f64 = 1e4;

/// X from 0 to 100, Y from −5 up.
fn settings() -> AuditSettings {
    let mut limits = Limits::uniform(1e9, 1e9, JERK);
    (limits.travel.lowest[0], limits.travel.highest[0]) = (0.0, 100.0);
    limits.travel.lowest[1] = -5.0;
    AuditSettings {
        limits,
        period_t: PERIOD,
        tolerance_mm: TOLERANCE,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    }
}

/// Audits states of X: position, velocity, acceleration; what is found of travel.
fn beyond(states: &[[f64; 3]]) -> (Vec<ViolationKind>, AuditReport) {
    let mut audit = Audit::new(&settings());
    for (tick, [x, v, a]) in (0..).zip(states) {
        audit.sample(&Sample {
            reported: Some([point(*v, 0.0), point(*a, 0.0)]),
            ..sample(tick, point(*x, 0.0))
        });
    }
    let report = audit.finish();
    let is_travel = |kind: &ViolationKind| matches!(kind, ViolationKind::Travel { .. });
    (
        kinds(&report).into_iter().filter(is_travel).collect(),
        report,
    )
}

#[test]
fn a_sample_beyond_an_end_is_found_and_one_at_it_is_not() {
    for (x, y, found) in [
        (100.0, 0.0, None),
        (0.0, -5.0, None),
        (100.0 + 5e-10, 0.0, None),
        (50.0, 1e6, None),
        (100.0 + 2e-9, 0.0, Some((Axis::X, 100.0))),
        (-0.0084, 0.0, Some((Axis::X, 0.0))),
        (50.0, -5.000_001, Some((Axis::Y, -5.0))),
    ] {
        let program = polygon(&[point(50.0, 0.0), point(51.0, 0.0)]);
        let mut audit = Audit::new(&settings());
        audit.program(&program[0]);
        audit.sample(&sample(0, point(x, y)));
        let report = audit.finish();
        let found_here = kinds(&report).into_iter().find_map(|kind| match kind {
            ViolationKind::Travel { axis, end, .. } => Some((axis, end)),
            _ => None,
        });
        assert_eq!(found_here, found, "{x}, {y}");
        assert_eq!(report.max_beyond_travel_mm > 0.0, found.is_some());
    }
}

#[test]
fn what_is_beyond_between_samples_is_found() {
    // 2.5 mm/s up and down in 4 ms: v·T/4 over the end.
    let (found, report) = beyond(&[[100.0, 2.5, -1250.0], [100.0, -2.5, -1250.0]]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        (report.max_beyond_travel_mm - 2.5e-3).abs() < 1e-6,
        "{report:?}"
    );
    let text = report.violations.iter().map(ToString::to_string);
    let want =
        "line 1, tick 1: X is at 100.002500 mm, 0.002500 mm beyond the end of its travel at 100 mm";
    assert!(
        text.clone().any(|text| text == want),
        "{:?}",
        text.collect::<Vec<_>>()
    );
    // The same below the end, and with nothing in between.
    assert_eq!(
        beyond(&[[99.99, 2.5, -1250.0], [99.99, -2.5, -1250.0]]).0,
        []
    );
    let mut audit = Audit::new(&settings());
    for (tick, v) in [(0, 2.5), (2, -2.5)] {
        audit.sample(&Sample {
            reported: Some([point(v, 0.0), point(-1250.0, 0.0)]),
            ..sample(tick, point(100.0, 0.0))
        });
    }
    let report = audit.finish();
    assert!(
        report.max_beyond_travel_mm <= 0.0,
        "across a gap nothing is known"
    );
}

#[test]
fn a_rest_at_an_end_within_a_period_is_none() {
    for part in 1..20_u32 {
        let rest_t = PERIOD * f64::from(part) / 20.0;
        let jerk_x = JERK * rest_t.powi(3) / 6.0;
        let before = [100.0 - jerk_x, JERK * rest_t.powi(2) / 2.0, -JERK * rest_t];
        let (found, _) = beyond(&[before, [100.0, 0.0, 0.0]]);
        assert_eq!(found, [], "{part}");
    }
}

#[test]
fn it_is_judged_away_from_the_path_too() {
    let mut audit = Audit::new(&settings());
    audit.sample(&sample(0, AxisVector::zeros()));
    audit.sample_away(&sample(1, point(-1.0, 0.0)));
    assert!(audit.finish().max_beyond_travel_mm > 0.5);
}

#[test]
fn between_frames_a_motion_may_swing_over_an_end() {
    let swing = JERK * PERIOD.powi(3) / 162.0;
    let judged = |x: f64, is_between_frames: bool| {
        let mut audit = Audit::new(&settings());
        audit.sample(&Sample {
            is_between_frames,
            ..sample(0, point(x, 0.0))
        });
        audit.finish().max_beyond_travel_mm > 0.0
    };
    assert!(!judged(100.0 + swing, true));
    assert!(judged(100.0 + swing, false));
    assert!(judged(100.0 + 1.1 * swing, true));
}
