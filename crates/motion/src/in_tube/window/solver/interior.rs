//! A primal-dual interior point method (Mehrotra 1992) for the sub-problem.
//!
//! Every row has two sides, v − high ≤ 0 and low − v ≤ 0. A side g ≤ 0 gets a slack s > 0, a
//! multiplier l > 0 and, if it is elastic, an excess e > 0 at a price p:
//!
//! ```text
//!     g + s − e = 0      s·l = μ      e·(p − l) = μ      μ → 0
//! ```
//!
//! Elimination of s, l and e leaves the normal equations for the control points, in which a side
//! weighs w = 1 / (s/l + e/(p − l)). A hard side is an elastic one of infinite price with e = 0.
//!
//! Each iteration factors once and solves twice: a predictor aims at μ = 0, and how far it gets
//! sets the μ that the corrector aims at.

use super::band::{Band, Block};
use super::ends::{first_difference, fold, take_away, tie_end};
use super::hard_sides::HardSides;
use super::problem::{DIFFERENCES, Problem, SPAN, combine, dot};
use super::sides::{Sides, TwoSides};

/// Share of the way to the boundary that a step may go.
const BACK_OFF: f64 = 0.99;
/// Largest residual of the rows of a solution.
const RESIDUAL: f64 = 1e-7;
/// The same where rounding allows no less: bounds are kept a little further away from the limits.
const SPENT_RESIDUAL: f64 = 1e-6;

