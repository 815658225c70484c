//! The start of a window: what it starts from, and when it is first thought to be where.

use super::guess::{Guess, rest_to_rest_t};
use super::scaled_path::ScaledPath;
use super::search_bias::SearchBias;
use super::spline::Grid;
use super::tube::{FEED_R, STEERING, Style};

/// The time T in which a guess brakes: T ≥ BRAKE_A·v/a and T² ≥ BRAKE_J·v/j. Its speed falls as
/// v·(1 − 3x² + 2x³), x = t/T, whose slope is 1.5·v/T at most and whose second derivative 6·v/T². What is above
/// 1.5 and 6 is left for what else a curve needs. With 1.5 and 6 themselves one of 35 programs was .25 % faster
/// and one .06 % slower, with twice these one .5 % slower and one .1 % faster.
const BRAKE_A: f64 = 2.0;
const BRAKE_J: f64 = 9.0;
/// Most of the time that a tail takes that counts as slowing down for its rest. No measurement of it is
/// kept.
const SLOWING_R: f64 = 0.4;
/// A sample that stops at a vertex is taken to be so far before it, in radii or lengths of the piece:
/// where samples go over to the next one ([`super::samples`]), and a hundredth more, so that it waits.
const HOP_R: f64 = 0.3;
const BEFORE_HOP_R: f64 = 1.01;
/// Part of the radius that is used where no phase of a search says otherwise: as much as in its first one.
const KEEP_R: f64 = 0.995;
/// How much longer a stop at each vertex is thought to take than an S-curve from rest to rest, and how
/// many knots: jerk changes at knots only. Too little, and no motion is in time on its pieces; too much
/// costs time, but this is the last attempt.
const STOP_TIME_R: f64 = 1.15;
const STOP_KNOTS: f64 = 3.0;

/// What a window starts from.
#[derive(Debug)]
pub(crate) struct WindowStart<'a, const D: usize> {
    /// A motion from the start state to rest: the one to fall back on. Its number of control points
    /// sets that of the window.
    pub(crate) tail: &'a [[f64; D]],
    /// The tail keeps the rates: it tells where to start from, and a window is to go further.
    pub(crate) keeps_rates: bool,
    /// Piece of the scaled path and progress on which it starts.
    pub(crate) piece: usize,
    pub(crate) progress: f64,
    /// The motion may have passed the corners before this piece already.
    pub(crate) passed: usize,
    pub(crate) grid: Grid,
    pub(crate) period_t: f64,
    /// Periods after which the next window will start.
    pub(crate) commit: usize,
    pub(crate) bias: SearchBias,
}

