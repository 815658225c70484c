//! A primal-dual interior point method (Mehrotra 1992) for the sub-problem.
//!
//! Every row has two sides, v − high ≤ 0 and low − v ≤ 0. A side g ≤ 0 gets a slack s > 0, a
//! multiplier l > 0 and, if it is soft, an excess e > 0 at a price p:
//!
//! ```text
//!     g + s − e = 0      s·l = μ      e·(p − l) = μ      μ → 0
//! ```
//!
//! Elimination of s, l and e leaves the normal equations for the control points, in which a side
//! weighs w = 1 / (s/l + e/(p − l)). A hard side is a soft one of infinite price with e = 0.
//!
//! With c the aims and what the centers of attraction pull with at x = 0, P the Hessian of attraction and jerk,
//! and a the coefficients of the rows (±, by side),
//! Newton's step for these conditions and stationarity, c − P·x − Σ l·a = 0, is
//!
//! ```text
//!     (P + Σ w·a·aᵀ + damping) · dx  =  c − P·x − Σ f·a          f = l + w·(g + α_s/l − α_e/(p − l))
//!     dl = f − l + w·a·dx        ds = (α_s − s·dl)/l − s         de = (α_e + e·dl)/(p − l) − e
//! ```
//!
//! where α_s and α_e are what s·l and e·(p − l) are to become. So the residual of the rows is taken
//! away by the same step, and x need not keep them at the start.
//!
//! Each iteration factors once and solves twice: a predictor aims at μ = 0, and how far it gets
//! sets the μ of the corrector. The work of an active-set method follows how many rows change
//! sides from one problem to the next; here every iteration of a problem costs the same, so work is
//! bounded in multiplications ([`Allowance`]), which are the same on every run.

use super::ahead::{Ahead, Target};
use super::constraints::Constraints;
use super::normal::NormalEquations;
use super::problem::Problem;
use super::rest::tie_rest;
use super::soft_constraint::SoftConstraint;

/// Share of the way to the boundary that a step may go. At 1 a slack or multiplier would be 0, and
/// there is no step from there.
const BACK_OFF: f64 = 0.99;
/// Largest residual of the rows of a solution, in units of each row. That of stationarity is not looked
/// at: it is linear in the unknowns like that of the rows, so a step of length α leaves 1 − α of it, and
/// μ falls no faster than that but for terms of second order.
const RESIDUAL: f64 = 1e-7;
/// The same where rounding allows no less: bounds are kept 2e-6 away from the limits, so that one that
/// is missed by this much is still inside.
const SPENT_RESIDUAL: f64 = 1e-6;

/// Multiplications and divisions for a row, its two sides and both directions.
const ROW_WORK: usize = 80;
/// Products of numbers of a block for each site.
const SITE_PRODUCTS: usize = 15;
/// Products of blocks for each block row of the matrix, factored and solved with. By count 7⅔ to
/// factor it and 16 over the number of axes to solve twice, so this is what two axes take. More axes take
/// less, and are counted too much: factor and solutions 1.23 times with three, 1.55 with six, 1.69 with
/// nine; an iteration of a usual window, with all else, 1.04, 1.2 and 1.35 times. So their windows may do
/// less than what is allowed, never more.
const FACTOR_PRODUCTS: usize = 16;
/// Axes from which on multiplications count half: in blocks so large they take half the time of
/// those in blocks of six. What six take is told at [`super::super::budget`].
const LARGE_BLOCK: usize = 7;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(in crate::in_tube::window) struct Goal {
    /// Mean complementarity of a solution.
    pub(in crate::in_tube::window) mu: f64,
    pub(in crate::in_tube::window) iterations: usize,
    /// Added to the diagonal of the Hessian, objective per tolerance squared, for control points that
    /// nothing acts on. It is not in the gradient: steps become shorter, what they lead to is the same.
    pub(in crate::in_tube::window) damping: f64,
}

/// How much work may be done: what is wanted, and the most.
#[derive(Debug, Clone, Copy)]
pub(in crate::in_tube::window) struct Allowance {
    pub(in crate::in_tube::window) wanted: usize,
    pub(in crate::in_tube::window) most: usize,
}

/// The method, with its memory.
#[derive(Debug, Clone)]
pub(in crate::in_tube::window) struct Interior<const D: usize> {
    sides: Constraints,
    normal: NormalEquations<D>,
    /// Multiplications so far, over all problems, as far as they grow with a problem's size: the
    /// measure of work.
    pub(in crate::in_tube::window) work: usize,
    /// Work up to which a problem may be begun, and up to which an iteration may.
    wanted_work: usize,
    most_work: usize,
    /// An iteration was refused.
    is_cut: bool,
}

