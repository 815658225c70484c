//! Cubic B-splines with clamped ends, not rational: what a fit is made of.

use crate::point::Point;

/// Knots `x₀ x₀ x₀ x₀ … xₙ xₙ xₙ xₙ`, one more control point than there are knots but four.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spline {
    pub(crate) knots: Vec<f64>,
    pub(crate) control: Vec<Point>,
}

/// A spline as one polynomial for each knot span.
#[derive(Debug)]
pub(crate) struct Pieces {
    /// Starts of the spans, and the end of the last.
    breaks: Vec<f64>,
    /// Coefficients of 1, t, t², t³ with t = x − start.
    coefficients: Vec<[Point; 4]>,
}

/// A spline at a parameter, with its derivatives.
pub(crate) struct Value {
    pub(crate) at: Point,
    pub(crate) d1: Point,
    pub(crate) d2: Point,
}

/// Clamped knots with these inside.
pub(crate) fn clamped(first: f64, inside: &[f64], last: f64) -> Vec<f64> {
    let mut knots = vec![first; 4];
    knots.extend_from_slice(inside);
    knots.extend([last; 4]);
    knots
}

/// The knots between the ends.
pub(crate) fn inside(knots: &[f64]) -> &[f64] {
    &knots[4..knots.len() - 4]
}

/// Index of the knot at the start of the span that holds `x`, not before `hint`, from which it is
/// looked for.
pub(crate) fn span_from(knots: &[f64], x: f64, hint: usize) -> usize {
    let last = knots.len() - 5;
    let mut k = hint.clamp(3, last);
    while k < last && x >= knots[k + 1] {
        k += 1;
    }
    k
}

/// The four B-splines that are not zero on span `k`, at `x` (Piegl and Tiller, algorithm A2.2).
pub(crate) fn basis(knots: &[f64], k: usize, x: f64) -> [f64; 4] {
    let mut values = [1.0, 0.0, 0.0, 0.0];
    for j in 1..4 {
        let mut saved = 0.0;
        for r in 0..j {
            let (right, left) = (knots[k + r + 1] - x, x - knots[k + 1 + r - j]);
            let share = values[r] / (right + left);
            values[r] = saved + right * share;
            saved = left * share;
        }
        values[j] = saved;
    }
    values
}

impl Spline {
    pub(crate) fn pieces(&self) -> Pieces {
        let (mut breaks, mut coefficients) = (Vec::new(), Vec::new());
        for k in 3..self.knots.len() - 4 {
            let (a, b) = (self.knots[k], self.knots[k + 1]);
            let h = b - a;
            if h <= 0.0 {
                continue;
            }
            let [p, q, r, s] = core::array::from_fn(|ends| self.blossom(k, ends));
            breaks.push(a);
            coefficients.push([
                p,
                (q - p) * (3.0 / h),
                (p - q * 2.0 + r) * (3.0 / (h * h)),
                (s - r * 3.0 + q * 3.0 - p) / (h * h * h),
            ]);
        }
        breaks.push(self.knots[self.knots.len() - 1]);
        Pieces {
            breaks,
            coefficients,
        }
    }

    /// Bézier point number `ends` of span `k`.
    fn blossom(&self, k: usize, ends: usize) -> Point {
        let mut d: [Point; 4] = core::array::from_fn(|j| self.control[k - 3 + j]);
        for r in 1..4 {
            let x = if r <= 3 - ends {
                self.knots[k]
            } else {
                self.knots[k + 1]
            };
            for j in (r..4).rev() {
                let (low, high) = (self.knots[k - 3 + j], self.knots[k + 1 + j - r]);
                let share = (x - low) / (high - low);
                d[j] = d[j - 1] * (1.0 - share) + d[j] * share;
            }
        }
        d[3]
    }
}

impl Pieces {
    pub(crate) fn count(&self) -> usize {
        self.coefficients.len()
    }

    /// Start and end of a piece.
    pub(crate) fn bounds(&self, piece: usize) -> (f64, f64) {
        (self.breaks[piece], self.breaks[piece + 1])
    }

    /// The piece that holds `x`, looked for from `hint` both ways.
    pub(crate) fn find(&self, x: f64, hint: usize) -> usize {
        let mut piece = hint.min(self.count() - 1);
        while piece > 0 && x < self.breaks[piece] {
            piece -= 1;
        }
        while piece + 1 < self.count() && x >= self.breaks[piece + 1] {
            piece += 1;
        }
        piece
    }

    pub(crate) fn at(&self, piece: usize, x: f64) -> Point {
        let t = x - self.breaks[piece];
        let [a, b, c, d] = &self.coefficients[piece];
        ((d * t + c) * t + b) * t + a
    }

    pub(crate) fn value(&self, piece: usize, x: f64) -> Value {
        let t = x - self.breaks[piece];
        let [a, b, c, d] = &self.coefficients[piece];
        Value {
            at: ((d * t + c) * t + b) * t + a,
            d1: (d * (3.0 * t) + c * 2.0) * t + b,
            d2: d * (6.0 * t) + c * 2.0,
        }
    }

    /// Length of the jump of the third derivative between a piece and the one before it.
    pub(crate) fn jump(&self, piece: usize) -> f64 {
        6.0 * (self.coefficients[piece][3] - self.coefficients[piece - 1][3]).norm()
    }
}
