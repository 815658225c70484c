//! The auditor: what it must find, what it must not, and its numbers against brute force.

mod arcs;
mod brute_force;
mod deviation;
mod direction;
mod joints;
mod limits;
mod planted;
mod program;
mod shape;
mod slow_down;
mod timing;
mod travel;
mod tremor;

use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample, ViolationKind};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind, Limits, PathMode, Rate};

const PERIOD: f64 = 0.004;
const TOLERANCE: f64 = 0.02;

fn point(x: f64, y: f64) -> AxisVector {
    let mut point = AxisVector::zeros();
    point[0] = x;
    point[1] = y;
    point
}

fn settings(limit: f64) -> AuditSettings {
    AuditSettings {
        limits: Limits::uniform(limit, limit, limit),
        period_t: PERIOD,
        tolerance_mm: TOLERANCE,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    }
}

fn item(line: u32, segment: Segment) -> Item {
    let mode = PathMode::Continuous { tolerance_mm: None };
    Item {
        block: 0,
        line,
        kind: ItemKind::Move {
            segment,
            rate: Rate::Rapid,
            mode,
        },
    }
}

/// The polygon through some points as a program of one line per side.
fn polygon(points: &[AxisVector]) -> Vec<Item> {
    points
        .windows(2)
        .zip(1..)
        .map(|(pair, line)| item(line, Segment::line(pair[0], pair[1])))
        .collect()
}

fn sample(tick: u64, position: AxisVector) -> Sample {
    Sample {
        tick,
        line: 1,
        position,
        reported: None,
        is_between_frames: false,
    }
}

/// Audits a motion through some positions, without limits.
fn audit(program: &[Item], positions: &[AxisVector]) -> AuditReport {
    audit_within(TOLERANCE, program, positions)
}

/// Points along a polygon, `step` apart, its corners included.
fn walk(points: &[AxisVector], step: f64) -> Vec<AxisVector> {
    let mut all = vec![points[0]];
    for pair in points.windows(2) {
        let parts = ((pair[1] - pair[0]).norm() / step).ceil().max(1.0);
        let mut k = 1.0;
        while k <= parts {
            all.push(pair[0] + (pair[1] - pair[0]) * (k / parts));
            k += 1.0;
        }
    }
    all
}

/// Audits a motion with a tolerance of its own.
fn audit_within(tolerance_mm: f64, program: &[Item], positions: &[AxisVector]) -> AuditReport {
    audited(tolerance_mm, program, positions).finish()
}

/// An audit that has seen a program and a motion.
fn audited(tolerance_mm: f64, program: &[Item], positions: &[AxisVector]) -> Audit {
    let settings = AuditSettings {
        tolerance_mm,
        ..settings(Limits::UNLIMITED)
    };
    let mut audit = Audit::new(&settings);
    for item in program {
        audit.program(item);
    }
    for (tick, &position) in (0..).zip(positions) {
        audit.sample(&sample(tick, position));
    }
    audit
}

fn kinds(report: &AuditReport) -> Vec<ViolationKind> {
    report
        .violations
        .iter()
        .map(|violation| violation.kind)
        .collect()
}
