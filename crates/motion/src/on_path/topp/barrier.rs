//! Newton's method with a logarithmic barrier, over the coefficients of b.
//!
//! What is minimised, with a weight that grows, is
//!
//! ```text
//!     weight · Σ share/√b  −  Σ ln(1 − b/cap)  −  Σ ln(1 − (used/A)²)  −  Σ ln(1/b − (used/J)²)
//! ```
//!
//! where `used` is what of an acceleration, or of a jerk over √b, an axis is asked for: linear in b, b′
//! and b″. The weight is per second, the shares are in mm. The last logarithm is that of both sides of
//! |used| ≤ J/√b, less 2·ln J: its argument has a unit, s²/mm², which shifts the value by a constant and no
//! step. At each place gradient and Hessian are collected over b, b′ and b″, and brought to the three
//! coefficients at once: a third of the work that limits took which were brought there one by one.
//!
//! *Convexity.* Time, top speeds and accelerations are convex. The jerk is not: |used| ≤ J/√b bounds by a
//! convex function of b. In its Hessian the second derivative of J/√b is left out, as if the bound were
//! its tangent at the present b. What is left has no negative eigenvalue, so each step goes downhill, and
//! the search along it is by what the limits really are. What is found is a local optimum.
//!
//! An iterate never leaves the limits, unlike one of the primal-dual method in the tube: whatever is at hand
//! when steps no longer gain is a motion that keeps them at its places.

use super::constraints::{ConstraintPoint, Part, Problem, Row};
use super::solver_tolerances::SolverTolerances;

/// The first weight of the time, in limits for the time that the initial iterate takes: the barrier then
/// leaves a fifth of that to be gained. With less, the first steps lead away from the limits, to come back
/// later; with more, they begin next to limits that the iterate is near.
const START: f64 = 5.0;
/// Steps of Newton's method for one weight of the barrier, at most. Where they do not do, the next weight
/// begins from what there is. No measurement of it is kept.
const STEPS: u32 = 60;
/// The square of a step, gᵀH⁻¹g (Newton's decrement), that is small whatever the number of knots: about
/// half as much is still to be gained of the weighted time and the barrier.
const SMALL_STEP: f64 = 1.0;
/// The weight of the time grows by this factor when a step is small. A larger one needs fewer weights and
/// more steps for each. No measurement of it is kept.
const GROWTH: f64 = 50.0;
/// How many limits a knot is counted as: a barrier of m limits leaves m/weight to be gained. There are more
/// ([`Problem::count`], of three axes some twenty at a knot), most of them far from binding; where more than
/// three bind, more is left than [`SolverTolerances::gap_r`]. Why three is not on record.
const LIMITS_OF_KNOT: f64 = 3.0;
/// Halvings of a step that would leave the limits.
const HALVINGS: u32 = 40;
/// Share of what a step promises, decrement times its length, that it has to gain (Armijo).
const PROMISED_R: f64 = 0.1;
/// Between these a product of factors is kept without taking its logarithm: far enough from the ends of a
/// double that one more factor cannot pass them.
const PRODUCTS: core::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Coefficients of a time parametrisation that keeps all limits and takes near the least time, from
/// one that keeps them with room to spare; `None` if that does not.
pub(crate) fn solve(
    problem: &Problem,
    initial: Vec<f64>,
    tolerances: &SolverTolerances,
) -> Option<Vec<f64>> {
    let mut x = initial;
    let time_t = problem.time(&x);
    let mut weight = START * problem.count as f64 / time_t;
    // Of the time of the initial iterate, which is longer than the least: the gap is a little wider than asked for.
    let last = LIMITS_OF_KNOT * problem.knots as f64 / (tolerances.gap_r * time_t);
    let small_step = (tolerances.small_r * problem.knots as f64).max(SMALL_STEP);
    let mut value = merit(problem, &x, weight)?;
    let mut newton = Newton::new(x.len());
    loop {
        for _ in 0..STEPS {
            newton.assemble(problem, &x, weight);
            let decrement = newton.solve();
            if decrement.is_nan() || decrement < small_step {
                break;
            }
            let Some(next_value) = newton.search(problem, &x, weight, value, decrement) else {
                break;
            };
            core::mem::swap(&mut x, &mut newton.next);
            value = next_value;
        }
        if weight >= last {
            return Some(x);
        }
        weight = (weight * GROWTH).min(last);
        value = merit(problem, &x, weight)?;
    }
}

