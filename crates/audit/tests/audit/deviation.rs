//! The matching of motion and program.

use crate::{TOLERANCE, audit, audited, kinds, point, polygon, walk};
use glidepath_audit::{AuditReport, ViolationKind};
use glidepath_geometry::AxisVector;

fn clean(report: &AuditReport) {
    assert!(report.is_clean(), "{:?}", report.violations);
    assert!(report.is_complete);
}

fn square() -> Vec<AxisVector> {
    [(0.0, 0.0), (5.0, 0.0), (5.0, 5.0), (0.0, 5.0), (0.0, 0.0)]
        .map(|(x, y)| point(x, y))
        .to_vec()
}

#[test]
fn the_path_itself_has_no_deviation() {
    let report = audit(&polygon(&square()), &walk(&square(), 0.3));
    clean(&report);
    assert!(
        report.max_deviation_mm <= 1e-6 * 1.0001,
        "{}",
        report.max_deviation_mm
    );
}

#[test]
fn a_skipped_corner_is_found() {
    let corners = square();
    let cut = [corners[0], corners[1], corners[3], corners[4]];
    let report = audit(&polygon(&corners), &walk(&cut, 0.3));
    // The distance of the skipped corner from the diagonal.
    let want = 2.5 * 2.0_f64.sqrt();
    assert!(
        (report.max_deviation_mm - want).abs() < 1e-4,
        "{}",
        report.max_deviation_mm
    );
    assert!(
        matches!(kinds(&report)[..], [ViolationKind::Deviation { .. }]),
        "{:?}",
        kinds(&report)
    );
    assert!(report.is_complete);
}

/// A path that ends where it begins, and motions that were ended: before they began, on the way, shortly
/// before the end.
#[test]
fn a_motion_that_was_ended_is_judged_as_far_as_it_went() {
    let way = walk(&square(), 0.3);
    let early = |positions: &[AxisVector]| {
        audited(TOLERANCE, &polygon(&square()), positions).finish_early()
    };
    let nearly = point(0.0, 0.015);
    let stood = [way[0], way[0]];
    let to_the_end = [&way[..way.len() - 1], &[nearly]].concat();
    for motion in [&stood[..], &way[..9], &to_the_end, &[]] {
        let report = early(motion);
        assert!(report.is_clean(), "{:?}", report.violations);
        assert!(!report.is_complete);
        assert!(
            report.max_deviation_mm < 1e-5,
            "{}",
            report.max_deviation_mm
        );
    }
    assert!(early(&way).is_complete);
    // What it went is judged all the same.
    let mut aside = way[..9].to_vec();
    aside[5] += point(0.0, 0.03);
    assert!(matches!(
        kinds(&early(&aside))[..],
        [ViolationKind::Deviation { .. }]
    ));
    let cut_short = [way[0], point(0.0, 3.0)];
    assert!(!early(&cut_short).is_clean());
}

#[test]
fn a_bulge_of_1_01_tolerances_is_found() {
    let path = [point(0.0, 0.0), point(10.0, 0.0)];
    for (bulge, found) in [(0.02, false), (0.0202, true)] {
        let mut motion = walk(&path, 0.3);
        motion[17] += point(0.0, bulge);
        let report = audit(&polygon(&path), &motion);
        assert_eq!(!report.is_clean(), found);
        assert!(
            (report.max_deviation_mm - bulge).abs() < 1e-6,
            "{}",
            report.max_deviation_mm
        );
        assert_eq!(report.max_deviation_tick, 17);
    }
}

#[test]
fn a_skipped_spike_is_found() {
    let spike =
        [(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (5.0, 0.0), (10.0, 0.0)].map(|(x, y)| point(x, y));
    clean(&audit(&polygon(&spike), &walk(&spike, 0.1)));
    let report = audit(&polygon(&spike), &walk(&[spike[0], spike[4]], 0.1));
    assert!(
        matches!(kinds(&report)[..], [ViolationKind::Deviation { .. }]),
        "{:?}",
        kinds(&report)
    );
    assert!(
        (report.max_deviation_mm - 3.0).abs() < 1e-3,
        "{}",
        report.max_deviation_mm
    );
}

#[test]
fn a_skipped_loop_and_a_swapped_order_are_found() {
    let twice: Vec<_> = square()
        .into_iter()
        .chain(square().into_iter().skip(1))
        .collect();
    clean(&audit(&polygon(&twice), &walk(&twice, 0.4)));
    let once = audit(&polygon(&twice), &walk(&square(), 0.4));
    assert!(
        matches!(kinds(&once)[..], [ViolationKind::Deviation { .. }]),
        "{:?}",
        kinds(&once)
    );
    assert!(once.max_deviation_mm > 5.0, "{}", once.max_deviation_mm);
    let back: Vec<_> = square().into_iter().rev().collect();
    assert!(!audit(&polygon(&square()), &walk(&back, 0.4)).is_clean());
}

#[test]
fn a_program_not_run_to_its_end_is_found() {
    let path = [point(0.0, 0.0), point(10.0, 0.0)];
    let report = audit(&polygon(&path), &walk(&[path[0], point(9.0, 0.0)], 0.3));
    assert_eq!(kinds(&report), [ViolationKind::Incomplete]);
    assert!(!report.is_complete);
}

/// A motion that has nothing to do with a dense program is given up, not followed at any price.
#[test]
fn a_hopeless_motion_is_lost() {
    let circle: Vec<_> = (0..=20_000)
        .map(|k| {
            let angle = 0.0003 * f64::from(k);
            point(30.0 * angle.cos(), 30.0 * angle.sin())
        })
        .collect();
    let motion: Vec<_> = circle.iter().rev().step_by(10).copied().collect();
    let report = audit(&polygon(&circle), &motion);
    assert!(
        kinds(&report).contains(&ViolationKind::Lost),
        "{:?}",
        report.violations
    );
    assert!(!report.is_complete);
}
