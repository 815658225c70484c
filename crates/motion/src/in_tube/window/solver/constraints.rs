//! The constraints: the sides of all rows, and one way past them with the value that each has.

use super::ahead::{Ahead, Pair, larger};
use super::hard_constraint::HardConstraint;
use super::problem::{DIFFERENCES, Problem, RowBounds, combine, dot, first_difference};
use super::soft_constraint::SoftConstraint;

/// The sides of all rows: first those that must hold, by order, control point and axis, then the
/// soft ones.
#[derive(Debug, Clone, Default)]
pub(super) struct Constraints {
    pub(super) hard: Vec<HardConstraint>,
    pub(super) soft: Vec<SoftConstraint>,
    /// Of the wide rows.
    pub(super) wide: Vec<SoftConstraint>,
}

/// How far from a solution the sides are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Standing {
    sums: Pair,
    residuals: Pair,
}

impl Standing {
    fn add(&mut self, (product, rest): (Pair, Pair)) {
        for k in 0..2 {
            self.sums[k] += product[k];
            self.residuals[k] = larger(self.residuals[k], rest[k]);
        }
    }

    /// Sum of all products.
    pub(super) fn sum(&self) -> f64 {
        self.sums[0] + self.sums[1]
    }

    /// Largest residual.
    pub(super) const fn residual(&self) -> f64 {
        larger(self.residuals[0], self.residuals[1])
    }
}

impl Constraints {
    /// Sizes everything; the number of complementary pairs.
    pub(super) fn resize<const D: usize>(&mut self, problem: &Problem<D>) -> usize {
        let counts = (0..3).map(|order| D * problem.differences(order));
        self.hard.resize(counts.sum(), HardConstraint::default());
        let count = problem.rows.len();
        self.soft.resize(count, SoftConstraint::default());
        let count = problem.wide_rows.len();
        self.wide.resize(count, SoftConstraint::default());
        2 * self.hard.len() + 4 * (self.soft.len() + self.wide.len())
    }

    /// Those that must hold, by order.
    pub(super) fn by_order<const D: usize>(&self, problem: &Problem<D>) -> [&[HardConstraint]; 3] {
        let (velocity, rest) = self.hard.split_at(D * problem.differences(0));
        let (acceleration, jerk) = rest.split_at(D * problem.differences(1));
        [velocity, acceleration, jerk]
    }

    /// The same, to be changed.
    pub(super) fn by_order_mut<const D: usize>(
        &mut self,
        problem: &Problem<D>,
    ) -> [&mut [HardConstraint]; 3] {
        let (velocity, rest) = self.hard.split_at_mut(D * problem.differences(0));
        let (acceleration, jerk) = rest.split_at_mut(D * problem.differences(1));
        [velocity, acceleration, jerk]
    }

    /// Sets out from control points.
    pub(super) fn start<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        x: &[[f64; D]],
    ) -> Standing {
        self.pass(
            (problem, x),
            |side, value, standing: &mut Standing| standing.add(side.start(value)),
            |side, value, bounds, standing| {
                standing.add(side.start(bounds.sides(value), bounds.price));
            },
        )
    }

    /// Goes a share of the step, which has brought the control points to where they are.
    pub(super) fn advance<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        x: &[[f64; D]],
        step: f64,
    ) -> Standing {
        self.pass(
            (problem, x),
            |side, value, standing: &mut Standing| standing.add(side.advance(step, value)),
            |side, value, bounds, standing| standing.add(side.advance(step, bounds.sides(value))),
        )
    }

    /// The step that goes with one of the control points.
    pub(super) fn follow<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        step: &[[f64; D]],
    ) -> Ahead {
        self.pass(
            (problem, step),
            |side, change, ahead: &mut Ahead| side.follow(change, ahead),
            |side, change, _, ahead| side.follow(change, ahead),
        )
    }

    /// Passes all rows with their values at some control points, or those of a step.
    #[inline]
    fn pass<const D: usize, T: Default>(
        &mut self,
        (problem, x): (&Problem<D>, &[[f64; D]]),
        hard: impl Fn(&mut HardConstraint, f64, &mut T),
        soft: impl Fn(&mut SoftConstraint, f64, &RowBounds, &mut T),
    ) -> T {
        let mut all = T::default();
        let [velocity, acceleration, jerk] = self.by_order_mut(problem);
        pass_differences::<D, 2, T>((problem, x), velocity, &mut all, &hard);
        pass_differences::<D, 3, T>((problem, x), acceleration, &mut all, &hard);
        pass_differences::<D, 4, T>((problem, x), jerk, &mut all, &hard);
        for site in &problem.sites {
            let y = combine(x, site.first, &site.weights);
            let sides = &mut self.soft[site.rows.clone()];
            for (row, side) in problem.rows[site.rows.clone()].iter().zip(sides) {
                soft(side, dot(&row.normal, &y), &row.bounds, &mut all);
            }
        }
        for (row, side) in problem.wide_rows.iter().zip(&mut self.wide) {
            soft(side, row.value(x), &row.bounds, &mut all);
        }
        all
    }
}

/// Passes the rows on differences of `N` points.
#[inline]
fn pass_differences<const D: usize, const N: usize, T>(
    (problem, x): (&Problem<D>, &[[f64; D]]),
    sides: &mut [HardConstraint],
    all: &mut T,
    go: &impl Fn(&mut HardConstraint, f64, &mut T),
) {
    let order = N - 2;
    let per_bound = problem.bounds[order].map(|bound| 1.0 / bound);
    let points = x[first_difference(order)..].windows(N);
    for (sides, points) in sides.chunks_exact_mut(D).zip(points) {
        let mut y = [0.0; D];
        for (point, weight) in points.iter().zip(&DIFFERENCES[order]) {
            for a in 0..D {
                y[a] += weight * point[a];
            }
        }
        for a in 0..D {
            go(&mut sides[a], y[a] * per_bound[a], all);
        }
    }
}