/// Sums logarithms: one of a product of several numbers is enough.
struct Logarithms {
    sum: f64,
    product: f64,
}

impl Logarithms {
    /// Takes a factor; false if it is not above zero.
    #[inline]
    fn take(&mut self, factor: f64) -> bool {
        self.product *= factor;
        if !PRODUCTS.contains(&self.product) {
            self.sum += self.product.ln();
            self.product = 1.0;
        }
        // Refuses what is not a number, too.
        factor > 0.0
    }
}

/// Weighted time and barrier; `None` where a limit is broken.
fn merit(problem: &Problem, x: &[f64], weight: f64) -> Option<f64> {
    let (mut time_t, mut from) = (0.0, 0);
    let mut logarithms = Logarithms {
        sum: 0.0,
        product: 1.0,
    };
    for place in &problem.places {
        let [b, slope, second] = place.values(x);
        let mut is_kept = b > 0.0;
        if place.cap_b.is_finite() {
            is_kept &= logarithms.take(1.0 - b / place.cap_b);
        }
        for row in &problem.rows[from..place.rows_end] {
            let ([a0, a1], [j0, j1, j2]) = (row.accel(), row.jerk());
            if row.most_a.is_finite() {
                let used_r = (a0 * b + a1 * slope) / row.most_a;
                is_kept &= logarithms.take(1.0 - used_r * used_r);
            }
            if row.most_j.is_finite() {
                let used_r = (j0 * b + j1 * slope + j2 * second) / row.most_j;
                // Both sides at once, (J/√b − used)(J/√b + used) over J².
                is_kept &= logarithms.take(1.0 / b - used_r * used_r);
            }
        }
        if !is_kept {
            return None;
        }
        from = place.rows_end;
        if place.share_s > 0.0 {
            time_t += place.share_s / b.sqrt();
        }
    }
    let barrier = -(logarithms.sum + logarithms.product.ln());
    (time_t.is_finite() && barrier.is_finite()).then_some(weight * time_t + barrier)
}

/// Gradient and Hessian of what is minimised at a place, over b, b′ and b″.
#[derive(Default)]
struct Local {
    gradient: [f64; 3],
    /// bb, bb′, bb″, b′b′, b′b″, b″b″.
    hessian: [f64; 6],
}

impl Local {
    fn at(place: &ConstraintPoint, rows: &[Row], [b, b1, b2]: [f64; 3], weight: f64) -> Self {
        let mut local = Self::default();
        let inverse = 1.0 / b;
        let root = inverse.sqrt();
        // Of share·b^(−1/2): −½·share·b^(−3/2) and ¾·share·b^(−5/2).
        if place.share_s > 0.0 {
            let pull = 0.5 * weight * place.share_s * inverse * root;
            local.gradient[0] -= pull;
            local.hessian[0] += 1.5 * pull * inverse;
        }
        if place.cap_b.is_finite() {
            let near = 1.0 / (place.cap_b - b);
            local.gradient[0] += near;
            local.hessian[0] += near * near;
        }
        for row in rows {
            if row.most_a.is_finite() {
                let [c0, c1] = row.accel();
                local.both_fixed([c0, c1], c0 * b + c1 * b1, row.most_a);
            }
            if row.most_j.is_finite() {
                let [c0, c1, c2] = row.jerk();
                let used = c0 * b + c1 * b1 + c2 * b2;
                let allowed = row.most_j * root;
                local.both([c0, c1, c2], used, allowed, -0.5 * allowed * inverse);
            }
        }
        local
    }

