//! The normal equations: their matrix, and the step of the control points that they give.
//!
//! The matrix is the Hessian of the Lagrangian with slacks and multipliers eliminated
//! ([`super::interior`]), the right-hand side its negative gradient at the multipliers f. Rows on
//! differences act on one axis each, so they are summed up by axis first, as numbers; only sites need
//! blocks.

use super::ahead::Target;
use super::band::{Band, Block};
use super::constraints::Constraints;
use super::hard_constraint::HardConstraint;
use super::problem::{DIFFERENCES, Problem, Row, SPAN, Site, combine, dot, first_difference};
use super::rest::{fold, fold_parts, take_away};
use super::soft_constraint::SoftConstraint;

/// The equations, with their memory.
#[derive(Debug, Clone)]
pub(super) struct NormalEquations<const D: usize> {
    band: Band<D>,
    /// What the rows of axes add to the matrix, by point, points before it and axis: they do not
    /// couple axes.
    of_axes: Vec<[[f64; D]; SPAN]>,
    /// Step of the control points.
    pub(super) step: Vec<[f64; D]>,
    /// Coefficients of the differences, by order and first control point, folded at the end.
    stencils: [Vec<[f64; SPAN]>; 3],
    /// Those of the sites.
    of_sites: Vec<[f64; SPAN]>,
    /// Those of the wide rows.
    of_wide: Vec<[[f64; D]; SPAN]>,
}

impl<const D: usize> NormalEquations<D> {
    pub(super) const fn new() -> Self {
        Self {
            band: Band::new(),
            of_axes: Vec::new(),
            step: Vec::new(),
            stencils: [Vec::new(), Vec::new(), Vec::new()],
            of_sites: Vec::new(),
            of_wide: Vec::new(),
        }
    }

    /// Sizes everything.
    pub(super) fn resize(&mut self, problem: &Problem<D>) {
        for (order, stencils) in self.stencils.iter_mut().enumerate() {
            let start = first_difference(order);
            let firsts = start..start + problem.differences(order);
            stencils.clear();
            stencils.extend(firsts.map(|first| fold(first, DIFFERENCES[order], problem)));
        }
        self.of_sites.clear();
        let sites = problem.sites.iter();
        let folded = sites.map(|site| fold(site.first, site.weights, problem));
        self.of_sites.extend(folded);
        self.of_wide.clear();
        let wide_rows = problem.wide_rows.iter();
        self.of_wide
            .extend(wide_rows.map(|row| fold_parts(row, problem)));
    }

    /// Makes the Hessian from the weights of the sides, and factors it.
    pub(super) fn factor(&mut self, problem: &Problem<D>, sides: &Constraints, damping: f64) {
        let none = [0.0; D];
        self.of_axes.clear();
        self.of_axes
            .resize(problem.intervals + 3, [[damping; D], none, none, none]);
        let [velocity, acceleration, jerk] = sides.by_order(problem);
        self.add_differences::<2>(problem, velocity);
        self.add_differences::<3>(problem, acceleration);
        self.add_differences::<4>(problem, jerk);
        self.band.start(&self.of_axes);
        for (site, weights) in problem.sites.iter().zip(&self.of_sites) {
            let of_rows = (
                &problem.rows[site.rows.clone()],
                &sides.soft[site.rows.clone()],
            );
            let block = block_of(site, of_rows);
            for i in 0..SPAN {
                for j in 0..=i {
                    let factor = weights[i] * weights[j];
                    if factor != 0.0 {
                        self.band.add_block(site.first + i, i - j, &block, factor);
                    }
                }
            }
        }
        let wide_rows = problem.wide_rows.iter().zip(&self.of_wide);
        for ((row, parts), side) in wide_rows.zip(&sides.wide) {
            let weight = side.weight();
            for i in 0..SPAN {
                for j in 0..=i {
                    let block = product(&parts[i], &parts[j]);
                    self.band.add_block(row.first + i, i - j, &block, weight);
                }
            }
        }
        for (k, fixed_axes) in problem.fixed_axes.iter().enumerate() {
            for a in (0..D).filter(|&a| fixed_axes[a]) {
                self.band.fix(k, a);
            }
        }
        self.band.factor(problem.free());
    }

    /// Adds the rows on differences of `N` points.
    fn add_differences<const N: usize>(&mut self, problem: &Problem<D>, sides: &[HardConstraint]) {
        let order = N - 2;
        let per_square = problem.bounds[order].map(|bound| 1.0 / (bound * bound));
        let start = first_difference(order);
        let stencils = self.stencils[order].iter().enumerate();
        for ((k, stencil), sides) in stencils.zip(sides.chunks_exact(D)) {
            // Hessian of a row that is scaled to −1 ≤ Δx/bound ≤ 1: w/bound²; the price of jerk is
            // one on Δ³x itself.
            let price = if order == 2 {
                problem.jerk_at(k)
            } else {
                [0.0; D]
            };
            let mut weights = [0.0; D];
            for a in 0..D {
                weights[a] = sides[a].weight() * per_square[a] + price[a];
            }
            let points = &mut self.of_axes[start + k..start + k + N];
            for i in 0..N {
                for j in 0..=i {
                    let factor = stencil[i] * stencil[j];
                    for a in 0..D {
                        points[i][i - j][a] += factor * weights[a];
                    }
                }
            }
        }
    }

