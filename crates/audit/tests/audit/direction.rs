//! The direction of the tool: what its angle to the programmed one may be, whatever the rotary axes are.

use crate::{TOLERANCE, item, kinds, sample, settings};
use glidepath_audit::{Audit, AuditReport, AuditSettings, AxisTurn, ToolAxis, ViolationKind};
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_program::{DirectionTolerance, ItemKind, Limits, PathMode};

/// C turns what A leans.
fn tool() -> ToolAxis {
    let turn = |axis, about| AxisTurn { axis, about };
    ToolAxis::new(&[
        turn(Axis::C, [0.0, 0.0, 1.0]),
        turn(Axis::A, [1.0, 0.0, 0.0]),
    ])
}

fn at(x: f64, a: f64, c: f64) -> AxisVector {
    let mut place = AxisVector::zeros();
    place[0] = x;
    (place[Axis::A.index()], place[Axis::C.index()]) = (a, c);
    place
}

fn judged(
    ends: [AxisVector; 2],
    angle_deg: Option<f64>,
    mode: PathMode,
    off: impl Fn(f64) -> AxisVector,
) -> AuditReport {
    judged_of(tool(), ends, angle_deg, mode, off)
}

/// Judges a motion in 100 periods along a line, off it by what is told of each share of the way.
fn judged_of(
    tool: ToolAxis,
    ends: [AxisVector; 2],
    angle_deg: Option<f64>,
    mode: PathMode,
    off: impl Fn(f64) -> AxisVector,
) -> AuditReport {
    let settings = AuditSettings {
        direction: DirectionTolerance {
            angle_deg,
            ..DirectionTolerance::default()
        },
        ..settings(Limits::UNLIMITED)
    };
    let mut audit = Audit::new(&settings).with_tool(Some(tool));
    let mut program = item(1, Segment::line(ends[0], ends[1]));
    if let ItemKind::Move { mode: of_move, .. } = &mut program.kind {
        *of_move = mode;
    }
    audit.program(&program);
    for tick in 0..=100_u32 {
        let share = f64::from(tick) / 100.0;
        let place = ends[0] + (ends[1] - ends[0]) * share;
        // On the way; at its ends it is where it has to be.
        let off = off(share) * (16.0 * share * (1.0 - share)).min(1.0);
        audit.sample(&sample(tick.into(), place + off));
    }
    audit.finish()
}

const PLAIN: PathMode = PathMode::Continuous { tolerance_mm: None };

#[test]
fn the_angle_is_that_between_directions() {
    let ends = [at(0.0, 60.0, 0.0), at(10.0, 60.0, 90.0)];
    let motion = |a: f64, c: f64| move |_| at(0.0, a, c);
    let stays = [at(0.0, 60.0, 0.0), at(10.0, 60.0, 0.0)];
    // On the way itself: in chords of both, which are not on the sphere.
    let still = judged(ends, None, PLAIN, motion(0.0, 0.0));
    assert!(still.is_clean(), "{:?}", still.violations);
    assert!(still.max_direction_deg.unwrap() < 1e-3, "{still:?}");
    // C by 0.02 degrees at 60 degrees of lean: 0.0173 of direction. Both axes by 0.014: 0.0186.
    for ((a, c), wanted_deg) in [
        ((0.0, 0.02), 0.02 * 60.0_f64.to_radians().sin()),
        ((0.014, 0.014), 0.014 * (1.0 + 0.75_f64).sqrt()),
    ] {
        let report = judged(stays, None, PLAIN, motion(a, c));
        assert!(report.is_clean(), "{:?}", report.violations);
        let found_deg = report.max_direction_deg.unwrap();
        assert!(
            (found_deg - wanted_deg).abs() < 1e-5,
            "{found_deg} {wanted_deg}"
        );
        // Where C turns, the tip is as near a little further on, where the direction is nearer.
        let report = judged(ends, None, PLAIN, motion(a, c));
        assert!(report.is_clean() && report.max_direction_deg.unwrap() <= wanted_deg + 1e-4);
    }
    // Each axis is inside, and the direction is not.
    let report = judged(stays, None, PLAIN, motion(0.0195, -0.0195));
    assert!(
        matches!(kinds(&report)[..], [ViolationKind::Direction { off_deg, allowed_deg }]
            if off_deg > allowed_deg && off_deg < 0.0267 && (allowed_deg - TOLERANCE).abs() < 1e-4),
        "{:?}",
        report.violations
    );
    assert!(report.max_deviation_mm <= TOLERANCE);
}

