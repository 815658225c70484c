//! The samples of a window, and which piece owns which: the one part of the problem that is not convex.
//!
//! Samples are the ends of the periods: what is handed out. With every sample given to a piece, all
//! that is asked of the motion is convex; after a solution, the samples are given out again by
//! projecting the motion onto the path, never backwards, and the problem is solved again. A sample
//! in the overlap of two tubes goes to the later one at once: the motion it has keeps the new rows
//! too, and the next solution can use the room.

use super::hold_back::{hold_back, is_too_fast};
use super::sample_place::SamplePlace;
use super::scaled_path::ScaledPath;
use super::solver::{combine, dot};
use super::spline::Grid;

/// From this part of the radius on a motion is worth a plane. Of this and the numbers up to
/// [`LEADING_TUBE_R`] no measurement is kept.
pub(crate) const WORTH_R: f64 = 0.5;
/// Shares of the radius from which a sample has come out at the edge of the tube, and up to which that is
/// put right by less radius. One that is further out is left to the next giving out.
const EDGE_R: f64 = 0.9995;
const FAR_OUT_R: f64 = 1.5;
/// Share of the radius at which it is to come out the next time, and the least factor of the radius to which
/// that may lead in all.
const INSIDE_R: f64 = 0.998;
const LEAST_SHRINK: f64 = 0.7;
/// A sample leads over to the next piece where the path turns by this at least, 2·sin(turn/2), where it is
/// nearer to the corner than so many radii over the turn (of 1 at most), and in the tube of the next piece up
/// to this share of its radius.
const LEADING_TURN: f64 = 0.05;
const LEADING_R: f64 = 4.0;
const LEADING_TUBE_R: f64 = 0.98;
/// A later piece has to be nearer by this share of the radius to be taken for the place of a sample; else the
/// earlier one is.
const NEARER_R: f64 = 1e-7;
/// Share of the radius before a fold in the path from which a sample may be on its other side.
const BEFORE_FOLD_R: f64 = 0.5;
/// Cosine of the turn from which a corner holds samples back: without it they jump over reversals and
/// short spikes, whose two sides are near each other.
const FOLD_COS: f64 = 0.2;
/// Share of the radius before the end of a piece at which a sample goes over to the next: where it is in
/// the tubes of both, mostly. No measurement of it is kept.
const HOP_R: f64 = 0.3;

/// Most length of path to a length moved, where the path does not stay within the tube. A right angle
/// is 1.41 times as long as its cut. No measurement of it is kept.
const MOST_DETOUR: f64 = 1.5;

/// Share of the radius by which rounding may put a sample beyond the end of its piece.
const AT_END_R: f64 = 1e-3;

/// What the motion bulges out of the chords of half periods, as a part of what it does out of whole
/// ones.
const OF_HALVES: f64 = 0.25;

/// Samples 0 … count of a window.
#[derive(Debug, Default, Clone)]
pub(crate) struct Samples {
    /// Progress along the scaled path, in tolerances: where a sample is taken to be.
    pub(crate) progress: Vec<f64>,
    /// Piece a sample must be given to at least.
    pub(crate) at_least: Vec<usize>,
    /// Piece a sample is given to.
    pub(crate) piece: Vec<usize>,
    /// Factor of the radius: below one where a sample has come out too far off.
    pub(crate) shrink: Vec<f64>,
    /// What the motion bulges out of the chord of the period before a sample, in tolerances.
    bulge: Vec<f64>,
    /// Whether the tube bounds middles of periods, too: where there are several knots in each. With
    /// one, windows along short legs are refused for it more often than others gain.
    bounds_middles: bool,
    /// Whether the middle of that period has come near the edge of the tube.
    is_middle_near: Vec<bool>,
    /// Whether the motion at a sample is too fast for the piece after the one it is on.
    is_too_fast: Vec<bool>,
    /// Largest distance from the path, in radii, found by the last projection.
    pub(crate) worst_r: f64,
}

impl Samples {
    pub(crate) fn reset(&mut self, count: usize) {
        self.progress.clear();
        self.progress.resize(count + 1, 0.0);
        self.forget();
    }

    /// Only the first samples remain.
    pub(crate) fn cut(&mut self, count: usize) {
        self.progress.truncate(count + 1);
        self.forget();
    }

    /// Forgets what iterations have learnt.
    pub(crate) fn forget(&mut self) {
        let count = self.progress.len();
        self.piece.resize(count, 0);
        self.at_least.clear();
        self.at_least.resize(count, 0);
        self.shrink.clear();
        self.shrink.resize(count, 1.0);
        self.bulge.clear();
        self.bulge.resize(count, 0.0);
        self.is_middle_near.clear();
        self.is_middle_near.resize(count, false);
        self.is_too_fast.clear();
        self.is_too_fast.resize(count, false);
    }

