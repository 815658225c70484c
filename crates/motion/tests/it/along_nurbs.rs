//! Tests of motion along NURBS: on the curve, within all limits, near the least time.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::preview::curves;
use crate::support;

use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_geometry::{Nurbs, NurbsPath, Segment};
use glidepath_motion::Planner;
use glidepath_program::{
    Effort, Frame, Item, ItemKind, Limits, Override, PathBounds, Rate, Settings, Smoothing,
};
use proptest::prelude::*;

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
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t,
        effort: Effort::Fast,
    }
}

fn items(path: &NurbsPath, tolerance_mm: f64, feed_v: f64) -> Vec<Item> {
    let segments = path.segments(1e-3 * tolerance_mm).into_iter();
    segments.map(|segment| item(segment, feed_v)).collect()
}

fn audit(settings: &Settings) -> Audit {
    Audit::new(&AuditSettings::from(settings))
}

fn plan(items: &[Item], settings: Settings) -> (Vec<Frame>, AuditReport) {
    let ItemKind::Move { segment, .. } = items[0].kind else {
        panic!("a move");
    };
    let mut planner = Planner::new(settings, segment.start());
    let mut audit = audit(&settings);
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
fn assert_clean(report: &AuditReport) {
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
        let (frames, report) = plan(&items, settings);
        assert_clean(&report);
        let cycle_t = report.cycle_time_s;
        assert!(cycle_t <= 1.01 * best_t, "{cycle_t} at {period_t}");
        assert!(report.max_deviation_mm <= 0.001);
        assert!(frames.len() > 1000);
        // At a feed that is reached nearly everywhere.
        let feed_v = 20.0;
        let (frames, report) = plan(&self::items(&path, settings.tolerance_mm, feed_v), settings);
        assert_clean(&report);
        let fluctuation_r = fluctuation(&path, &frames, feed_v, period_t);
        assert!(fluctuation_r < 1e-4, "{fluctuation_r} at {period_t}");
    }
}

