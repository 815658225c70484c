//! The convex problem of one round: its rows, its objective, and its solution.

use super::Optimiser;
use crate::in_tube::window::scaled_path::ScaledPath;
use crate::in_tube::window::solver::Goal;
use crate::in_tube::window::tube::{self, JERK_AT_FEED, Layout, Style};
use crate::in_tube::window::{damping, feed_rows, joint_rows, shortcuts, travel_rows};

/// Interior point iterations in one problem, of which it usually takes 6 to 20. One that takes more counts
/// as not solved ([`super::phases`]).
const SOLVER_ITERATIONS: usize = 40;
/// Mean complementarity, in periods of progress, at which a problem is solved: in rounds in which lines
/// may leave the path, and in others. With 1e-7 the motion wanders less within the tube where the feed
/// binds, but has as much jerk: what is wanted there is said by prices ([`Style::jerk`]), not by μ.
const SEARCH_MU: f64 = 1e-4;
const EXACT_MU: f64 = 1e-5;
/// [`Goal::damping`] times the square of the way in a knot at the top speed. No measurement
/// of it is kept.
const DAMPING: f64 = 1e-7;
/// Share of every limit that is planned with: the residual of a solution may be half of the rest.
const LIMIT_R: f64 = 1.0 - 2e-6;

impl<const D: usize> Optimiser<D> {
    /// Solves the convex problem of a style. True if there is a solution.
    pub(in crate::in_tube::window) fn solve(
        &mut self,
        path: &ScaledPath<D>,
        style: &Style,
        points: &mut [[f64; D]],
        is_end_fixed: bool,
        is_exact: bool,
    ) -> bool {
        let h = style.grid.knot_t;
        self.problem.clear(points.len() - 3, is_end_fixed);
        // Limits of differences of control points, in tolerances: a knot is the unit of time.
        self.problem.bounds = [
            path.velocity_bounds().map(|v| v * h * LIMIT_R),
            path.acceleration.map(|a| a * h * h * LIMIT_R),
            path.jerk.map(|j| j * h * h * h * LIMIT_R),
        ];
        // |Δ³x / unit|² is one at the jerk that is priced.
        let unit = style.priced_jerk(path).map(|j| j * h * h * h);
        self.problem.jerk = unit.map(|unit| style.jerk / (unit * unit));
        self.problem.dear_jerk = (JERK_AT_FEED, style.intervals_at_feed());
        let margin = style.settling_periods(path);
        self.fixed_axes
            .set(path, &self.samples, points, &style.grid, margin);
        self.problem
            .fixed_axes
            .clone_from(&self.fixed_axes.of_points);
        let extents = &mut self.extents[usize::from(style.stray_r > 1.0)];
        let layout = Layout {
            path,
            samples: &self.samples,
            cutting_planes: &self.cutting_planes,
            points,
            style,
        };
        tube::build(&mut self.problem, &layout, extents);
        feed_rows::add(&mut self.problem, &layout);
        travel_rows::add(&mut self.problem, &layout);
        if path.joints().is_some() {
            joint_rows::add(&mut self.problem, &layout);
        }
        if style.is_damped {
            damping::add(&mut self.problem, &layout);
        }
        if style.counts_way {
            shortcuts::add(&mut self.problem, &layout);
        }
        let top = path
            .segments
            .iter()
            .map(|segment| segment.top)
            .fold(0.0, f64::max);
        let goal = Goal {
            mu: if is_exact { EXACT_MU } else { SEARCH_MU },
            iterations: SOLVER_ITERATIONS,
            damping: DAMPING / (top * h).powi(2),
        };
        self.interior.solve(&self.problem, points, goal)
    }
}
