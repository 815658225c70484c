//! Tests of dense chords along curves, as CAM writes them: rounded to a few digits, with sharp
//! features, rotary axes that go along, and changes of feed.

#![allow(
    clippy::expect_used,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test that fails may panic, and counts are small"
)]

use crate::support::{FREE, at, cases, mill};
use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_motion::Planner;
use glidepath_program::{Item, ItemKind, Rate, Settings, Smoothing};
use proptest::prelude::*;

fn items(points: &[AxisVector], feed_v: impl Fn(usize) -> f64) -> Vec<Item> {
    let distinct = points
        .windows(2)
        .filter(|pair| pair[0] != pair[1])
        .enumerate();
    distinct
        .map(|(i, pair)| Item {
            block: 0,
            line: u32::try_from(i).expect("few points") + 1,
            kind: ItemKind::Move {
                segment: Segment::line(pair[0], pair[1]),
                rate: Rate::Feed(feed_v(i)),
                mode: FREE,
            },
        })
        .collect()
}

fn audited(items: &[Item], settings: Settings) -> AuditReport {
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    let mut planner = Planner::new(settings, AxisVector::zeros());
    for item in items {
        audit.program(item);
        planner.push(item).expect("a valid item");
    }
    planner.finish();
    while let Some(frame) = planner.pop_frame().expect("a motion") {
        audit.sample(&Sample::from(&frame));
    }
    audit.finish()
}

/// A circle of radius 10 mm from its rightmost point, relative to it.
fn circle(chord_mm: f64, digits: i32) -> Vec<AxisVector> {
    let count = (core::f64::consts::TAU * 10.0 / chord_mm).round();
    let unit = 10_f64.powi(-digits);
    let rounded = |x: f64| (x / unit).round() * unit;
    (0..=count as u32)
        .map(|i| {
            let phi = f64::from(i) / count * core::f64::consts::TAU;
            at(rounded(10.0 * phi.cos() - 10.0), rounded(10.0 * phi.sin()))
        })
        .collect()
}

#[test]
fn a_finer_circle_is_hardly_slower() {
    // The exact circle takes 0.7325 s under these limits.
    let times: Vec<_> = [(1.0, 6), (0.1, 6), (0.01, 6), (0.1, 3), (0.01, 3)]
        .map(|(chord_mm, digits)| {
            let report = audited(&items(&circle(chord_mm, digits), |_| 100.0), mill());
            assert!(report.is_clean(), "{chord_mm} {digits}: {report:#?}");
            report.cycle_time_s
        })
        .into();
    let (fastest, slowest) = times
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(a, b), &t| (a.min(t), b.max(t)));
    assert!(slowest < 1.25 * fastest, "{times:?}");
    assert!(slowest < 1.12 * 0.7325, "{times:?}");
}

#[test]
fn noise_within_the_tolerance_does_not_slow_a_line() {
    let noisy: Vec<_> = (0..=200)
        .map(|i| at(0.1 * f64::from(i), if i % 2 == 0 { 0.0 } else { 0.005 }))
        .collect();
    let straight = audited(&items(&[at(0.0, 0.0), at(20.0, 0.0)], |_| 100.0), mill());
    let report = audited(&items(&noisy, |_| 100.0), mill());
    assert!(report.is_clean(), "{report:#?}");
    assert!(
        report.cycle_time_s < 1.1 * straight.cycle_time_s,
        "{} s against {} s",
        report.cycle_time_s,
        straight.cycle_time_s
    );
}

#[test]
fn a_zigzag_as_wide_as_the_tolerance_is_never_slower_than_with_stops() {
    for turn_deg in [60.0_f64, 75.0, 90.0, 99.0, 105.0] {
        for step_mm in [0.03, 0.045, 0.06, 0.1] {
            let height_mm = step_mm * (0.5 * turn_deg.to_radians()).tan();
            let points: Vec<_> = (0..=150)
                .map(|i| at(step_mm * f64::from(i), height_mm * f64::from(i % 2)))
                .collect();
            let items = items(&points, |_| 100.0);
            let stops = Settings {
                smoothing: Smoothing::ExactStop,
                ..mill()
            };
            let [smooth, stopping] = [mill(), stops].map(|settings| audited(&items, settings));
            assert!(smooth.is_clean(), "{smooth:#?}");
            let (smooth_t, stop_t) = (smooth.cycle_time_s, stopping.cycle_time_s);
            assert!(
                smooth_t < 0.85 * stop_t,
                "{turn_deg}° {step_mm} mm: {smooth_t} s against {stop_t} s"
            );
        }
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn dense_programs_keep_limits_and_tolerance(
        chord_mm in (-2.3..-0.2_f64).prop_map(|x| 10_f64.powf(x)),
        digits in 2..6_i32,
        (waves, height_mm) in (1.0..12.0_f64, 0.0..4.0_f64),
        (turn, sway) in (0.0..20.0_f64, 0.0..3.0_f64),
        corners in prop::collection::vec((0.0..1.0_f64, -2.0..2.0_f64), 0..5),
        feeds in prop::collection::vec(5.0..100.0_f64, 1..4),
        tolerance_mm in (-3.0..-1.0_f64).prop_map(|x| 10_f64.powf(x)),
    ) {
        let count = (12.0 / chord_mm) as u32;
        let unit = 10_f64.powi(-digits);
        let points: Vec<_> = (0..=count)
            .map(|i| {
                let t = f64::from(i) / f64::from(count);
                let jump: f64 = corners.iter().filter(|c| c.0 < t).map(|c| c.1).sum();
                let mut point = AxisVector::zeros();
                point[0] = 12.0 * t;
                point[1] = height_mm * (waves * t).sin() + jump;
                point[2] = 0.2 * (3.0 * waves * t).cos() - 0.2;
                point[3] = turn * t;
                point[7] = sway * (waves * t).sin();
                point.map(|x| (x / unit).round() * unit)
            })
            .collect();
        let parts = feeds.len();
        let items = items(&points, |i| feeds[i * parts / points.len()]);
        let settings = Settings { tolerance_mm, ..mill() };
        let report = audited(&items, settings);
        prop_assert!(report.is_clean() && report.is_complete, "{:#?}", report);
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn paths_that_pass_a_point_twice_keep_to_the_program(
        steps in prop::collection::vec((-1..=1_i32, -1..=1_i32), 3..60),
        size_mm in (-2.0..1.0_f64).prop_map(|x| 10_f64.powf(x)),
    ) {
        let mut points = vec![at(0.0, 0.0)];
        let (mut x, mut y) = (0, 0);
        for (dx, dy) in steps {
            (x, y) = (x + dx, y + dy);
            points.push(at(size_mm * f64::from(x), size_mm * f64::from(y)));
        }
        let report = audited(&items(&points, |_| 60.0), mill());
        prop_assert!(report.is_clean(), "{:#?}", report);
    }
}
