//! Newton's method with a logarithmic barrier, over the coefficients of b.

use super::constraints::{Constraint, Problem};

/// The weight of the time at the start, in limits for the time that the start takes.
const START: f64 = 5.0;
/// Steps of Newton's method for one weight of the barrier, and in all.
const STEPS: u32 = 60;
/// The weight of the time grows by this factor when a step is small.
const GROWTH: f64 = 5.0;
/// The square of a step, in the measure of the barrier, that counts as small.
const SMALL_STEP: f64 = 1.0;
/// Halvings of a step that would leave the limits.
const HALVINGS: u32 = 40;
/// What is left to gain in the end, as a share of the time.
const GAP_R: f64 = 2e-5;

/// Coefficients of a time parametrisation that keeps all limits and takes near the least time, from
/// one that keeps them with room to spare; `None` if the start does not.
pub(crate) fn solve(problem: &Problem, start: Vec<f64>) -> Option<Vec<f64>> {
    let mut x = start;
    let time_t = problem.time(&x);
    let count = problem.knots() as f64;
    let mut weight = START * problem.constraints.len() as f64 / time_t;
    let last = 3.0 * count / (GAP_R * time_t);
    let mut value = merit(problem, &x, weight)?;
    let mut newton = Newton::new(x.len());
    loop {
        for _ in 0..STEPS {
            newton.assemble(problem, &x, weight);
            let decrement = newton.solve();
            if decrement.is_nan() || decrement < SMALL_STEP {
                break;
            }
            let Some((next, next_value)) = newton.search(problem, &x, weight, value, decrement)
            else {
                break;
            };
            (x, value) = (next, next_value);
        }
        if weight >= last {
            return Some(x);
        }
        weight = (weight * GROWTH).min(last);
        value = merit(problem, &x, weight)?;
    }
}

/// Weighted time and barrier; `None` where a limit is broken.
fn merit(problem: &Problem, x: &[f64], weight: f64) -> Option<f64> {
    let mut sum = 0.0;
    // Products of a few slacks: one logarithm for several constraints.
    let mut product = 1.0_f64;
    for constraint in &problem.constraints {
        let slack = constraint.slack(x);
        // Refuses what is not a number, too.
        let is_kept = slack > 0.0;
        if !is_kept {
            return None;
        }
        product *= slack / constraint.limit;
        if !(1e-100..=1e100).contains(&product) {
            sum -= product.ln();
            product = 1.0;
        }
    }
    sum -= product.ln();
    let time_t = problem.time(x);
    (time_t.is_finite() && sum.is_finite()).then_some(weight * time_t + sum)
}

/// Gradient, banded second derivative and step.
struct Newton {
    gradient: Vec<f64>,
    /// Diagonal and two bands above it.
    band: Vec<[f64; 3]>,
    step: Vec<f64>,
}

impl Newton {
    fn new(count: usize) -> Self {
        Self {
            gradient: vec![0.0; count],
            band: vec![[0.0; 3]; count],
            step: vec![0.0; count],
        }
    }

    fn assemble(&mut self, problem: &Problem, x: &[f64], weight: f64) {
        self.gradient.fill(0.0);
        self.band.fill([0.0; 3]);
        for knot in &problem.knots {
            let b = knot.value(x);
            let root = b.sqrt();
            let slope = -0.5 * weight * knot.share_s / (b * root);
            let bend = 0.75 * weight * knot.share_s / (b * b * root);
            self.add(knot.first, &knot.of, slope, bend);
        }
        for constraint in &problem.constraints {
            let (slack, slope) = constraint.slack_and_slope(x);
            self.add(
                constraint.first,
                &slope,
                -1.0 / slack,
                1.0 / (slack * slack),
            );
        }
        // The two coefficients at either end are given.
        let count = x.len();
        for fixed in [0, 1, count - 2, count - 1] {
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

    fn add(&mut self, first: usize, of: &[f64; 3], slope: f64, bend: f64) {
        for i in 0..3 {
            self.gradient[first + i] += slope * of[i];
            for j in i..3 {
                self.band[first + i][j - i] += bend * of[i] * of[j];
            }
        }
    }

    /// Factorises, and solves for the step; gives the square of its size in the measure of the
    /// barrier.
    fn solve(&mut self) -> f64 {
        let count = self.band.len();
        for k in 0..count {
            let [diagonal, one, two] = self.band[k];
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

    /// A point along the step that is better.
    fn search(
        &self,
        problem: &Problem,
        x: &[f64],
        weight: f64,
        value: f64,
        decrement: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            let next: Vec<f64> = x
                .iter()
                .zip(&self.step)
                .map(|(x, s)| x + share * s)
                .collect();
            if let Some(next_value) = merit(problem, &next, weight)
                && next_value <= value - 0.1 * share * decrement
            {
                return Some((next, next_value));
            }
            share *= 0.5;
        }
        None
    }
}

impl Constraint {
    fn dot(of: &[f64; 3], x: &[f64; 3]) -> f64 {
        of[0] * x[0] + of[1] * x[1] + of[2] * x[2]
    }

    fn near(&self, x: &[f64]) -> [f64; 3] {
        [x[self.first], x[self.first + 1], x[self.first + 2]]
    }

    /// How much is left of the limit; not a number where b is not above zero.
    pub(crate) fn slack(&self, x: &[f64]) -> f64 {
        let x = self.near(x);
        let used = Self::dot(&self.of, &x);
        match &self.root_of {
            Some(of) => self.limit / Self::dot(of, &x).sqrt() - used,
            None => self.limit - used,
        }
    }

    fn slack_and_slope(&self, x: &[f64]) -> (f64, [f64; 3]) {
        let x = self.near(x);
        let used = Self::dot(&self.of, &x);
        let slope = self.of.map(|c| -c);
        match &self.root_of {
            Some(of) => {
                let b = Self::dot(of, &x);
                let allowed = self.limit / b.sqrt();
                let change = -0.5 * allowed / b;
                let slope = core::array::from_fn(|i| slope[i] + change * of[i]);
                (allowed - used, slope)
            }
            None => (self.limit - used, slope),
        }
    }
}
