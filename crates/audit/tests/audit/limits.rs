//! Tests of limits, reports, gaps and times.

use crate::{PERIOD, TOLERANCE, point, polygon, sample, settings};
use glidepath_audit::{Audit, AuditReport, AuditSettings, Inconsistency, Sample, ViolationKind};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Limits;

/// One axis under bang-bang jerk: up, down, down, up, each of some periods.
fn rest_to_rest(jerk: f64, periods: u32) -> Vec<Sample> {
    let (mut p, mut v, mut a) = (0.0, 0.0, 0.0);
    let mut samples = vec![state(0, p, v, a)];
    let phases = [jerk, -jerk, -jerk, jerk];
    let mut tick = 0;
    for j in phases {
        for _ in 0..periods {
            let t = PERIOD;
            p += v * t + a * t * t / 2.0 + j * t * t * t / 6.0;
            v += a * t + j * t * t / 2.0;
            a += j * t;
            tick += 1;
            samples.push(state(tick, p, v, a));
        }
    }
    samples
}

fn state(tick: u64, p: f64, v: f64, a: f64) -> Sample {
    let axis = |value| point(value, 0.0);
    Sample {
        tick,
        line: 7,
        position: axis(p),
        reported: Some([axis(v), axis(a)]),
        is_between_frames: false,
    }
}

const JERK: f64 = 1000.0;
const PERIODS: u32 = 25;

/// Peaks of the motion above: a = J·nT, v = J·(nT)².
fn peaks() -> (f64, f64) {
    let phase_t = f64::from(PERIODS) * PERIOD;
    (JERK * phase_t, JERK * phase_t * phase_t)
}

fn judge(limits: Limits, samples: &[Sample]) -> AuditReport {
    let settings = AuditSettings {
        limits,
        period_t: PERIOD,
        tolerance_mm: TOLERANCE,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    };
    let mut audit = Audit::new(&settings);
    let end = samples[samples.len() - 1].position;
    for item in polygon(&[AxisVector::zeros(), end]) {
        audit.program(&item);
    }
    for sample in samples {
        audit.sample(sample);
    }
    audit.finish()
}

fn limits(velocity: f64, acceleration: f64, jerk: f64) -> Limits {
    let mut limits = Limits::uniform(1.0, 1.0, 1.0);
    limits.velocity[0] = velocity;
    limits.acceleration[0] = acceleration;
    limits.jerk[0] = jerk;
    limits
}

#[test]
fn a_motion_at_its_limits_is_clean() {
    let (a, v) = peaks();
    let report = judge(limits(v, a, JERK), &rest_to_rest(JERK, PERIODS));
    assert!(report.is_clean(), "{:?}", report.violations);
    assert!(
        (report.max_jerk_ratio.ratio - 1.0).abs() < 1e-6,
        "{:?}",
        report.max_jerk_ratio
    );
    assert_eq!(report.max_jerk_ratio.axis, Some(Axis::X));
    assert!(report.max_velocity_ratio.ratio > 0.97 && report.max_velocity_ratio.ratio < 1.0);
    assert!(report.max_acceleration_ratio.ratio > 0.95);
    assert!(report.is_complete);
    assert!((report.cycle_time_s - 4.0 * f64::from(PERIODS) * PERIOD).abs() < 1e-12);
    let length = report.final_position[0];
    assert!((report.path_length_mm - length).abs() < 1e-12);
    assert!((report.max_velocity[0] / v - report.max_velocity_ratio.ratio).abs() < 1e-12);
}

#[test]
fn a_limit_broken_by_a_hundred_thousandth_is_found() {
    let samples = rest_to_rest(JERK, PERIODS);
    let free = Limits::UNLIMITED;
    let clean = judge(limits(free, free, free), &samples);
    let (v, a) = (clean.max_velocity[0], clean.max_acceleration[0]);
    for (order, factor, broken) in [
        (0, 1.0 - 1e-5, true),
        (0, 1.0, false),
        (1, 1.0 - 1e-5, true),
        (1, 1.0, false),
        (2, 1.0 - 1e-5, true),
        (2, 1.0, false),
    ] {
        let mut tight = [free, free, free];
        tight[order] = [v, a, JERK][order] * factor;
        let report = judge(limits(tight[0], tight[1], tight[2]), &samples);
        let found = report
            .violations
            .iter()
            .any(|violation| match violation.kind {
                ViolationKind::Velocity { axis, .. } => order == 0 && axis == Axis::X,
                ViolationKind::Acceleration { axis, .. } => order == 1 && axis == Axis::X,
                ViolationKind::Jerk { axis, .. } => order == 2 && axis == Axis::X,
                _ => false,
            });
        assert_eq!(found, broken, "order {order}: {:?}", report.violations);
        assert_eq!(report.is_clean(), !broken);
        assert!(
            report
                .violations
                .iter()
                .all(|violation| violation.line == 7)
        );
    }
}

