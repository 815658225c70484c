//! Newton's method with a logarithmic barrier, over the coefficients of b.
//!
//! At each place slope and bend of the barrier are collected over b, b′ and b″, and brought to the
//! three coefficients at once.

use super::constraints::{Part, Place, Problem, Row};
use super::fineness::Fineness;

/// The weight of the time at the start, in limits for the time that the start takes.
const START: f64 = 5.0;
/// Steps of Newton's method for one weight of the barrier.
const STEPS: u32 = 60;
/// The square of a step, in the measure of the barrier, that is small whatever the number of knots.
const SMALL_STEP: f64 = 1.0;
/// The weight of the time grows by this factor when a step is small.
const GROWTH: f64 = 50.0;
/// Halvings of a step that would leave the limits.
const HALVINGS: u32 = 40;

/// Coefficients of a time parametrisation that keeps all limits and takes near the least time, from
/// one that keeps them with room to spare; `None` if the start does not.
pub(crate) fn solve(problem: &Problem, start: Vec<f64>, fineness: &Fineness) -> Option<Vec<f64>> {
    let mut x = start;
    let time_t = problem.time(&x);
    let mut weight = START * problem.count as f64 / time_t;
    let last = 3.0 * problem.knots as f64 / (fineness.gap_r * time_t);
    let small_step = (fineness.small_r * problem.knots as f64).max(SMALL_STEP);
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
        if !(1e-100..=1e100).contains(&self.product) {
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

/// Slope and bend of the objective at a place, over b, b′ and b″.
#[derive(Default)]
struct Local {
    slope: [f64; 3],
    /// bb, bb′, bb″, b′b′, b′b″, b″b″.
    bend: [f64; 6],
}

impl Local {
    fn at(place: &Place, rows: &[Row], [b, b1, b2]: [f64; 3], weight: f64) -> Self {
        let mut local = Self::default();
        let inverse = 1.0 / b;
        let root = inverse.sqrt();
        if place.share_s > 0.0 {
            let slope = 0.5 * weight * place.share_s * inverse * root;
            local.slope[0] -= slope;
            local.bend[0] += 1.5 * slope * inverse;
        }
        if place.cap_b.is_finite() {
            let near = 1.0 / (place.cap_b - b);
            local.slope[0] += near;
            local.bend[0] += near * near;
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

    /// A limit both ways: `used` = `of`·(b, b′) within ±`allowed`, whatever b is.
    #[inline]
    fn both_fixed(&mut self, of: [f64; 2], used: f64, allowed: f64) {
        let [c0, c1] = of;
        let product = 1.0 / ((allowed - used) * (allowed + used));
        let (above, below) = ((allowed + used) * product, (allowed - used) * product);
        let difference = above - below;
        self.slope[0] += difference * c0;
        self.slope[1] += difference * c1;
        let square = above * above + below * below;
        self.bend[0] += square * (c0 * c0);
        self.bend[1] += square * c0 * c1;
        self.bend[3] += square * c1 * c1;
    }

    /// A limit both ways: `used` = `of`·(b, b′, b″) within ±`allowed`, which changes by `change`
    /// with b.
    #[inline]
    fn both(&mut self, of: [f64; 3], used: f64, allowed: f64, change: f64) {
        let [c0, c1, c2] = of;
        let product = 1.0 / ((allowed - used) * (allowed + used));
        let (above, below) = ((allowed + used) * product, (allowed - used) * product);
        let (difference, sum) = (above - below, above + below);
        self.slope[0] += difference * c0 - sum * change;
        self.slope[1] += difference * c1;
        self.slope[2] += difference * c2;
        let square = above * above + below * below;
        let cross = -difference * sum * change;
        self.bend[0] += square * (c0 * c0 + change * change) + 2.0 * cross * c0;
        self.bend[1] += (square * c0 + cross) * c1;
        self.bend[2] += (square * c0 + cross) * c2;
        self.bend[3] += square * c1 * c1;
        self.bend[4] += square * c1 * c2;
        self.bend[5] += square * c2 * c2;
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

    /// Brings slope and bend over b alone to the three coefficients of a place.
    #[inline]
    fn add_value(&mut self, place: &Place, local: &Local) {
        let v = &place.taylor.value;
        let gradient = &mut self.gradient[place.first..place.first + 3];
        let band = &mut self.band[place.first..place.first + 3];
        for i in 0..3 {
            gradient[i] += local.slope[0] * v[i];
            for j in i..3 {
                band[i][j - i] += local.bend[0] * v[i] * v[j];
            }
        }
    }

    /// Brings slope and bend at an end of an interval to its three coefficients. b and b′ depend on
    /// two of them, `I` and `J`, `I` < `J`; on the third, `K`, only b″ does.
    #[inline]
    fn add<const I: usize, const J: usize, const K: usize>(
        &mut self,
        place: &Place,
        local: &Local,
    ) {
        let (v, s, c) = (
            &place.taylor.value,
            &place.taylor.slope,
            &place.taylor.second,
        );
        let [g0, g1, g2] = local.slope;
        let [h00, h01, h02, h11, h12, h22] = local.bend;
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
                && next_value <= value - 0.1 * share * decrement
            {
                return Some(next_value);
            }
            share *= 0.5;
        }
        None
    }
}
