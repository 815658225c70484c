//! Tests of limits: every planned motion keeps every axis' limits and the tolerance, in the eyes of
//! the auditor.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::support::cases;
use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample};
use glidepath_geometry::{AXES, Arc, AxisVector, Plane, Segment};
use glidepath_motion::Planner;
use glidepath_program::{
    Effort, Frame, Item, ItemKind, Limits, PathBounds, PathMode, Rate, Settings, Smoothing, Travel,
};
use proptest::prelude::*;

/// One random step of a program.
#[derive(Debug, Clone)]
enum Step {
    Line {
        step: [f64; AXES],
        feed_v: Option<f64>,
        mode: PathMode,
    },
    /// Centre relative to the start, in the plane; sweep; rise.
    Arc {
        plane: Plane,
        center: [f64; 2],
        sweep_rad: f64,
        rise_mm: f64,
        feed_v: f64,
    },
    /// A half turn continued by a tangent line.
    Slot {
        radius_mm: f64,
        sweep_rad: f64,
        tail_mm: f64,
        feed_v: f64,
    },
    Dwell(f64),
}

fn settings(limits: Limits, tolerance_mm: f64, smoothing: Smoothing, period_t: f64) -> Settings {
    Settings {
        limits,
        tolerance_mm,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing,
        corners: glidepath_program::Corners::default(),
        period_t,
        effort: Effort::Fast,
    }
}

fn items(steps: &[Step]) -> Vec<Item> {
    let mut items = Vec::new();
    let mut at = AxisVector::zeros();
    let free = PathMode::Continuous { tolerance_mm: None };
    let mut push = |kind| {
        let line = u32::try_from(items.len()).expect("few items") + 1;
        items.push(Item {
            block: 0,
            line,
            kind,
        });
    };
    for step in steps {
        match step {
            Step::Line { step, feed_v, mode } => {
                let end = at + AxisVector::from_column_slice(step);
                let rate = feed_v.map_or(Rate::Rapid, Rate::Feed);
                push(ItemKind::Move {
                    segment: Segment::line(at, end),
                    rate,
                    mode: *mode,
                });
                at = end;
            }
            Step::Arc {
                plane,
                center,
                sweep_rad,
                rise_mm,
                feed_v,
            } => {
                let arc = arc(at, *plane, *center, *sweep_rad, *rise_mm);
                let rate = Rate::Feed(*feed_v);
                push(ItemKind::Move {
                    segment: Segment::Arc(arc),
                    rate,
                    mode: free,
                });
                at = arc.end;
            }
            Step::Slot {
                radius_mm,
                sweep_rad,
                tail_mm,
                feed_v,
            } => {
                let arc = arc(at, Plane::Xy, [0.0, *radius_mm], *sweep_rad, 0.0);
                let rate = Rate::Feed(*feed_v);
                push(ItemKind::Move {
                    segment: Segment::Arc(arc),
                    rate,
                    mode: free,
                });
                let tangent = arc.jet(arc.length()).d1;
                let end = arc.end + tangent * *tail_mm;
                push(ItemKind::Move {
                    segment: Segment::line(arc.end, end),
                    rate,
                    mode: free,
                });
                at = end;
            }
            Step::Dwell(dwell_t) => push(ItemKind::Dwell(*dwell_t)),
        }
    }
    items
}

fn arc(start: AxisVector, plane: Plane, center: [f64; 2], sweep_rad: f64, rise_mm: f64) -> Arc {
    let (first, second) = plane.axes();
    let (first, second) = (first.index(), second.index());
    let center_at = [start[first] + center[0], start[second] + center[1]];
    let (sin, cos) = sweep_rad.sin_cos();
    let mut end = start;
    end[first] = center_at[0] - center[0] * cos + center[1] * sin;
    end[second] = center_at[1] - center[0] * sin - center[1] * cos;
    end[plane.normal().index()] += rise_mm;
    Arc {
        start,
        end,
        plane,
        center: center_at,
        sweep_rad,
    }
}

