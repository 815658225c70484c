//! Tests of the check of joints that are not the axes.

use glidepath_audit::diagnosis::{Binding, Diagnosis};
use glidepath_audit::{
    Audit, AuditReport, AuditSettings, JointBounds, JointRate, Violation, ViolationKind,
};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Corners, Frame, FrameFlags, Item, ItemKind, Limits, PathMode, Rate};

const PERIOD_T: f64 = 0.004;

/// The verdict on positions of two joints, a pair a tick, of which the second can do half.
fn judged(positions: &[[f64; 2]]) -> AuditReport {
    let bounds = |share: f64| JointBounds {
        range: [-1.0, 50.0],
        rates: [100.0, 1000.0, 20_000.0].map(|limit| share * limit),
    };
    let mut audit = Audit::new(&AuditSettings {
        limits: Limits::uniform(1.0, 1.0, 1.0),
        period_t: PERIOD_T,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: Corners::default(),
    })
    .with_joints(vec![bounds(1.0), bounds(0.5)]);
    for (tick, joints) in (0..).zip(positions) {
        audit.joints(tick, 7, joints);
    }
    audit.finish()
}

/// From rest to rest by a jerk in one direction, twice as long in the other and back: 80 ticks.
fn there(jerk_j: f64) -> Vec<f64> {
    let (mut p, mut v, mut a) = (0.0, 0.0, 0.0);
    let mut positions = vec![p];
    for tick in 0..80 {
        let j = if (20..60).contains(&tick) {
            -jerk_j
        } else {
            jerk_j
        };
        p += PERIOD_T * (v + PERIOD_T * (a / 2.0 + PERIOD_T * j / 6.0));
        v += PERIOD_T * (a + PERIOD_T * j / 2.0);
        a += PERIOD_T * j;
        positions.push(p);
    }
    positions
}

fn joints_of(report: &AuditReport) -> Vec<(usize, JointRate)> {
    let of = |found: &Violation| match found.kind {
        ViolationKind::Joint { joint, rate, .. } => Some((joint, rate)),
        _ => None,
    };
    report.violations.iter().filter_map(of).collect()
}

#[test]
fn what_joints_can_do_is_no_violation() {
    // 10 000 mm/s³ for 80 ms: 800 mm/s², 64 mm/s.
    let positions: Vec<_> = there(10_000.0).iter().map(|p| [*p, *p / 2.0]).collect();
    let report = judged(&positions);
    assert!(joints_of(&report).is_empty(), "{:?}", report.violations);
    let worst = report.max_joint_ratios.expect("joints were judged");
    let ratios = worst.map(|worst| worst.ratio);
    assert!((ratios[0] - 0.64).abs() < 0.01, "{ratios:?}");
    assert!((ratios[1] - 0.8).abs() < 0.02, "{ratios:?}");
    assert!((ratios[2] - 0.5).abs() < 1e-6, "{ratios:?}");
}

#[test]
fn each_joint_is_judged_by_its_own_limits() {
    let positions: Vec<_> = there(10_000.0).iter().map(|p| [*p, *p]).collect();
    let found = joints_of(&judged(&positions));
    assert!(found.contains(&(1, JointRate::Velocity)), "{found:?}");
    assert!(found.contains(&(1, JointRate::Acceleration)), "{found:?}");
    assert!(found.iter().all(|(joint, _)| *joint == 1), "{found:?}");
    // Half of the jerk is all that the second joint can do, and no more.
    assert!(!found.contains(&(1, JointRate::Jerk)), "{found:?}");
    let positions: Vec<_> = there(10_001.0).iter().map(|p| [0.0, *p]).collect();
    assert!(joints_of(&judged(&positions)).contains(&(1, JointRate::Jerk)));
}