    pub(crate) fn count(&self) -> usize {
        self.progress.len() - 1
    }

    /// True if the period before sample `k` lies on one piece.
    fn is_on_one_piece(&self, k: usize) -> bool {
        self.piece[k - 1] == self.piece[k]
    }

    /// True if the tube bounds the middle of the period before sample `k`, too.
    pub(crate) fn has_middle(&self, k: usize) -> bool {
        self.is_middle_near[k] && self.is_on_one_piece(k)
    }

    /// What the motion bulges, next to sample `k`, out of chords whose ends are bounded: those of
    /// periods. With their middles bounded those of half periods on one piece, and at a corner of
    /// the part of a period that is on its side.
    pub(crate) fn sagitta<const D: usize>(&self, path: &ScaledPath<D>, k: usize) -> f64 {
        let bulge_after = self.bulge.get(k + 1).copied().unwrap_or(0.0);
        if !self.bounds_middles {
            return f64::max(self.bulge[k], bulge_after);
        }
        let part_of = |share: f64| (share * share).clamp(OF_HALVES, 1.0);
        let before = if self.is_on_one_piece(k) {
            OF_HALVES
        } else {
            part_of(1.0 - self.share_before(path, self.piece[k], k))
        };
        let after = match self.piece.get(k + 1) {
            None => 0.0,
            Some(next) if *next == self.piece[k] => OF_HALVES,
            Some(_) => part_of(self.share_before(path, self.piece[k] + 1, k + 1)),
        };
        f64::max(before * self.bulge[k], after * bulge_after)
    }

    /// The share of the period before sample `k` that is before the start of a piece.
    fn share_before<const D: usize>(&self, path: &ScaledPath<D>, piece: usize, k: usize) -> f64 {
        let (from, to) = (self.progress[k - 1], self.progress[k]);
        let share = (path.segments[piece].s - from) / (to - from);
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.5
        }
    }

    /// Gives every sample to a piece by its progress.
    pub(crate) fn assign<const D: usize>(&mut self, path: &ScaledPath<D>, first: usize) {
        let segments = &path.segments;
        let mut i = first;
        self.piece[0] = first;
        for k in 1..self.progress.len() {
            while i + 1 < segments.len() {
                let segment = &segments[i];
                let waits = path.slows_after(i) || path.changes_rate_after(i);
                let hop = if waits || self.is_too_fast[k] {
                    -AT_END_R * segment.radius
                } else {
                    HOP_R * segment.radius.min(segment.length)
                };
                let is_past = self.progress[k] > segment.s + segment.length - hop;
                if !is_past && self.at_least[k] <= i {
                    break;
                }
                i += 1;
            }
            self.piece[k] = i;
        }
    }

    /// Projects a motion onto the path, in order, from a place on piece `first`. With `may_lead`, a
    /// sample that is already in the tube of the next piece will be given to that.
    pub(crate) fn project<const D: usize>(
        &mut self,
        path: &ScaledPath<D>,
        points: &[[f64; D]],
        first: usize,
        grid: &Grid,
        may_lead: bool,
    ) {
        let mut at = SamplePlace {
            piece: first,
            s: self.progress[0],
            distance: 0.0,
        };
        self.worst_r = 0.0;
        self.bounds_middles = grid.knots > 1;
        let mut bend_before = 0.0;
        let mut before = sample(points, grid, 0);
        for k in 1..=self.count() {
            let y = sample(points, grid, k);
            let next = nearest(path, &y, at, ahead(path, at.piece, &before, &y));
            before = y;
            at = hold_back(path, points, (k, &y), (at, next), grid);
            let SamplePlace { piece, s, distance } = at;
            self.is_too_fast[k] = is_too_fast(path, points, (piece, k), grid);
            self.progress[k] = s;
            self.at_least[k] = 0;
            let (site, weights) = grid.bend_site(k);
            // A chord over a period T is off by T²/8 of the acceleration in its middle.
            let bend = across(path, piece, &combine(points, site, &weights)) / 8.0;
            self.bulge[k] = f64::max(bend, bend_before);
            bend_before = bend;
            self.is_middle_near[k] |=
                self.bounds_middles && middle_r(path, piece, points, grid, k) > WORTH_R;
            let distance_r = distance / path.segments[piece].radius;
            self.worst_r = self.worst_r.max(distance_r);
            if may_lead && !self.is_too_fast[k] && leads(path, &y, piece, s) {
                self.at_least[k] = piece + 1;
            }
            // A sample that came out at the edge, or a little beyond, gets a smaller radius, and keeps it.
            if distance_r > EDGE_R && distance_r < FAR_OUT_R {
                self.shrink[k] = (self.shrink[k] * INSIDE_R / distance_r).max(LEAST_SHRINK);
            }
        }
    }

    /// Between what the samples were given for and where they came out: against coming and going.
    pub(crate) fn go_half_way(&mut self, given: &[f64]) {
        for (s, before) in self.progress.iter_mut().zip(given) {
            *s = 0.5 * (*s + before);
        }
        self.at_least.fill(0);
    }

    /// Mean progress since the first sample, in the time that it takes at the top speeds, s: where the
    /// feed is slow, little way is much time.
    pub(crate) fn mean_t<const D: usize>(&self, path: &ScaledPath<D>) -> f64 {
        let times = self.times(path);
        let start_t = times.first().copied().unwrap_or(0.0);
        mean(times.iter().map(|t| t - start_t))
    }

    /// Progress of each sample, in the time that it takes at the top speeds from the start of the path, s.
    pub(crate) fn times<const D: usize>(&self, path: &ScaledPath<D>) -> Vec<f64> {
        let segments = &path.segments;
        let mut i = 0;
        let time = |s: &f64| {
            while i + 1 < segments.len() && segments[i].s + segments[i].length <= *s {
                i += 1;
            }
            segments[i].t + (s - segments[i].s) / segments[i].top
        };
        self.progress.iter().map(time).collect()
    }
}

