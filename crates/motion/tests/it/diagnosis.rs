//! Tests of the diagnosis, on motions whose binding limits are known.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::support::{FREE, at, mill};
use core::f64::consts::TAU;
use glidepath_audit::AuditSettings;
use glidepath_audit::diagnosis::{Binding, Diagnosis, Summary};
use glidepath_geometry::{Arc, Axis, AxisVector, Plane, Segment};
use glidepath_motion::Planner;
use glidepath_program::{Frame, Item, ItemKind, Limits, PathMode, Rate, Settings};

fn line(number: u32, from: AxisVector, to: AxisVector, rate: Rate, mode: PathMode) -> Item {
    Item {
        block: 0,
        line: number,
        kind: ItemKind::Move {
            segment: Segment::line(from, to),
            rate,
            mode,
        },
    }
}

/// Plans and diagnoses; the frames, each with what binds.
fn diagnosed(items: &[Item], settings: Settings) -> (Vec<(Frame, Binding)>, Summary) {
    let mut diagnosis = Diagnosis::new(&AuditSettings::from(&settings));
    let mut planner = Planner::new(settings, AxisVector::zeros());
    for item in items {
        planner.push(item).expect("a valid item");
        diagnosis.program(item);
    }
    planner.finish();
    let mut frames = Vec::new();
    while let Some(frame) = planner.pop_frame().expect("a motion") {
        frames.push((frame, diagnosis.frame(&frame)));
    }
    (frames, diagnosis.finish())
}

fn share(summary: &Summary, binding: Binding) -> f64 {
    let found = summary.shares.iter().find(|(b, _)| *b == binding);
    found.map_or(0.0, |(_, share)| *share)
}

#[test]
fn a_line_is_bound_by_jerk_and_acceleration_and_then_by_its_feed() {
    let items = [line(
        3,
        at(0.0, 0.0),
        at(100.0, 0.0),
        Rate::Feed(120.0),
        FREE,
    )];
    let (frames, summary) = diagnosed(&items, mill());
    for (frame, binding) in &frames {
        let known = [
            Binding::Rest,
            Binding::Feed,
            Binding::Acceleration(Axis::X),
            Binding::Jerk(Axis::X),
            // A period in which the jerk changes.
            Binding::None,
        ];
        assert!(known.contains(binding), "{binding} at {}", frame.sequence);
        assert!(
            *binding != Binding::Feed || frame.path_v > 117.0,
            "{}",
            frame.path_v
        );
    }
    // 120 mm/s: 50 ms of each jerk phase, 10 ms at full acceleration; 0.71 s at the feed.
    let total_t = frames.len() as f64 * 0.004;
    let jerk_t = share(&summary, Binding::Jerk(Axis::X)) * total_t;
    assert!((0.15..0.2).contains(&jerk_t), "{jerk_t}");
    assert!(share(&summary, Binding::Feed) > 0.65, "{summary:?}");
    let sum: f64 = summary.shares.iter().map(|(_, share)| share).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
}

#[test]
fn a_stop_is_the_slowest_place_and_its_loss_is_that_of_the_motion() {
    let stop = PathMode::ExactStop;
    let (a, b, c) = (at(0.0, 0.0), at(40.0, 0.0), at(40.0, 40.0));
    let items = [
        line(10, a, b, Rate::Feed(50.0), stop),
        line(20, b, c, Rate::Feed(50.0), stop),
        Item {
            block: 0,
            line: 30,
            kind: ItemKind::Dwell(0.5),
        },
    ];
    let (frames, summary) = diagnosed(&items, mill());
    let worst = summary.slowest[0];
    assert!(
        worst.speed_v <= 0.0 && worst.first_line == 10 && worst.last_line == 20,
        "{worst:?}"
    );
    assert!((worst.feed_v - 50.0).abs() < 1e-9, "{worst:?}");
    let moving = frames
        .iter()
        .filter(|(frame, _)| frame.path_v > 0.0)
        .count();
    let lost_t: f64 = summary.slowest.iter().map(|place| place.lost_t).sum();
    let expected_t = moving as f64 * 0.004 - 80.0 / 50.0;
    assert!(
        (lost_t - expected_t).abs() < 0.02,
        "{lost_t} of {expected_t}"
    );
    assert_eq!(
        summary.slowest.len(),
        3,
        "start, corner, end: not the dwell"
    );
}

#[test]
fn a_rapid_is_bound_by_the_axis_that_is_slowest_for_it() {
    let items = [line(1, at(0.0, 0.0), at(100.0, 300.0), Rate::Rapid, FREE)];
    let (_, summary) = diagnosed(&items, mill());
    assert!(
        share(&summary, Binding::Velocity(Axis::Y)) > 0.8,
        "{summary:?}"
    );
    assert!(
        share(&summary, Binding::Velocity(Axis::X)) <= 0.0,
        "{summary:?}"
    );
}

#[test]
fn a_circle_too_fast_for_the_period_is_bound_by_the_chord_error() {
    let arc = Arc {
        start: at(0.0, 0.0),
        end: at(0.0, 0.0),
        plane: Plane::Xy,
        center: [-50.0, 0.0],
        sweep_rad: TAU * 3.0,
    };
    let items = [Item {
        block: 0,
        line: 1,
        kind: ItemKind::Move {
            segment: Segment::Arc(arc),
            rate: Rate::Feed(1000.0),
            mode: FREE,
        },
    }];
    let settings = Settings {
        limits: Limits::uniform(1e4, 1e6, 1e9),
        ..mill()
    };
    let (_, summary) = diagnosed(&items, settings);
    assert!(share(&summary, Binding::ChordError) > 0.9, "{summary:?}");
}

#[test]
fn a_curve_at_the_edge_of_its_tolerance_is_bound_by_the_tolerance() {
    // A motion 19.8 µm beside its program, with nothing else in its way.
    let items = [line(
        1,
        at(0.0, 0.0),
        at(10.0, 0.0),
        Rate::Feed(100.0),
        FREE,
    )];
    let mut diagnosis = Diagnosis::new(&AuditSettings {
        limits: mill().limits,
        period_t: 0.004,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    });
    diagnosis.program(&items[0]);
    let (frames, _) = diagnosed(&items, mill());
    let mut frame = frames[0].0;
    diagnosis.frame(&frame);
    for i in 1..40 {
        frame.flags = frames[1].0.flags;
        frame.position = at(0.1 * f64::from(i), 0.0198);
        frame.path_v = 25.0;
        let binding = diagnosis.frame(&frame);
        assert!(i < 4 || binding == Binding::Tolerance, "{binding} at {i}");
    }
}
