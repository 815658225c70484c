//! A soft constraint, the sides of a row that may be violated at a price: slacks, multipliers and
//! excesses, and their steps. What they are is told in [`super::interior`].

use super::ahead::{Ahead, Pair, Target, larger};
use super::hard_constraint::{START_MU, START_SLACK};

/// Largest share of the price that a multiplier begins with: both l and p − l have to be above 0.
const MOST_START_R: f64 = 0.5;
/// The share of the price that p − l is taken to be at the start.
const START_REST_R: f64 = 0.9;

/// Both sides of a row that may be violated at a price.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SoftConstraint {
    price: f64,
    /// Values of the sides.
    g: Pair,
    slack: Pair,
    multiplier: Pair,
    excess: Pair,
    /// One over them, and over what the multiplier is below the price.
    per_slack: Pair,
    per_multiplier: Pair,
    per_excess: Pair,
    per_rest: Pair,
    d_slack: Pair,
    d_multiplier: Pair,
    d_excess: Pair,
    /// What s·l and e·(p − l) are to become.
    target_slack: Pair,
    target_excess: Pair,
    /// Weight in the normal equations, and the multiplier that goes with no change of the row.
    weight: Pair,
    force: Pair,
}

impl SoftConstraint {
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

    /// Sets out from the values of the sides, which may be violated at a price; complementarity and
    /// residual of each.
    #[inline]
    pub(super) fn start(&mut self, g: Pair, price: f64) -> (Pair, Pair) {
        self.price = price;
        for k in 0..2 {
            self.slack[k] = (-g[k]).max(START_SLACK);
            // With l from 0 to p/2 the product e·(p − l) is .56 to 1.11 of μ, unless the row is violated.
            self.excess[k] = (g[k] + self.slack[k]).max(START_MU / (START_REST_R * price));
            self.multiplier[k] = (START_MU / self.slack[k]).min(MOST_START_R * price);
        }
        self.stand(g)
    }

    /// Goes a share of the step, which has brought the sides to values; complementarity and residual
    /// of each.
    #[inline]
    pub(super) fn advance(&mut self, step: f64, g: Pair) -> (Pair, Pair) {
        for k in 0..2 {
            self.slack[k] += step * self.d_slack[k];
            self.multiplier[k] += step * self.d_multiplier[k];
            self.excess[k] += step * self.d_excess[k];
        }
        self.stand(g)
    }

    /// Weight, and targets and force of the predictor.
    #[inline]
    fn stand(&mut self, g: Pair) -> (Pair, Pair) {
        let (mut product, mut rest) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let (s, l, e) = (self.slack[k], self.multiplier[k], self.excess[k]);
            // The multiplier of e ≥ 0: stationarity in e is p = l + ν.
            let nu = self.price - l;
            let (of_slack, of_excess) = (s * l, e * nu);
            product[k] = of_slack + of_excess;
            rest[k] = (g[k] + s - e).abs();
            let (per_slack, per_excess) = (1.0 / of_slack, 1.0 / of_excess);
            self.per_slack[k] = per_slack * l;
            self.per_multiplier[k] = per_slack * s;
            self.per_excess[k] = per_excess * nu;
            self.per_rest[k] = per_excess * e;
            // Below l/s, that of a hard side, and below (p − l)/e, which is small once it is violated.
            let weight = 1.0 / (s * self.per_multiplier[k] + e * self.per_rest[k]);
            self.weight[k] = weight;
            self.force[k] = l + weight * g[k];
            self.target_slack[k] = 0.0;
            self.target_excess[k] = 0.0;
        }
        self.g = g;
        (product, rest)
    }

    /// Targets and force of the corrector.
    #[inline]
    pub(super) fn correct(&mut self, Target { product, bound }: Target) {
        for k in 0..2 {
            let d_l = self.d_multiplier[k];
            let target_slack = product - (self.d_slack[k] * d_l).clamp(-bound, bound);
            // ν falls as l rises: its step is −dl.
            let target_excess = product + (self.d_excess[k] * d_l).clamp(-bound, bound);
            let of_slack = target_slack * self.per_multiplier[k];
            let of_excess = target_excess * self.per_rest[k];
            self.target_slack[k] = target_slack;
            self.target_excess[k] = target_excess;
            let rest = self.g[k] + of_slack - of_excess;
            self.force[k] = self.multiplier[k] + self.weight[k] * rest;
        }
    }

    /// The step of the sides that goes with a change of the row.
    #[inline]
    pub(super) fn follow(&mut self, change: f64, ahead: &mut Ahead) {
        let change = [change, -change];
        let (mut d_slack, mut d_multiplier, mut d_excess) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for k in 0..2 {
            let (s, l, e) = (self.slack[k], self.multiplier[k], self.excess[k]);
            let (per_l, per_nu) = (self.per_multiplier[k], self.per_rest[k]);
            let d_l = self.force[k] - l + self.weight[k] * change[k];
            let d_s = (self.target_slack[k] - s * d_l) * per_l - s;
            let d_e = (self.target_excess[k] + e * d_l) * per_nu - e;
            let of_slack = larger(-d_s * self.per_slack[k], -d_e * self.per_excess[k]);
            let of_multiplier = larger(-d_l * per_l, d_l * per_nu);
            ahead.shrink[k] = larger(ahead.shrink[k], larger(of_slack, of_multiplier));
            ahead.product[k] += (d_s - d_e) * d_l;
            (d_slack[k], d_multiplier[k], d_excess[k]) = (d_s, d_l, d_e);
        }
        self.d_slack = d_slack;
        self.d_multiplier = d_multiplier;
        self.d_excess = d_excess;
    }
}