impl<const D: usize> Interior<D> {
    pub(in crate::in_tube::window) fn new() -> Self {
        Self {
            sides: Constraints::default(),
            normal: NormalEquations::new(),
            work: 0,
            wanted_work: 0,
            most_work: 0,
            is_cut: false,
        }
    }

    /// Allows work from now on: more problems up to `wanted`, and to finish the last one up to
    /// `most`.
    pub(in crate::in_tube::window) const fn allow(
        &mut self,
        Allowance { wanted, most }: Allowance,
    ) {
        self.wanted_work = self.work.saturating_add(wanted);
        self.most_work = self.work.saturating_add(most);
        self.is_cut = false;
    }

    /// So much more work is wanted, of the most that there is.
    pub(in crate::in_tube::window) const fn want(&mut self, wanted: usize) {
        self.wanted_work = self.work.saturating_add(wanted);
    }

    /// True if no other problem is to be begun.
    pub(in crate::in_tube::window) const fn is_spent(&self) -> bool {
        self.is_cut || self.work > self.wanted_work
    }

    /// Improves `x`, M + 3 control points of which the first three (and the last, if fixed) stay.
    /// True if it is a solution.
    pub(in crate::in_tube::window) fn solve(
        &mut self,
        problem: &Problem<D>,
        x: &mut [[f64; D]],
        goal: Goal,
    ) -> bool {
        #[expect(clippy::cast_precision_loss, reason = "thousands")]
        let pairs = self.sides.resize(problem) as f64;
        self.normal.resize(problem);
        let mut standing = self.sides.start(problem, x);
        let work = work_of_iteration(problem);
        let mut last_residual = f64::INFINITY;
        for _ in 0..goal.iterations {
            let (mu, residual) = (standing.sum() / pairs, standing.residual());
            if mu < goal.mu && residual < RESIDUAL {
                return true;
            }
            // Near the goal, a residual that rises is rounding's: more iterations only add to it.
            if mu < goal.mu && residual > last_residual {
                return residual < SPENT_RESIDUAL;
            }
            if !(mu.is_finite() && residual.is_finite()) {
                return false;
            }
            last_residual = residual;
            if self.work + work > self.most_work {
                self.is_cut = true;
                return false;
            }
            self.work += work;
            self.normal.factor(problem, &self.sides, goal.damping);
            let predicted = self.direction(problem, x, None);
            // One length for points, slacks and multipliers: in a quadratic program stationarity has
            // both x and l in it, and steps of two lengths would leave a residual of it.
            let step = predicted.room().min(1.0);
            let share = predicted.sum_after(standing.sum(), step) / pairs / mu;
            let corrected = self.direction(problem, x, Some(Target::after(mu, share)));
            let step = (BACK_OFF * corrected.room()).min(1.0);
            for k in problem.free() {
                for a in 0..D {
                    x[k][a] += step * self.normal.step[k][a];
                }
            }
            tie_rest(problem, x);
            standing = self.sides.advance(problem, x, step);
        }
        standing.sum() / pairs < goal.mu && standing.residual() < RESIDUAL
    }

    /// The step of the control points and of the sides: that of the predictor, or with a target
    /// that of the corrector.
    fn direction(&mut self, problem: &Problem<D>, x: &[[f64; D]], target: Option<Target>) -> Ahead {
        self.normal.solve(problem, x, &mut self.sides, target);
        self.sides.follow(problem, &self.normal.step)
    }

    /// How much the soft rows of the last solution are violated at most.
    pub(in crate::in_tube::window) fn violation(&self) -> f64 {
        let sides = self.sides.soft.iter().chain(&self.sides.wide);
        let violations = sides.map(SoftConstraint::violation);
        violations.fold(0.0, f64::max)
    }
}

/// Multiplications of an iteration: every row goes through both directions and, with its square,
/// into the matrix, which is factored once.
fn work_of_iteration<const D: usize>(problem: &Problem<D>) -> usize {
    let axis_rows: usize = (0..3).map(|order| D * problem.differences(order)).sum();
    let (rows, wide_rows) = (problem.rows.len(), problem.wide_rows.len());
    let of_sides = ROW_WORK * (axis_rows + rows + wide_rows);
    let blocks = rows + SITE_PRODUCTS * (problem.sites.len() + wide_rows);
    let of_matrix = blocks * D * D;
    let of_factor = problem.intervals * FACTOR_PRODUCTS * D * D * D;
    (of_sides + of_matrix + of_factor) / if D < LARGE_BLOCK { 1 } else { 2 }
}
