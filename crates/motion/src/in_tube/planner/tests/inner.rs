//! Motion on the inner side: stops of axes, corners, reversals.

use super::*;
use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::shape::ShapeReport;
use glidepath_program::{Corners, Frame, FrameFlags};

fn space(points: &[[f64; 3]]) -> Vec<AxisVector> {
    let at = |[x, y, z]: &[f64; 3]| {
        let mut point = AxisVector::zeros();
        (point[0], point[1], point[2]) = (*x, *y, *z);
        point
    };
    points.iter().map(at).collect()
}

/// The points turned in the plane.
fn turned(points: &[AxisVector], degrees: f64) -> Vec<AxisVector> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let turn = |point: &AxisVector| {
        let mut turned = *point;
        turned[0] = cos * point[0] - sin * point[1];
        turned[1] = sin * point[0] + cos * point[1];
        turned
    };
    points.iter().map(turn).collect()
}

impl Case {
    fn shape(&self, periods: &[Period]) -> ShapeReport {
        let mut diagnosis = Diagnosis::new(&AuditSettings {
            limits: self.limits,
            period_t: self.period_t,
            tolerance_mm: self.tolerance_mm,
            direction: glidepath_program::DirectionTolerance::default(),
            corners: self.corners,
        });
        for item in self.items() {
            diagnosis.program(&item);
        }
        let mut frame = Frame {
            planned_override: 1.0,
            flags: FrameFlags::FIRST,
            ..Frame::blank(self.points[0])
        };
        diagnosis.frame(&frame);
        frame.flags = FrameFlags::default();
        for period in periods {
            frame.sequence += 1;
            frame.line = period.tag as u32 + 1;
            frame.position = period.position;
            frame.path_v = period.path_v;
            diagnosis.frame(&frame);
        }
        diagnosis.finish().shape
    }
}

/// A plan on the inner side, judged in all; what there is to tell of its shape.
fn inner(points: Vec<AxisVector>) -> ShapeReport {
    let case = &inside(points);
    let periods = case.plan();
    assert_clean(case, &periods);
    let shape = case.shape(&periods);
    assert_eq!(shape.finding_count, 0, "{:?}", shape.findings);
    shape
}

fn inside(points: Vec<AxisVector>) -> Case {
    Case {
        corners: Corners::Inner,
        straight_mm: Some(1e-3),
        ..Case::mill(points)
    }
}

fn reversals(shape: &ShapeReport) -> (u64, u64) {
    let of = |counts: &[u64]| counts.iter().sum();
    (of(&shape.reversals), of(&shape.programmed_reversals))
}

#[test]
fn a_plunge_a_pocket_and_a_retract_are_inside() {
    let pocket = space(&[
        [0.0, 0.0, 2.0],
        [10.0, 10.0, 2.0],
        [10.0, 10.0, -1.0],
        [30.0, 10.0, -1.0],
        [30.0, 30.0, -1.0],
        [10.0, 30.0, -1.0],
        [10.0, 10.0, -1.0],
        [10.0, 10.0, 2.0],
        [0.0, 10.0, 2.0],
    ]);
    for degrees in [0.0, 30.0] {
        let shape = inner(turned(&pocket, degrees));
        assert!(shape.below[2].distance_mm <= 1e-3, "{:?}", shape.below);
        assert!(shape.above[2].distance_mm <= 1e-3, "{:?}", shape.above);
        let (counted, programmed) = reversals(&shape);
        assert!(
            counted <= programmed,
            "{degrees}: {counted} for {programmed}"
        );
    }
}

/// Whatever corners are before and after, on a line that no axis is along.
#[test]
fn sides_are_straight_however_short() {
    for (corners, turn) in [(3, 120.0), (4, 90.0), (6, 60.0)] {
        for side_mm in [5.5, 8.0, 10.0, 14.0] {
            let mut points = vec![[0.0; 3]];
            for k in 0..2 * corners {
                let (sin, cos) = (17.0 + turn * f64::from(k)).to_radians().sin_cos();
                let [x, y, _] = points[points.len() - 1];
                points.push([x + side_mm * cos, y + side_mm * sin, 0.0]);
            }
            let shape = inner(space(&points));
            assert!(shape.straight_moves >= 1, "{shape:?}");
            let beside_mm = shape.beside.distance_mm;
            assert!(beside_mm <= 1e-3, "{corners} {side_mm}: {beside_mm}");
        }
    }
}

#[test]
fn drilling_does_not_pass_the_depth() {
    let holes: Vec<[f64; 3]> = (0..4)
        .flat_map(|k| [2.0, -5.0, 2.0].map(|z| [3.0 * f64::from(k), 0.0, z]))
        .collect();
    let shape = inner(space(&holes));
    assert!(shape.below[2].distance_mm <= 1e-3, "{:?}", shape.below);
    let (counted, programmed) = reversals(&shape);
    assert!(counted <= programmed, "{counted} for {programmed}");
}

#[test]
fn corners_are_passed_inside_whatever_their_angle() {
    let zigzag: Vec<_> = (0..12)
        .map(|k| (1.2 * f64::from(k), 2.0 * f64::from(k % 2)))
        .collect();
    let stairs: Vec<_> = (0..12)
        .map(|k| (f64::from((k + 1) / 2), f64::from(k / 2)))
        .collect();
    for points in [square(), plane(&zigzag), plane(&stairs)] {
        for degrees in [0.0, 30.0] {
            let shape = inner(turned(&points, degrees));
            let (counted, programmed) = reversals(&shape);
            assert!(
                counted <= programmed,
                "{degrees}: {counted} for {programmed}"
            );
        }
    }
}

/// A window sees no further than to where the motion is about to be fast again: that counts, too.
#[test]
fn a_corner_between_fast_moves_is_no_stop() {
    let case = Case {
        feed_v: 200.0,
        ..inside(plane(&[
            (0.0, 0.0),
            (100.0, 0.0),
            (100.0, 30.0),
            (90.0, 30.0),
        ]))
    };
    let periods = case.plan();
    assert_clean(&case, &periods);
    let gained_t = bench::exact_stop_t(&case) - periods.len() as f64 * case.period_t;
    assert!(gained_t > 0.04, "20 ms a corner and more, not {gained_t}");
}

/// What the rules are for: the judge sees that they are broken where they do not hold.
#[test]
fn on_either_side_it_is_faster_and_outside() {
    let zigzag: Vec<_> = (0..12)
        .map(|k| (1.2 * f64::from(k), 2.0 * f64::from(k % 2)))
        .collect();
    let either = Case {
        corners: Corners::Either,
        ..Case::mill(plane(&zigzag))
    };
    let periods = either.plan();
    assert_clean(&either, &periods);
    let within = inside(either.points.clone());
    assert!(periods.len() < within.plan().len(), "{}", periods.len());
    assert_eq!(either.shape(&periods).finding_count, 0);
    assert!(within.shape(&periods).finding_count > 5);
}
