//! Uniform cubic B-splines in time, and the grid of knots against the grid of periods.

use super::solver::SPAN;
use crate::in_tube::period::State;
use glidepath_geometry::{AXES, AxisVector};

/// Weights of four control points at a place 0…1 of their interval.
pub(crate) fn basis(u: f64) -> [f64; 4] {
    let v = 1.0 - u;
    [
        v * v * v / 6.0,
        (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
        (-3.0 * u * u * u + 3.0 * u * u + 3.0 * u + 1.0) / 6.0,
        u * u * u / 6.0,
    ]
}

/// Weights of velocity, per interval.
pub(super) fn basis_1(u: f64) -> [f64; 4] {
    let v = 1.0 - u;
    [
        -0.5 * v * v,
        1.5 * u * u - 2.0 * u,
        -1.5 * u * u + u + 0.5,
        0.5 * u * u,
    ]
}

/// Weights of acceleration, per interval squared.
pub(super) fn basis_2(u: f64) -> [f64; 4] {
    [1.0 - u, 3.0 * u - 2.0, 1.0 - 3.0 * u, u]
}

/// Steps in which acceleration goes to its limit, at least: jerk changes at knots only, so the
/// fewer there are, the later the changes come. On a machine that reaches
/// its acceleration within 10 ms, knots of 2 ms came late.
const RAMP_STEPS: f64 = 10.0;
/// Most knots in a period: each is a block row of the solver, and rows of its own.
const MOST_KNOTS: usize = 4;
/// The same where acceleration ramps are long.
const MOST_USUAL_KNOTS: usize = 2;
/// Most periods between knots. Where jerk is so weak that a longer step would do, knots are closer than
/// wanted, which costs work alone.
const MOST_PERIODS: f64 = 8.0;
/// Share of the knots wanted in a period that are made: a step a third longer does as well, and is cheaper.
const FEWER_R: f64 = 0.75;

/// How knots lie on the grid of periods: several knots a period, or several periods a knot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Knot step, s.
    pub(crate) knot_t: f64,
    /// Knots in a period, or 1.
    pub(crate) knots: usize,
    /// Periods between knots, or 1.
    pub(crate) periods: usize,
}

impl Grid {
    /// The grid whose knot step is nearest to `wanted_t`, with several knots in a period where
    /// acceleration goes to its limit in `ramp_t` and that would be a few steps only.
    pub(crate) fn new(period_t: f64, wanted_t: f64, ramp_t: f64) -> Self {
        let ratio = period_t / wanted_t;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        let whole = |value: f64| value.round().clamp(1.0, MOST_PERIODS) as usize;
        let (knots, periods) = if ratio >= 1.0 {
            let of_ramp = whole(period_t / ramp_t * RAMP_STEPS).min(MOST_KNOTS);
            (whole(FEWER_R * ratio).min(MOST_USUAL_KNOTS).max(of_ramp), 1)
        } else {
            (1, whole(1.0 / ratio))
        };
        #[expect(clippy::cast_precision_loss, reason = "at most eight")]
        let knot_t = period_t * periods as f64 / knots as f64;
        Self {
            knot_t,
            knots,
            periods,
        }
    }

    /// Interval and place in it of the end of a period, counted from a knot.
    fn interval_of(&self, period: usize) -> (usize, f64) {
        let steps = period * self.knots;
        #[expect(clippy::cast_precision_loss, reason = "at most eight")]
        let u = (steps % self.periods) as f64 / self.periods as f64;
        (steps / self.periods, u)
    }

    /// First control point and weights of the end of a period.
    pub(crate) fn site(&self, period: usize) -> (usize, [f64; SPAN]) {
        let (first, u) = self.interval_of(period);
        (first, basis(u))
    }

