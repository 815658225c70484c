//! The natural cubic spline through points, straight beyond both ends.
//!
//! A broken line is no curve: its steps of slope are steps of velocity, which a fast axis feels as 5 times its jerk
//! limit at 1 ms (steps of slope of 2·10⁻⁴ at 200 mm/s). The natural spline has a continuous second derivative
//! everywhere, also where it goes on straight, because it is 0 at both ends.

use glidepath_geometry::number::{Number, Series};

/// A natural cubic spline.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spline {
    /// The points, ascending, at least two; the second derivative at each.
    knots: Box<[Knot]>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Knot {
    x: f64,
    value: f64,
    second: f64,
}

/// Value and derivatives at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Rates {
    pub(crate) value: f64,
    pub(crate) first: f64,
    pub(crate) second: f64,
}

impl Spline {
    /// The spline through points whose places ascend. At least two of them; otherwise it is 0 everywhere.
    pub(crate) fn through(points: &[(f64, f64)]) -> Self {
        let mut knots: Box<[Knot]> = points
            .iter()
            .map(|&(x, value)| Knot {
                x,
                value,
                second: 0.0,
            })
            .collect();
        bend(&mut knots);
        Self { knots }
    }

    /// Value and derivatives. Bounded work: the search halves what is left.
    pub(crate) fn at(&self, x: f64) -> Rates {
        let behind = self.knots.partition_point(|knot| knot.x <= x);
        let [Some(low), Some(high)] =
            [behind.max(1) - 1, behind.max(1)].map(|k| self.knots.get(k).copied())
        else {
            // Behind the last knot, or there are none.
            return self.beyond(x);
        };
        if x < low.x {
            return straight(&low, slopes(&low, &high)[0], x);
        }
        let h = high.x - low.x;
        let (a, b) = ((high.x - x) / h, (x - low.x) / h);
        let bent = ((a * a - 1.0) * a * low.second + (b * b - 1.0) * b * high.second) * h * h / 6.0;
        let chord = (high.value - low.value) / h;
        let turned = (3.0 * b * b - 1.0) * high.second - (3.0 * a * a - 1.0) * low.second;
        Rates {
            value: a * low.value + b * high.value + bent,
            first: chord + turned * h / 6.0,
            second: a * low.second + b * high.second,
        }
    }

    fn beyond(&self, x: f64) -> Rates {
        match *self.knots {
            [.., before, last] => straight(&last, slopes(&before, &last)[1], x),
            _ => Rates::default(),
        }
    }

    /// The same along a curve. Of an enclosure the middle says which of the pieces is meant.
    pub(crate) fn along<const N: usize, T: Number>(&self, x: Series<N, T>) -> Series<N, T> {
        let place = x.value().nominal();
        let Rates {
            value,
            first,
            second,
        } = self.at(place);
        let way = x - Series::constant(place);
        let third = Series::constant(self.third_at(place) / 6.0);
        let bent = Series::constant(0.5 * second) + way * third;
        Series::constant(value) + way * (Series::constant(first) + way * bent)
    }

    /// The third derivative, on the far side of a point.
    fn third_at(&self, x: f64) -> f64 {
        let behind = self.knots.partition_point(|knot| knot.x <= x);
        let pair = behind
            .checked_sub(1)
            .and_then(|first| self.knots.get(first..=behind));
        match pair {
            Some([low, high]) => (high.second - low.second) / (high.x - low.x),
            _ => 0.0,
        }
    }

    /// The lowest and the highest value from one place to another.
    pub(crate) fn range(&self, from: f64, to: f64) -> [f64; 2] {
        let turns = self.knots.windows(2).flat_map(|pair| match pair {
            [low, high] => turns(low, high),
            _ => [None; 2],
        });
        let knots = self.knots.iter().map(|knot| knot.x);
        let inside = knots
            .chain(turns.flatten())
            .filter(|x| (from..=to).contains(x));
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for x in inside.chain([from, to]) {
            let value = self.at(x).value;
            range = [range[0].min(value), range[1].max(value)];
        }
        range
    }

    /// No amount anywhere between the first and the last point is larger than this: an interval leaves its chord by
    /// h²/8 of its second derivative at most.
    pub(super) fn bound(&self) -> f64 {
        let intervals = self.knots.windows(2).map(|pair| match *pair {
            [low, high] => {
                let h = high.x - low.x;
                let second = low.second.abs().max(high.second.abs());
                low.value.abs().max(high.value.abs()) + h * h * second / 8.0
            }
            _ => 0.0,
        });
        intervals.fold(0.0, f64::max)
    }

    /// The largest amounts of the first, second and third derivative anywhere.
    pub(crate) fn most(&self) -> [f64; 3] {
        let mut most = [0.0_f64; 3];
        for pair in self.knots.windows(2) {
            let &[low, high] = pair else { continue };
            let h = high.x - low.x;
            let [one, other] = slopes(&low, &high);
            let third = (high.second - low.second) / h;
            // The slope is a parabola: largest at an end, or where the second derivative passes 0.
            let turns = low.second * high.second < 0.0;
            let turn = if turns {
                one - 0.5 * low.second * low.second / third
            } else {
                0.0
            };
            let here = [
                one.abs().max(other.abs()).max(turn.abs()),
                low.second.abs().max(high.second.abs()),
                third.abs(),
            ];
            for (most, here) in most.iter_mut().zip(here) {
                *most = most.max(here);
            }
        }
        most
    }
}

fn straight(from: &Knot, slope: f64, x: f64) -> Rates {
    Rates {
        value: from.value + slope * (x - from.x),
        first: slope,
        second: 0.0,
    }
}