/// Multiplications and divisions for a row, its two sides and both directions.
const ROW_WORK: usize = 80;
/// Products of blocks for each block row of the matrix, factored and solved with.
const FACTOR_PRODUCTS: usize = 16;
/// Axes from which on multiplications count half: in blocks so large they take half the time of
/// those in blocks of six.
const LARGE_BLOCK: usize = 7;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(in crate::in_tube::window) struct Goal {
    /// Mean complementarity of a solution.
    pub(in crate::in_tube::window) mu: f64,
    pub(in crate::in_tube::window) iterations: usize,
    /// Added to the diagonal of the normal equations, per axis unit squared.
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
    sides: Sides,
    band: Band<D>,
    step: Vec<[f64; D]>,
    /// Coefficients of the differences, by order and first control point, folded at the end.
    stencils: [Vec<[f64; 4]>; 3],
    orders: [bool; 3],
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
            sides: Sides::default(),
            band: Band::new(),
            step: Vec::new(),
            stencils: [Vec::new(), Vec::new(), Vec::new()],
            orders: [true; 3],
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
        let pairs = self.prepare(problem);
        self.evaluate(problem, x);
        self.sides.start();
        let work = self.work_of_iteration(problem);
        let mut last_residual = f64::INFINITY;
        for _ in 0..goal.iterations {
            let (mu, residual) = self.sides.state(pairs);
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
            self.sides.aim_at_zero();
            self.assemble(problem, goal.damping);
            self.band.factor(problem.free());
            self.direction(problem, x);
            self.sides.aim_at(mu, pairs);
            self.direction(problem, x);
            let step = (BACK_OFF * self.sides.room()).min(1.0);
            self.sides.advance(step);
            for k in problem.free() {
                for a in 0..D {
                    x[k][a] += step * self.step[k][a];
                }
            }
            tie_end(problem, x);
            self.evaluate(problem, x);
        }
        let (mu, residual) = self.sides.state(pairs);
        mu < goal.mu && residual < RESIDUAL
    }

    /// Multiplications of an iteration: every row goes through both directions and, with its
    /// square, into the matrix, which is factored once.
    fn work_of_iteration(&self, problem: &Problem<D>) -> usize {
        let axis_rows: usize = self.stencils.iter().map(|of| D * of.len()).sum();
        let rows = problem.rows.len();
        let of_sides = ROW_WORK * (axis_rows + rows);
        let of_matrix = rows * D * D + SPAN * (SPAN + 1) / 2 * problem.sites.len() * D * D;
        let of_factor = problem.intervals * FACTOR_PRODUCTS * D * D * D;
        (of_sides + of_matrix + of_factor) / if D < LARGE_BLOCK { 1 } else { 2 }
    }

    /// How much the elastic rows of the last solution are violated at most.
    pub(in crate::in_tube::window) fn violation(&self) -> f64 {
        let violations = self.sides.rows.iter().map(TwoSides::violation);
        violations.fold(0.0, f64::max)
    }

    /// Sizes everything; the number of complementary pairs.
    fn prepare(&mut self, problem: &Problem<D>) -> f64 {
        let last = problem.intervals;
        let mut axis_rows = 0;
        for order in 0..3 {
            self.orders[order] = problem.bounds[order].iter().any(|bound| bound.is_finite());
            self.stencils[order].clear();
            if self.orders[order] {
                for first in first_difference(order)..last {
                    let folded = fold(first, DIFFERENCES[order], problem);
                    self.stencils[order].push(folded);
                }
                axis_rows += D * self.stencils[order].len();
            }
        }
        self.sides.hard.clear();
        self.sides.hard.resize(axis_rows, HardSides::default());
        let rows = &mut self.sides.rows;
        rows.clear();
        rows.extend(problem.rows.iter().map(|row| TwoSides::of(row.price)));
        #[expect(clippy::cast_precision_loss, reason = "thousands")]
        let pairs = (2 * axis_rows + 4 * problem.rows.len()) as f64;
        pairs
    }

    /// Values of all rows in their order, of the control points or of a step of them: those of the
    /// axes, and the elastic ones with their bounds.
    fn rows_of(
        &self,
        problem: &Problem<D>,
        x: &[[f64; D]],
        mut take_axis: impl FnMut(f64),
        mut take: impl FnMut(f64, [f64; 2]),
    ) {
        for order in 0..3 {
            let start = first_difference(order);
            let bounds = &problem.bounds[order];
            for k in 0..self.stencils[order].len() {
                let y = combine(x, start + k, &DIFFERENCES[order]);
                for (value, bound) in y.iter().zip(bounds) {
                    take_axis(value / bound);
                }
            }
        }
        for site in &problem.sites {
            let y = combine(x, site.first, &site.weights);
            for row in &problem.rows[site.rows.clone()] {
                take(dot(&row.normal, &y), [row.low, row.high]);
            }
        }
    }

    fn evaluate(&mut self, problem: &Problem<D>, x: &[[f64; D]]) {
        let mut sides = core::mem::take(&mut self.sides);
        let (mut hard, mut rows) = (sides.hard.iter_mut(), sides.rows.iter_mut());
        let set_axis = |value| {
            if let Some(row) = hard.next() {
                row.set(value);
            }
        };
        self.rows_of(problem, x, set_axis, |value, [low, high]| {
            if let Some(row) = rows.next() {
                row.g = [value - high, low - value];
            }
        });
        self.sides = sides;
    }

    /// The matrix of the normal equations.
    fn assemble(&mut self, problem: &Problem<D>, damping: f64) {
        self.band.clear(problem.intervals + 3);
        let mut weights = self.sides.hard.iter().map(HardSides::weight);
        let mut next_weight = || weights.next().unwrap_or(0.0);
        for order in 0..3 {
            let start = first_difference(order);
            for (k, stencil) in self.stencils[order].iter().enumerate() {
                for a in 0..D {
                    let bound = problem.bounds[order][a];
                    let mut weight = next_weight() / (bound * bound);
                    if order == 2 {
                        weight += problem.jerk[a];
                    }
                    for i in 0..4 {
                        for j in 0..=i {
                            self.band.add_axis(
                                start + k + i,
                                i - j,
                                a,
                                weight * stencil[i] * stencil[j],
                            );
                        }
                    }
                }
            }
        }
        let mut weights = self.sides.rows.iter().map(TwoSides::weight);
        let mut next_weight = || weights.next().unwrap_or(0.0);
        for site in &problem.sites {
            let mut block: Block<D> = [[0.0; D]; D];
            for row in &problem.rows[site.rows.clone()] {
                let weight = next_weight();
                for a in 0..D {
                    let scaled = weight * row.normal[a];
                    for b in 0..D {
                        block[a][b] += scaled * row.normal[b];
                    }
                }
            }
            for a in 0..D {
                block[a][a] += site.ridge;
                for b in 0..D {
                    block[a][b] -= site.ridge * site.tangent[a] * site.tangent[b];
                }
            }
            let weights = fold(site.first, site.weights, problem);
            for i in 0..SPAN {
                for j in 0..=i {
                    let factor = weights[i] * weights[j];
                    if factor != 0.0 {
                        self.band.add_block(site.first + i, i - j, &block, factor);
                    }
                }
            }
        }
        for k in problem.free() {
            for a in 0..D {
                self.band.add_axis(k, 0, a, damping);
            }
        }
        for (k, pins) in problem.pins.iter().enumerate() {
            for a in (0..D).filter(|&a| pins[a]) {
                self.band.pin(k, a);
            }
        }
    }

    /// Solves for the step of the control points, and from it that of the sides.
    fn direction(&mut self, problem: &Problem<D>, x: &[[f64; D]]) {
        let last = problem.intervals;
        self.step.clear();
        self.step.resize(last + 3, [0.0; D]);
        let step = &mut self.step;
        for (k, aim) in problem.aims.iter().enumerate() {
            let k = k.min(last);
            for a in 0..D {
                step[k][a] += aim[a];
            }
        }
        let mut forces = self.sides.hard.iter().map(HardSides::force);
        let mut next_force = || forces.next().unwrap_or(0.0);
        for order in 0..3 {
            let start = first_difference(order);
            for (k, stencil) in self.stencils[order].iter().enumerate() {
                let mut pull = [0.0; D];
                for (pull, bound) in pull.iter_mut().zip(&problem.bounds[order]) {
                    *pull = next_force() / bound;
                }
                if order == 2 {
                    let third = combine(x, start + k, &DIFFERENCES[2]);
                    for a in 0..D {
                        pull[a] += problem.jerk[a] * third[a];
                    }
                }
                take_away(step, start + k, stencil, &pull);
            }
        }
        let mut forces = self.sides.rows.iter().map(TwoSides::force);
        let mut next_force = || forces.next().unwrap_or(0.0);
        for site in &problem.sites {
            let mut pull = [0.0; D];
            for row in &problem.rows[site.rows.clone()] {
                let force = next_force();
                for a in 0..D {
                    pull[a] += force * row.normal[a];
                }
            }
            if site.ridge > 0.0 {
                let y = combine(x, site.first, &site.weights);
                let mut offset = [0.0; D];
                for a in 0..D {
                    offset[a] = y[a] - site.center[a];
                }
                let along = dot(&offset, &site.tangent);
                for a in 0..D {
                    pull[a] += site.ridge * (offset[a] - along * site.tangent[a]);
                }
            }
            let weights = fold(site.first, site.weights, problem);
            take_away(step, site.first, &weights, &pull);
        }
        for (step, pins) in self.step.iter_mut().zip(&problem.pins) {
            for a in (0..D).filter(|&a| pins[a]) {
                step[a] = 0.0;
            }
        }
        self.band.solve(problem.free(), &mut self.step);
        for k in 0..3 {
            self.step[k] = [0.0; D];
        }
        let end = if problem.is_end_fixed {
            [0.0; D]
        } else {
            self.step[last]
        };
        for k in last..last + 3 {
            self.step[k] = end;
        }
        self.follow_step(problem);
    }

    /// The step of the sides that goes with that of the control points.
    fn follow_step(&mut self, problem: &Problem<D>) {
        let mut sides = core::mem::take(&mut self.sides);
        let (mut hard, mut rows) = (sides.hard.iter_mut(), sides.rows.iter_mut());
        let follow_axis = |change| {
            if let Some(row) = hard.next() {
                row.follow(change);
            }
        };
        self.rows_of(problem, &self.step, follow_axis, |change, _| {
            if let Some(row) = rows.next() {
                row.follow(change);
            }
        });
        self.sides = sides;
    }
}
