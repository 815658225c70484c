//! Balls as planes: what the tube and the corners are cut by, learnt from one solution to the next.
//!
//! The tube of a piece is round, and so is the room round a corner. Each is bounded by planes that
//! touch it where earlier solutions were: outer approximations that close in on the ball (the cutting
//! planes of Kelley 1960). The planes of the last few rounds are all kept, or else a motion that is
//! pushed back at one side comes out at another.
//!
//! The balls themselves could be rows, as cones of second order. But the solver is one for linear rows
//! with a Hessian that does not change; planes keep it so, and most samples never need one.

use super::samples::{Samples, WORTH_R, sample};
use super::scaled_path::ScaledPath;
use super::solver::{combine, dot};
use super::speed::velocity_over_feed;
use super::spline::Grid;
use crate::in_tube::path::SHARP;

/// Part of the radius from which a gentle corner gets rows: with less, every vertex of a fine polyline
/// has some, with more a motion may come out of the ball before there is a plane.
pub(crate) const CLOSE_R: f64 = 0.85;
/// Planes kept for each ball, the newest ones: each is a row of the problem. No measurement of it is kept.
const KEPT: usize = 5;
/// Directions kept in which a velocity was above the feed. With six, chords of a circle took three periods
/// more in one unit of length; for slow curves in wide tubes, which six were tried for, a stronger pull
/// to the path took their place ([`super::rounds`]).
const KEPT_DIRECTIONS: usize = 3;
/// Velocity over the feed from which a direction is kept. The judge allows 5e-4.
pub(crate) const WORTH_OF_FEED: f64 = 1.0 + 1e-4;

/// A plane with its outward normal; what it cuts off lies beyond `radius` from `center`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane<const D: usize> {
    pub(crate) normal: [f64; D],
    pub(crate) center: [f64; D],
}

/// The latest planes of one ball.
#[derive(Debug, Clone)]
struct Few<const D: usize> {
    /// Whose ball it is.
    owner: usize,
    planes: [Option<Plane<D>>; KEPT],
    next: usize,
}

impl<const D: usize> Few<D> {
    const EMPTY: Self = Self {
        owner: usize::MAX,
        planes: [None; KEPT],
        next: 0,
    };

    fn add(&mut self, owner: usize, plane: Plane<D>) {
        if self.owner != owner {
            *self = Self {
                owner,
                ..Self::EMPTY
            };
        }
        self.planes[self.next] = Some(plane);
        self.next = (self.next + 1) % KEPT;
    }
}

/// All planes of a window.
#[derive(Debug, Clone)]
pub(crate) struct CuttingPlanes<const D: usize> {
    samples: Vec<Few<D>>,
    corners: Vec<Few<D>>,
    /// By first control point of a first difference, newest first.
    feeds: Vec<[Option<[f64; D]>; KEPT_DIRECTIONS]>,
}

impl<const D: usize> CuttingPlanes<D> {
    pub(crate) const fn new() -> Self {
        Self {
            samples: Vec::new(),
            corners: Vec::new(),
            feeds: Vec::new(),
        }
    }

    pub(crate) fn clear(&mut self, samples: usize, corners: usize) {
        self.samples.clear();
        self.samples.resize(samples + 1, Few::EMPTY);
        self.corners.clear();
        self.corners.resize(corners, Few::EMPTY);
        self.feeds.clear();
    }

    /// Directions in which the velocity at a first difference was above the feed, as unit vectors
    /// of what [`velocity_over_feed`] gives.
    pub(crate) fn of_feed(&self, k: usize) -> impl Iterator<Item = &[f64; D]> {
        self.feeds
            .get(k)
            .into_iter()
            .flat_map(|few| few.iter().flatten())
    }

    /// Planes of sample `k` as long as it is on a piece.
    pub(crate) fn of_sample(&self, k: usize, piece: usize) -> impl Iterator<Item = &Plane<D>> {
        let few = self.samples.get(k).filter(|few| few.owner == piece);
        few.into_iter().flat_map(|few| few.planes.iter().flatten())
    }

    /// Planes of the corner at the end of piece `i`.
    pub(crate) fn of_corner(&self, i: usize) -> impl Iterator<Item = &Plane<D>> {
        self.corners
            .get(i)
            .into_iter()
            .flat_map(|few| few.planes.iter().flatten())
    }

    /// Takes note of where a motion is, with the samples as they were assigned for it; its largest
    /// speed over the feed.
    pub(crate) fn learn(
        &mut self,
        path: &ScaledPath<D>,
        samples: &Samples,
        points: &[[f64; D]],
        grid: &Grid,
    ) -> f64 {
        for k in 1..=samples.count() {
            let piece = samples.piece[k];
            self.learn_sample(path, (k, piece), &sample(points, grid, k));
            // Sharp corners always have rows, so a plane is kept early; of gentle ones only those that are
            // nearly missed.
            for i in samples.piece[k - 1]..piece {
                let passing = nearest_to_corner(path, points, (i, k, samples.count()), grid);
                let off = passing.furthest();
                let radius = path.segments[i].radius.min(path.segments[i + 1].radius);
                let distance = dot(&off, &off).sqrt();
                let worth_r = if path.turn(i, i + 1) > SHARP {
                    WORTH_R
                } else {
                    CLOSE_R
                };
                if distance > worth_r * radius {
                    let plane = Plane {
                        normal: off.map(|o| o / distance),
                        center: path.segments[i + 1].start,
                    };
                    self.corners[i].add(i, plane);
                }
            }
        }
        self.learn_feeds(path, samples, points, grid)
    }