/// Takes all frames there are; a motion that crawls is a fault, not a matter of patience.
fn take(planner: &mut Planner, frames: &mut Vec<Frame>) {
    while let Some(frame) = planner.pop_frame().expect("a motion") {
        frames.push(frame);
        assert!(frames.len() < 1_000_000, "the motion crawls: {frame:?}");
    }
}

fn plan(items: &[Item], settings: Settings) -> Vec<Frame> {
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let mut frames = Vec::new();
    for item in items {
        planner.push(item).expect("valid item");
        take(&mut planner, &mut frames);
    }
    planner.finish();
    take(&mut planner, &mut frames);
    frames
}

/// What the auditor finds in the frames.
fn audit(items: &[Item], frames: &[Frame], settings: &Settings) -> AuditReport {
    let mut audit = Audit::new(&AuditSettings::from(settings));
    for item in items {
        audit.program(item);
    }
    for frame in frames {
        audit.sample(&Sample::from(frame));
    }
    audit.finish()
}

fn any_mode() -> impl Strategy<Value = PathMode> {
    prop_oneof![
        6 => Just(PathMode::Continuous { tolerance_mm: None }),
        2 => (-3.0..0.0_f64).prop_map(|p| PathMode::Continuous { tolerance_mm: Some(10_f64.powf(p)) }),
        1 => Just(PathMode::ExactStop),
        1 => Just(PathMode::ExactPath),
    ]
}

fn any_feed() -> impl Strategy<Value = f64> {
    (0.7..2.3_f64).prop_map(|x| 10_f64.powf(x))
}

fn any_step() -> impl Strategy<Value = Step> {
    let length = (-2.0..1.3_f64).prop_map(|x| 10_f64.powf(x));
    let axes = prop_oneof![
        Just([true, true, false, false, false, false, false, false, false]),
        Just([true, true, true, false, false, false, false, false, false]),
        Just([true, true, true, true, false, true, false, false, false]),
        Just([false, false, false, true, false, true, false, false, false]),
        Just([true, true, false, false, false, false, true, true, false]),
        Just([true; AXES]),
    ];
    let line = (
        prop::array::uniform9(-1.0..1.0_f64),
        axes,
        length,
        prop::option::weighted(0.9, any_feed()),
        any_mode(),
    )
        .prop_map(|(direction, axes, length, feed_v, mode)| {
            let mut step = [0.0; AXES];
            for i in 0..AXES {
                step[i] = if axes[i] { direction[i] * length } else { 0.0 };
            }
            Step::Line { step, feed_v, mode }
        });
    let plane = prop_oneof![Just(Plane::Xy), Just(Plane::Zx), Just(Plane::Yz)];
    let radius = (-1.5..1.0_f64).prop_map(|x| 10_f64.powf(x));
    let arc = (
        plane,
        radius.clone(),
        0.0..core::f64::consts::TAU,
        -13.0..13.0_f64,
        -2.0..2.0_f64,
        any_feed(),
    )
        .prop_map(
            |(plane, radius, direction, sweep_rad, rise_mm, feed_v)| Step::Arc {
                plane,
                center: [radius * direction.cos(), radius * direction.sin()],
                sweep_rad: if sweep_rad.abs() < 0.01 {
                    1.0
                } else {
                    sweep_rad
                },
                rise_mm,
                feed_v,
            },
        );
    let slot = (radius, 0.2..4.0_f64, 0.01..5.0_f64, any_feed()).prop_map(
        |(radius_mm, sweep_rad, tail_mm, feed_v)| Step::Slot {
            radius_mm,
            sweep_rad,
            tail_mm,
            feed_v,
        },
    );
    prop_oneof![8 => line, 2 => arc, 1 => slot, 1 => (0.0..0.05_f64).prop_map(Step::Dwell)]
}

