//! The sides of all rows: slacks, multipliers and excesses, and their steps.
//!
//! What they are is told in [`super::interior`]. Both sides of a row lie together and take the same
//! way through every loop, so that one instruction does for both.

use super::hard_sides::{HardSides, Pair, START_MU, START_SLACK, larger};

/// Both sides of an elastic row.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TwoSides {
    /// Values of the sides.
    pub(super) g: Pair,
    slack: Pair,
    multiplier: Pair,
    excess: Pair,
    price: Pair,
    d_slack: Pair,
    d_multiplier: Pair,
    d_excess: Pair,
    /// What s·l and e·(p − l) are to become.
    aim_slack: Pair,
    aim_excess: Pair,
    /// Weight in the normal equations, and the multiplier that goes with no change of the row.
    weight: Pair,
    force: Pair,
}

impl TwoSides {
    /// The sides of a row that may be violated at a price.
    pub(super) fn of(price: f64) -> Self {
        Self {
            price: [price; 2],
            ..Self::default()
        }
    }

    /// Weight in the normal equations.
    #[inline]
    pub(super) const fn weight(&self) -> f64 {
        self.weight[0] + self.weight[1]
    }

    /// Force that goes with no change of the row.
    #[inline]
    pub(super) const fn force(&self) -> f64 {
        self.force[0] - self.force[1]
    }

    /// How much it is violated, below zero if it is not.
    pub(super) const fn violation(&self) -> f64 {
        self.g[0].max(self.g[1])
    }

    fn start(&mut self) {
        for k in 0..2 {
            let g = self.g[k];
            self.slack[k] = (-g).max(START_SLACK);
            self.excess[k] = (g + self.slack[k]).max(START_MU / (0.9 * self.price[k]));
            self.multiplier[k] = (START_MU / self.slack[k]).min(0.5 * self.price[k]);
        }
    }

    /// Complementarity and residual of each side.
    #[inline]
    fn state(&self) -> (Pair, Pair) {
        let (mut product, mut rest) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let l = self.multiplier[k];
            product[k] = self.slack[k] * l + self.excess[k] * (self.price[k] - l);
            rest[k] = (self.g[k] + self.slack[k] - self.excess[k]).abs();
        }
        (product, rest)
    }

    /// Weight, and aims and force of the predictor.
    #[inline]
    fn aim_at_zero(&mut self) {
        for k in 0..2 {
            let (l, nu) = (self.multiplier[k], self.price[k] - self.multiplier[k]);
            let weight = 1.0 / (self.slack[k] / l + self.excess[k] / nu);
            self.aim_slack[k] = 0.0;
            self.aim_excess[k] = 0.0;
            self.weight[k] = weight;
            self.force[k] = l + weight * self.g[k];
        }
    }

    /// One over the largest step that keeps each side positive.
    #[inline]
    fn shrink(&self) -> Pair {
        let mut shrink = [0.0; 2];
        for k in 0..2 {
            let nu = self.price[k] - self.multiplier[k];
            let of_excess = -self.d_excess[k] / self.excess[k];
            let of_excess = if self.excess[k] > 0.0 { of_excess } else { 0.0 };
            let of_slack = -self.d_slack[k] / self.slack[k];
            let of_multiplier = larger(
                -self.d_multiplier[k] / self.multiplier[k],
                self.d_multiplier[k] / nu,
            );
            shrink[k] = larger(larger(of_slack, of_multiplier), of_excess);
        }
        shrink
    }

    /// Complementarity of each side after a step.
    #[inline]
    fn state_after(&self, step: f64) -> Pair {
        let mut product = [0.0; 2];
        for k in 0..2 {
            let l = self.multiplier[k] + step * self.d_multiplier[k];
            product[k] = (self.slack[k] + step * self.d_slack[k]) * l
                + (self.excess[k] + step * self.d_excess[k]) * (self.price[k] - l);
        }
        product
    }

    /// Aims and force of the corrector.
    #[inline]
    fn aim_at(&mut self, target: f64, bound: f64) {
        for k in 0..2 {
            let (l, nu) = (self.multiplier[k], self.price[k] - self.multiplier[k]);
            let d_l = self.d_multiplier[k];
            let aim_slack = target - (self.d_slack[k] * d_l).clamp(-bound, bound);
            let aim_excess = target + (self.d_excess[k] * d_l).clamp(-bound, bound);
            let rest = self.g[k] + aim_slack / l - aim_excess / nu;
            self.aim_slack[k] = aim_slack;
            self.aim_excess[k] = aim_excess;
            self.force[k] = l + self.weight[k] * rest;
        }
    }

    #[inline]
    fn advance(&mut self, step: f64) {
        for k in 0..2 {
            self.slack[k] += step * self.d_slack[k];
            self.multiplier[k] += step * self.d_multiplier[k];
            self.excess[k] += step * self.d_excess[k];
        }
    }

    /// The step of the sides that goes with a change of the row.
    #[inline]
    pub(super) fn follow(&mut self, change: f64) {
        let change = [change, -change];
        let (mut d_multiplier, mut d_slack, mut d_excess) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let (s, l, e) = (self.slack[k], self.multiplier[k], self.excess[k]);
            let nu = self.price[k] - l;
            let d_l = self.force[k] - l + self.weight[k] * change[k];
            d_multiplier[k] = d_l;
            d_slack[k] = (self.aim_slack[k] - s * d_l) / l - s;
            d_excess[k] = (self.aim_excess[k] + e * d_l) / nu - e;
        }
        self.d_multiplier = d_multiplier;
        self.d_slack = d_slack;
        self.d_excess = d_excess;
    }
}

