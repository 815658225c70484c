//! The planner, judged by the auditor.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small counts drawn at random"
)]

mod bench;
mod calls;
mod extremes;
mod inner;

use super::state::ActiveMotion;
use super::*;
use crate::in_tube::SearchBias;
use crate::in_tube::path::{Reference, Straightness};
use crate::in_tube::period::Period;
use crate::in_tube::window::PLAN_WORK;
use crate::programmed_rate::PieceRate;
use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Corners, Item, ItemKind, Limits, PathMode, Rate};
use proptest::prelude::{ProptestConfig, proptest};

/// A path with everything needed to plan and to judge it.
#[derive(Clone)]
struct Case {
    limits: Limits,
    period_t: f64,
    tolerance_mm: f64,
    feed_v: f64,
    corners: Corners,
    straight_mm: Option<f64>,
    beyond_mm: f64,
    points: Vec<AxisVector>,
}

impl Case {
    fn mill(points: Vec<AxisVector>) -> Self {
        Self {
            limits: Limits::uniform(200.0, 2000.0, 40_000.0),
            period_t: 0.004,
            tolerance_mm: 0.02,
            feed_v: 100.0,
            corners: Corners::default(),
            straight_mm: None,
            beyond_mm: 2e-4,
            points,
        }
    }

    fn references(&self) -> Vec<Reference> {
        let moves = self.points.windows(2).enumerate();
        moves
            .map(|(k, ends)| {
                let _ = ends[0];
                Reference {
                    end: ends[1],
                    rate: PieceRate::by_feed(self.feed_v),
                    tolerance_mm: self.tolerance_mm,
                    tolerance_deg: self.tolerance_mm,
                    sagitta_vector: AxisVector::zeros(),
                    straight: self.straight_mm.map(Straightness::of_move),
                    beyond_mm: self.beyond_mm,
                    is_rapid: false,
                    tag: k as u64,
                }
            })
            .collect()
    }

    fn planner(&self) -> TubePlanner {
        TubePlanner::new(
            &self.limits,
            self.period_t,
            self.points[0],
            SearchBias::USUAL,
        )
        .with_corners(self.corners)
    }

    fn plan(&self) -> Vec<Period> {
        let mut planner = self.planner();
        for reference in self.references() {
            planner.push(reference);
        }
        planner.finish();
        let mut periods = Vec::new();
        let mut work = 0;
        while let Some(period) = planner.next_period() {
            let spent = planner.state.optimisers.work() - work;
            assert!(
                spent <= PLAN_WORK,
                "{spent} before period {}",
                periods.len()
            );
            work += spent;
            periods.push(period);
        }
        assert!(planner.is_over());
        periods
    }