    /// First control point and weights of a point within the period that follows `period`, at
    /// parameter `lambda`, with a part of the acceleration added: q + `part`·T²·q″. With an eighth
    /// it is where a chord is that has its middle there.
    pub(crate) fn inner_site(&self, period: usize, lambda: f64, part: f64) -> (usize, [f64; SPAN]) {
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let steps =
            (period as f64 + lambda.clamp(0.0, 1.0)) * self.knots as f64 / self.periods as f64;
        // The end of a period belongs to the interval before it.
        let whole = (steps.ceil() - 1.0).max(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a count of intervals"
        )]
        let first = whole as usize;
        let u = steps - whole;
        let part = part * self.ratio() * self.ratio();
        let (place, bend) = (basis(u), basis_2(u));
        let weights = core::array::from_fn(|i| place[i] + part * bend[i]);
        (first, weights)
    }

    /// Knots in a period, whole or not.
    fn ratio(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "at most eight")]
        let ratio = self.knots as f64 / self.periods as f64;
        ratio
    }

    /// First control point and weights of the velocity at the end of a period, times the period.
    pub(crate) fn velocity_site(&self, period: usize) -> (usize, [f64; SPAN]) {
        let (first, u) = self.interval_of(period);
        let ratio = self.ratio();
        (first, basis_1(u).map(|w| w * ratio))
    }

    /// First control point and weights of the acceleration at the end of a period, times the square
    /// of the period.
    pub(crate) fn bend_site(&self, period: usize) -> (usize, [f64; SPAN]) {
        let (first, u) = self.interval_of(period);
        let ratio = self.ratio();
        (first, basis_2(u).map(|w| w * ratio * ratio))
    }

    /// Periods in a number of knot intervals; intervals may be cut off.
    pub(crate) const fn periods_in(&self, intervals: usize) -> usize {
        intervals * self.periods / self.knots
    }

    /// A number of intervals rounded down to whole periods.
    pub(crate) const fn whole_periods(&self, intervals: usize) -> usize {
        intervals / self.knots * self.knots
    }

    /// A weighted sum of four control points. An axis on which they agree is left out of the sum and
    /// has `of_still` of their value: rounding must not move what stands still.
    fn weigh(
        points: &[AxisVector],
        first: usize,
        weights: [f64; 4],
        of_still: impl Fn(f64) -> f64,
    ) -> AxisVector {
        let Some(last) = points.last() else {
            return AxisVector::zeros();
        };
        let four: [&AxisVector; 4] =
            core::array::from_fn(|offset| points.get(first + offset).unwrap_or(last));
        let mut sum = AxisVector::zeros();
        for (point, weight) in four.iter().zip(weights) {
            sum += *point * weight;
        }
        for i in 0..AXES {
            let value = four[0][i];
            if four[1..]
                .iter()
                .all(|point| point[i].total_cmp(&value).is_eq())
            {
                sum[i] = of_still(value);
            }
        }
        sum
    }

    /// The state at the end of a period.
    pub(crate) fn state(&self, points: &[AxisVector], period: usize) -> State {
        let [velocity, acceleration] = self.derivatives(points, period);
        State {
            position: self.position(points, period),
            velocity,
            acceleration,
        }
    }

    /// Position at the end of a period, counted from the first knot of the control points.
    pub(crate) fn position(&self, points: &[AxisVector], period: usize) -> AxisVector {
        let (first, u) = self.interval_of(period);
        let is_at_rest = points.len() >= 3 && first + 3 >= points.len();
        match points.last() {
            Some(last) if is_at_rest => *last,
            _ => Self::weigh(points, first, basis(u), |value| value),
        }
    }

    /// Velocity and acceleration there.
    pub(crate) fn derivatives(&self, points: &[AxisVector], period: usize) -> [AxisVector; 2] {
        let (first, u) = self.interval_of(period);
        let t = self.knot_t;
        [
            Self::weigh(points, first, basis_1(u), |_| 0.0) / t,
            Self::weigh(points, first, basis_2(u), |_| 0.0) / (t * t),
        ]
    }
}
