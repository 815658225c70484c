//! The driver of the window: full, it is fitted, and where that fails, refined or given up.

use super::output::Output;
use super::sample::Sample;
use super::window::{End, MOST_SAMPLES, WINDOW, Window, first_weight};

/// Refinements of a window whose certificate fails.
const REFINEMENTS: u32 = 5;

/// Blocks that may wait in a window.
pub(super) const MOST_BLOCKS: usize = 1536;

impl<const D: usize> Window<D> {
    /// The next sample, `spacing_t` after the last.
    pub(super) fn add(
        &mut self,
        point: [f64; D],
        (along_t, spacing_t): (f64, f64),
        out: &mut Output,
    ) {
        let foot_t = self.knots.last().copied().unwrap_or(0.0) + spacing_t;
        self.knots.push(foot_t);
        self.samples.push(Sample {
            point,
            along_t,
            spacing_t,
            foot_t,
            weight: first_weight(spacing_t),
            feed_v: self.feed_v,
            error_mm: 0.0,
        });
        if self.samples.len() > WINDOW || out.blocks_waiting() >= MOST_BLOCKS {
            self.drive(None, out);
        }
    }

    /// The curve ends at the last sample.
    pub(super) fn finish(&mut self, end: End, out: &mut Output) {
        self.drive(Some(end), out);
        self.samples.clear();
    }

    /// Fits what is there and puts out the first half, or all of it if it ends here.
    fn drive(&mut self, end: Option<End>, out: &mut Output) {
        let mut refinements = 0;
        while self.samples.len() > 1 {
            let spans = self.prepare(end);
            let worst = self.fit(end, spans, refinements > 0);
            let Some(worst) = worst else {
                self.put_out(spans, out);
                if end.is_none() {
                    self.shift(spans);
                }
                return;
            };
            let may_refine = refinements < REFINEMENTS && self.samples.len() < MOST_SAMPLES;
            refinements += 1;
            if may_refine && self.refine(worst) {
                continue;
            }
            refinements = 0;
            if !self.fall_back(worst, end, out) {
                return;
            }
        }
    }
}
