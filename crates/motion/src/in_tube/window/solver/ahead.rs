//! The outlook of a step: how far it may go, and what products it leads to, before it is taken.

/// A value of the upper side of a row, and of the lower one: both take the same way through every
/// loop, so that one instruction does for both.
pub(super) type Pair = [f64; 2];

/// Least share of the mean product that is aimed at. With 0 the corrector would aim at the boundary
/// itself; a larger one costs iterations, for no product falls faster.
const LEAST_CENTERING: f64 = 1e-4;
/// The most that a product of steps counts, in mean products. Where the predictor is stopped short,
/// products of its whole steps can be many times that, and are of steps that nobody takes.
const MOST_CORRECTION: f64 = 5.0;

/// The target of the corrector. (An aim is a part of the objective.)
#[derive(Debug, Clone, Copy)]
pub(super) struct Target {
    /// What all products are to become.
    pub(super) product: f64,
    /// The most that a product of steps counts.
    pub(super) bound: f64,
}

impl Target {
    /// The target where the mean of the products is `mu`, and the predictor leaves a share of it:
    /// Mehrotra's cube, which hardly centres where the predictor gets far.
    pub(super) fn after(mu: f64, share: f64) -> Self {
        let ratio = share.powi(3);
        let centering = if ratio.is_finite() {
            ratio.clamp(LEAST_CENTERING, 1.0)
        } else {
            1.0
        };
        Self {
            product: mu * centering,
            bound: MOST_CORRECTION * mu,
        }
    }
}

/// How far the sides may go along a step, and what becomes of their products.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ahead {
    /// One over the largest step that keeps all positive.
    pub(super) shrink: Pair,
    /// Sum of the products of steps.
    pub(super) product: Pair,
}

impl Ahead {
    /// The largest step that keeps all positive.
    pub(super) fn room(&self) -> f64 {
        1.0 / larger(self.shrink[0], self.shrink[1])
    }

    /// Sum of all products after a step of the predictor, which would bring them to zero but for
    /// the products of steps.
    pub(super) fn sum_after(&self, sum: f64, step: f64) -> f64 {
        // (s + α·ds)(l + α·dl) with s·dl + l·ds = −s·l
        (1.0 - step) * sum + step * step * (self.product[0] + self.product[1])
    }
}

/// The larger of two values; the first one if the second is not a number.
#[inline]
pub(super) const fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
