//! What is carried from round to round of the optimisation of a window.

use super::samples::Samples;

/// Gain of progress, relative to that of the window, below which nothing more is tried.
const LITTLE_GAIN: f64 = 1e-4;

/// The best motion so far.
#[derive(Debug)]
pub(super) struct Found<const D: usize> {
    pub(super) best: Option<(f64, Vec<[f64; D]>, Samples)>,
    /// Work of the solver up to which there is something left to spend.
    pub(super) most_work: usize,
}

impl<const D: usize> Found<D> {
    pub(super) fn add(&mut self, mean: f64, points: &[[f64; D]], samples: &Samples) {
        if self.best.as_ref().is_none_or(|(most, ..)| mean > *most) {
            self.best = Some((mean, points.to_vec(), samples.clone()));
        }
    }
}

/// Where an attempt is.
#[derive(Debug)]
pub(super) struct Walk<const D: usize> {
    pub(super) points: Vec<[f64; D]>,
    /// The points are a motion, and not only the tail to start from.
    pub(super) has_motion: bool,
    /// Rows were violated in the last round: samples are on pieces too early.
    pub(super) is_exceeding: bool,
    /// Mean progress in the last round.
    pub(super) mean: f64,
}

impl<const D: usize> Walk<D> {
    /// True if progress hardly changes any more.
    pub(super) fn has_settled(&self, mean: f64, start: f64) -> bool {
        (mean - self.mean).abs() < LITTLE_GAIN * (mean - start)
    }
}
