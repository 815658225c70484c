//! Rows that keep the motion inside the travel of every axis.
//!
//! In the tube a motion may swing to the outer side of a corner, before a rest it may overshoot, and
//! where the program touches an end of travel both lead out of it. There the tube ends at the wall.
//!
//! An interval of the spline lies in the hull of its Bézier points, so each of these is a row, and
//! what is between samples is bounded with them. The hull is wider than the curve by a·h²/24 where
//! that bends; of half intervals it is a quarter of that, and a motion that only touches the wall
//! loses hardly anything:
//!
//! ```text
//!   ─────────── end of travel ───────────     points of the halves, by control points x₀ … x₃
//!         ●───●       ●───●                    (the knots and the middle lie between them):
//!       ╱  ╭──────────────╮  ╲                 1/12  2/3   1/4
//!     ●  ╱                 ╲  ●                1/24  7/12  3/8     and the same backwards
//! ```

use super::solver::Problem;
use super::tube::Layout;

/// How near to an end of travel the last motion is where rows are needed, in tolerances: more than a
/// motion moves from round to round once it is one.
const NEAR_R: f64 = 8.0;
/// What is left to the residual of a solution, in tolerances: three times the largest that one may have.
const LEFT_R: f64 = 3e-6;
/// The side of a row that is not the wall: further away than any motion is, in tolerances. `FAR`
/// is 20 mm at a tolerance of 20 µm.
pub(super) const NOWHERE: f64 = 1e7;
/// The points of both halves of an interval.
const POINTS: [[f64; 4]; 4] = [
    [1.0 / 12.0, 2.0 / 3.0, 0.25, 0.0],
    [1.0 / 24.0, 7.0 / 12.0, 0.375, 0.0],
    [0.0, 0.375, 7.0 / 12.0, 1.0 / 24.0],
    [0.0, 0.25, 2.0 / 3.0, 1.0 / 12.0],
];

/// Adds rows for every axis that has an end of travel near the last motion.
pub(super) fn add<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>) {
    for axis in 0..D {
        for (wall, outwards) in layout.path.walls[axis].into_iter().zip([-1.0, 1.0]) {
            if wall.is_finite() {
                add_wall(problem, layout.points, (axis, wall, outwards));
            }
        }
    }
}

fn add_wall<const D: usize>(
    problem: &mut Problem<D>,
    points: &[[f64; D]],
    (axis, wall, outwards): (usize, f64, f64),
) {
    let mut normal = [0.0; D];
    normal[axis] = outwards;
    let mut center = [0.0; D];
    center[axis] = wall;
    for first in 0..problem.intervals {
        let four = &points[first..first + 4];
        let is_near = |point: &[f64; D]| outwards * (wall - point[axis]) < NEAR_R;
        if !four.iter().any(is_near) {
            continue;
        }
        for weights in POINTS {
            // What is given or fixed is where it is.
            if problem.is_given((first, &weights), axis) {
                continue;
            }
            problem.add_site(first, weights);
            problem.add_firm_row(normal, &center, [-NOWHERE, -LEFT_R]);
        }
    }
}
