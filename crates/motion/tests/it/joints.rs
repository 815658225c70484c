//! Tests of joints that are not the axes, imitated: what a window takes no notice of by itself.

#![allow(clippy::expect_used, reason = "tests")]

use super::support::{FREE, at, optimal};
use glidepath_geometry::{AXES, AxisVector, Jet, Segment};
use glidepath_motion::{Joints, JointsOnCurve, Planner};
use glidepath_program::{Item, ItemKind, Limits, Rate, Settings};
use std::sync::Arc;

/// A joint that is the X axis, and slower.
#[derive(Debug)]
struct SlowX {
    velocity_v: f64,
}

impl Joints for SlowX {
    fn at(&self, curve: &[AxisVector; 4]) -> Option<JointsOnCurve> {
        let mut jacobian = [[AxisVector::zeros(); AXES]; 4];
        jacobian[0][0][0] = 1.0;
        Some(JointsOnCurve {
            derivatives: curve.map(|of_axes| at(of_axes[0], 0.0)),
            jacobian,
        })
    }

    fn allow(&self, positions: &[AxisVector; 4], period_t: f64) -> bool {
        let step = positions[0][0] - positions[1][0];
        step.abs() <= self.velocity_v * period_t * (1.0 + 1e-6)
    }

    fn along(&self, path: &Jet) -> Option<Jet> {
        let only_x = |of: &AxisVector| at(of[0], 0.0);
        Some(Jet {
            position: only_x(&path.position),
            d1: only_x(&path.d1),
            d2: only_x(&path.d2),
            d3: only_x(&path.d3),
        })
    }

    fn limits(&self) -> [AxisVector; 3] {
        let mut velocity = AxisVector::repeat(Limits::UNLIMITED);
        velocity[0] = self.velocity_v;
        let free = AxisVector::repeat(Limits::UNLIMITED);
        [velocity, free, free]
    }
}

/// A joint that can never follow.
#[derive(Debug)]
struct Stuck;

impl Joints for Stuck {
    fn at(&self, _: &[AxisVector; 4]) -> Option<JointsOnCurve> {
        None
    }

    fn allow(&self, _: &[AxisVector; 4], _: f64) -> bool {
        false
    }

    fn along(&self, _: &Jet) -> Option<Jet> {
        None
    }

    fn limits(&self) -> [AxisVector; 3] {
        [AxisVector::repeat(Limits::UNLIMITED); 3]
    }
}

/// A wave of lines of 2 mm, 25° up and down, at 8 mm/s.
fn wave() -> Vec<Item> {
    let (sin, cos) = 25.0_f64.to_radians().sin_cos();
    let vertex = |k: u32| at(2.0 * cos * f64::from(k), 2.0 * sin * f64::from(k % 2));
    let lines = (0..20).map(|k| ItemKind::Move {
        segment: Segment::line(vertex(k), vertex(k + 1)),
        rate: Rate::Feed(8.0),
        mode: FREE,
    });
    let numbered = (1..).zip(lines);
    numbered
        .map(|(line, kind)| Item {
            block: line,
            line,
            kind,
        })
        .collect()
}

/// Positions at all periods.
fn planned(settings: Settings, joints: Option<Arc<dyn Joints>>, items: &[Item]) -> Vec<AxisVector> {
    let mut planner = Planner::new(settings, AxisVector::zeros());
    if let Some(joints) = joints {
        planner = planner.with_joints(joints);
    }
    for item in items {
        planner.push(item).expect("a wave");
    }
    planner.finish();
    let mut positions = Vec::new();
    while planner.make_frame().expect("a plan") {
        positions.push(planner.frame().position);
    }
    positions
}

/// Largest speed of X, mm/s.
fn fastest_v(positions: &[AxisVector], period_t: f64) -> f64 {
    let steps = positions.windows(2).map(|pair| pair[1][0] - pair[0][0]);
    steps.fold(0.0, |most: f64, step| most.max(step.abs() / period_t))
}

#[test]
fn where_a_corner_is_rounded_joints_keep_their_speed_too() {
    // Along the lines X has 7.25 mm/s; over their tops it could have all of the feed.
    let joint_v = 7.4;
    let items = wave();
    let settings = optimal();
    let free = planned(settings, None, &items);
    assert!(fastest_v(&free, settings.period_t) > 1.01 * joint_v);
    let slow = Arc::new(SlowX {
        velocity_v: joint_v,
    });
    let kept = planned(settings, Some(slow), &items);
    assert!(fastest_v(&kept, settings.period_t) <= joint_v * (1.0 + 1e-6));
    // All of it may be lost where the joint binds, and nothing else.
    let most = 8.0 / joint_v;
    assert!(
        (kept.len() as f64) < most * free.len() as f64,
        "{} of {}",
        kept.len(),
        free.len()
    );
}

#[test]
fn what_joints_cannot_follow_is_not_driven_round_a_corner() {
    let items = wave();
    let settings = optimal();
    let stuck = planned(settings, Some(Arc::new(Stuck)), &items);
    // No window is taken, so the motion rests at every vertex.
    let rests = |vertex: AxisVector| {
        let near = |position: &&AxisVector| (**position - vertex).amax() < 1e-3;
        stuck.iter().filter(near).count() > 1
    };
    for item in &items {
        if let ItemKind::Move { segment, .. } = item.kind {
            assert!(rests(segment.end()), "line {}", item.line);
        }
    }
}