#[test]
fn starting_and_stopping_abruptly_is_found() {
    // Constant speed all the way: nothing wrong but at the two ends.
    let samples: Vec<_> = (0..10_u32)
        .map(|k| sample(u64::from(k), point(0.1 * f64::from(k), 0.0)))
        .collect();
    let report = judge(limits(1e3, 1e3, 1e9), &samples);
    let ticks: Vec<_> = report
        .violations
        .iter()
        .filter(|violation| matches!(violation.kind, ViolationKind::Acceleration { .. }))
        .map(|violation| violation.tick)
        .collect();
    assert_eq!(ticks, [1, 10], "{:?}", report.violations);
}

#[test]
fn a_gap_is_found() {
    let mut samples = rest_to_rest(JERK, PERIODS);
    samples.remove(30);
    let (a, v) = peaks();
    let report = judge(limits(v, a, JERK), &samples);
    let kinds: Vec<_> = report
        .violations
        .iter()
        .map(|violation| violation.kind)
        .collect();
    assert_eq!(kinds, [ViolationKind::Gap { after: 29 }]);
}

#[test]
fn swapped_and_repeated_samples_are_gaps() {
    let mut samples = rest_to_rest(JERK, PERIODS);
    samples.swap(30, 31);
    let (a, v) = peaks();
    let report = judge(limits(v, a, JERK), &samples);
    let gaps = report
        .violations
        .iter()
        .filter(|violation| matches!(violation.kind, ViolationKind::Gap { .. }))
        .count();
    assert_eq!(gaps, 3, "{:?}", report.violations);
}

#[test]
fn reports_that_do_not_fit_are_found() {
    let (a, v) = peaks();
    for (what, velocity, acceleration) in [
        (Inconsistency::Velocity, JERK * PERIOD * PERIOD, 0.0),
        (Inconsistency::Acceleration, 0.0, 3.0 * JERK * PERIOD),
    ] {
        let mut samples = rest_to_rest(JERK, PERIODS);
        samples[40].reported = samples[40]
            .reported
            .map(|[v, a]| [v + point(velocity, 0.0), a + point(acceleration, 0.0)]);
        let report = judge(limits(v, a, JERK), &samples);
        let found = report.violations.iter().any(|violation| {
            matches!(violation.kind, ViolationKind::Inconsistent { axis: Axis::X, what: found } if found == what)
        });
        assert!(found, "{what:?}: {:?}", report.violations);
    }
}

#[test]
fn what_is_not_a_number_is_found() {
    let mut samples = rest_to_rest(JERK, PERIODS);
    samples[3].position[4] = f64::NAN;
    let report = judge(limits(1e9, 1e9, 1e9), &samples);
    assert!(
        report
            .violations
            .iter()
            .any(|v| v.kind == ViolationKind::NotFinite)
    );
}

/// Coordinates are rounded: their third difference at a short period is noise, not jerk.
#[test]
fn rounding_far_from_the_origin_is_no_jerk() {
    let period_t = 1.25e-4;
    let limits = Limits::uniform(1e4, 1e9, 1.0);
    let mut audit = Audit::new(&AuditSettings {
        limits,
        period_t,
        tolerance_mm: TOLERANCE,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    });
    // At rest, but for the last bit of the coordinate.
    let at = 8000.0_f64;
    for tick in 0..100_u32 {
        let jitter = if tick % 2 == 0 {
            0.0
        } else {
            at * f64::EPSILON / 2.0
        };
        audit.sample(&sample(u64::from(tick), point(at + jitter, 0.0)));
    }
    let report = audit.finish();
    assert!(
        report.max_jerk_ratio.ratio > 1.0,
        "{:?}",
        report.max_jerk_ratio
    );
    let jerks = report
        .violations
        .iter()
        .filter(|v| matches!(v.kind, ViolationKind::Jerk { .. }));
    assert_eq!(jerks.count(), 0, "{:?}", report.violations);
}

#[test]
fn nothing_at_all_is_clean() {
    let report = Audit::new(&settings(1.0)).finish();
    assert!(report.is_clean() && report.is_complete);
    assert_eq!(report.samples, 0);
}

#[test]
fn a_violation_reads_well() {
    let report = judge(limits(1e9, 1e9, 999.0), &rest_to_rest(JERK, PERIODS));
    let texts: Vec<_> = report.violations.iter().map(ToString::to_string).collect();
    let want = "line 7, tick 3: X has 1.001001 of its jerk limit";
    assert!(texts.iter().any(|text| text == want), "{texts:?}");
}