/// The largest relative difference from the feed of steps along the exact curve, where the feed is
/// reached and kept.
fn fluctuation(path: &NurbsPath, frames: &[Frame], feed_v: f64, period_t: f64) -> f64 {
    let s_of = |frame: &Frame| {
        // Newton's method for the foot on the exact curve.
        let mut s = frame.path_s;
        for _ in 0..4 {
            let jet = path.jet(s);
            s -= (jet.position - frame.position).dot(&jet.d1);
        }
        s
    };
    let at_feed = |frame: &Frame| (frame.path_v / feed_v - 1.0).abs() < 5e-5;
    let steps: Vec<f64> = frames
        .windows(4)
        .filter(|around| around.iter().all(at_feed))
        .map(|around| (s_of(&around[2]) - s_of(&around[1])) / (feed_v * period_t))
        .collect();
    assert!(steps.len() > 100, "{} steps at the feed", steps.len());
    let differences = steps.iter().map(|step| (step - 1.0).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn the_butterfly_on_a_mill_is_near_the_optimum_of_the_exact_curve() {
    let path = curves::path("butterfly");
    let items = items(&path, mill().tolerance_mm, 100.0);
    for effort in [Effort::Fast, Effort::Optimal] {
        let (_, report) = plan(&items, Settings { effort, ..mill() });
        assert_clean(&report);
        // The optimum by a solver of its own, with limits by axis: 4.6025 s.
        let cycle_t = report.cycle_time_s;
        assert!(cycle_t <= 1.02 * 4.6025, "{effort:?} {cycle_t}");
    }
}

fn mill() -> Settings {
    Settings {
        smoothing: Smoothing::Auto,
        ..support::mill()
    }
}

#[test]
fn a_long_curve_is_planned_in_windows_and_hardly_slower() {
    let path = curves::path("butterfly");
    // More than a minute.
    let items = items(&path, mill().tolerance_mm, 5.0);
    let (_, report) = plan(&items, mill());
    assert_clean(&report);
    let (cycle_t, least_t) = (report.cycle_time_s, path.length() / 5.0);
    assert!(cycle_t < 1.005 * least_t, "{cycle_t} for {least_t}");
}

fn item(segment: Segment, feed_v: f64) -> Item {
    Item {
        block: 0,
        line: 1,
        kind: ItemKind::Move {
            segment,
            rate: Rate::Feed(feed_v),
            mode: support::FREE,
        },
    }
}

#[test]
fn a_curve_is_entered_and_left_at_speed_where_it_is_tangent() {
    let points = [[0.0, 0.0], [10.0, 0.0], [20.0, 10.0], [20.0, 20.0]];
    let points = points.map(|[x, y]| support::at(x, y));
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let curve = Nurbs::new(3, &points, &[1.0; 4], &knots).expect("valid");
    let curve = NurbsPath::new(curve);
    let line = |from: [f64; 2], to: [f64; 2]| {
        let [from, to] = [from, to].map(|[x, y]| support::at(x, y));
        item(Segment::line(from, to), 50.0)
    };
    let mut program = vec![line([-20.0, 0.0], [0.0, 0.0])];
    program.extend(items(&curve, mill().tolerance_mm, 50.0));
    program.push(line([20.0, 20.0], [20.0, 40.0]));
    program.push(line([20.0, 40.0], [40.0, 40.0]));
    for effort in [Effort::Fast, Effort::Optimal] {
        let (frames, report) = plan(&program, Settings { effort, ..mill() });
        assert_clean(&report);
        let near_v = |x: f64, y: f64| {
            let gap = |frame: &Frame| (frame.position - support::at(x, y)).norm();
            let nearest = frames.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
            nearest.expect("frames").path_v
        };
        // Tangent, but for a step of curvature.
        let [entry_v, exit_v] = [near_v(0.0, 0.0), near_v(20.0, 20.0)];
        assert!(
            entry_v > 15.0 && exit_v > 15.0,
            "{effort:?} {entry_v} {exit_v}"
        );
    }
}

#[test]
fn an_override_on_a_curve_keeps_all_limits() {
    let path = curves::path("star");
    let settings = sheet(0.004);
    for (feed_r, most_r) in [(0.5, 1.0), (1.8, 1.8)] {
        let mut planner = Planner::new(settings, path.jet(0.0).position);
        let mut audit = audit(&settings).with_override(most_r);
        for item in items(&path, settings.tolerance_mm, 60.0) {
            planner.push(&item).expect("valid");
            audit.program(&item);
        }
        planner.finish();
        let mut count = 0;
        while let Some(frame) = planner.pop_frame().expect("motion") {
            audit.sample_at(&(&frame).into(), frame.path_s);
            count += 1;
            if count == 200 {
                let rapid_r = 1.0;
                let wanted = Override { feed_r, rapid_r };
                planner.set_override(wanted).expect("valid");
            }
        }
        assert_clean(&audit.finish());
    }
}

/// A curve of degree 1 to 5 in space: a point, a weight and a gap between knots each.
fn any_curve() -> impl Strategy<Value = NurbsPath> {
    let part = (
        prop::array::uniform3(-60.0..60.0_f64),
        prop_oneof![Just(1.0), 0.3..3.0_f64],
        0.02..1.0_f64,
    );
    (1..=5_usize, prop::collection::vec(part, 6..16)).prop_map(|(degree, parts)| {
        let over_axes = |p: &[f64; 3]| {
            let mut point = support::at(p[0], p[1]);
            point[2] = p[2];
            point
        };
        let points: Vec<_> = parts.iter().map(|part| over_axes(&part.0)).collect();
        let weights: Vec<f64> = parts.iter().map(|part| part.1).collect();
        let mut knots = vec![0.0; degree];
        let mut last = 0.0;
        for part in &parts[degree..] {
            knots.push(last);
            last += part.2;
        }
        knots.extend(vec![last; degree + 1]);
        NurbsPath::new(Nurbs::new(degree, &points, &weights, &knots).expect("valid"))
    })
}

proptest! {
    #![proptest_config(support::cases(20))]

    #[test]
    fn random_curves_are_followed_within_all_limits(path in any_curve(), bounded in any::<bool>()) {
        let settings = if bounded { sheet(0.004) } else { mill() };
        let (_, report) = plan(&items(&path, settings.tolerance_mm, 100.0), settings);
        prop_assert!(report.is_clean() && report.is_complete, "{:?}", report.violations);
    }
}
