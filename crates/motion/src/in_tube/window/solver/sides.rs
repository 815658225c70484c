//! The sides of all rows: slacks, multipliers and excesses, and their steps.
//!
//! What they are is told in [`super::interior`]. Both sides of a row lie together and take the same
//! way through every loop, so that one instruction does for both.

use super::problem::HARD;

/// μ to start from.
const START_MU: f64 = 0.05;
/// Least slack to start from.
const START_SLACK: f64 = 0.05;

/// A value of the upper side of a row, and of the lower one.
pub(super) type Pair = [f64; 2];

/// Both sides of a row.
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

    /// How much an elastic row is violated, below zero if it is not; `None` for a hard one.
    pub(super) const fn violation(&self) -> Option<f64> {
        if self.price[0] < HARD {
            Some(self.g[0].max(self.g[1]))
        } else {
            None
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

/// The sides of all rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    pub(super) rows: Vec<TwoSides>,
}

impl Sides {
    pub(super) fn start(&mut self) {
        for row in &mut self.rows {
            for k in 0..2 {
                let g = row.g[k];
                row.slack[k] = (-g).max(START_SLACK);
                row.multiplier[k] = START_MU / row.slack[k];
                if row.price[k] < HARD {
                    row.excess[k] = (g + row.slack[k]).max(START_MU / (0.9 * row.price[k]));
                    row.multiplier[k] = row.multiplier[k].min(0.5 * row.price[k]);
                }
            }
        }
    }

    /// Mean complementarity and largest residual.
    pub(super) fn state(&self, pairs: f64) -> (f64, f64) {
        let (mut sum, mut residual) = (0.0, [0.0; 2]);
        for row in &self.rows {
            let (mut product, mut rest) = ([0.0; 2], [0.0; 2]);
            for k in 0..2 {
                let l = row.multiplier[k];
                product[k] = row.slack[k] * l + row.excess[k] * (row.price[k] - l);
                rest[k] = (row.g[k] + row.slack[k] - row.excess[k]).abs();
            }
            for k in 0..2 {
                sum += product[k];
                residual[k] = larger(residual[k], rest[k]);
            }
        }
        (sum / pairs, larger(residual[0], residual[1]))
    }

    /// Weights, and aims and forces of the predictor.
    pub(super) fn aim_at_zero(&mut self) {
        for row in &mut self.rows {
            for k in 0..2 {
                let (l, nu) = (row.multiplier[k], row.price[k] - row.multiplier[k]);
                let weight = 1.0 / (row.slack[k] / l + row.excess[k] / nu);
                row.aim_slack[k] = 0.0;
                row.aim_excess[k] = 0.0;
                row.weight[k] = weight;
                row.force[k] = l + weight * row.g[k];
            }
        }
    }

    /// The largest step that keeps all positive.
    pub(super) fn room(&self) -> f64 {
        let mut shrink = [0.0; 2];
        for row in &self.rows {
            for k in 0..2 {
                let nu = row.price[k] - row.multiplier[k];
                let of_excess = -row.d_excess[k] / row.excess[k];
                let of_excess = if row.excess[k] > 0.0 { of_excess } else { 0.0 };
                let of_slack = -row.d_slack[k] / row.slack[k];
                let of_multiplier = larger(
                    -row.d_multiplier[k] / row.multiplier[k],
                    row.d_multiplier[k] / nu,
                );
                let most = larger(larger(of_slack, of_multiplier), of_excess);
                shrink[k] = larger(shrink[k], most);
            }
        }
        1.0 / larger(shrink[0], shrink[1])
    }

    /// Aims and forces of the corrector, from what the predictor has found.
    pub(super) fn aim_at(&mut self, mu: f64, pairs: f64) {
        let step = self.room().min(1.0);
        let mut sum = 0.0;
        for row in &self.rows {
            let mut product = [0.0; 2];
            for k in 0..2 {
                let l = row.multiplier[k] + step * row.d_multiplier[k];
                product[k] = (row.slack[k] + step * row.d_slack[k]) * l
                    + (row.excess[k] + step * row.d_excess[k]) * (row.price[k] - l);
            }
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
        for row in &mut self.rows {
            for k in 0..2 {
                let (l, nu) = (row.multiplier[k], row.price[k] - row.multiplier[k]);
                let d_l = row.d_multiplier[k];
                let aim_slack = target - (row.d_slack[k] * d_l).clamp(-bound, bound);
                let aim_excess = target + (row.d_excess[k] * d_l).clamp(-bound, bound);
                let aim_excess = if row.price[k] < HARD { aim_excess } else { 0.0 };
                let rest = row.g[k] + aim_slack / l - aim_excess / nu;
                row.aim_slack[k] = aim_slack;
                row.aim_excess[k] = aim_excess;
                row.force[k] = l + row.weight[k] * rest;
            }
        }
    }

    pub(super) fn advance(&mut self, step: f64) {
        for row in &mut self.rows {
            for k in 0..2 {
                row.slack[k] += step * row.d_slack[k];
                row.multiplier[k] += step * row.d_multiplier[k];
                row.excess[k] += step * row.d_excess[k];
            }
        }
    }
}

/// The larger of two values; the first one if the second is not a number.
#[inline]
const fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