    fn learn_feeds(
        &mut self,
        path: &ScaledPath<D>,
        samples: &Samples,
        points: &[[f64; D]],
        grid: &Grid,
    ) -> f64 {
        let mut most_r = 0.0_f64;
        self.feeds.resize(points.len(), [None; KEPT_DIRECTIONS]);
        for k in 2..points.len() - 3 {
            let slowest = slowest_feed(path, pieces_at(samples, grid, k));
            let (size, direction) = velocity_over_feed(points, &slowest, k, grid);
            most_r = most_r.max(size);
            if size > WORTH_OF_FEED {
                self.feeds[k].rotate_right(1);
                self.feeds[k][0] = Some(direction);
            }
        }
        most_r
    }

    fn learn_sample(&mut self, path: &ScaledPath<D>, (k, piece): (usize, usize), y: &[f64; D]) {
        let segment = &path.segments[piece];
        let offset: [f64; D] = core::array::from_fn(|a| y[a] - segment.start[a]);
        let along = dot(&offset, &segment.tangent);
        let x = along.clamp(0.0, segment.length);
        let is_beyond = (along - x).abs() > 0.0;
        // In a plane the sides of the tube are planes; far beyond an end its rows are what counts.
        if (D == 2 && !is_beyond) || (along - x).abs() > segment.radius {
            return;
        }
        let foot: [f64; D] = core::array::from_fn(|a| segment.start[a] + x * segment.tangent[a]);
        let across: [f64; D] = core::array::from_fn(|a| y[a] - foot[a]);
        let distance = dot(&across, &across).sqrt();
        if distance > WORTH_R * segment.radius {
            let plane = Plane {
                normal: across.map(|c| c / distance),
                center: foot,
            };
            self.samples[k].add(piece, plane);
        }
    }
}

/// Periods before and after the one in which samples change pieces, in which a corner may be
/// passed: samples go over before the end of a piece, the motion cuts the corner after it.
const NEAR_PERIODS: usize = 2;

/// Half-way from the motion to a chord that cuts it off, as a part of T² times acceleration: a chord of a
/// period that has its middle there is T²/8 times acceleration away.
pub(crate) const HALF_WAY: f64 = 1.0 / 16.0;
/// What the judge adds for chords that begin between those it looks at, of half their distance. It adds
/// .031 of that where a chord passes a vertex with its very middle, .094 within the sixteenth beside it
/// (`verify::follow`, half a step of 1/16): corners are passed near the middle of chords. For others the row
/// is too weak, and the judge refuses what passes there. All the same neither end is better: of 35 programs with
/// .031 four were up to .3 % faster and one .3 % slower, with .094 three up to 2 % faster and three up to .9 % slower.
const BETWEEN: f64 = 0.06;
/// Cosine of the turn within a period up to which all of the acceleration takes room at a corner. From
/// there to 1 what is along the motion fades out; the judge has a step, at .8.
const TURNING: f64 = 0.9;

/// How a motion passes a corner.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passing<const D: usize> {
    /// The sample after it.
    pub(crate) sample: usize,
    /// The parameter since the sample before at which it is nearest, and how far off: half-way from
    /// the motion to the chords that cut it off there.
    pub(crate) lambda: f64,
    off: [f64; D],
    /// From the motion to there, and from there to the chords.
    half: [f64; D],
}

impl<const D: usize> Passing<D> {
    /// The further one of motion and chords from the corner.
    pub(crate) fn furthest(&self) -> [f64; D] {
        let side = if dot(&self.off, &self.half) < 0.0 {
            -1.0
        } else {
            1.0
        };
        core::array::from_fn(|a| self.off[a] + side * self.half[a])
    }

    /// How much nearer than motion and chords half-way is in a direction, with what lies between
    /// the chords the judge looks at.
    pub(crate) fn room(&self, normal: &[f64; D]) -> f64 {
        dot(&self.half, normal).abs() + BETWEEN * dot(&self.half, &self.half).sqrt()
    }
}

/// How a motion passes the corner at the end of piece `i` near sample `k` of so many.
pub(crate) fn nearest_to_corner<const D: usize>(
    path: &ScaledPath<D>,
    points: &[[f64; D]],
    (i, k, count): (usize, usize, usize),
    grid: &Grid,
) -> Passing<D> {
    let vertex = &path.segments[i + 1].start;
    let mut best = Nearest::of(vertex, points, k, grid);
    for other in k.saturating_sub(NEAR_PERIODS).max(1)..=(k + NEAR_PERIODS).min(count) {
        if other != k {
            let other = Nearest::of(vertex, points, other, grid);
            if dot(&other.off, &other.off) < dot(&best.off, &best.off) {
                best = other;
            }
        }
    }
    best.passing(points, grid, path.turn(i, i + 1))
}