fn any_limits() -> impl Strategy<Value = Limits> {
    prop_oneof![
        Just(Limits::uniform(200.0, 2000.0, 40_000.0)),
        Just(Limits::uniform(100.0, 10_000.0, 1e6)),
        prop::array::uniform9(0.0..1.0_f64).prop_map(|x| {
            let per_axis = |base: f64| AxisVector::from_fn(|i, _| base * 10_f64.powf(x[i] - 0.5));
            Limits {
                velocity: per_axis(150.0),
                acceleration: per_axis(2000.0),
                jerk: per_axis(60_000.0),
                path: PathBounds::NONE,
                travel: Travel::unlimited(),
            }
        }),
    ]
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn random_programs_keep_the_limits_and_reach_their_end(
        steps in prop::collection::vec(any_step(), 1..25),
        limits in any_limits(),
        pair in any::<bool>(),
        period_t in prop_oneof![Just(0.004), Just(0.001)],
    ) {
        let smoothing = if pair { Smoothing::BezierPair } else { Smoothing::Sextic };
        keeps_limits(&steps, &settings(limits, 0.02, smoothing, period_t))?;
    }
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn random_programs_planned_optimally_keep_the_limits_and_reach_their_end(
        steps in prop::collection::vec(any_step(), 1..12),
        limits in any_limits(),
        period_t in prop_oneof![Just(0.004), Just(0.001)],
    ) {
        let settings = Settings {
            effort: Effort::Optimal,
            ..settings(limits, 0.02, Smoothing::Auto, period_t)
        };
        keeps_limits(&steps, &settings)?;
    }
}

fn keeps_limits(steps: &[Step], settings: &Settings) -> Result<(), TestCaseError> {
    let items = items(steps);
    let frames = plan(&items, *settings);
    let report = audit(&items, &frames, settings);
    prop_assert!(report.is_clean(), "{:#?}", report);
    let end = items.iter().rev().find_map(|item| match item.kind {
        ItemKind::Move { segment, .. } => Some(segment.end()),
        _ => None,
    });
    let last = frames.last().expect("frames").position;
    prop_assert!(
        (last - end.unwrap_or_default()).amax() <= 1e-9,
        "ends at {last}"
    );
    Ok(())
}

/// A leg that a window leaves beside the last move, which turns A and C, has a little way back in
/// XYZ.
#[test]
fn rotary_moves_keep_their_feed_beside_the_path() {
    let line = |xyz: [f64; 3], ac: [f64; 2], uv: [f64; 2], feed_v| Step::Line {
        step: [xyz[0], xyz[1], xyz[2], ac[0], 0.0, ac[1], uv[0], uv[1], 0.0],
        feed_v: Some(feed_v),
        mode: PathMode::Continuous { tolerance_mm: None },
    };
    let (none, still) = ([0.0; 2], [0.0; 3]);
    let first = [
        -0.573_609_915_453_666_7,
        -0.515_821_482_900_072_8,
        0.776_259_895_080_488_8,
    ];
    let turn = [-0.099_325_534_402_875_37, -0.346_075_896_664_517_1];
    let second = [0.156_121_449_716_230_24, 0.050_678_367_480_935_065, 0.0];
    let aside = [-0.155_618_826_907_270_9, -0.194_812_206_837_571_06];
    let third = [
        0.059_893_836_378_403_92,
        -0.021_102_088_002_728_32,
        -0.059_197_878_513_611_9,
    ];
    let last = [-2.294_686_382_025_161_3, 5.190_878_525_056_154];
    let steps = [
        line(first, turn, none, 20.936_199_626_763_187),
        line(second, none, aside, 140.360_791_085_039_55),
        line(third, none, none, 168.292_528_983_540_45),
        line(still, last, none, 37.639_001_668_288_2),
    ];
    let settings = Settings {
        effort: Effort::Optimal,
        ..settings(
            Limits::uniform(100.0, 10_000.0, 1e6),
            0.02,
            Smoothing::Auto,
            0.001,
        )
    };
    keeps_limits(&steps, &settings).unwrap();
}
