//! The axes that are fixed: control points that stay at the programmed coordinate of an axis.
//!
//! Where the pieces leave an axis alone, moving it buys nothing. A control point is fixed if every
//! sample within a margin of it lies on such pieces, all at the same coordinate:
//!
//! ```text
//!   Z of the pieces   ╲
//!                      ╲______________________________________________
//!                       samples ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·
//!                             ├─ margin ─┤ fixed from here on
//! ```
//!
//! The margin is what the motion takes to settle after the corner. Next to the start of a window the
//! motion that is given has to have settled: what the last window has fixed stays where it is, so
//! that an axis which has come to its coordinate is not let go by the next window that begins soon
//! after the corner.

use super::samples::Samples;
use super::scaled_path::ScaledPath;
use super::spline::Grid;

/// A control point further off than this, in tolerances, is not put in its place at once: the
/// problem would start from a motion that jumps.
const NEAR_R: f64 = 1.0;

/// Which control points stay where they are, by axis.
#[derive(Debug, Default, Clone)]
pub(crate) struct FixedAxes<const D: usize> {
    pub(crate) of_points: Vec<[bool; D]>,
}

impl<const D: usize> FixedAxes<D> {
    /// Fixes control points, of which the first three are given, and puts them in their places.
    /// `margin` is in periods.
    pub(crate) fn set(
        &mut self,
        path: &ScaledPath<D>,
        samples: &Samples,
        points: &mut [[f64; D]],
        grid: &Grid,
        margin: usize,
    ) {
        self.of_points.clear();
        self.of_points.resize(points.len(), [false; D]);
        let count = samples.count();
        // A control point acts on two knots to either side of its middle.
        let reach = (2 * grid.periods).div_ceil(grid.knots) + margin;
        for a in 0..D {
            let level_at = |k: usize| path.segments[samples.piece[k]].level[a];
            let mut since = vec![0_usize; count + 1];
            for k in 1..=count {
                let is_same = level_at(k).is_some() && level_at(k) == level_at(k - 1);
                since[k] = if is_same { since[k - 1] } else { k };
            }
            for c in 3..points.len() {
                // The middle of what the control point acts on.
                let middle = grid.periods_in(c - 1);
                let last = (middle + reach).min(count);
                let Some(level) = level_at(last) else {
                    continue;
                };
                let is_there = |point: &[f64; D]| point[a].total_cmp(&level).is_eq();
                // Near the start what is given decides: an axis that still moves is not stopped by being fixed.
                let is_settled =
                    middle >= reach || is_there(&points[c]) || points[..3].iter().all(is_there);
                if since[last] <= middle.saturating_sub(reach)
                    && is_settled
                    && (points[c][a] - level).abs() <= NEAR_R
                {
                    self.of_points[c][a] = true;
                    points[c][a] = level;
                }
            }
        }
        // The last control points are one.
        let last = points.len() - 3;
        for c in last + 1..points.len() {
            self.of_points[c] = self.of_points[last];
            points[c] = points[last];
        }
    }
}
