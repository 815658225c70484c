//! Tests of the feed that is kept: a motion that slows down in the middle of a move is found, unless something else
//! than the feed may bind it there.

use crate::tremor::{FEED_V, at_feed, distance, mill, settings};
use crate::{PERIOD, point, sample};
use core::f64::consts::TAU;
use glidepath_audit::{Audit, JointBounds, ViolationKind};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::Limits;

/// The length of every move here, mm.
const LENGTH_MM: f64 = 100.0;

/// What is found of a motion along a move that falls behind by so much between 30 and 70 mm, where and how slow.
fn falling_behind(
    mut audit: Audit,
    segment: Segment,
    by_mm: f64,
    is_between_frames: bool,
) -> Vec<(f64, f64)> {
    let length_mm = segment.length();
    assert!((length_mm - LENGTH_MM).abs() < 1e-9);
    audit.program(&at_feed(1, segment));
    let along = |tick: u64| {
        let s = distance(tick as f64 * PERIOD, length_mm + by_mm);
        let u = ((s - 30.0) / 40.0).clamp(0.0, 1.0);
        s - by_mm * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u)
    };
    let mut tick = 0;
    loop {
        let s = along(tick);
        let position = segment.jet(s.min(length_mm)).position;
        let mut sample = sample(tick, position);
        sample.is_between_frames = is_between_frames;
        audit.sample(&sample);
        if tick > 0 && s <= along(tick - 1) {
            break;
        }
        tick += 1;
    }
    let report = audit.finish();
    assert!(report.is_complete, "{:?}", report.violations);
    let found = report.tremors.iter();
    let slow = found.filter_map(|tremor| match tremor.kind {
        ViolationKind::SlowedDown { speed_v, feed_v } => {
            assert!((feed_v - FEED_V).abs() < 1e-9, "{feed_v}");
            Some((along(tremor.tick), speed_v))
        }
        _ => None,
    });
    slow.collect()
}

fn line() -> Segment {
    Segment::line(point(0.0, 0.0), point(LENGTH_MM, 0.0))
}

/// Round and round.
fn arc(radius_mm: f64) -> Segment {
    let sweep_rad = LENGTH_MM / radius_mm;
    let (sin, cos) = sweep_rad.sin_cos();
    Segment::Arc(Arc {
        start: point(radius_mm, 0.0),
        end: point(radius_mm * cos, radius_mm * sin),
        plane: Plane::Xy,
        center: [0.0; 2],
        sweep_rad,
    })
}

#[test]
fn a_motion_that_slows_down_in_the_middle_of_a_move_is_found() {
    let audit = || Audit::new(&settings(mill()));
    for segment in [line(), arc(LENGTH_MM / TAU)] {
        // Slower by 15/8 of the mean: by 4.7 %, and by 9.4 % in the middle of 40 mm.
        assert_eq!(falling_behind(audit(), segment, 1.0, false), []);
        let found = falling_behind(audit(), segment, 2.0, false);
        let [(at_mm, speed_v)] = found[..] else {
            panic!("{found:?}")
        };
        assert!((speed_v - 45.3125).abs() < 0.05, "{speed_v}");
        assert!((at_mm - 49.0).abs() < 1.0, "{at_mm}");
        // Where program time runs slower, that may be why.
        assert_eq!(falling_behind(audit(), segment, 2.0, true), []);
    }
}

#[test]
fn what_an_axis_can_hardly_do_is_not_run_at_the_feed() {
    let arc = arc(10.0);
    let [least_a, least_j] = [FEED_V * FEED_V / 10.0, FEED_V.powi(3) / 100.0];
    let limits = [
        (2.0 * FEED_V, 2.0 * least_a, 2.0 * least_j, true),
        (1.05 * FEED_V, 2.0 * least_a, 2.0 * least_j, false),
        (2.0 * FEED_V, 1.05 * least_a, 2.0 * least_j, false),
        (2.0 * FEED_V, 2.0 * least_a, 1.05 * least_j, false),
    ];
    for (v, a, j, is_found) in limits {
        let audit = Audit::new(&settings(Limits::uniform(v, a, j)));
        let found = falling_behind(audit, arc, 2.0, false);
        assert_eq!(found.len(), usize::from(is_found), "{v} {a} {j}");
    }
}

#[test]
fn joints_may_bind_where_axes_do_not() {
    let bounds = JointBounds {
        range: [f64::NEG_INFINITY, f64::INFINITY],
        rates: [f64::INFINITY; 3],
    };
    let audit = Audit::new(&settings(mill())).with_joints(vec![bounds]);
    assert_eq!(falling_behind(audit, line(), 2.0, false), []);
}

#[test]
fn turning_axes_have_a_speed_of_their_own() {
    let mut end = point(LENGTH_MM, 0.0);
    end[3] = 10.0;
    let turning = Segment::line(AxisVector::zeros(), end);
    let audit = Audit::new(&settings(mill()));
    assert_eq!(falling_behind(audit, turning, 2.0, false), []);
}