    /// Solves for the step of the control points, towards the targets of the sides.
    pub(super) fn solve(
        &mut self,
        problem: &Problem<D>,
        x: &[[f64; D]],
        sides: &mut Constraints,
        target: Option<Target>,
    ) {
        let last = problem.intervals;
        // The negative gradient, from that of the linear part on.
        self.step.clear();
        self.step.extend_from_slice(&problem.aims);
        for k in last + 1..last + 3 {
            let aim = core::mem::replace(&mut self.step[k], [0.0; D]);
            for a in 0..D {
                self.step[last][a] += aim[a];
            }
        }
        let [velocity, acceleration, jerk] = sides.by_order_mut(problem);
        self.pull_differences::<2>((problem, x), velocity, target);
        self.pull_differences::<3>((problem, x), acceleration, target);
        self.pull_differences::<4>((problem, x), jerk, target);
        for (site, weights) in problem.sites.iter().zip(&self.of_sites) {
            let mut pull = pull_of_attraction(site, x);
            let rows = problem.rows[site.rows.clone()].iter();
            for (row, side) in rows.zip(&mut sides.soft[site.rows.clone()]) {
                if let Some(target) = target {
                    side.correct(target);
                }
                let force = side.force();
                for a in 0..D {
                    pull[a] += force * row.normal[a];
                }
            }
            take_away(&mut self.step, site.first, weights, &pull);
        }
        let wide_rows = problem.wide_rows.iter().zip(&self.of_wide);
        for ((row, parts), side) in wide_rows.zip(&mut sides.wide) {
            if let Some(target) = target {
                side.correct(target);
            }
            let force = side.force();
            for (point, part) in self.step[row.first..].iter_mut().zip(parts) {
                for a in 0..D {
                    point[a] -= force * part[a];
                }
            }
        }
        for (step, fixed_axes) in self.step.iter_mut().zip(&problem.fixed_axes) {
            for a in (0..D).filter(|&a| fixed_axes[a]) {
                step[a] = 0.0;
            }
        }
        self.band.solve(problem.free(), &mut self.step);
        self.step[..3].fill([0.0; D]);
        let end = if problem.is_end_fixed {
            [0.0; D]
        } else {
            self.step[last]
        };
        self.step[last..].fill(end);
    }

    /// Takes away the pulls of the rows on differences of `N` points; those after them are zero.
    fn pull_differences<const N: usize>(
        &mut self,
        (problem, x): (&Problem<D>, &[[f64; D]]),
        sides: &mut [HardConstraint],
        target: Option<Target>,
    ) {
        let order = N - 2;
        let per_bound = problem.bounds[order].map(|bound| 1.0 / bound);
        let start = first_difference(order);
        let stencils = self.stencils[order].iter().enumerate();
        for ((k, stencil), sides) in stencils.zip(sides.chunks_exact_mut(D)) {
            let mut pull = [0.0; D];
            for a in 0..D {
                if let Some(target) = target {
                    sides[a].correct(target);
                }
                pull[a] = sides[a].force() * per_bound[a];
            }
            if order == 2 {
                let third = combine(x, start + k, &DIFFERENCES[2]);
                let price = problem.jerk_at(k);
                for a in 0..D {
                    pull[a] += price[a] * third[a];
                }
            }
            take_away(&mut self.step, start + k, stencil, &pull);
        }
    }
}

/// a·bᵀ
#[inline]
fn product<const D: usize>(a: &[f64; D], b: &[f64; D]) -> Block<D> {
    a.map(|value| b.map(|other| value * other))
}

/// What the rows of a site and its attraction add to the Hessian, where its weights are one:
/// Σ w·n·nᵀ + attraction·(I − t·tᵀ).
#[inline]
fn block_of<const D: usize>(
    site: &Site<D>,
    (rows, sides): (&[Row<D>], &[SoftConstraint]),
) -> Block<D> {
    let mut block: Block<D> = [[0.0; D]; D];
    for (row, side) in rows.iter().zip(sides) {
        let weight = side.weight();
        for a in 0..D {
            let scaled = weight * row.normal[a];
            for b in 0..D {
                block[a][b] += scaled * row.normal[b];
            }
        }
    }
    if site.attraction > 0.0 {
        for a in 0..D {
            block[a][a] += site.attraction;
            for b in 0..D {
                block[a][b] -= site.attraction * site.tangent[a] * site.tangent[b];
            }
        }
    }
    block
}

/// How the attraction of a site pulls: the gradient of ½·attraction·|offset across t|².
#[inline]
fn pull_of_attraction<const D: usize>(site: &Site<D>, x: &[[f64; D]]) -> [f64; D] {
    let mut pull = [0.0; D];
    if site.attraction > 0.0 {
        let y = combine(x, site.first, &site.weights);
        let mut offset = [0.0; D];
        for a in 0..D {
            offset[a] = y[a] - site.center[a];
        }
        let along = dot(&offset, &site.tangent);
        for a in 0..D {
            pull[a] = site.attraction * (offset[a] - along * site.tangent[a]);
        }
    }
    pull
}