impl<const D: usize> WindowStart<'_, D> {
    /// How rows are made unless a search asks for more room.
    pub(crate) fn style(&self, has_motion: bool) -> Style {
        Style {
            grid: self.grid,
            period_t: self.period_t,
            passed: self.passed,
            stray_r: 1.0,
            is_feed_firm: true,
            feed_r: FEED_R,
            is_damped: false,
            counts_way: false,
            is_centred: false,
            aims_beyond: 0,
            aims_until: usize::MAX,
            at_feed: 0,
            keep_r: KEEP_R,
            attraction: self.bias.pull,
            jerk: self.bias.jerk,
            steering: STEERING,
            has_motion,
            keeps_progress: false,
        }
    }

    /// From which sample on the tail rests, and from which it may be slowing down for that.
    pub(crate) fn tail_ends(&self, path: &ScaledPath<D>) -> (usize, usize) {
        let tail = self.tail;
        if !self.keeps_rates {
            return (0, 0);
        }
        let last = tail[tail.len() - 1];
        let differs = |point: &[f64; D]| point.iter().zip(&last).any(|(a, b)| (a - b).abs() > 0.0);
        let moving = tail.iter().rposition(differs).map_or(0, |k| k + 1);
        let rest = self.grid.periods_in(moving + self.grid.knots - 1);
        let segment = &path.segments[self.piece];
        let limits = segment.limits;
        // An S-curve from the top speed to rest, as far as the tail has room for one.
        let stop_t = (segment.top / limits.accel_a + limits.accel_a / limits.jerk_j)
            .min(SLOWING_R * self.periods_t(rest));
        let stop = self.whole_periods(stop_t);
        (rest, rest.saturating_sub(stop))
    }

    /// Samples from `from` on follow the guess, at a pace.
    pub(crate) fn play_guess(
        &self,
        path: &ScaledPath<D>,
        guess: &Guess,
        progress: &mut [f64],
        (from, pace): (usize, f64),
    ) {
        let mut hint = piece_at(path, self.piece, progress[from]);
        let start_t = guess.t_at(path, progress[from], hint);
        for k in from + 1..progress.len() {
            let t = start_t + pace * self.periods_t(k - from);
            let s = guess.s_at(path, t, &mut hint);
            let most = progress[k - 1] + guess.top_v(hint) * self.period_t;
            progress[k] = s.min(most).max(progress[k]).max(progress[k - 1]);
        }
    }

    /// Lets samples that go on come to rest at the last one, in a time in which a machine can; from
    /// which sample on they brake.
    pub(crate) fn brake(&self, path: &ScaledPath<D>, progress: &mut [f64]) -> usize {
        let segment = &path.segments[self.piece];
        let (top, limits) = (segment.top, segment.limits);
        let brake_t = (BRAKE_A * top / limits.accel_a).max((BRAKE_J * top / limits.jerk_j).sqrt());
        let last = progress.len() - 1;
        let end = last.saturating_sub(self.grid.periods_in(3 + self.grid.knots));
        let from = end.saturating_sub(self.whole_periods(brake_t) + 1);
        let steps: Vec<f64> = progress.windows(2).map(|step| step[1] - step[0]).collect();
        for k in from..last {
            #[expect(clippy::cast_precision_loss, reason = "hundreds")]
            let x = ((k - from) as f64 / (end - from).max(1) as f64).min(1.0);
            progress[k + 1] = progress[k] + steps[k] * (1.0 - x * x * (3.0 - 2.0 * x));
        }
        from
    }

    /// Control points of a motion that is exactly on the path when samples are: from the start
    /// state on, and to a rest where the last sample is.
    pub(crate) fn points_along(&self, path: &ScaledPath<D>, progress: &[f64]) -> Vec<[f64; D]> {
        let count = self.tail.len();
        let mut piece = self.piece;
        let mut points = self.tail[..3].to_vec();
        points.extend((3..count).map(|k| {
            // Control point k is nearest at knot k − 1; the last three are the last sample.
            let knot = (k - 1).min(count - 4) * self.grid.periods;
            let (sample, part) = (knot / self.grid.knots, knot % self.grid.knots);
            let next = progress[(sample + 1).min(progress.len() - 1)];
            #[expect(clippy::cast_precision_loss, reason = "a few")]
            let share = part as f64 / self.grid.knots as f64;
            let s = progress[sample] + share * (next - progress[sample]);
            piece = piece_at(path, piece, s);
            path.position(piece, s)
        }));
        points
    }

    /// Samples from `from` on stop at every vertex, with time to spare.
    pub(crate) fn play_stops(&self, path: &ScaledPath<D>, progress: &mut [f64], from: usize) {
        let mut s = progress[from];
        let mut i = piece_at(path, self.piece, s);
        let mut start_t = 0.0;
        let mut k = from + 1;
        while k < progress.len() {
            let segment = &path.segments[i];
            let end = segment.s + segment.length;
            let rest = (end - s).max(0.0);
            let last = if i + 1 < path.segments.len() {
                end - HOP_R * segment.radius.min(segment.length) * BEFORE_HOP_R
            } else {
                end
            };
            let duration_t = STOP_TIME_R * rest_to_rest_t(rest, segment.top, segment.limits)
                + STOP_KNOTS * self.grid.knot_t;
            while k < progress.len() && self.periods_t(k - from) < start_t + duration_t {
                let share = (self.periods_t(k - from) - start_t) / duration_t;
                progress[k] = (s + (last - s).max(0.0) * share).max(progress[k - 1]);
                k += 1;
            }
            start_t += duration_t;
            s = end;
            if i + 1 < path.segments.len() {
                i += 1;
            } else {
                progress[k..].fill(end);
                break;
            }
        }
    }

    /// How much faster than the guess the part up to the next window is.
    pub(crate) fn pace(&self, path: &ScaledPath<D>, guess: &Guess, progress: &[f64]) -> f64 {
        let k = self.commit.min(progress.len() - 1);
        let (from, to) = (progress[0], progress[k]);
        let first = piece_at(path, self.piece, from);
        let taken_t =
            guess.t_at(path, to, piece_at(path, first, to)) - guess.t_at(path, from, first);
        taken_t / self.periods_t(k)
    }

    /// Time of a number of periods.
    fn periods_t(&self, periods: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let periods = periods as f64;
        periods * self.period_t
    }

    /// Periods in a time ≥ 0.
    fn whole_periods(&self, t: f64) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a time within the window"
        )]
        let periods = (t / self.period_t) as usize;
        periods
    }
}

/// The piece of a progress, from a piece on.
fn piece_at<const D: usize>(path: &ScaledPath<D>, from: usize, s: f64) -> usize {
    let past = path.segments[from..]
        .iter()
        .take_while(|segment| segment.s + segment.length <= s)
        .count();
    (from + past).min(path.segments.len() - 1)
}
