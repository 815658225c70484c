//! Tests of helices at a low feed, with effort "optimal": never slower than along the arcs, or from
//! stop to stop.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use glidepath_audit::{Audit, AuditSettings};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_motion::Planner;
use glidepath_program::{
    Effort, Frame, Item, ItemKind, Limits, PathMode, Rate, Settings, Smoothing,
};

const FEED_V: f64 = 7.5;
/// Of two bores, each followed by its depth in turns.
const BORES: [(f64, u32); 2] = [(1.0125, 12), (0.325, 16)];

fn settings(effort: Effort, smoothing: Smoothing) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort,
    }
}

fn point(x: f64, y: f64, z: f64) -> AxisVector {
    let mut point = AxisVector::zeros();
    (point[0], point[1], point[2]) = (x, y, z);
    point
}

/// Rapids to the bores, and a helix of arcs of a third of a turn down each.
fn bores() -> Vec<Item> {
    let mut items = Vec::new();
    let mut at = point(0.0, 0.0, 3.0);
    let mut go = |segment: Segment, rate: Rate| {
        items.push(Item {
            block: 0,
            line: u32::try_from(items.len()).expect("few") + 1,
            kind: ItemKind::Move {
                segment,
                rate,
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        });
        segment.end()
    };
    for (number, (radius_mm, turns)) in (1..).zip(BORES) {
        let center = 20.0 * f64::from(number);
        for z in [3.0, 0.0] {
            let end = point(center + radius_mm, 0.0, z);
            at = go(Segment::line(at, end), Rate::Rapid);
        }
        for third in 1..=3 * turns {
            let sweep_rad = core::f64::consts::TAU / 3.0;
            let angle = f64::from(third % 3) * sweep_rad;
            let (y, x) = angle.sin_cos();
            let depth_mm = 0.1 * f64::from(third);
            let end = point(radius_mm.mul_add(x, center), radius_mm * y, -depth_mm);
            let arc = Arc {
                start: at,
                end,
                plane: Plane::Xy,
                center: [center, 0.0],
                sweep_rad,
            };
            at = go(Segment::Arc(arc), Rate::Feed(FEED_V));
        }
        at = go(Segment::line(at, point(at[0], at[1], 3.0)), Rate::Rapid);
    }
    items
}

fn plan(items: &[Item], settings: Settings) -> Vec<Frame> {
    let mut planner = Planner::new(settings, point(0.0, 0.0, 3.0));
    for item in items {
        planner.push(item).expect("a good item");
    }
    planner.finish();
    let frame = || planner.pop_frame().expect("motion");
    core::iter::from_fn(frame).collect()
}

#[test]
fn helices_are_driven_no_slower_than_along_their_arcs() {
    let items = bores();
    let settings_of_windows = settings(Effort::Optimal, Smoothing::Auto);
    let frames = plan(&items, settings_of_windows);
    let fast = plan(&items, settings(Effort::Fast, Smoothing::Auto)).len();
    let stops = plan(&items, settings(Effort::Fast, Smoothing::ExactStop)).len();
    let count = frames.len();
    assert!(
        count <= stops && count <= fast + 1,
        "{count} frames, {fast} with effort fast, {stops} with stops"
    );

    let mut audit = Audit::new(&AuditSettings::from(&settings_of_windows));
    for item in &items {
        audit.program(item);
    }
    for frame in &frames {
        audit.sample_at(&frame.into(), frame.path_s);
    }
    let report = audit.finish();
    assert!(report.is_clean() && report.is_complete, "{report:?}");
}