#[test]
fn a_tolerance_of_its_own_is_that_whatever_the_tip_may() {
    let ends = [at(0.0, 20.0, 0.0), at(10.0, 30.0, 0.0)];
    let off = |_| at(0.0, 0.0, 0.3);
    let lean_deg = 0.3 * 30.0_f64.to_radians().sin();
    let p = |tolerance_mm| PathMode::Continuous {
        tolerance_mm: Some(tolerance_mm),
    };
    for mode in [PLAIN, p(0.001), p(1.0)] {
        assert!(judged(ends, Some(1.01 * lean_deg), mode, off).is_clean());
        let report = judged(ends, Some(0.5 * lean_deg), mode, off);
        assert!(
            matches!(kinds(&report)[0], ViolationKind::Direction { .. }),
            "{:?}",
            report.violations
        );
    }
    // Without one it is that of the tip, in degrees.
    assert!(judged(ends, None, p(1.01 * lean_deg), off).is_clean());
    assert!(!judged(ends, None, p(0.5 * lean_deg), off).is_clean());
}

#[test]
fn beside_the_pole_c_may_be_anywhere() {
    // C turns by 180 degrees all at once where the program has it even, 0.009 degrees beside the pole.
    let ends = [at(0.0, 0.009, 0.0), at(10.0, 0.009, 180.0)];
    let sooner = |share: f64| at(0.0, 0.0, 90.0 * (core::f64::consts::TAU * share).sin());
    assert!(judged(ends, None, PLAIN, sooner).is_clean());
    // At a lean of a degree it may not.
    let ends = [at(0.0, 1.0, 0.0), at(10.0, 1.0, 180.0)];
    let report = judged(ends, None, PLAIN, sooner);
    assert!(
        matches!(kinds(&report)[0], ViolationKind::Direction { .. }),
        "{:?}",
        report.violations
    );
}

#[test]
fn a_tip_that_is_off_is_told_as_that() {
    let ends = [at(0.0, 20.0, 0.0), at(10.0, 30.0, 40.0)];
    let aside = |_| {
        let mut aside = AxisVector::zeros();
        aside[1] = 0.03;
        aside
    };
    let report = judged(ends, None, PLAIN, aside);
    assert!(
        matches!(kinds(&report)[..], [ViolationKind::Deviation { deviation_mm }]
            if (deviation_mm - 0.03).abs() < 1e-4),
        "{:?}",
        report.violations
    );
}

#[test]
fn the_end_is_where_the_axes_are() {
    // Along the rotary axis C says nothing of the direction; the program ends where it has C all the same.
    let ends = [at(0.0, 0.0, 0.0), at(10.0, 0.0, 90.0)];
    let mut audit = Audit::new(&settings(Limits::UNLIMITED)).with_tool(Some(tool()));
    audit.program(&item(1, Segment::line(ends[0], ends[1])));
    for tick in 0..=10_u32 {
        let share = f64::from(tick) / 10.0;
        audit.sample(&sample(tick.into(), at(10.0 * share, 0.0, 45.0 * share)));
    }
    assert!(!audit.finish().is_clean());
}

#[test]
fn axes_that_count_for_themselves_are_judged_beside_the_direction() {
    // Upright, C turns the tool about itself: the direction is the same.
    let ends = [at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0)];
    let off = |deg: f64| move |_| at(0.0, 0.0, deg);
    let of = |tool, deg| judged_of(tool, ends, None, PLAIN, off(deg));
    assert!(of(tool(), 1.0).is_clean());
    assert!(!of(tool().with_axes(), 1.0).is_clean());
    let within = of(tool().with_axes(), 0.99 * TOLERANCE);
    assert!(within.is_clean(), "{:?}", within.violations);
    assert!(!of(tool().with_axes(), 1.01 * TOLERANCE).is_clean());
}

#[test]
fn an_exact_end_is_that_whatever_a_degree_counts_for() {
    // The tolerance of the tip is 0.02 mm: a degree counts for 0.04 and for 10 mm.
    for angle_deg in [0.5, 0.002] {
        let reached = |off_deg: f64| {
            let ends = [at(0.0, 20.0, 0.0), at(10.0, 20.0, 10.0)];
            let settings = AuditSettings {
                direction: DirectionTolerance {
                    angle_deg: Some(angle_deg),
                    ..DirectionTolerance::default()
                },
                ..settings(Limits::UNLIMITED)
            };
            let mut audit = Audit::new(&settings).with_tool(Some(tool()));
            audit.program(&item(1, Segment::line(ends[0], ends[1])));
            for tick in 0..=100_u32 {
                let share = f64::from(tick) / 100.0;
                let place = ends[0] + (ends[1] - ends[0]) * share;
                audit.sample(&sample(tick.into(), place + at(0.0, 0.0, off_deg * share)));
            }
            audit.finish()
        };
        for (off_deg, is_there) in [(0.9e-6, true), (1.2e-6, false), (1e-5, false)] {
            let report = reached(off_deg);
            assert_eq!(
                report.is_clean(),
                is_there,
                "{angle_deg} {off_deg}: {report:?}"
            );
        }
    }
}
