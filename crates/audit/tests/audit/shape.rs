//! Tests of the shape figures: overshoot, corners, straightness, reversals, and the deviation that
//! plots show.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test; figures that are exact"
)]

use crate::{TOLERANCE, point, polygon, settings, walk};
use core::f64::consts::PI;
use glidepath_audit::AuditSettings;
use glidepath_audit::diagnosis::{Diagnosis, Summary};
use glidepath_audit::shape::{Border, ShapeAudit, ShapeReport};
use glidepath_geometry::{Arc, Axis, AxisVector, Plane, Segment};
use glidepath_program::{Corners, Frame, FrameFlags, Item, ItemKind, Limits, Rate};

/// X, Y, Z.
fn at(x: f64, y: f64, z: f64) -> AxisVector {
    let mut at = point(x, y);
    at[2] = z;
    at
}

/// What is told of a motion along a polygon at feed, and the largest deviation shown.
fn told(program: &[AxisVector], motion: &[AxisVector]) -> (Summary, f64) {
    told_of(polygon(program), motion)
}

/// The same of items.
fn told_of(items: Vec<Item>, motion: &[AxisVector]) -> (Summary, f64) {
    let mut diagnosis = Diagnosis::new(&inside());
    for mut item in items {
        if let ItemKind::Move { rate, .. } = &mut item.kind {
            *rate = Rate::Feed(25.0);
        }
        diagnosis.program(&item);
    }
    let mut most_mm = 0.0_f64;
    for (sequence, position) in (0_u32..).zip(motion) {
        let mut frame = Frame {
            sequence: sequence.into(),
            line: sequence,
            path_v: 25.0,
            planned_override: 1.0,
            ..Frame::blank(*position)
        };
        if sequence == 0 {
            frame.flags = FrameFlags::FIRST;
        }
        diagnosis.frame(&frame);
        most_mm = most_mm.max(diagnosis.deviation().distance_mm);
    }
    (diagnosis.finish(), most_mm)
}

/// Corners on their inner side.
fn inside() -> AuditSettings {
    AuditSettings {
        corners: Corners::Inner,
        ..settings(Limits::UNLIMITED)
    }
}

fn shape(program: &[AxisVector], motion: &[AxisVector]) -> ShapeReport {
    told(program, motion).0.shape
}

/// Adds a bump of a height to an axis between two samples.
fn bump(motion: &mut [AxisVector], axis: usize, from: usize, to: usize, height: f64) {
    for (k, position) in motion[from..to].iter_mut().enumerate() {
        let part = k as f64 / (to - from) as f64;
        position[axis] += height * (1.0 - (2.0 * PI * part).cos()) / 2.0;
    }
}

const PLUNGE: [[f64; 3]; 4] = [
    [0.0, 0.0, 5.0],
    [0.0, 0.0, -1.0],
    [12.0, 0.0, -1.0],
    [12.0, 0.0, 5.0],
];

#[test]
fn a_plunge_below_the_programmed_depth_is_told() {
    let program = PLUNGE.map(|[x, y, z]| at(x, y, z));
    let clean = walk(&program, 0.1);
    let none = shape(&program, &clean);
    assert!(
        none.below
            .iter()
            .chain(&none.above)
            .all(|met| met.distance_mm < 1e-9)
    );
    assert_eq!(none.programmed_reversals[..3], [0, 0, 1]);
    assert_eq!(none.reversals[..3], [0, 0, 1]);
    // Through the end of the plunge and back, while X sets out.
    let mut deep = clean.clone();
    bump(&mut deep, 2, 58, 70, -0.0188);
    let told = shape(&program, &deep);
    let below = told.below[2];
    assert!((below.distance_mm - 0.0188).abs() < 1e-3, "{below:?}");
    assert!((58..=70).contains(&below.line), "{below:?}");
    assert!(told.above[2].distance_mm < 1e-9, "{told:?}");
    // On the way up from the floor it rounds the corner early: that is no overshoot.
    let mut round = clean;
    let corner = round.iter().rposition(|p| p[2] <= -1.0).unwrap();
    for k in 0..20_u32 {
        let part = f64::from(k) / 20.0;
        round[corner - 20 + k as usize][2] += 0.015 * part * part;
    }
    let told = shape(&program, &round);
    assert!(told.above[2].distance_mm < 1e-9, "{told:?}");
}

