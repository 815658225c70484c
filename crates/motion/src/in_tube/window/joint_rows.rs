//! Rows that keep velocity, acceleration and jerk of joints, where joints are not the axes.
//!
//! Along a curve of the axes a joint is a curve, too, and how it changes with a control point is known exactly
//! ([`crate::joints::JointsOnCurve`]):
//!
//! ```text
//!   ∂q⁽ʳ⁾/∂c = r! Σ_{i ≤ r} Jᵢ · B⁽ʳ⁻ⁱ⁾ / (r − i)!          q⁽ʳ⁾ of a joint, B of a control point c
//! ```
//!
//! with the Jacobian J along the last motion, the bends of the mechanism included. So a limit of a joint is a row
//! on the four control points of an interval, like that of an axis, but with a direction of its own for each.
//! What is left out is of second order in what the motion changes by from one round to the next, and is gone
//! where it changes no more.
//!
//! ```text
//!   knot ──────────── middle ──────────── knot        velocity and jerk in the middle of an interval,
//!    q̈                 q̇ q⃛                 q̈          acceleration at knots, where it has its peaks
//! ```

use super::solver::{FIRM_PRICE, PRICE, Problem, RowBounds, SPAN, WideRow, combine};
use super::spline::{basis, basis_1, basis_2};
use super::tube::Layout;
use crate::joints::JointsOnCurve;
use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::Limits;

/// Share of a joint's limits that is planned with: what a joint does between the places of its rows, and what
/// it changes by in the last round.
const JOINT_R: f64 = 0.998;
/// Share of a limit from which on the last motion gets a row: rows of joints couple all axes, so those far from
/// their limits are left out. With more, one that is passed in the next round has no row yet.
const CLOSE_R: f64 = 0.4;
const FACTORIAL: [f64; 4] = [1.0, 1.0, 2.0, 6.0];
/// Third derivative of the basis functions of an interval, by its parameter.
const BASIS_3: [f64; SPAN] = [-1.0, 3.0, -3.0, 1.0];

/// Adds rows for every interval that is not given.
pub(super) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>) {
    for k in 0..problem.intervals {
        add_at(problem, layout, (k, 0.5), &[1, 3]);
        if k > 0 {
            add_at(problem, layout, (k, 0.0), &[2]);
        }
    }
}

/// Rows of derivatives of some orders at a place 0…1 of interval `k`.
fn add_at<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    (k, u): (usize, f64),
    orders: &[usize],
) {
    let Some(joints) = layout.path.joints() else {
        return;
    };
    let bases = bases(u, layout.style.grid.knot_t);
    let curve = if layout.style.has_motion {
        along_motion(layout, k, &bases)
    } else {
        along_guess(layout, k, u)
    };
    let Some(here) = joints.at(&curve) else {
        return;
    };
    let limits = joints.limits();
    for &order in orders {
        for joint in 0..AXES {
            let limit = limits[order - 1][joint];
            let row = row(layout, (k, &bases), (&here, &curve), (joint, order), limit);
            let is_close = here.derivatives[order][joint].abs() > CLOSE_R * limit;
            if let Some(row) = row.filter(|_| is_close || !layout.style.has_motion) {
                problem.wide_rows.push(row);
            }
        }
    }
}

/// Basis functions of an interval and their derivatives by time, at a place of it.
fn bases(u: f64, h: f64) -> [[f64; SPAN]; 4] {
    let of_interval = [basis(u), basis_1(u), basis_2(u), BASIS_3];
    let mut per_t = 1.0;
    of_interval.map(|of_points| {
        let scaled = of_points.map(|value| value * per_t);
        per_t /= h;
        scaled
    })
}

/// The last motion at a place, and its derivatives by time, mm or degrees.
fn along_motion<const D: usize>(
    layout: &Layout<'_, D>,
    k: usize,
    bases: &[[f64; SPAN]; 4],
) -> [AxisVector; 4] {
    core::array::from_fn(|order| {
        let value = combine(layout.points, k, &bases[order]);
        if order == 0 {
            layout.path.outside(&value)
        } else {
            layout.path.outside_rate(&value)
        }
    })
}

/// Where samples are thought to be before there is a motion: along the piece of each, at a steady speed. What a
/// polygon has of acceleration in its corners, no motion will have.
fn along_guess<const D: usize>(layout: &Layout<'_, D>, k: usize, u: f64) -> [AxisVector; 4] {
    let Layout {
        path,
        samples,
        style,
        ..
    } = layout;
    let last = samples.progress.len() - 1;
    #[expect(clippy::cast_precision_loss, reason = "hundreds")]
    let period = (k as f64 + u) * style.grid.periods as f64 / style.grid.knots as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count of periods"
    )]
    let from = (period as usize).min(last.saturating_sub(1));
    #[expect(clippy::cast_precision_loss, reason = "hundreds")]
    let share = (period - from as f64).min(1.0);
    let step = samples.progress[last.min(from + 1)] - samples.progress[from];
    let progress = samples.progress[from] + share * step;
    let piece = samples.piece[last.min(from + 1)];
    let tangent = &path.segments[piece].tangent;
    let speed = step / style.period_t;
    let none = AxisVector::zeros();
    [
        path.outside(&path.position(piece, progress)),
        path.outside_rate(&tangent.map(|part| part * speed)),
        none,
        none,
    ]
}

/// The row of a derivative of a joint; `None` if it has no limit.
fn row<const D: usize>(
    layout: &Layout<'_, D>,
    (k, bases): (usize, &[[f64; SPAN]; 4]),
    (here, curve): (&JointsOnCurve, &[AxisVector; 4]),
    (joint, order): (usize, usize),
    limit: f64,
) -> Option<WideRow<D>> {
    if limit >= Limits::UNLIMITED {
        return None;
    }
    let mut parts = [[0.0; D]; SPAN];
    let mut rest = here.derivatives[order][joint];
    for i in 0..=order {
        let by_axes = &here.jacobian[i][joint];
        let factor = FACTORIAL[order] / FACTORIAL[order - i];
        rest -= factor * by_axes.dot(&curve[order - i]);
        let normal = layout.path.inside_row(by_axes);
        for (part, weight) in parts.iter_mut().zip(&bases[order - i]) {
            for a in 0..D {
                part[a] += factor * weight / limit * normal[a];
            }
        }
    }
    // Control points count from the origin of the window. Axes that do not move are there.
    let origin = &layout.path.origin;
    rest += FACTORIAL[order] * here.jacobian[order][joint].dot(origin);
    let rest = rest / limit;
    Some(WideRow {
        first: k,
        parts,
        bounds: RowBounds {
            low: -JOINT_R - rest,
            high: JOINT_R - rest,
            price: if layout.style.is_feed_firm {
                FIRM_PRICE
            } else {
                PRICE
            },
        },
    })
}