/// The slopes at both ends of an interval.
fn slopes(low: &Knot, high: &Knot) -> [f64; 2] {
    let h = high.x - low.x;
    let chord = (high.value - low.value) / h;
    [
        chord - h * (2.0 * low.second + high.second) / 6.0,
        chord + h * (low.second + 2.0 * high.second) / 6.0,
    ]
}

/// Where an interval is level: the roots of its slope s + M₀ t + (M₁ − M₀) t² / 2h, by the form that loses no digits.
fn turns(low: &Knot, high: &Knot) -> [Option<f64>; 2] {
    let h = high.x - low.x;
    let (square, linear) = (0.5 * (high.second - low.second) / h, low.second);
    let [slope, _] = slopes(low, high);
    let root = (linear * linear - 4.0 * square * slope).sqrt();
    let sum = -0.5 * (linear + root.copysign(linear));
    [sum / square, slope / sum].map(|t| Some(low.x + t).filter(|_| (0.0..=h).contains(&t)))
}

/// Solves for the second derivatives: h₀ M₀ + 2 (h₀ + h₁) M₁ + h₁ M₂ = 6 (slope₁ − slope₀) at each inner knot, 0 at
/// both ends. The matrix is diagonally dominant, so elimination without pivots is stable.
fn bend(knots: &mut [Knot]) {
    let count = knots.len();
    let mut upper = vec![0.0; count];
    for k in 1..count.saturating_sub(1) {
        let [before, at, after] = [knots[k - 1], knots[k], knots[k + 1]];
        let (h0, h1) = (at.x - before.x, after.x - at.x);
        let right = 6.0 * ((after.value - at.value) / h1 - (at.value - before.value) / h0);
        let pivot = 2.0 * (h0 + h1) - h0 * upper[k - 1];
        upper[k] = h1 / pivot;
        knots[k].second = (right - h0 * before.second) / pivot;
    }
    for k in (1..count.saturating_sub(1)).rev() {
        knots[k].second -= upper[k] * knots[k + 1].second;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::float_cmp, reason = "a test")]

    use super::*;

    fn bumpy() -> (Vec<(f64, f64)>, Spline) {
        let points: Vec<(f64, f64)> = (0..9)
            .map(|k| {
                let x = f64::from(k) * 25.0 + f64::from(k % 3);
                (x, 0.005 * (1.7 * f64::from(k)).sin())
            })
            .collect();
        let spline = Spline::through(&points);
        (points, spline)
    }

    #[test]
    fn it_passes_its_points_and_its_derivatives_are_its_own() {
        let (points, spline) = bumpy();
        for (x, value) in points {
            assert!((spline.at(x).value - value).abs() < 1e-15);
        }
        let step = 1e-4;
        for k in -200..2_300 {
            let x = f64::from(k) * 0.1 + 0.037;
            let [low, mid, high] = [-step, 0.0, step].map(|d| spline.at(x + d));
            let first = (high.value - low.value) / (2.0 * step);
            let second = (high.first - low.first) / (2.0 * step);
            assert!((first - mid.first).abs() < 1e-9, "{x}: {first} {mid:?}");
            assert!((second - mid.second).abs() < 1e-9, "{x}: {second} {mid:?}");
        }
    }

    #[test]
    fn nothing_steps_up_to_the_second_derivative_and_the_largest_are_the_largest() {
        let (_, spline) = bumpy();
        let most = spline.most();
        let mut before = spline.at(-30.0);
        let mut seen = [0.0_f64; 3];
        for k in 1..26_000 {
            let at = spline.at(-30.0 + f64::from(k) * 0.01);
            let third = (at.second - before.second) / 0.01;
            assert!(
                third.abs() <= most[2] * (1.0 + 1e-6) + 1e-12,
                "the second derivative steps"
            );
            for (seen, rate) in seen.iter_mut().zip([at.first, at.second, third]) {
                *seen = seen.max(rate.abs());
            }
            before = at;
        }
        for (seen, most) in seen.into_iter().zip(most) {
            assert!(
                seen <= most * (1.0 + 1e-6) && seen > 0.99 * most,
                "{seen} {most}"
            );
        }
    }

    #[test]
    fn its_range_is_that_of_its_values() {
        let (_, spline) = bumpy();
        for (from, to) in [(-30.0, 230.0), (3.0, 18.0), (40.0, 41.0), (-50.0, -20.0)] {
            let [low, high] = spline.range(from, to);
            let values = (0..=20_000).map(|k| from + (to - from) * f64::from(k) / 20_000.0);
            let values: Vec<f64> = values.map(|x| spline.at(x).value).collect();
            let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
            let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(low <= lowest && lowest - low < 1e-8, "{low} {lowest}");
            assert!(high >= highest && high - highest < 1e-8, "{high} {highest}");
        }
    }

    #[test]
    fn it_is_straight_beyond_its_ends() {
        let (points, spline) = bumpy();
        let (end, value) = points[points.len() - 1];
        let slope = spline.at(end).first;
        let far = spline.at(end + 40.0);
        assert!((far.value - value - 40.0 * slope).abs() < 1e-12);
        assert_eq!(far.second, 0.0);
        let before = spline.at(-40.0);
        assert!((before.value - points[0].1 + 40.0 * before.first).abs() < 1e-12);
    }

    #[test]
    fn two_points_are_a_line_and_fewer_nothing() {
        let line = Spline::through(&[(0.0, 0.0), (100.0, 0.01)]);
        assert!((line.at(50.0).value - 0.005).abs() < 1e-15);
        assert_eq!(line.most()[1..], [0.0, 0.0]);
        assert_eq!(Spline::through(&[]).at(3.0), Rates::default());
    }
}
