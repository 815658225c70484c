//! The sides of all rows: slacks, multipliers and excesses, and their steps.
//!
//! What they are is told in [`super::interior`]. All loops here run over plain arrays without a branch.

use super::problem::HARD;

/// μ to start from.
const START_MU: f64 = 0.05;
/// Least slack to start from.
const START_SLACK: f64 = 0.05;
/// All sides, one value each; sides 2r and 2r + 1 are the upper and the lower one of row r.
#[derive(Debug, Default)]
pub(super) struct Sides {
    /// Value of the side.
    pub(super) g: Vec<f64>,
    pub(super) slack: Vec<f64>,
    pub(super) multiplier: Vec<f64>,
    pub(super) excess: Vec<f64>,
    pub(super) price: Vec<f64>,
    pub(super) d_slack: Vec<f64>,
    pub(super) d_multiplier: Vec<f64>,
    pub(super) d_excess: Vec<f64>,
    /// What s·l and e·(p − l) are to become.
    pub(super) aim_slack: Vec<f64>,
    pub(super) aim_excess: Vec<f64>,
    /// Weight in the normal equations, and the multiplier that goes with no change of the row.
    pub(super) weight: Vec<f64>,
    pub(super) force: Vec<f64>,
}

impl Sides {
    pub(super) fn resize(&mut self, sides: usize) {
        for values in [
            &mut self.g,
            &mut self.slack,
            &mut self.multiplier,
            &mut self.excess,
            &mut self.price,
            &mut self.d_slack,
            &mut self.d_multiplier,
            &mut self.d_excess,
            &mut self.aim_slack,
            &mut self.aim_excess,
            &mut self.weight,
            &mut self.force,
        ] {
            values.clear();
            values.resize(sides, 0.0);
        }
    }

    pub(super) fn start(&mut self) {
        for i in 0..self.g.len() {
            let g = self.g[i];
            self.slack[i] = (-g).max(START_SLACK);
            self.multiplier[i] = START_MU / self.slack[i];
            if self.price[i] < HARD {
                self.excess[i] = (g + self.slack[i]).max(START_MU / (0.9 * self.price[i]));
                self.multiplier[i] = self.multiplier[i].min(0.5 * self.price[i]);
            }
        }
    }

    /// Mean complementarity and largest residual.
    pub(super) fn state(&self, pairs: f64) -> (f64, f64) {
        let (mut sum, mut residual) = (0.0, 0.0_f64);
        for i in 0..self.g.len() {
            sum += self.slack[i] * self.multiplier[i]
                + self.excess[i] * (self.price[i] - self.multiplier[i]);
            residual = residual.max((self.g[i] + self.slack[i] - self.excess[i]).abs());
        }
        (sum / pairs, residual)
    }

    /// Weights and forces for the aims.
    pub(super) fn weigh(&mut self) {
        for i in 0..self.g.len() {
            let (l, nu) = (self.multiplier[i], self.price[i] - self.multiplier[i]);
            let weight = 1.0 / (self.slack[i] / l + self.excess[i] / nu);
            let rest = self.g[i] + self.aim_slack[i] / l - self.aim_excess[i] / nu;
            self.weight[i] = weight;
            self.force[i] = l + weight * rest;
        }
    }

    /// The step of every side, from that of its row in `d_rows`.
    pub(super) fn follow(&mut self, d_rows: &[f64]) {
        for i in 0..self.g.len() {
            let change = if i % 2 == 0 {
                d_rows[i / 2]
            } else {
                -d_rows[i / 2]
            };
            let (s, l, e) = (self.slack[i], self.multiplier[i], self.excess[i]);
            let nu = self.price[i] - l;
            let d_l = self.force[i] - l + self.weight[i] * change;
            self.d_multiplier[i] = d_l;
            self.d_slack[i] = (self.aim_slack[i] - s * d_l) / l - s;
            self.d_excess[i] = (self.aim_excess[i] + e * d_l) / nu - e;
        }
    }

    /// The largest step that keeps all positive.
    pub(super) fn room(&self) -> f64 {
        let mut shrink = 0.0_f64;
        for i in 0..self.g.len() {
            let nu = self.price[i] - self.multiplier[i];
            shrink = shrink
                .max(-self.d_slack[i] / self.slack[i])
                .max(-self.d_multiplier[i] / self.multiplier[i])
                .max(self.d_multiplier[i] / nu);
            if self.excess[i] > 0.0 {
                shrink = shrink.max(-self.d_excess[i] / self.excess[i]);
            }
        }
        1.0 / shrink
    }

    /// Aims of the predictor.
    pub(super) fn aim_at_zero(&mut self) {
        self.aim_slack.fill(0.0);
        self.aim_excess.fill(0.0);
    }

    /// Aims of the corrector, from what the predictor has found.
    pub(super) fn aim_at(&mut self, mu: f64, pairs: f64) {
        let step = self.room().min(1.0);
        let mut sum = 0.0;
        for i in 0..self.g.len() {
            let l = self.multiplier[i] + step * self.d_multiplier[i];
            sum += (self.slack[i] + step * self.d_slack[i]) * l
                + (self.excess[i] + step * self.d_excess[i]) * (self.price[i] - l);
        }
        let ratio = (sum / pairs / mu).powi(3);
        let target = mu
            * if ratio.is_finite() {
                ratio.clamp(1e-4, 1.0)
            } else {
                1.0
            };
        let bound = 5.0 * mu;
        for i in 0..self.g.len() {
            let d_l = self.d_multiplier[i];
            self.aim_slack[i] = target - (self.d_slack[i] * d_l).clamp(-bound, bound);
            if self.price[i] < HARD {
                self.aim_excess[i] = target + (self.d_excess[i] * d_l).clamp(-bound, bound);
            }
        }
    }

    pub(super) fn advance(&mut self, step: f64) {
        for i in 0..self.g.len() {
            self.slack[i] += step * self.d_slack[i];
            self.multiplier[i] += step * self.d_multiplier[i];
            self.excess[i] += step * self.d_excess[i];
        }
    }
}