/// Where half-way from the motion of a period to its chords is nearest to a vertex.
struct Nearest<const D: usize> {
    /// The sample at the end of the period.
    sample: usize,
    lambda: f64,
    along: [f64; D],
    place: [f64; D],
    off: [f64; D],
}

impl<const D: usize> Nearest<D> {
    fn of(vertex: &[f64; D], points: &[[f64; D]], sample: usize, grid: &Grid) -> Self {
        let at = |lambda: f64| -> [f64; D] {
            let (first, weights) = grid.inner_site(sample - 1, lambda, HALF_WAY);
            combine(points, first, &weights)
        };
        // The nearest place of the straight line between both ends: the parameter is a guess for a row,
        // and the judge looks at what comes out.
        let (from, to) = (at(0.0), at(1.0));
        let along: [f64; D] = core::array::from_fn(|a| to[a] - from[a]);
        let offset: [f64; D] = core::array::from_fn(|a| vertex[a] - from[a]);
        let lambda = dot(&along, &offset) / dot(&along, &along);
        let lambda = if lambda.is_finite() {
            lambda.clamp(0.0, 1.0)
        } else {
            0.5
        };
        let place = at(lambda);
        Self {
            sample,
            lambda,
            along,
            place,
            off: core::array::from_fn(|a| place[a] - vertex[a]),
        }
    }

    /// How a motion passes there that turns so much.
    fn passing(&self, points: &[[f64; D]], grid: &Grid, turn: f64) -> Passing<D> {
        let (first, weights) = grid.inner_site(self.sample - 1, self.lambda, 0.0);
        let (motion, along) = (combine(points, first, &weights), &self.along);
        let mut half: [f64; D] = core::array::from_fn(|a| self.place[a] - motion[a]);
        let part = dot(&half, along) / dot(along, along);
        if part.is_finite() {
            let share = if turn <= SHARP {
                1.0
            } else {
                straightness(points, grid, self.sample)
            };
            // What a chord is off along the motion takes no room, as long as the motion goes straight on.
            half = core::array::from_fn(|a| half[a] - share * part * along[a]);
        }
        Passing {
            sample: self.sample,
            lambda: self.lambda,
            off: self.off,
            half,
        }
    }
}

/// How much of what is along the motion does not matter in the period that ends with sample `k`:
/// the less, the more it turns. The judge knows yes and no only; here that would come and go from
/// round to round.
fn straightness<const D: usize>(points: &[[f64; D]], grid: &Grid, k: usize) -> f64 {
    let [before, after] = [k - 1, k].map(|k| {
        let (first, weights) = grid.velocity_site(k);
        combine(points, first, &weights)
    });
    let cos = dot(&before, &after) / (dot(&before, &before) * dot(&after, &after)).sqrt();
    if cos.is_finite() {
        ((cos - TURNING) / (1.0 - TURNING)).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// The pieces that the first difference from control point `k` on has a part in. It is the control point of a
/// quadratic spline, the velocity: its middle is k − ½ intervals from the first knot, and it acts on one and
/// a half to either side. In half intervals that is 2k − 1 ± 3; `grid.knots`, half a period, are added at the
/// upper end, because a sample has the piece of the period that ends with it.
pub(crate) fn pieces_at(
    samples: &Samples,
    grid: &Grid,
    k: usize,
) -> core::ops::RangeInclusive<usize> {
    piece_at(samples, grid, 2 * k - 4)..=piece_at(samples, grid, 2 * k + 2 + grid.knots)
}

/// The piece at a number of half intervals.
pub(crate) fn piece_at(samples: &Samples, grid: &Grid, halves: usize) -> usize {
    samples.piece[sample_at(samples, grid, halves)]
}

/// The sample at a number of half intervals.
pub(crate) fn sample_at(samples: &Samples, grid: &Grid, halves: usize) -> usize {
    (halves * grid.periods / (2 * grid.knots)).min(samples.count())
}

/// The progress at a number of half intervals, between two samples by the time between them.
pub(crate) fn progress_at(samples: &Samples, grid: &Grid, halves: usize) -> f64 {
    let (at, period) = (halves * grid.periods, 2 * grid.knots);
    let sample = sample_at(samples, grid, halves);
    let next = (sample + 1).min(samples.count());
    #[expect(clippy::cast_precision_loss, reason = "a few")]
    let share = (at % period) as f64 / period as f64;
    samples.progress[sample] + share * (samples.progress[next] - samples.progress[sample])
}

/// Per axis, one over the feed of the slowest of some pieces, where the feed counts the axis.
pub(crate) fn slowest_feed<const D: usize>(
    path: &ScaledPath<D>,
    pieces: core::ops::RangeInclusive<usize>,
) -> [f64; D] {
    let mut slowest = [0.0_f64; D];
    for segment in &path.segments[pieces] {
        for a in 0..D {
            slowest[a] = slowest[a].max(segment.feed_axes[a]);
        }
    }
    slowest
}
