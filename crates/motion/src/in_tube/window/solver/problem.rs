//! The convex sub-problem of a window: a uniform cubic B-spline in time, linear rows.
//!
//! Unknown are the control points x₀ … x_{M+2} of M knot intervals; the first three are the state
//! the window starts from, the last three are equal: the window ends at rest. All limits are bounds
//! of differences of control points, and hold in continuous time: jerk is constant in an interval
//! and is the third difference, acceleration is linear between knots, where it is the second
//! difference, and velocity lies in the hull of first differences.
//!
//! ```text
//!     maximise   Σ aim_k · x_k  −  ½ Σ attraction · |offset across the path|²  −  ½ Σ jerk · |Δ³x|²
//!     subject to |Δⁿ x|  ≤ bound        every axis, n = 1, 2, 3         hard
//!                low ≤ normal · Σ wᵢ x_{m+i} ≤ high                      soft: at a price
//!                low ≤ Σ partᵢ · x_{m+i} ≤ high                          soft, for joints
//! ```
//!
//! That is a convex quadratic program: of the negative objective the gradient is −aim plus the pulls
//! of attraction and jerk, and the Hessian, Σ attraction · (I − t·tᵀ) + Σ jerk · Δ³ᵀΔ³ with t along the path, has
//! no negative eigenvalue and does not depend on x. All that is round (the tube, the feed) is left
//! outside, as planes learnt between problems ([`super::super::cutting_planes`]); which sample belongs to which
//! piece, which is not convex, too.
//!
//! Units: a coordinate is measured in tolerances, a row in the radius, bound or feed that it is for,
//! the objective in periods of progress at the feed, averaged over the samples. So prices and
//! tolerances below need not know the machine.
//!
//! Soft rows make sure there is always a solution: the rest of the last window keeps the hard
//! ones.

/// Price of violating a soft row by one, in periods of mean progress. A penalty proportional to the violation is
/// exact, so a row that can be kept is kept, as long as the price is above the multiplier that the row would have
/// if it were hard. For a row of the feed that is about one: all later samples are a period further on. For the
/// tube no such bound is known: where the feed is slow a radius is many periods of way. Velocity across has a price
/// of its own there ([`super::super::feed_rows`]), and the judge refuses what was bought. With 10 five of 35
/// programs were faster, most by a period, and three up to .5 % slower; with 100 three were faster by a period, and
/// three up to .3 % slower. Of the next no measurement is kept.
pub(in crate::in_tube::window) const PRICE: f64 = 30.0;
/// The same where a violation must not buy a smaller one elsewhere.
pub(in crate::in_tube::window) const FIRM_PRICE: f64 = 1000.0;
/// A bound that does not bind, in units of its row: rows are made near where they matter, and such a
/// side has a multiplier of μ / 1000. Walls, which are made for a whole axis, have one further away. Whoever
/// has a small unit has to see that a thousand of it are out of reach.
pub(in crate::in_tube::window) const FAR: f64 = 1e3;

/// Cosine from which two directions are the same, but for the rounding of both: 1.4e-6 rad.
const SAME_COS: f64 = 1.0 - 1e-12;

/// Most control points in a row.
pub(in crate::in_tube::window) const SPAN: usize = 4;

/// A weighted sum of up to [`SPAN`] consecutive control points, and rows on it.
#[derive(Debug, Clone)]
pub(in crate::in_tube::window) struct Site<const D: usize> {
    /// The first control point.
    pub(in crate::in_tube::window) first: usize,
    pub(in crate::in_tube::window) weights: [f64; SPAN],
    /// Its rows.
    pub(in crate::in_tube::window) rows: core::ops::Range<usize>,
    /// Pull towards the line through `center` along `tangent`, objective per tolerance²: ½·attraction·distance² is
    /// what it costs.
    pub(in crate::in_tube::window) attraction: f64,
    pub(in crate::in_tube::window) center: [f64; D],
    pub(in crate::in_tube::window) tangent: [f64; D],
}

/// `low ≤ normal · y ≤ high`, scaled so that one is a large violation.
#[derive(Debug, Clone, Copy)]
pub(in crate::in_tube::window) struct Row<const D: usize> {
    pub(in crate::in_tube::window) normal: [f64; D],
    pub(in crate::in_tube::window) bounds: RowBounds,
}

/// What a row is to lie between, and at which price it may not.
#[derive(Debug, Clone, Copy)]
pub(in crate::in_tube::window) struct RowBounds {
    pub(in crate::in_tube::window) low: f64,
    pub(in crate::in_tube::window) high: f64,
    /// Price of violating it by one.
    pub(in crate::in_tube::window) price: f64,
}

