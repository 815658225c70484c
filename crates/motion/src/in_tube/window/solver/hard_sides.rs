//! The sides of a row that must hold: no excess, and less to do than for an elastic one
//! ([`super::sides`]), with the same values to the bit. Most rows are such.

/// A value of the upper side of a row, and of the lower one.
pub(super) type Pair = [f64; 2];

/// μ to start from.
pub(super) const START_MU: f64 = 0.05;
/// Least slack to start from.
pub(super) const START_SLACK: f64 = 0.05;

/// Both sides of a row, −1 ≤ v ≤ 1.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct HardSides {
    g: Pair,
    slack: Pair,
    multiplier: Pair,
    d_slack: Pair,
    d_multiplier: Pair,
    /// What s·l is to become.
    aim: Pair,
    /// Weight in the normal equations, and the multiplier that goes with no change of the row.
    weight: Pair,
    force: Pair,
}

impl HardSides {
    /// Takes the value of the row.
    #[inline]
    pub(super) const fn set(&mut self, value: f64) {
        self.g = [value - 1.0, -1.0 - value];
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

    pub(super) fn start(&mut self) {
        for k in 0..2 {
            self.slack[k] = (-self.g[k]).max(START_SLACK);
            self.multiplier[k] = START_MU / self.slack[k];
        }
    }

    /// Complementarity and residual of each side.
    #[inline]
    pub(super) fn state(&self) -> (Pair, Pair) {
        let (mut product, mut rest) = ([0.0; 2], [0.0; 2]);
        for k in 0..2 {
            product[k] = self.slack[k] * self.multiplier[k];
            rest[k] = (self.g[k] + self.slack[k]).abs();
        }
        (product, rest)
    }

    /// Weight, and aim and force of the predictor.
    #[inline]
    pub(super) fn aim_at_zero(&mut self) {
        for k in 0..2 {
            let l = self.multiplier[k];
            let weight = 1.0 / (self.slack[k] / l);
            self.aim[k] = 0.0;
            self.weight[k] = weight;
            self.force[k] = l + weight * self.g[k];
        }
    }

    /// The step that goes with a change of the row.
    #[inline]
    pub(super) fn follow(&mut self, change: f64) {
        let change = [change, -change];
        for k in 0..2 {
            let (s, l) = (self.slack[k], self.multiplier[k]);
            let d_l = self.force[k] - l + self.weight[k] * change[k];
            self.d_multiplier[k] = d_l;
            self.d_slack[k] = (self.aim[k] - s * d_l) / l - s;
        }
    }

    /// One over the largest step that keeps each side positive.
    #[inline]
    pub(super) fn shrink(&self) -> Pair {
        let mut shrink = [0.0; 2];
        for k in 0..2 {
            let of_slack = -self.d_slack[k] / self.slack[k];
            let of_multiplier = -self.d_multiplier[k] / self.multiplier[k];
            shrink[k] = larger(of_slack, of_multiplier);
        }
        shrink
    }

    /// Complementarity of each side after a step.
    #[inline]
    pub(super) fn state_after(&self, step: f64) -> Pair {
        let mut product = [0.0; 2];
        for k in 0..2 {
            let l = self.multiplier[k] + step * self.d_multiplier[k];
            product[k] = (self.slack[k] + step * self.d_slack[k]) * l;
        }
        product
    }

    /// Aim and force of the corrector.
    #[inline]
    pub(super) fn aim_at(&mut self, target: f64, bound: f64) {
        for k in 0..2 {
            let l = self.multiplier[k];
            let aim = target - (self.d_slack[k] * self.d_multiplier[k]).clamp(-bound, bound);
            let rest = self.g[k] + aim / l;
            self.aim[k] = aim;
            self.force[k] = l + self.weight[k] * rest;
        }
    }

    #[inline]
    pub(super) fn advance(&mut self, step: f64) {
        for k in 0..2 {
            self.slack[k] += step * self.d_slack[k];
            self.multiplier[k] += step * self.d_multiplier[k];
        }
    }
}

/// The larger of two values; the first one if the second is not a number.
#[inline]
pub(super) const fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
