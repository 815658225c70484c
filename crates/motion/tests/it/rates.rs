//! Where a feed move is, the motion keeps its feed, however wide the tolerance is and however fast the moves
//! before and behind are.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use crate::planned::{numbered, plan};
use crate::support::cases;
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::{
    Effort, Frame, Item, ItemKind, Limits, PathMode, Rate, Settings, Smoothing,
};
use proptest::prelude::*;

/// A mill, and a fast light machine.
const MACHINES: [[f64; 3]; 2] = [[200.0, 2000.0, 40_000.0], [100.0, 10_000.0, 1e6]];

/// One move of a program: to where, relative to its start; on an arc about the middle between both; its feed,
/// mm/s, or none for a rapid.
#[derive(Debug, Clone, Copy)]
struct Step {
    by: [f64; 3],
    is_arc: bool,
    feed_v: Option<f64>,
    tolerance_mm: f64,
}

const fn line(by: [f64; 3], feed_v: Option<f64>, tolerance_mm: f64) -> Step {
    Step {
        by,
        is_arc: false,
        feed_v,
        tolerance_mm,
    }
}

fn program(steps: &[Step]) -> Vec<Item> {
    let mut at = AxisVector::zeros();
    let moves = steps.iter().map(|step| {
        let mut end = at;
        for (axis, by) in step.by.into_iter().enumerate() {
            end[axis] += by;
        }
        let segment = if step.is_arc {
            Segment::Arc(Arc {
                start: at,
                end,
                plane: Plane::Xy,
                center: [0.5 * (at[0] + end[0]), 0.5 * (at[1] + end[1])],
                sweep_rad: core::f64::consts::PI,
            })
        } else {
            Segment::line(at, end)
        };
        at = end;
        ItemKind::Move {
            segment,
            rate: step.feed_v.map_or(Rate::Rapid, Rate::Feed),
            mode: PathMode::Continuous {
                tolerance_mm: Some(step.tolerance_mm),
            },
        }
    });
    numbered(moves.collect())
}

fn settings([velocity, acceleration, jerk]: [f64; 3], effort: Effort) -> Settings {
    Settings {
        limits: Limits::uniform(velocity, acceleration, jerk),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort,
    }
}

/// What the auditor finds, fed with the program as the planner is, and the motion.
fn driven(steps: &[Step], settings: Settings) -> (AuditReport, Vec<Frame>) {
    let items = program(steps);
    let frames = plan(&items, settings, usize::MAX);
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    items.iter().for_each(|item| audit.program(item));
    frames.iter().for_each(|frame| audit.frame(frame));
    (audit.finish(), frames)
}

/// The reports on both machines, with either effort.
fn reports(steps: &[Step]) -> impl Iterator<Item = (String, AuditReport)> {
    let all =
        MACHINES.map(|machine| [Effort::Fast, Effort::Optimal].map(|effort| (machine, effort)));
    all.into_iter().flatten().map(move |(machine, effort)| {
        let (report, _) = driven(steps, settings(machine, effort));
        (format!("{effort:?}, {machine:?}"), report)
    })
}

const RAPID: Option<f64> = None;
const F1000: Option<f64> = Some(1000.0 / 60.0);
const F100: Option<f64> = Some(100.0 / 60.0);

#[test]
fn a_rapid_is_over_where_the_cut_begins() {
    let programs = [
        vec![
            line([1.0, 0.0, 0.0], RAPID, 5.0),
            line([2.0, 3.0, 0.0], F1000, 5.0),
        ],
        // There and back: the end is within the tolerance of the rapid.
        vec![
            line([-0.09, 1.56, 0.0], RAPID, 2.0),
            line([2.64, 1.32, 0.0], F1000, 2.0),
            line([-0.92, -1.29, 0.0], F1000, 2.0),
        ],
        vec![
            line([2.67, 2.43, 1.0], F1000, 1.0),
            line([-1.19, -0.05, 0.0], RAPID, 1.0),
        ],
        // Straight on, round a corner, down into the work.
        vec![
            line([60.0, 0.0, 0.0], RAPID, 5.0),
            line([12.0, 0.0, 0.0], F100, 5.0),
        ],
        vec![
            line([60.0, 0.0, 0.0], RAPID, 5.0),
            line([0.0, 12.0, 0.0], F100, 5.0),
        ],
        vec![
            line([30.0, 20.0, 0.0], RAPID, 1.0),
            line([0.0, 0.0, -40.0], RAPID, 1.0),
            line([0.0, 0.0, -5.0], F100, 1.0),
            line([20.0, 0.0, 0.0], F1000, 1.0),
        ],
        // A slower cut behind a faster one.
        vec![
            line([30.0, 0.0, 0.0], Some(80.0), 3.0),
            line([5.0, 1.0, 0.0], F100, 3.0),
        ],
    ];
    for steps in programs {
        for (name, report) in reports(&steps) {
            assert!(report.is_clean(), "{steps:?}, {name}: {report:#?}");
        }
    }
}

/// Measured on the frames alone: 0.1 mm into a cut along an axis its feed is kept.
#[test]
fn the_feed_holds_a_tenth_of_a_millimetre_into_the_cut() {
    for tolerance_mm in [0.05, 0.3, 5.0] {
        let steps = [
            line([100.0, 0.0, 0.0], RAPID, tolerance_mm),
            line([30.0, 0.0, 0.0], F100, tolerance_mm),
        ];
        for effort in [Effort::Fast, Effort::Optimal] {
            let settings = settings(MACHINES[0], effort);
            let (_, frames) = driven(&steps, settings);
            let cut = frames.windows(2).filter(|ends| ends[0].position[0] > 100.1);
            let fastest_v = cut.fold(0.0_f64, |most, ends| {
                most.max((ends[1].position[0] - ends[0].position[0]) / settings.period_t)
            });
            assert!(
                fastest_v < 1.001 * 100.0 / 60.0,
                "{effort:?}, {tolerance_mm} mm: {fastest_v} mm/s"
            );
        }
    }
}

fn any_step() -> impl Strategy<Value = Step> {
    let size_mm = (-1.3..1.3_f64).prop_map(|x| 10_f64.powf(x));
    let tolerance_mm = prop_oneof![
        1 => Just(0.02),
        4 => (-1.3..0.8_f64).prop_map(|x| 10_f64.powf(x)),
    ];
    let feed_v = (-0.2..2.2_f64).prop_map(|x| 10_f64.powf(x));
    (
        prop::array::uniform3(-1.0..1.0_f64),
        size_mm,
        0..8_u8,
        prop::option::weighted(0.6, feed_v),
        tolerance_mm,
    )
        .prop_map(|(direction, size_mm, kind, feed_v, tolerance_mm)| {
            let [x, y, z] = direction.map(|x| x * size_mm);
            let is_arc = kind == 0 && feed_v.is_some();
            let by = match kind {
                0..=2 => [x, y, 0.0],
                3 => [x, 0.0, 0.0],
                4 => [0.0, 0.0, z],
                _ => [x, y, z],
            };
            Step {
                by,
                is_arc,
                feed_v,
                tolerance_mm,
            }
        })
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn feeds_are_kept_between_rapids_in_wide_tubes(
        steps in prop::collection::vec(any_step(), 2..7),
        same_tolerance in any::<bool>(),
    ) {
        let mut steps = steps;
        if same_tolerance {
            let tolerance_mm = steps[0].tolerance_mm;
            steps.iter_mut().for_each(|step| step.tolerance_mm = tolerance_mm);
        }
        for (name, report) in reports(&steps) {
            prop_assert!(report.is_clean(), "{name}: {report:#?}");
        }
    }
}