impl RowBounds {
    /// Values of the sides of a row, none of them above zero where it is kept.
    #[inline]
    pub(super) const fn sides(&self, value: f64) -> [f64; 2] {
        [value - self.high, self.low - value]
    }
}

/// `low ≤ Σ parts_i · x_{first+i} ≤ high`, scaled so that one is a large violation: a row in which every control
/// point has a direction of its own.
#[derive(Debug, Clone, Copy)]
pub(in crate::in_tube::window) struct WideRow<const D: usize> {
    pub(in crate::in_tube::window) first: usize,
    pub(in crate::in_tube::window) parts: [[f64; D]; SPAN],
    pub(in crate::in_tube::window) bounds: RowBounds,
}

impl<const D: usize> WideRow<D> {
    /// Its sum at some control points.
    #[inline]
    pub(in crate::in_tube::window) fn value(&self, x: &[[f64; D]]) -> f64 {
        let points = x[self.first..].iter().zip(&self.parts);
        points.map(|(point, part)| dot(point, part)).sum()
    }
}

/// What is to be solved.
#[derive(Debug, Clone)]
pub(in crate::in_tube::window) struct Problem<const D: usize> {
    /// Knot intervals, ≥ 6.
    pub(in crate::in_tube::window) intervals: usize,
    /// The last three control points are given, not only equal.
    pub(in crate::in_tube::window) is_end_fixed: bool,
    /// Bounds of first, second, third differences, in tolerances; an infinite one is left out.
    pub(in crate::in_tube::window) bounds: [[f64; D]; 3],
    /// Weight of half the square of third differences, by axis, objective per tolerance².
    pub(in crate::in_tube::window) jerk: [f64; D],
    /// How many times as much it is in the first knot intervals, and in how many.
    pub(in crate::in_tube::window) dear_jerk: (f64, usize),
    /// Which control points stay where they are given, by axis.
    pub(in crate::in_tube::window) fixed_axes: Vec<[bool; D]>,
    /// Gradient of the linear part of the objective, which is maximised, by control point, objective per
    /// tolerance.
    pub(in crate::in_tube::window) aims: Vec<[f64; D]>,
    pub(in crate::in_tube::window) sites: Vec<Site<D>>,
    pub(in crate::in_tube::window) rows: Vec<Row<D>>,
    pub(in crate::in_tube::window) wide_rows: Vec<WideRow<D>>,
}

impl<const D: usize> Problem<D> {
    /// Weight of half the square of the third difference `k`, by axis.
    pub(super) fn jerk_at(&self, k: usize) -> [f64; D] {
        let (times, intervals) = self.dear_jerk;
        if k < intervals {
            self.jerk.map(|weight| times * weight)
        } else {
            self.jerk
        }
    }

    pub(in crate::in_tube::window) const fn new() -> Self {
        Self {
            intervals: 0,
            is_end_fixed: false,
            bounds: [[f64::INFINITY; D]; 3],
            jerk: [0.0; D],
            dear_jerk: (1.0, 0),
            fixed_axes: Vec::new(),
            aims: Vec::new(),
            sites: Vec::new(),
            rows: Vec::new(),
            wide_rows: Vec::new(),
        }
    }

    /// Starts anew.
    pub(in crate::in_tube::window) fn clear(&mut self, intervals: usize, is_end_fixed: bool) {
        self.intervals = intervals;
        self.is_end_fixed = is_end_fixed;
        self.fixed_axes.clear();
        self.fixed_axes.resize(intervals + 3, [false; D]);
        self.aims.clear();
        self.aims.resize(intervals + 3, [0.0; D]);
        self.sites.clear();
        self.rows.clear();
        self.wide_rows.clear();
    }

    /// Adds to the objective how far a weighted sum of control points is in a direction.
    pub(in crate::in_tube::window) fn add_aim(
        &mut self,
        (first, weights): (usize, [f64; SPAN]),
        aim: f64,
        direction: &[f64; D],
    ) {
        for (aims, weight) in self.aims[first..].iter_mut().zip(weights) {
            for (sum, part) in aims.iter_mut().zip(direction) {
                *sum += aim * weight * part;
            }
        }
    }

    /// A site without pull; rows added next belong to it.
    pub(in crate::in_tube::window) fn add_site(&mut self, first: usize, weights: [f64; SPAN]) {
        let at = self.rows.len();
        self.sites.push(Site {
            first,
            weights,
            rows: at..at,
            attraction: 0.0,
            center: [0.0; D],
            tangent: [0.0; D],
        });
    }