#[test]
fn the_outer_side_of_a_corner_is_told_and_the_inner_one_is_not() {
    for turned in [0.0_f64, 0.5, 2.0] {
        let turn = |[x, y]: [f64; 2]| {
            let (sin, cos) = turned.sin_cos();
            point(x * cos - y * sin, x * sin + y * cos)
        };
        let program = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(turn);
        // To the left is inside.
        for (across, outside) in [(0.012, 0.0), (-0.012, 0.012)] {
            let mut motion = walk(&program, 0.1);
            let side = turn([0.0, across]);
            for (k, position) in motion.iter_mut().enumerate().take(95).skip(80) {
                let part = (k - 80) as f64 / 15.0;
                *position += side * (1.0 - (2.0 * PI * part).cos()) / 2.0;
            }
            let told = shape(&program, &motion);
            let off = (told.outside.distance_mm - outside).abs();
            assert!(off < 3e-4, "{turned} {across}: {told:?}");
        }
    }
    // A curve in chords is no corner.
    let arc: Vec<_> = (0..=40)
        .map(|k| f64::from(k) * 0.1)
        .map(|angle| point(10.0 * angle.cos(), 10.0 * angle.sin()))
        .collect();
    let wide: Vec<_> = walk(&arc, 0.1).iter().map(|p| p * 1.001).collect();
    assert!(shape(&arc, &wide).outside.distance_mm < 1e-9);
}

/// A line to (10, 0), and half a circle of 10 mm from there, which sets out upwards and bends to the left.
#[test]
fn a_corner_between_a_line_and_an_arc_has_an_outer_side_too() {
    let on_arc = |angle: f64, radius: f64| point(radius * angle.cos(), radius * angle.sin());
    let mut items = polygon(&[point(0.0, 0.0), point(10.0, 0.0), point(10.0, 5.0)]);
    if let ItemKind::Move { segment, .. } = &mut items.last_mut().unwrap().kind {
        *segment = Segment::Arc(Arc {
            start: point(10.0, 0.0),
            end: point(-10.0, 0.0),
            plane: Plane::Xy,
            center: [0.0, 0.0],
            sweep_rad: PI,
        });
    }
    // The tool is beside the arc by so much at its start, and on it an eighth of a turn later.
    for (across, outside) in [(0.0, 0.0), (-0.012, 0.0), (0.012, 0.012)] {
        let mut motion = walk(&[point(0.0, 0.0), point(10.0, 0.0)], 0.1);
        let lanes = (1..=314_u32).map(|k| {
            let angle = f64::from(k) * 0.01;
            let fades = (1.0 - angle / 0.8).max(0.0);
            on_arc(angle, 10.0 + across * fades * fades)
        });
        motion.extend(lanes);
        let told = told_of(items.clone(), &motion).0.shape;
        let off = (told.outside.distance_mm - outside).abs();
        assert!(off < 6e-4, "{across}: {told:?}");
    }
}

#[test]
fn a_straight_cut_beside_its_line_is_told() {
    let program = [point(0.0, 0.0), point(20.0, 0.0), point(20.0, 3.0)];
    let mut motion = walk(&program, 0.1);
    let told = shape(&program, &motion);
    assert_eq!((told.straight_moves, told.beside.distance_mm), (1, 0.0));
    // Near its ends it may be off.
    bump(&mut motion, 1, 5, 40, 0.015);
    assert!(shape(&program, &motion).beside.distance_mm < 1e-9);
    bump(&mut motion, 1, 70, 120, 0.006);
    let beside = shape(&program, &motion).beside;
    assert!((beside.distance_mm - 0.006).abs() < 1e-4, "{beside:?}");
}

#[test]
fn reversals_that_the_program_does_not_ask_for_are_told() {
    let program = [point(0.0, 0.0), point(20.0, 0.0), point(20.0, 3.0)];
    let mut motion = walk(&program, 0.1);
    bump(&mut motion, 1, 60, 90, 0.0015);
    assert_eq!(shape(&program, &motion).reversals[..2], [0, 0]);
    bump(&mut motion, 1, 110, 140, 0.005);
    let told = shape(&program, &motion);
    assert_eq!(told.programmed_reversals[..2], [0, 0]);
    assert_eq!(told.reversals[..2], [0, 2]);
}

/// Where the path comes back beside itself, the nearest place is that of a later move: what is shown
/// is the distance from the place that the motion is at.
#[test]
fn the_deviation_shown_is_not_that_from_a_later_move() {
    // Out by a spur of two short moves, and back a micrometre beside it.
    let program = [
        point(0.0, 0.0),
        point(1.0, 0.0),
        point(1.04, 0.0),
        point(1.04, 0.001),
        point(0.0, 0.001),
    ];
    let mut motion = walk(&program, 0.011);
    for position in &mut motion {
        position[1] = 0.001 - position[1];
    }
    let (_, most_mm) = told(&program, &motion);
    assert!(most_mm <= 0.0011, "{most_mm}");
    assert!(most_mm < TOLERANCE);
}