/// The mean of some values, of which there is one at least.
pub(crate) fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "thousands")]
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The length of a vector across a piece.
fn across<const D: usize>(path: &ScaledPath<D>, piece: usize, vector: &[f64; D]) -> f64 {
    let tangent = &path.segments[piece].tangent;
    let along = dot(vector, tangent);
    let rest: [f64; D] = core::array::from_fn(|a| vector[a] - along * tangent[a]);
    dot(&rest, &rest).sqrt()
}

/// How far the middle of the period before sample `k` is off the line of a piece, in radii.
fn middle_r<const D: usize>(
    path: &ScaledPath<D>,
    piece: usize,
    points: &[[f64; D]],
    grid: &Grid,
    k: usize,
) -> f64 {
    let (site, weights) = grid.inner_site(k - 1, 0.5, 0.0);
    let middle = combine(points, site, &weights);
    let segment = &path.segments[piece];
    let offset = core::array::from_fn(|a| middle[a] - segment.start[a]);
    across(path, piece, &offset) / segment.radius
}

/// The point of a sample.
pub(crate) fn sample<const D: usize>(points: &[[f64; D]], grid: &Grid, k: usize) -> [f64; D] {
    let (first, weights) = grid.site(k);
    combine(points, first, &weights)
}

/// How far along the path a sample can be from the one before, if it has moved so far: a closed path
/// comes by the same place again, and must not be taken to have been passed in one step.
fn ahead<const D: usize>(
    path: &ScaledPath<D>,
    piece: usize,
    before: &[f64; D],
    y: &[f64; D],
) -> f64 {
    let moved: [f64; D] = core::array::from_fn(|k| y[k] - before[k]);
    MOST_DETOUR * dot(&moved, &moved).sqrt() + 2.0 * path.segments[piece].radius
}

/// The nearest place from `at` on, at most so far ahead, that a sample can be at.
fn nearest<const D: usize>(
    path: &ScaledPath<D>,
    y: &[f64; D],
    at: SamplePlace,
    ahead: f64,
) -> SamplePlace {
    let segments = &path.segments;
    let mut best = SamplePlace {
        distance: f64::INFINITY,
        ..at
    };
    let mut i = at.piece;
    while i < segments.len() && segments[i].s <= at.s + ahead {
        let segment = &segments[i];
        let place = SamplePlace::on(path, i, at.s, y);
        if place.distance < best.distance - NEARER_R * segment.radius {
            best = place;
        }
        // A path that folds back is not jumped over while the motion can still be before the fold.
        let folds = segments
            .get(i + 1)
            .is_some_and(|next| dot(&segment.tangent, &next.tangent) < FOLD_COS);
        if folds
            && best.distance <= segment.radius
            && best.s < segment.s + segment.length - BEFORE_FOLD_R * segment.radius
        {
            break;
        }
        i += 1;
    }
    best
}

/// True if a sample near the end of a piece is in the tube of the next one as well: at a corner, and near
/// to it.
fn leads<const D: usize>(path: &ScaledPath<D>, y: &[f64; D], piece: usize, s: f64) -> bool {
    let next = path.segments.get(piece + 1);
    let Some(next) = next.filter(|_| !path.changes_rate_after(piece)) else {
        return false;
    };
    let turn = path.turn(piece, piece + 1);
    if turn <= LEADING_TURN || next.s - s >= LEADING_R * next.radius / turn.min(1.0) {
        return false;
    }
    let offset: [f64; D] = core::array::from_fn(|k| y[k] - next.start[k]);
    let x = dot(&offset, &next.tangent).clamp(0.0, next.length);
    let across: [f64; D] = core::array::from_fn(|k| offset[k] - x * next.tangent[k]);
    dot(&across, &across).sqrt() < LEADING_TUBE_R * next.radius
}
