//! Rows that keep the speeds of joints, where joints are not the axes.
//!
//! A joint's velocity is a row of the mechanism's Jacobian times that of the axes, so where the
//! motion is known roughly, its limit is linear in the control points, like the feed. Along the
//! pieces the rates keep it already; round a corner the motion goes in other directions, and swings
//! beyond both.

use super::solver::{Problem, dot};
use super::tube::Layout;

/// Share of a joint's speed that is planned with: what a Jacobian changes by while a difference has a
/// part in the motion is left.
const JOINT_R: f64 = 0.99;
/// Share of it from which on the last motion gets a row: rows of joints couple all axes, so those far from
/// their limits are left out. With more, one that is passed in the next round has no row yet.
const CLOSE_R: f64 = 0.5;

/// Adds rows for every first difference that is not given.
pub(super) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>) {
    for k in 2..problem.intervals {
        add_at(problem, layout, k);
    }
}

/// Rows for the first difference from control point `k` on: a site of its own.
fn add_at<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>, k: usize) {
    let (points, h) = (layout.points, layout.style.grid.knot_t);
    // A row is the gradient of a joint's velocity over its limit, J·ẋ/q̇_max, by ẋ. What J itself changes
    // by x is left out: it is taken anew at the last motion in each round, and what that misses within
    // one is what JOINT_R leaves.
    let step: [f64; D] = core::array::from_fn(|a| points[k + 1][a] - points[k][a]);
    let middle: [f64; D] = core::array::from_fn(|a| points[k][a] + 0.5 * step[a]);
    let rows = layout.path.joint_rows(&middle);
    let close = rows.into_iter().map(|row| row.map(|part| part / h));
    let mut close = close
        .filter(|row| dot(row, &step).abs() > CLOSE_R)
        .peekable();
    if close.peek().is_some() {
        problem.add_site(k, [-1.0, 1.0, 0.0, 0.0]);
        for row in close {
            problem.add_feed_row(row, [-JOINT_R, JOINT_R], layout.style.is_feed_firm);
        }
    }
}