#[test]
fn a_motion_begins_and_ends_at_rest() {
    let mut positions: Vec<_> = there(10_000.0).iter().map(|p| [*p, 0.0]).collect();
    positions.truncate(41);
    let found = joints_of(&judged(&positions));
    assert!(found.contains(&(0, JointRate::Acceleration)), "{found:?}");
    positions.drain(..20);
    let whole = joints_of(&judged(&positions));
    assert!(whole.len() > found.len());
}

#[test]
fn a_joint_stays_in_its_range() {
    let inside = judged(&[[50.0, -1.0]; 3]);
    let outside = judged(&[[50.0, -1.001]; 3]);
    let ranges = |report: &AuditReport| {
        let is_range =
            |found: &&Violation| matches!(found.kind, ViolationKind::JointRange { joint: 1, .. });
        report.violations.iter().filter(is_range).count()
    };
    assert_eq!((ranges(&inside), ranges(&outside) > 0), (0, true));
    let text = outside.violations.iter().map(ToString::to_string);
    assert!(text.into_iter().any(|text| {
        text.contains("J1 is at -1.001000, 0.001000 beyond the end of its range at -1")
    }),);
}

#[test]
fn a_position_that_is_none_is_told() {
    let report = judged(&[[0.0, 0.0], [f64::NAN, 0.0]]);
    let is_told = |found: &Violation| matches!(found.kind, ViolationKind::NotFinite);
    assert!(report.violations.iter().any(is_told));
}

/// What binds at every period of a motion of two joints, of which the first does what `there` says and the second that
/// times a factor, with limits for which the jerk of `there` is the whole.
fn bound_by(factor: f64, with_joints: bool) -> Vec<Binding> {
    let bounds = JointBounds {
        range: [f64::NEG_INFINITY, f64::INFINITY],
        rates: [64.0, 1000.0, 10_000.0],
    };
    let settings = AuditSettings {
        limits: Limits::uniform(1e5, 1e7, 1e10),
        period_t: PERIOD_T,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: Corners::default(),
    };
    let mut diagnosis = Diagnosis::new(&settings);
    if with_joints {
        diagnosis = diagnosis.with_joints(&[bounds; 2]);
    }
    let positions = there(10_000.0);
    let mut position = AxisVector::zeros();
    let mut end = position;
    end[0] = positions[80];
    diagnosis.program(&Item {
        block: 0,
        line: 1,
        kind: ItemKind::Move {
            segment: Segment::line(position, end),
            rate: Rate::Feed(1e4),
            mode: PathMode::Continuous { tolerance_mm: None },
        },
    });
    let bound = (0..).zip(&positions).map(|(sequence, place)| {
        position[0] = *place;
        diagnosis.joints(&[*place, factor * place]);
        diagnosis.frame(&Frame {
            sequence,
            line: 1,
            planned_override: 1.0,
            flags: if sequence == 0 {
                FrameFlags::FIRST
            } else {
                FrameFlags::default()
            },
            ..Frame::blank(position)
        })
    });
    bound.collect()
}

#[test]
fn the_joint_that_binds_is_told() {
    let count = |bound: &[Binding], wanted: Binding| bound.iter().filter(|b| **b == wanted).count();
    // The first joint alone is at its jerk, but for the periods in which that changes, and at its velocity halfway.
    let first = bound_by(0.5, true);
    assert!(count(&first, Binding::JointJerk(0)) >= 60, "{first:?}");
    assert!(count(&first, Binding::JointVelocity(0)) >= 3, "{first:?}");
    assert_eq!(count(&first, Binding::JointJerk(1)), 0);
    assert_eq!(first[0], Binding::Rest);
    // The second joint, which has further to go.
    let second = bound_by(1.0001, true);
    assert!(count(&second, Binding::JointJerk(1)) >= 60, "{second:?}");
    assert_eq!(count(&second, Binding::JointJerk(0)), 0);
    // Nobody looks at joints.
    let none = bound_by(1.0001, false);
    assert!(count(&none, Binding::None) >= 75, "{none:?}");
}