    fn items(&self) -> impl Iterator<Item = Item> {
        let moves = (1..).zip(self.points.windows(2));
        moves.map(|(line, ends)| Item {
            block: 0,
            line,
            kind: ItemKind::Move {
                segment: Segment::line(ends[0], ends[1]),
                rate: Rate::Feed(self.feed_v),
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        })
    }

    fn audit(&self, periods: &[Period]) -> AuditReport {
        let mut audit = Audit::new(&AuditSettings {
            limits: self.limits,
            period_t: self.period_t,
            tolerance_mm: self.tolerance_mm,
            direction: glidepath_program::DirectionTolerance::default(),
            corners: self.corners,
        });
        for item in self.items() {
            audit.program(&item);
        }
        let zero = AxisVector::zeros();
        let start = (self.points[0], 1, [zero, zero]);
        let moving = periods
            .iter()
            .map(|p| (p.position, p.tag as u32 + 1, [p.velocity, p.acceleration]));
        for (tick, (position, line, reported)) in (0..).zip(core::iter::once(start).chain(moving)) {
            audit.sample(&Sample {
                tick,
                line,
                position,
                reported: Some(reported),
                is_between_frames: false,
            });
        }
        audit.finish()
    }
}

fn plane(points: &[(f64, f64)]) -> Vec<AxisVector> {
    points
        .iter()
        .map(|&(x, y)| {
            let mut point = AxisVector::zeros();
            (point[0], point[1]) = (x, y);
            point
        })
        .collect()
}

fn square() -> Vec<AxisVector> {
    plane(&[
        (0.0, 0.0),
        (20.0, 0.0),
        (20.0, 20.0),
        (0.0, 20.0),
        (0.0, 0.0),
    ])
}

#[test]
fn a_square_is_driven_to_its_end_within_everything() {
    let case = Case::mill(square());
    let periods = case.plan();
    let report = case.audit(&periods);
    assert!(report.is_clean() && report.is_complete, "{report:?}");
    assert!(
        periods
            .last()
            .is_some_and(|last| last.rest_at_end && last.position == case.points[4])
    );
}

/// A path of every kind of corner, drawn from a seed: any angle, exact reversals, nearly straight
/// vertices, repeated points, two to six axes with limits of their own.
fn random_case(seed: u64, is_light: bool) -> Case {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5851_F42D_4C95_7F2D;
    let mut draw = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let axes = [
        vec![0, 1],
        vec![0, 1, 2],
        vec![0, 1, 3],
        vec![0, 1, 2, 3, 5],
        vec![0, 1, 2, 6, 7, 8],
    ][(draw() * 5.0) as usize]
        .clone();
    let class = (draw() * 5.0) as usize;
    let mut limits = if is_light {
        Limits::uniform(100.0, 10_000.0, 1e6)
    } else {
        Limits::uniform(200.0, 2000.0, 40_000.0)
    };
    if draw() < 0.5 {
        for i in 0..9 {
            limits.velocity[i] *= 0.3 + 0.7 * draw();
            limits.acceleration[i] *= 0.3 + 0.7 * draw();
            limits.jerk[i] *= 0.3 + 0.7 * draw();
        }
    }
    let mut points = vec![AxisVector::zeros()];
    let mut direction = AxisVector::zeros();
    direction[0] = 1.0;
    for _ in 0..3 + (draw() * 30.0) as usize {
        let length = match class {
            0 => 0.05 * 100.0_f64.powf(draw()),
            1 => 0.05 + 0.3 * draw(),
            2 if draw() < 0.5 => 0.05 + 0.1 * draw(),
            2 => 1.0 + 4.0 * draw(),
            3 => 0.5 + 4.5 * draw(),
            _ => 100.0_f64.powf(draw()),
        };
        let kind = draw();
        let mut next = direction;
        if kind < 0.06 {
            next = -direction;
        } else {
            let spread = if kind < 0.3 { 0.1 } else { 1e3 };
            for &i in &axes {
                next[i] += spread * (draw() - 0.5);
            }
        }
        direction = next / next.norm().max(1e-9);
        let last = points[points.len() - 1];
        points.push(last + direction * length);
        if kind > 0.97 {
            points.push(last + direction * length);
        }
    }
    Case {
        limits,
        period_t: 0.004,
        tolerance_mm: if is_light { 0.03 } else { 0.02 },
        corners: Corners::default(),
        straight_mm: None,
        beyond_mm: 2e-4,
        feed_v: if is_light { 83.333 } else { 100.0 },
        points,
    }
}

fn assert_clean(case: &Case, periods: &[Period]) {
    let report = case.audit(periods);
    assert!(
        report.is_clean() && report.is_complete,
        "{:?}",
        report.violations
    );
    assert!(periods.last().is_some_and(|last| last.rest_at_end));
}

/// A seeded sample for every run; `PROPTEST_CASES` sets how many for a long one.
fn cases(number: u32) -> ProptestConfig {
    let long = std::env::var_os("PROPTEST_CASES").is_some();
    ProptestConfig {
        cases: if long {
            ProptestConfig::default().cases
        } else {
            number
        },
        // A seed does not get simpler by getting smaller.
        max_shrink_iters: 0,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases(6))]
    #[test]
    fn any_path_is_driven_to_its_end_within_everything(seed: u64, is_light: bool) {
        let case = random_case(seed, is_light);
        let periods = case.plan();
        assert_clean(&case, &periods);
        let before_last_t = (periods.len() - 1) as f64 * case.period_t;
        assert!(before_last_t <= bench::exact_stop_t(&case) * (1.0 + 1e-9), "no slower than stopping");
    }
}