    /// A row of the last site: `low ≤ normal · (y − center) ≤ high`.
    pub(in crate::in_tube::window) fn add_row(
        &mut self,
        normal: [f64; D],
        center: &[f64; D],
        [low, high]: [f64; 2],
    ) {
        let shift = dot(&normal, center);
        self.rows.push(Row {
            normal,
            bounds: RowBounds {
                low: low + shift,
                high: high + shift,
                price: PRICE,
            },
        });
        if let Some(site) = self.sites.last_mut() {
            site.rows.end = self.rows.len();
        }
    }

    /// A row of the last site on a difference; a firm one has a price that nothing else is worth.
    pub(in crate::in_tube::window) fn add_feed_row(
        &mut self,
        normal: [f64; D],
        sides: [f64; 2],
        is_firm: bool,
    ) {
        if is_firm {
            self.add_firm_row(normal, &[0.0; D], sides);
        } else {
            self.add_row(normal, &[0.0; D], sides);
        }
    }

    /// A row of the last site that has a price that nothing else is worth.
    pub(in crate::in_tube::window) fn add_firm_row(
        &mut self,
        normal: [f64; D],
        center: &[f64; D],
        sides: [f64; 2],
    ) {
        self.add_row(normal, center, sides);
        if let Some(row) = self.rows.last_mut() {
            row.bounds.price = FIRM_PRICE;
        }
    }

    /// Keeps the last site where `normal · y ≥ least`, for a unit vector: a row of it that is across the
    /// same way ends there; if there is none, there is another one, with violations in a measure.
    pub(in crate::in_tube::window) fn keep_beyond(
        &mut self,
        normal: &[f64; D],
        least: f64,
        measure: f64,
    ) {
        let Some(site) = self.sites.last() else {
            return;
        };
        for row in &mut self.rows[site.rows.clone()] {
            let size = dot(&row.normal, &row.normal).sqrt();
            let cos = dot(&row.normal, normal) / size;
            if cos > SAME_COS {
                row.bounds.low = row.bounds.low.max(size * least);
                return;
            }
            if cos < -SAME_COS {
                row.bounds.high = row.bounds.high.min(-size * least);
                return;
            }
        }
        // FAR is 1000 measures: whoever adds a border is near it.
        let center = normal.map(|n| n * least);
        self.add_row(normal.map(|n| n / measure), &center, [0.0, FAR]);
    }

    /// How many differences the start alone does not give, if any has a bound. Order 0, 1, 2 is velocity,
    /// acceleration, jerk.
    pub(in crate::in_tube::window) fn differences(&self, order: usize) -> usize {
        let is_bounded = self.bounds[order].iter().any(|bound| bound.is_finite());
        if is_bounded {
            self.intervals - first_difference(order)
        } else {
            0
        }
    }

    /// True if an axis of a weighted sum of control points is not to be found, but given.
    pub(in crate::in_tube::window) fn is_given(
        &self,
        (first, weights): (usize, &[f64; SPAN]),
        axis: usize,
    ) -> bool {
        let free = self.free();
        let is_given = |k: usize| !free.contains(&k) || self.fixed_axes[k][axis];
        (0..SPAN).all(|k| weights[k].abs() <= 0.0 || is_given(first + k))
    }

    /// Control points that are unknown.
    pub(in crate::in_tube::window) fn free(&self) -> core::ops::Range<usize> {
        3..self.intervals + usize::from(!self.is_end_fixed)
    }
}

/// The first control point of the first difference that is not given by the start alone: that whose
/// last point is x₃. Order 0, 1, 2 is velocity, acceleration, jerk.
pub(super) const fn first_difference(order: usize) -> usize {
    2 - order
}

/// Coefficients of first, second and third differences, of order 0, 1, 2.
pub(in crate::in_tube::window) const DIFFERENCES: [[f64; SPAN]; 3] = [
    [-1.0, 1.0, 0.0, 0.0],
    [1.0, -2.0, 1.0, 0.0],
    [-1.0, 3.0, -3.0, 1.0],
];

pub(in crate::in_tube::window) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for k in 0..D {
        sum += a[k] * b[k];
    }
    sum
}

/// A weighted sum of consecutive points.
#[inline]
pub(in crate::in_tube::window) fn combine<const D: usize, const N: usize>(
    points: &[[f64; D]],
    first: usize,
    weights: &[f64; N],
) -> [f64; D] {
    let mut sum = [0.0; D];
    for (point, weight) in points[first..].iter().zip(weights) {
        for k in 0..D {
            sum[k] += weight * point[k];
        }
    }
    sum
}