    /// A limit both ways: `used` = `of`·(b, b′) within ±`allowed`, whatever b is. Of
    /// −ln(allowed − used) − ln(allowed + used); `above` and `below` are the reciprocals.
    #[inline]
    fn both_fixed(&mut self, of: [f64; 2], used: f64, allowed: f64) {
        let [c0, c1] = of;
        let product = 1.0 / ((allowed - used) * (allowed + used));
        let (above, below) = ((allowed + used) * product, (allowed - used) * product);
        let difference = above - below;
        self.gradient[0] += difference * c0;
        self.gradient[1] += difference * c1;
        let square = above * above + below * below;
        self.hessian[0] += square * (c0 * c0);
        self.hessian[1] += square * c0 * c1;
        self.hessian[3] += square * c1 * c1;
    }

    /// A limit both ways: `used` = `of`·(b, b′, b″) within ±`allowed`, which changes by `change`
    /// with b, and linearly as far as the Hessian is concerned (see above).
    #[inline]
    fn both(&mut self, of: [f64; 3], used: f64, allowed: f64, change: f64) {
        let [c0, c1, c2] = of;
        let product = 1.0 / ((allowed - used) * (allowed + used));
        let (above, below) = ((allowed + used) * product, (allowed - used) * product);
        let (difference, sum) = (above - below, above + below);
        self.gradient[0] += difference * c0 - sum * change;
        self.gradient[1] += difference * c1;
        self.gradient[2] += difference * c2;
        let square = above * above + below * below;
        let cross = -difference * sum * change;
        self.hessian[0] += square * (c0 * c0 + change * change) + 2.0 * cross * c0;
        self.hessian[1] += (square * c0 + cross) * c1;
        self.hessian[2] += (square * c0 + cross) * c2;
        self.hessian[3] += square * c1 * c1;
        self.hessian[4] += square * c1 * c2;
        self.hessian[5] += square * c2 * c2;
    }
}

/// Gradient, banded second derivative and step.
struct Newton {
    gradient: Vec<f64>,
    /// Diagonal and two bands above it.
    band: Vec<[f64; 3]>,
    step: Vec<f64>,
    /// What the last search found.
    next: Vec<f64>,
}

impl Newton {
    fn new(count: usize) -> Self {
        Self {
            gradient: vec![0.0; count],
            band: vec![[0.0; 3]; count],
            step: vec![0.0; count],
            next: vec![0.0; count],
        }
    }

    fn assemble(&mut self, problem: &Problem, x: &[f64], weight: f64) {
        self.gradient.fill(0.0);
        self.band.fill([0.0; 3]);
        let mut from = 0;
        for place in &problem.places {
            let rows = &problem.rows[from..place.rows_end];
            from = place.rows_end;
            let local = Local::at(place, rows, place.values(x), weight);
            match place.part {
                Part::Inside => self.add_value(place, &local),
                Part::Start => self.add::<0, 1, 2>(place, &local),
                Part::End => self.add::<1, 2, 0>(place, &local),
            }
        }
        // One or two coefficients at either end are given.
        let count = x.len();
        let [first, last] = problem.given;
        for fixed in (0..first).chain(count - last..count) {
            self.gradient[fixed] = 0.0;
            self.band[fixed] = [1.0, 0.0, 0.0];
            if fixed >= 1 {
                self.band[fixed - 1][1] = 0.0;
            }
            if fixed >= 2 {
                self.band[fixed - 2][2] = 0.0;
            }
        }
    }

    /// Brings gradient and Hessian over b alone to the three coefficients of a place.
    #[inline]
    fn add_value(&mut self, place: &ConstraintPoint, local: &Local) {
        let v = &place.taylor.value;
        let gradient = &mut self.gradient[place.first..place.first + 3];
        let band = &mut self.band[place.first..place.first + 3];
        for i in 0..3 {
            gradient[i] += local.gradient[0] * v[i];
            for j in i..3 {
                band[i][j - i] += local.hessian[0] * v[i] * v[j];
            }
        }
    }

