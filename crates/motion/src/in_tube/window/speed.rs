//! Velocities against the feed.

use super::solver::dot;
use super::spline::Grid;

/// The first differences up to a sample that it has a part in: those that may be no faster than what
/// it is given to ([`super::cutting_planes::pieces_at`]).
pub(crate) fn differences_of(grid: &Grid, sample: usize) -> core::ops::RangeInclusive<usize> {
    let intervals_2 = 2 * grid.knots * sample;
    let reach_2 = (2 + grid.knots) * grid.periods;
    let first = intervals_2
        .saturating_sub(reach_2)
        .div_ceil(2 * grid.periods);
    first..=grid.knots * sample / grid.periods
}

/// The velocity at a first difference over the feed, and its direction in that measure.
pub(crate) fn velocity_over_feed<const D: usize>(
    points: &[[f64; D]],
    slowest: &[f64; D],
    k: usize,
    grid: &Grid,
) -> (f64, [f64; D]) {
    let weighted: [f64; D] =
        core::array::from_fn(|a| (points[k + 1][a] - points[k][a]) * slowest[a] / grid.knot_t);
    let size = dot(&weighted, &weighted).sqrt();
    (size, weighted.map(|w| w / size))
}

#[cfg(test)]
mod tests {
    use super::{Grid, differences_of};
    use crate::in_tube::window::cutting_planes::pieces_at;
    use crate::in_tube::window::samples::Samples;

    /// A piece for each sample: what a difference has a part in are samples, then.
    #[test]
    fn differences_of_a_sample_are_those_that_have_a_part_in_it() {
        let mut samples = Samples::default();
        samples.reset(100);
        samples.piece = (0..=100).collect();
        for (knots, periods) in [(1, 1), (2, 1), (3, 1), (4, 1), (1, 2), (1, 4), (1, 7)] {
            let grid = Grid {
                knot_t: 0.001,
                knots,
                periods,
            };
            for sample in 10..60 {
                let ends_at = knots * sample / periods;
                let of_sample: Vec<_> = (2..=ends_at)
                    .filter(|m| pieces_at(&samples, &grid, *m).contains(&sample))
                    .collect();
                let found: Vec<_> = differences_of(&grid, sample).filter(|m| *m >= 2).collect();
                assert_eq!(found, of_sample, "{grid:?}, sample {sample}");
            }
        }
    }
}