/// The sides of all rows: first those that must hold, then the elastic ones.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    pub(super) hard: Vec<HardSides>,
    pub(super) rows: Vec<TwoSides>,
}

impl Sides {
    pub(super) fn start(&mut self) {
        self.hard.iter_mut().for_each(HardSides::start);
        self.rows.iter_mut().for_each(TwoSides::start);
    }

    /// Mean complementarity and largest residual.
    pub(super) fn state(&self, pairs: f64) -> (f64, f64) {
        let (mut sum, mut residual) = (0.0, [0.0; 2]);
        let hard = self.hard.iter().map(HardSides::state);
        let rows = self.rows.iter().map(TwoSides::state);
        let mut add = |(product, rest): (Pair, Pair)| {
            for k in 0..2 {
                sum += product[k];
                residual[k] = larger(residual[k], rest[k]);
            }
        };
        hard.for_each(&mut add);
        rows.for_each(&mut add);
        (sum / pairs, larger(residual[0], residual[1]))
    }

    /// Weights, and aims and forces of the predictor.
    pub(super) fn aim_at_zero(&mut self) {
        self.hard.iter_mut().for_each(HardSides::aim_at_zero);
        self.rows.iter_mut().for_each(TwoSides::aim_at_zero);
    }

    /// The largest step that keeps all positive.
    pub(super) fn room(&self) -> f64 {
        let mut shrink = [0.0; 2];
        let mut add = |most: Pair| {
            for k in 0..2 {
                shrink[k] = larger(shrink[k], most[k]);
            }
        };
        self.hard.iter().map(HardSides::shrink).for_each(&mut add);
        self.rows.iter().map(TwoSides::shrink).for_each(&mut add);
        1.0 / larger(shrink[0], shrink[1])
    }

    /// Aims and forces of the corrector, from what the predictor has found.
    pub(super) fn aim_at(&mut self, mu: f64, pairs: f64) {
        let step = self.room().min(1.0);
        let mut sum = 0.0;
        for row in &self.hard {
            let product = row.state_after(step);
            sum += product[0];
            sum += product[1];
        }
        for row in &self.rows {
            let product = row.state_after(step);
            sum += product[0];
            sum += product[1];
        }
        let ratio = (sum / pairs / mu).powi(3);
        let target = mu
            * if ratio.is_finite() {
                ratio.clamp(1e-4, 1.0)
            } else {
                1.0
            };
        let bound = 5.0 * mu;
        for row in &mut self.hard {
            row.aim_at(target, bound);
        }
        for row in &mut self.rows {
            row.aim_at(target, bound);
        }
    }

    pub(super) fn advance(&mut self, step: f64) {
        for row in &mut self.hard {
            row.advance(step);
        }
        for row in &mut self.rows {
            row.advance(step);
        }
    }
}