    /// Brings gradient and Hessian at an end of an interval to its three coefficients. b and b′ depend on
    /// two of them, `I` and `J`, `I` < `J`; on the third, `K`, only b″ does.
    #[inline]
    fn add<const I: usize, const J: usize, const K: usize>(
        &mut self,
        place: &ConstraintPoint,
        local: &Local,
    ) {
        let (v, s, c) = (
            &place.taylor.value,
            &place.taylor.slope,
            &place.taylor.second,
        );
        let [g0, g1, g2] = local.gradient;
        let [h00, h01, h02, h11, h12, h22] = local.hessian;
        let gradient = &mut self.gradient[place.first..place.first + 3];
        let band = &mut self.band[place.first..place.first + 3];
        for i in [I, J] {
            gradient[i] += g0 * v[i] + g1 * s[i] + g2 * c[i];
            let of_b = h00 * v[i] + h01 * s[i] + h02 * c[i];
            let of_slope = h01 * v[i] + h11 * s[i] + h12 * c[i];
            let of_second = h02 * v[i] + h12 * s[i] + h22 * c[i];
            band[i][0] += of_b * v[i] + of_slope * s[i] + of_second * c[i];
            if i == I {
                band[I][J - I] += of_b * v[J] + of_slope * s[J] + of_second * c[J];
            }
            let (low, high) = if i < K { (i, K) } else { (K, i) };
            band[low][high - low] += of_second * c[K];
        }
        gradient[K] += g2 * c[K];
        band[K][0] += h22 * c[K] * c[K];
    }

    /// Factorises, and solves for the step; gives the square of its size in the measure of the
    /// barrier.
    fn solve(&mut self) -> f64 {
        let count = self.band.len();
        for k in 0..count {
            let [diagonal, one, two] = self.band[k];
            // Rounding alone can leave none. The step is huge then, and the search refuses it.
            let pivot = if diagonal > 0.0 {
                diagonal
            } else {
                f64::MIN_POSITIVE
            };
            let (l1, l2) = (one / pivot, two / pivot);
            if k + 1 < count {
                self.band[k + 1][0] -= l1 * one;
                self.band[k + 1][1] -= l1 * two;
            }
            if k + 2 < count {
                self.band[k + 2][0] -= l2 * two;
            }
            self.band[k] = [pivot, l1, l2];
        }
        for k in 0..count {
            let mut value = -self.gradient[k];
            if k >= 1 {
                value -= self.band[k - 1][1] * self.step[k - 1];
            }
            if k >= 2 {
                value -= self.band[k - 2][2] * self.step[k - 2];
            }
            self.step[k] = value;
        }
        for k in (0..count).rev() {
            let [pivot, l1, l2] = self.band[k];
            let mut value = self.step[k] / pivot;
            if k + 1 < count {
                value -= l1 * self.step[k + 1];
            }
            if k + 2 < count {
                value -= l2 * self.step[k + 2];
            }
            self.step[k] = value;
        }
        let product = self.gradient.iter().zip(&self.step).map(|(g, s)| g * s);
        -product.sum::<f64>()
    }

    /// Puts a point along the step that is better into `next`; how good it is.
    fn search(
        &mut self,
        problem: &Problem,
        x: &[f64],
        weight: f64,
        value: f64,
        decrement: f64,
    ) -> Option<f64> {
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            for ((next, x), step) in self.next.iter_mut().zip(x).zip(&self.step) {
                *next = x + share * step;
            }
            if let Some(next_value) = merit(problem, &self.next, weight)
                && next_value <= value - PROMISED_R * share * decrement
            {
                return Some(next_value);
            }
            share *= 0.5;
        }
        None
    }
}