/// What comes to its place late, on the inner side of a rounded corner, is not beyond it.
#[test]
fn what_has_not_come_yet_is_not_beyond() {
    let program = PLUNGE.map(|[x, y, z]| at(x, y, z));
    let mut motion = walk(&program, 0.1);
    let corner = motion.iter().position(|p| p[2] <= -1.0).unwrap();
    for (k, position) in motion.iter_mut().skip(corner).take(30).enumerate() {
        position[2] += 0.015 * (1.0 - k as f64 / 30.0);
    }
    let told = shape(&program, &motion);
    assert!(told.above[2].distance_mm < 1e-9, "{told:?}");
    assert_eq!(told.finding_count, 0, "{told:?}");
    // Once there, it may not leave again.
    bump(&mut motion, 2, corner + 40, corner + 60, 0.005);
    let above = shape(&program, &motion).above[2];
    assert!((above.distance_mm - 0.005).abs() < 2e-4, "{above:?}");
}

#[test]
fn what_is_beyond_a_stop_or_outside_of_a_corner_is_a_finding() {
    let program = PLUNGE.map(|[x, y, z]| at(x, y, z));
    let clean = walk(&program, 0.1);
    assert_eq!(shape(&program, &clean).finding_count, 0);
    // Down to the depth, and up to the clearance plane, where X sets out and where it stops.
    for (axis, from, height, sign) in [(2, 58, -0.0188, -1.0), (0, 175, 0.012, 1.0)] {
        for (height, count) in [(height, 1), (sign * 5e-4, 0), (-height, 0)] {
            let mut motion = clean.clone();
            bump(&mut motion, axis, from, from + 12, height);
            let told = shape(&program, &motion);
            let findings: Vec<_> = told.findings.iter().flatten().collect();
            let of_axis = findings
                .iter()
                .filter(|found| found.border == Border::Stop(Axis::ALL[axis]));
            assert_eq!(of_axis.count(), count, "{axis} {height}: {findings:?}");
        }
    }
}

#[test]
fn what_is_beside_a_straight_move_is_a_finding_in_its_middle_half() {
    let program = [[0.0, 0.0, 0.0], [6.0, 8.0, 0.0], [20.0, 8.0, 0.0]].map(|[x, y, z]| at(x, y, z));
    let clean = walk(&program, 0.1);
    assert_eq!(shape(&program, &clean).finding_count, 0);
    // 10 mm from the start, a tenth of a millimetre each: the middle half is from 25 to 75.
    for (from, height, count) in [
        (40, 0.01, 1),
        (40, -0.01, 1),
        (40, 0.001, 0),
        (5, 0.01, 0),
        (80, 0.01, 0),
    ] {
        let mut motion = clean.clone();
        bump(&mut motion, 0, from, from + 12, height);
        let told = shape(&program, &motion);
        let findings: Vec<_> = told.findings.iter().flatten().collect();
        let beside = findings
            .iter()
            .filter(|found| found.border == Border::Straight);
        assert_eq!(beside.count(), count, "{from} {height}: {findings:?}");
    }
}

#[test]
fn on_either_side_nothing_is_a_finding() {
    let program = PLUNGE.map(|[x, y, z]| at(x, y, z));
    let mut deep = walk(&program, 0.1);
    bump(&mut deep, 2, 58, 70, -0.0188);
    for (corners, count) in [(Corners::Either, 0), (Corners::Inner, 1)] {
        let mut audit = ShapeAudit::new(&AuditSettings {
            corners,
            ..inside()
        });
        for item in polygon(&program) {
            audit.program(&item);
        }
        for (line, position) in (0..).zip(&deep) {
            audit.next(position, line);
        }
        let told = audit.finish();
        assert_eq!(told.finding_count, count, "{told:?}");
        assert!(told.below[2].distance_mm > 0.018, "{told:?}");
    }
}

/// Between corners that turn to different sides the motion goes over from one side to the other: about the
/// middle neither of them is the nearer one.
#[test]
fn about_the_middle_either_corner_of_a_move_is_the_one_that_counts() {
    let program =
        |last_x| [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (last_x, 10.0)].map(|(x, y)| point(x, y));
    // The coordinate of Y, what X is off there, how often that is a finding where the second corner turns back,
    // and where it turns on.
    let cases = [
        (3.0, 0.012, 1, 1),
        (3.0, -0.012, 0, 0),
        (4.6, 0.012, 0, 1),
        (5.4, -0.012, 0, 0),
        (7.0, -0.012, 1, 0),
        (7.0, 0.012, 0, 1),
    ];
    for (y, off, back, on) in cases {
        for (last_x, count) in [(20.0, back), (0.0, on)] {
            let mut motion = walk(&program(last_x), 0.1);
            let place = motion.iter().position(|p| p[1] >= y).unwrap();
            bump(&mut motion, 0, place - 2, place + 3, off);
            let told = shape(&program(last_x), &motion);
            // That the motion is not straight there is another matter.
            let found = told.findings.iter().flatten();
            let of_sides = found.filter(|found| found.border != Border::Straight);
            assert_eq!(of_sides.count(), count, "{y} {off} {last_x}: {told:?}");
        }
    }
}
