//! The end of a window that sees the end of its path: the shortest motion that rests exactly there.

use super::optimiser::{Optimiser, Question, Solution};
use super::rounds::{ENOUGH_VIOLATION, hurried};
use super::scaled_path::ScaledPath;
use super::tube::Style;
use super::window_start::WindowStart;

/// Lengths of the last window that are tried, and rounds for each.
const FINISHES: usize = 16;
const FINISH_ROUNDS: usize = 5;
/// Pull towards the path where nothing else is aimed at.
const CENTRED_PULL: f64 = 1e-2;

impl<const D: usize> Optimiser<D> {
    /// If the motion comes to rest at the end of the path: the shortest one that rests exactly
    /// there.
    pub(super) fn finish(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        points: &[[f64; D]],
        progress: &[f64],
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Option<Solution<D>> {
        let last = path.segments.last().filter(|_| path.is_final)?;
        let total = path.length();
        let near = 0.02 * last.radius + 1e-9 * total;
        let arrival = progress.iter().position(|&s| s >= total - near)?;
        let intervals = points.len() - 3;
        let end = path.vertex(path.segments.len() - 1);
        let multiple = window_start.grid.knots;
        let arrival = arrival * window_start.grid.knots / window_start.grid.periods;
        let first = arrival.max(6).div_ceil(multiple) * multiple;
        let style = Style {
            is_centred: true,
            ridge: CENTRED_PULL,
            jerk: 0.0,
            ..window_start.style(true)
        };
        let grid = &window_start.grid;
        let mut shortest: Option<(usize, Vec<[f64; D]>, Vec<f64>)> = None;
        let mut count = first;
        let mut step = multiple;
        for _ in 0..FINISHES {
            if count < 6 || count > intervals || self.interior.is_spent() {
                break;
            }
            let (mut next, progress) = match &shortest {
                // All of it a little faster.
                Some((longer, points, progress)) => {
                    let fewer = longer - count;
                    let between = |a: &[f64; D], b: &[f64; D], share| {
                        core::array::from_fn(|k| a[k] + share * (b[k] - a[k]))
                    };
                    let fewer_periods = grid.periods_in(fewer);
                    (
                        hurried(points, fewer, between),
                        hurried(progress, fewer_periods, |a, b, share| a + share * (b - a)),
                    )
                }
                None => (points[..count + 3].to_vec(), progress.to_vec()),
            };
            self.samples.progress = progress;
            self.samples.cut(grid.periods_in(count));
            self.samples.give_out(path, window_start.piece);
            next[..3].copy_from_slice(&points[..3]);
            next[count..].fill(end);
            if self.finish_in(path, window_start, &style, &mut next, judge) {
                self.samples
                    .project(path, &next, window_start.piece, grid, false);
                shortest = Some((count, next, self.samples.progress.clone()));
                count = count.saturating_sub(step);
                step *= 2;
            } else if let Some((longer, ..)) = &shortest {
                if longer - count <= multiple {
                    break;
                }
                step = multiple;
                count = longer - multiple;
            } else {
                count += multiple;
            }
        }
        let (_, points, _) = shortest?;
        let points = self.smooth_finish(path, window_start, points, judge);
        Some(Solution {
            points,
            is_end: true,
        })
    }

    /// The same in the same time, but as smooth as it can be, if that passes.
    fn smooth_finish(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        points: Vec<[f64; D]>,
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> Vec<[f64; D]> {
        if self.interior.is_spent() {
            return points;
        }
        let style = Style {
            is_centred: true,
            ..window_start.style(true)
        };
        let count = window_start.grid.periods_in(points.len() - 3);
        self.samples.cut(count);
        self.samples
            .project(path, &points, window_start.piece, &window_start.grid, false);
        self.samples.give_out(path, window_start.piece);
        let mut next = points.clone();
        if self.finish_in(path, window_start, &style, &mut next, judge) {
            next
        } else {
            points
        }
    }

    /// Makes a motion pass that rests at the end of the path after so many control points.
    fn finish_in(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        style: &Style,
        points: &mut [[f64; D]],
        judge: &mut impl FnMut(&[[f64; D]], Question) -> bool,
    ) -> bool {
        for _ in 0..FINISH_ROUNDS {
            let is_solved = self.solve(path, style, points, true, true);
            if !is_solved || self.interior.violation() > ENOUGH_VIOLATION {
                return false;
            }
            if judge(points, Question::IsEnd) {
                return true;
            }
            self.cuts
                .learn(path, &self.samples, points, &window_start.grid);
        }
        false
    }
}
