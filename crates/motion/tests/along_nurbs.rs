//! Motion along NURBS: on the curve, within all limits, near the least time.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

#[path = "preview/curves.rs"]
#[allow(dead_code, reason = "a part of it is used")]
mod curves;
mod support;

use glidepath_geometry::{NurbsPath, Segment};
use glidepath_motion::audit::{Audit, AuditSettings, Report};
use glidepath_motion::{
    Effort, Frame, Item, ItemKind, Limits, PathBounds, PathMode, Planner, Rate, Settings, Smoothing,
};

/// The published comparison: limits along the path alone, those of the axes do not bind.
fn sheet(period_t: f64) -> Settings {
    let mut limits = Limits::uniform(1e4, 1e5, 1e8);
    limits.path = PathBounds {
        tangential_a: 1000.0,
        normal_a: 1000.0,
        jerk_j: 20_000.0,
    };
    Settings {
        limits,
        tolerance_mm: 0.001,
        smoothing: Smoothing::Auto,
        period_t,
        effort: Effort::Fast,
    }
}

fn items(path: &NurbsPath, tolerance_mm: f64, feed_v: f64) -> Vec<Item> {
    let segments = path.segments(1e-3 * tolerance_mm);
    let item = |segment: Segment| Item {
        line: 1,
        kind: ItemKind::Move {
            segment,
            rate: Rate::Feed(feed_v),
            mode: PathMode::Continuous { tolerance_mm: None },
        },
    };
    segments.into_iter().map(item).collect()
}

fn plan(items: &[Item], settings: Settings) -> (Vec<Frame>, Report) {
    let ItemKind::Move { segment, .. } = items[0].kind else {
        panic!("a move");
    };
    let mut planner = Planner::new(settings, segment.start());
    let mut audit = Audit::new(&AuditSettings {
        limits: settings.limits,
        period_t: settings.period_t,
        tolerance_mm: settings.tolerance_mm,
    });
    let mut frames = Vec::new();
    let mut pop = |planner: &mut Planner, audit: &mut Audit| {
        while let Some(frame) = planner.pop_frame().expect("motion") {
            audit.sample_at(&(&frame).into(), frame.path_s);
            frames.push(frame);
        }
    };
    for item in items {
        planner.push(item).expect("valid");
        audit.program(item);
        pop(&mut planner, &mut audit);
    }
    planner.finish();
    pop(&mut planner, &mut audit);
    (frames, audit.finish())
}

#[track_caller]
fn assert_clean(report: &Report) {
    assert!(
        report.is_clean() && report.is_complete,
        "{:?} {:?}",
        report.max_path_ratios,
        report.violations
    );
}

#[test]
fn the_butterfly_in_the_published_setting_is_as_fast_as_the_best_known() {
    let path = curves::path("butterfly");
    for (period_t, best_t) in [(0.001, 5.698), (0.004, 6.274)] {
        let settings = sheet(period_t);
        let items = items(&path, settings.tolerance_mm, 100.0);
        let start = std::time::Instant::now();
        let (_, report) = plan(&items, settings);
        println!(
            "{period_t}: {} s, deviation {} mm, {} pieces, {:?} {:?}",
            report.cycle_time_s,
            report.max_deviation_mm,
            items.len(),
            start.elapsed(),
            report.max_path_ratios.map(|worst| worst.ratio)
        );
        assert_clean(&report);
        assert!(
            report.cycle_time_s <= 1.01 * best_t,
            "{}",
            report.cycle_time_s
        );
    }
}

#[test]
fn the_butterfly_on_a_mill_is_near_the_optimum_of_the_exact_curve() {
    let path = curves::path("butterfly");
    let settings = Settings {
        smoothing: Smoothing::Auto,
        ..support::mill()
    };
    let items = items(&path, settings.tolerance_mm, 100.0);
    let start = std::time::Instant::now();
    let (_, report) = plan(&items, settings);
    println!(
        "mill: {} s, deviation {} mm, {:?}",
        report.cycle_time_s,
        report.max_deviation_mm,
        start.elapsed()
    );
    assert_clean(&report);
    assert!(
        report.cycle_time_s <= 1.02 * 4.6025,
        "{}",
        report.cycle_time_s
    );
}
