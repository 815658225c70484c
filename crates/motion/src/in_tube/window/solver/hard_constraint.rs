//! A hard constraint, the sides of a row that must hold: no excess, and less to do than for a soft one
//! ([`super::soft_constraint`]). Most rows are such.

use super::ahead::{Ahead, Pair, Target, larger};

/// μ to start from, in units of the objective. With more, the same goal takes
/// more iterations; with less, rows that turn out to bind begin next to the boundary, where steps are
/// short. No measurement of it is kept.
pub(super) const START_MU: f64 = 0.05;
/// Least slack to start from, in units of the row. A row that is violated or nearly so begins with
/// this, and its residual g + s is taken away by the steps: the start need not be inside.
pub(super) const START_SLACK: f64 = 0.05;

/// Both sides of a row, −1 ≤ v ≤ 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct HardConstraint {
    g: Pair,
    slack: Pair,
    multiplier: Pair,
    /// One over them: a division takes as long as eight multiplications.
    per_slack: Pair,
    per_multiplier: Pair,
    d_slack: Pair,
    d_multiplier: Pair,
    /// What s·l is to become.
    target: Pair,
    /// Weight in the normal equations, and the multiplier that goes with no change of the row.
    weight: Pair,
    force: Pair,
}

impl HardConstraint {
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

    /// Sets out from the value of the row; complementarity and residual of each side.
    #[inline]
    pub(super) fn start(&mut self, value: f64) -> (Pair, Pair) {
        let g = [value - 1.0, -1.0 - value];
        for k in 0..2 {
            // On the central path from the start: s·l is the same for all.
            self.slack[k] = (-g[k]).max(START_SLACK);
            self.multiplier[k] = START_MU / self.slack[k];
        }
        self.stand(g)
    }

    /// Goes a share of the step, which has brought the row to a value; complementarity and residual
    /// of each side.
    #[inline]
    pub(super) fn advance(&mut self, step: f64, value: f64) -> (Pair, Pair) {
        for k in 0..2 {
            self.slack[k] += step * self.d_slack[k];
            self.multiplier[k] += step * self.d_multiplier[k];
        }
        self.stand([value - 1.0, -1.0 - value])
    }

    /// Weight, and target and force of the predictor.
    #[inline]
    fn stand(&mut self, g: Pair) -> (Pair, Pair) {
        let (mut product, mut rest) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let (s, l) = (self.slack[k], self.multiplier[k]);
            product[k] = s * l;
            rest[k] = (g[k] + s).abs();
            let per_product = 1.0 / product[k];
            self.per_slack[k] = per_product * l;
            self.per_multiplier[k] = per_product * s;
            // w = l/s is what the side adds to the Hessian, l + w·g its multiplier at μ = 0.
            self.weight[k] = l * self.per_slack[k];
            self.force[k] = l + self.weight[k] * g[k];
            self.target[k] = 0.0;
        }
        self.g = g;
        (product, rest)
    }

    /// Target and force of the corrector.
    #[inline]
    pub(super) fn correct(&mut self, Target { product, bound }: Target) {
        for k in 0..2 {
            let target = product - (self.d_slack[k] * self.d_multiplier[k]).clamp(-bound, bound);
            self.target[k] = target;
            let rest = self.g[k] + target * self.per_multiplier[k];
            self.force[k] = self.multiplier[k] + self.weight[k] * rest;
        }
    }

    /// The step that goes with a change of the row.
    #[inline]
    pub(super) fn follow(&mut self, change: f64, ahead: &mut Ahead) {
        let change = [change, -change];
        let (mut d_slack, mut d_multiplier) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let (s, l) = (self.slack[k], self.multiplier[k]);
            let d_l = self.force[k] - l + self.weight[k] * change[k];
            // From l·ds + s·dl = target − s·l.
            let d_s = (self.target[k] - s * d_l) * self.per_multiplier[k] - s;
            let of_slack = -d_s * self.per_slack[k];
            let of_multiplier = -d_l * self.per_multiplier[k];
            ahead.shrink[k] = larger(ahead.shrink[k], larger(of_slack, of_multiplier));
            ahead.product[k] += d_s * d_l;
            (d_slack[k], d_multiplier[k]) = (d_s, d_l);
        }
        self.d_slack = d_slack;
        self.d_multiplier = d_multiplier;
    }
}
