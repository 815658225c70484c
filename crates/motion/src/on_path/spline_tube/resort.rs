//! The resort where a fit stays outside the tube.
//!
//! First samples and knots are put into the middle of the worst chord and of its neighbours, and
//! the fit is made again. At last straight lines are drawn through the samples, with a stop at the
//! first and behind the last of them, and a new curve starts there. Those lines are in the tube
//! whatever happens: each leads from a point near a chord to the end of that chord, or along a
//! chord.

use super::knots::DEGREE;
use super::output::Output;
use super::sample::Sample;
use super::vector::between;
use super::window::{End, Window, first_weight};

/// A gap between feet that is no longer than this, in tolerances, is not split again.
const LEAST_SPLIT_R: f64 = 5e-3;
/// A sample that is put in gets a knot if the next one is further away than this, in its spacings: the
/// shortest span beside one of usual length.
const LEAST_SPAN_R: f64 = 0.1;

impl<const D: usize> Window<D> {
    /// Puts samples and knots into the middle of the worst chord and of its neighbours; false if no
    /// place is left there.
    pub(super) fn refine(&mut self, worst: usize) -> bool {
        let mut is_refined = false;
        for j in [worst + 1, worst, worst.saturating_sub(1)] {
            if (1..self.samples.len()).contains(&j) {
                is_refined |= self.split(j);
            }
        }
        is_refined
    }

    fn split(&mut self, j: usize) -> bool {
        let (before, after) = (self.samples[j - 1], self.samples[j]);
        let start_t = self.knots[DEGREE];
        let from_t = before.foot_t.max(start_t);
        let foot_t = 0.5 * (from_t + after.foot_t);
        let frozen_t = if self.is_frozen {
            self.knots[(2 * DEGREE).min(self.knots.len() - 1)]
        } else {
            start_t
        };
        if after.foot_t - from_t <= LEAST_SPLIT_R * self.shares.tolerance_mm || foot_t <= frozen_t {
            return false;
        }
        // The middle of what is left of the chord: of the first one a part is behind.
        let passed_u = if j == 1 { self.passed_u } else { 0.0 };
        let share = 0.5 * (1.0 + passed_u);
        let spacing_t = share * after.spacing_t;
        let middle = Sample {
            point: between(&before.point, &after.point, share),
            along_t: before.along_t + share * (after.along_t - before.along_t),
            spacing_t,
            foot_t,
            weight: after.weight.max(first_weight(spacing_t)),
            feed_v: after.feed_v,
            error_mm: 0.0,
        };
        self.samples[j].spacing_t -= spacing_t;
        self.samples.insert(j, middle);
        if j == 1 {
            self.passed_u /= share;
        }
        let i = self.knots.partition_point(|&t| t < foot_t);
        let least_t = LEAST_SPAN_R * spacing_t;
        let is_apart = (i == 0 || foot_t - self.knots[i - 1] > least_t)
            && self.knots.get(i).is_none_or(|t| t - foot_t > least_t);
        if is_apart {
            self.knots.insert(i, foot_t);
        }
        self.kept = if self.is_frozen { DEGREE } else { 0 };
        true
    }

    /// Draws lines through the samples up to the worst chord. True if there is more to fit behind
    /// them.
    pub(super) fn fall_back(&mut self, worst: usize, end: Option<End>, out: &mut Output) -> bool {
        let last = self.samples.len() - 1;
        let up_to = if last - worst.min(last) >= 3 {
            worst
        } else if end.is_some() {
            last
        } else {
            last - 2
        };
        let mut from = self.samples[0].point;
        let mut from_t = self.samples[0].along_t;
        if self.is_frozen {
            from = self.spline.at(0, self.knots[DEGREE]).0;
            from_t += self.passed_u * (self.samples[1].along_t - from_t);
            out.stop();
        }
        for sample in &self.samples[1..=up_to] {
            let along_t = (from_t, sample.along_t);
            out.line(
                (&from, &sample.point),
                along_t,
                self.shares.merge_mm + self.shares.allowed_mm,
                [false; 2],
            );
            (from, from_t) = (sample.point, sample.along_t);
        }
        if up_to == last {
            return false;
        }
        out.stop();
        self.samples.drain(..up_to);
        self.restart(End::Stop);
        // With more to come, the window is filled up first.
        end.is_some()
    }
}
