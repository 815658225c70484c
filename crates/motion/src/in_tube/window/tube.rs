//! The rows of a window: stay in the tube of the piece, come near the corners. Those of the feed are in
//! [`super::feed_rows`].
//!
//! ```text
//!          ┊ over                     A sample of a piece stays within the radius of its line, and
//!   ───────●┈┈┈┈┈                     on the line between `back` before its start and `over` beyond
//!          │ ╲ ball                   its end: as far as the line stays near the path. Beyond a
//!          │   round the corner       sharp corner that is less than the radius; along gentle chords
//!                                     it is far, so that samples need not change pieces at once.
//! ```
//!
//! Samples are bound to the tube and, with several knots in a period, the middles between samples
//! of one piece where they are near its edge; less what the motion bulges out of the chords between
//! them. A straight line between two samples of one piece is then in it too, and where the motion
//! goes over to another piece, it must come near every corner on the way: a point of it between the
//! two samples must be inside the ball round the corner, and so must a chord that has its middle
//! there. Half-way between both, which is linear in the control points, each plane that touches the
//! ball is nearer by half the way. Together that is just what the judge asks.
//!
//! The round parts are bounded by planes ([`super::cutting_planes`]).
//!
//! The objective counts in periods. A sample that is a period's way at the top speed further on counts
//! 1/N of N samples, so what is gained at a place counts as much as later samples have a part in the
//! window: from nearly one where it begins to nothing where it ends, however long it is. Offsets are paid
//! at each sample, in the same measure. So a longer window weighs a corner or an arc against the pull like
//! a short one, and prices need no division by N.

use super::cutting_planes::{CLOSE_R, CuttingPlanes, HALF_WAY, Passing, Plane, nearest_to_corner};
use super::one_sided::{self, StartOffset};
use super::rate_changes;
use super::samples::{Samples, sample};
use super::scaled_path::ScaledPath;
use super::solver::{FAR, Problem, dot};
use super::spline::Grid;
use crate::in_tube::path::SHARP;

/// Part of a radius by which the path has left the line of a piece where that ends.
const STRAY_R: f64 = 0.5;
/// The furthest that a line goes on, in ways of a knot at the top speed. No measurement of this or of
/// [`STRAY_R`] is kept.
const CAP_KNOTS: f64 = 4.0;
/// How far the line of the first piece goes on before its start, in radii. Of what was before it nothing is
/// seen. Why .3 is not on record.
const UNSEEN_R: f64 = 0.3;
/// How many radii beyond an end of its line a sample is out of that row by one: to be there costs a quarter
/// of being out of the tube by as much; why is not on record.
const BEYOND_R: f64 = 4.0;
/// Turn from which there is a plane half-way between two pieces, 2·sin(turn/2): a smaller one is rounding.
const LEAST_TURN: f64 = 1e-6;
/// Most of the radius of a corner that is left to chords that cut it off: the radius that rows have must
/// stay well above 0, which they are divided by. No measurement of it is kept.
const MOST_SAGITTA_R: f64 = 0.5;
/// Most corners between two samples that get rows: those furthest from it. No measurement
/// of it is kept.
const MOST_CORNERS: usize = 4;
/// Share of the feed that is planned with at most. It is a period in 80 s; with all of the feed the
/// motion trembles here and there after corners.
pub(crate) const FEED_R: f64 = 0.999_95;
/// Price of velocity across the path ([`Style::steering`]). Of this and the next no measurement is kept.
pub(crate) const STEERING: f64 = 0.5;
/// The same as long as samples find their places: at corners it is paid in time.
pub(crate) const SEARCH_STEERING: f64 = 0.1;
/// How many times as dear jerk is where the motion is at the feed: no time is to be gained there. What windows do there
/// differs from one to the next by a micrometre or so, and with the usual price the motion went over within six
/// periods, with a jerk of up to a fifth of the limit. The time to settle goes with the sixth root: it is 1.8 times
/// as long. Of eight programs of CAM systems that trembled with the usual price five still did with 8 times as much, three
/// with 32, four with 128.
pub(crate) const JERK_AT_FEED: f64 = 32.0;
/// How the rows are to be made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Style {
    pub(crate) grid: Grid,
    pub(crate) period_t: f64,
    /// Radii by which lines may leave the path beyond their ends: large while searching.
    pub(crate) stray_r: f64,
    /// Corners at the ends of pieces before this one may have been passed already.
    pub(crate) passed: usize,
    /// The feed is not exceeded to be in time on a piece.
    pub(crate) is_feed_firm: bool,
    /// Share of the feed that is planned with.
    pub(crate) feed_r: f64,
    /// Part of the radius that is used: the rest is left to rounding, and to iterates that come and
    /// go.
    pub(crate) keep_r: f64,
    /// Pull towards the programmed path: an offset of the whole radius costs half of this at each sample,
    /// in periods of mean progress. Half, because such a price is that of a square, ½·price·offset²; this
    /// is its derivative at the radius.
    pub(crate) attraction: f64,
    /// The same of jerk at its limit, for each knot interval: with more knots in a period a time costs more
    /// of it beside the pull, which counts by sample.
    pub(crate) jerk: f64,
    /// The same of a velocity across the path as large as the feed where the feed is slow, for each first
    /// difference ([`super::feed_rows`]).
    pub(crate) steering: f64,
    /// After a corner the motion comes to the path without swinging ([`super::damping`]).
    pub(crate) is_damped: bool,
    /// On curves at the feed way counts, not progress ([`super::shortcuts`]).
    pub(crate) counts_way: bool,
    /// Not as far as possible, but as much in the middle as possible.
    pub(crate) is_centred: bool,
    /// The aim is the mean progress of the samples beyond this one, up to the other.
    pub(crate) aims_beyond: usize,
    pub(crate) aims_until: usize,
    /// The sample up to which the motion is at the feed from the start on: there is no time to be gained there, and
    /// jerk is dearer ([`JERK_AT_FEED`]).
    pub(crate) at_feed: usize,
    /// The points of the last motion are one, and not only a place to start from.
    pub(crate) has_motion: bool,
    /// No sample is to be further on than in the last motion: what is linear about that only has to settle.
    pub(crate) keeps_progress: bool,
}

/// What the motion takes to settle, in times in which jerk strays by a tolerance: 15 periods of 4 ms where
/// jerk is 4e4 and the tolerance .02 mm, with which axes were first fixed. One of the two pulls
/// ([`Style::attraction`], [`Style::jerk`]) against the other is the sixth root of their ratio, .83, of such a
/// time.
const SETTLING: f64 = 7.5;

impl Style {
    /// The jerk of each axis that [`Style::jerk`] is for, in tolerances per s³: its limit, but no more than
    /// a tolerance per period³, about what can be seen in one. With a limit far above that the price
    /// would be none. That it is just a period is a choice, of which no measurement is kept.
    pub(crate) fn priced_jerk<const D: usize>(&self, path: &ScaledPath<D>) -> [f64; D] {
        path.usual[1].map(|jerk| jerk.min(self.period_t.powi(-3)))
    }

    /// The knot intervals from the start in which the motion is at the feed.
    pub(crate) fn intervals_at_feed(&self) -> usize {
        self.at_feed * self.grid.knots / self.grid.periods
    }

    /// The time in which jerk strays by a tolerance, or a period if that is longer, s.
    pub(crate) fn stray_t<const D: usize>(&self, path: &ScaledPath<D>) -> f64 {
        let jerk = self.priced_jerk(path);
        let slowest_j = jerk.into_iter().fold(f64::INFINITY, f64::min);
        slowest_j.recip().cbrt()
    }

    /// Periods to settle in after a corner.
    pub(crate) fn settling_periods<const D: usize>(&self, path: &ScaledPath<D>) -> usize {
        settling_periods(path, self.period_t)
    }
}

/// Periods to settle in, by the limit of jerk: by the priced one 35 programs took the same time.
pub(crate) fn settling_periods<const D: usize>(path: &ScaledPath<D>, period_t: f64) -> usize {
    let slowest_j = path.usual[1].iter().copied().fold(f64::INFINITY, f64::min);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few, and clamped"
    )]
    let periods = (SETTLING * slowest_j.recip().cbrt() / period_t)
        .ceil()
        .min(1e6) as usize;
    periods
}

/// Extent of each piece's line beyond its ends, found when first asked for.
#[derive(Debug, Clone, Default)]
pub(crate) struct Extents {
    spans: Vec<Option<[f64; 2]>>,
}

impl Extents {
    pub(crate) fn clear(&mut self, pieces: usize) {
        self.spans.clear();
        self.spans.resize(pieces, None);
    }

    /// How far the line of a piece goes on before its start and beyond its end.
    fn of<const D: usize>(&mut self, path: &ScaledPath<D>, i: usize, style: &Style) -> [f64; 2] {
        if let Some(span) = self.spans[i] {
            return span;
        }
        let segment = &path.segments[i];
        // A line goes on until the path has left it by half a radius: half a radius beyond a sharp
        // corner, far along gentle chords. With that, steps need no bound of their own.
        let stray = STRAY_R * style.stray_r * segment.radius;
        let cap = (CAP_KNOTS * segment.top * style.grid.knot_t).max(segment.radius);
        let last = path.segments.len() - 1;
        let over = if path.slows_after(i) {
            0.0
        } else if i < last {
            let ahead = (i + 1..=last).map(|j| path.vertex(j));
            extent(&path.vertex(i), &segment.tangent, ahead, stray, cap)
        } else {
            0.0
        };
        let back = if i > 0 {
            let earlier = (0..i).rev().map(|j| path.segments[j].start);
            extent(
                &segment.start,
                &segment.tangent.map(|t| -t),
                earlier,
                stray,
                cap,
            )
        } else {
            UNSEEN_R * segment.radius
        };
        self.spans[i] = Some([back, over]);
        [back, over]
    }
}

/// How far the ray from a vertex goes before the path through `vertices` has left it by `stray`.
fn extent<const D: usize>(
    from: &[f64; D],
    direction: &[f64; D],
    vertices: impl Iterator<Item = [f64; D]>,
    stray: f64,
    cap: f64,
) -> f64 {
    let mut best = 0.0_f64;
    let mut last = (0.0, 0.0);
    for vertex in vertices {
        let offset: [f64; D] = core::array::from_fn(|k| vertex[k] - from[k]);
        let x = dot(&offset, direction);
        let across: [f64; D] = core::array::from_fn(|k| offset[k] - x * direction[k]);
        let distance = dot(&across, &across).sqrt();
        if x < best || distance > stray {
            if distance > last.1 && distance > stray {
                let share = ((stray - last.1) / (distance - last.1)).clamp(0.0, 1.0);
                best = best.max((last.0 + (x - last.0) * share).min(best + cap));
            }
            break;
        }
        best = x;
        last = (x, distance);
        if best > cap {
            break;
        }
    }
    best.max(stray).min(cap)
}

/// What rows are made from.
#[derive(Debug)]
pub(crate) struct Layout<'a, const D: usize> {
    pub(crate) path: &'a ScaledPath<D>,
    /// Given out.
    pub(crate) samples: &'a Samples,
    pub(crate) cutting_planes: &'a CuttingPlanes<D>,
    /// The motion so far.
    pub(crate) points: &'a [[f64; D]],
    pub(crate) style: &'a Style,
}

impl<const D: usize> Layout<'_, D> {
    /// What the progress of sample `k` counts, per length.
    pub(crate) fn aim(&self, k: usize) -> f64 {
        let (beyond, until) = (self.style.aims_beyond, self.style.aims_until);
        if self.style.is_centred || k <= beyond || k > until {
            return 0.0;
        }
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let count = (self.samples.count().min(until) - beyond) as f64;
        let top = self.path.segments[self.samples.piece[k]].top;
        1.0 / count / (top * self.style.period_t)
    }
}

/// Makes the rows of the tube and of its corners, and the objective.
pub(crate) fn build<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    extents: &mut Extents,
) {
    let Layout {
        path,
        samples,
        style,
        ..
    } = layout;
    let start = StartOffset::new(
        path,
        (samples.piece[0], samples.progress[0]),
        &sample(layout.points, &style.grid, 0),
        style.settling_periods(path),
    );
    for k in 1..=samples.count() {
        let i = samples.piece[k];
        let segment = &path.segments[i];
        let (first, weights) = style.grid.site(k);
        problem.add_site(first, weights);
        let span = extents.of(path, i, style);
        add_tube(problem, layout, (k, &start), span);
        let aim_direction = if style.counts_way {
            segment.progress_direction()
        } else {
            segment.tangent
        };
        problem.add_aim((first, weights), layout.aim(k), &aim_direction);
        if samples.piece[k - 1] < i {
            add_corners(problem, layout, k);
        }
    }
}

/// Rows of the last site, which is sample `k`.
fn add_tube<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    (k, start): (usize, &StartOffset<D>),
    [back, over]: [f64; 2],
) {
    let piece = layout.samples.piece[k];
    let segment = &layout.path.segments[piece];
    let sagitta = layout.samples.sagitta(layout.path, k);
    let sagitta = sagitta.min(MOST_SAGITTA_R * segment.radius);
    let radius = (segment.radius * layout.style.keep_r - sagitta) * layout.samples.shrink[k];
    if let Some(site) = problem.sites.last_mut() {
        site.attraction = layout.style.attraction / (radius * radius);
        site.center = layout.path.center(piece, layout.samples.progress[k]);
        site.tangent = segment.tangent;
    }
    let progress = layout.samples.progress[k];
    let period_s = segment.top * layout.style.period_t;
    let beside = segment.beside(progress, period_s, radius) / radius;
    for normal in &segment.normals[..D - 1] {
        let normal = normal.map(|n| n / radius);
        problem.add_row(normal, &segment.start, [-beside, beside]);
    }
    let scale = BEYOND_R * radius;
    let end = if layout.style.keeps_progress {
        (progress - segment.s).min(segment.length + over)
    } else {
        segment.length + over
    };
    let ends = [-back / scale, end / scale];
    problem.add_row(segment.tangent.map(|t| t / scale), &segment.start, ends);
    for plane in layout.cutting_planes.of_sample(k, piece) {
        let normal = plane.normal.map(|n| n / radius);
        problem.add_row(normal, &plane.center, [-FAR, 1.0]);
    }
    one_sided::keep(problem, layout.path, (k, piece, progress), (radius, start));
    rate_changes::keep(problem, layout.path, (piece, progress), radius);
    if layout.samples.has_middle(k) {
        add_middle(problem, layout, (k, start), radius);
    }
}

/// The same, but for the ends, for the middle between two samples of one piece. What has bounded
/// the samples bounds it, too.
fn add_middle<const D: usize>(
    problem: &mut Problem<D>,
    layout: &Layout<'_, D>,
    (k, start): (usize, &StartOffset<D>),
    radius: f64,
) {
    let piece = layout.samples.piece[k];
    let segment = &layout.path.segments[piece];
    let (first, weights) = layout.style.grid.inner_site(k - 1, 0.5, 0.0);
    problem.add_site(first, weights);
    let progress = 0.5 * (layout.samples.progress[k - 1] + layout.samples.progress[k]);
    let period_s = segment.top * layout.style.period_t;
    let beside = segment.beside(progress, period_s, radius) / radius;
    for normal in &segment.normals[..D - 1] {
        let normal = normal.map(|n| n / radius);
        problem.add_row(normal, &segment.start, [-beside, beside]);
    }
    let planes = [k - 1, k].map(|k| layout.cutting_planes.of_sample(k, piece));
    for plane in planes.into_iter().flatten() {
        let normal = plane.normal.map(|n| n / radius);
        problem.add_row(normal, &plane.center, [-FAR, 1.0]);
    }
    one_sided::keep(problem, layout.path, (k, piece, progress), (radius, start));
}

/// The line from the sample before `k` to sample `k` comes near the corners between.
fn add_corners<const D: usize>(problem: &mut Problem<D>, layout: &Layout<'_, D>, k: usize) {
    let Layout {
        path,
        samples,
        points,
        style,
        ..
    } = layout;
    let (from, to) = (samples.piece[k - 1].max(style.passed), samples.piece[k]);
    let mut corners: Vec<(f64, usize, Option<Passing<D>>)> = (from..to)
        .filter_map(|i| {
            let turn = path.turn(i, i + 1);
            if !style.has_motion {
                return (turn > SHARP).then_some((turn, i, None));
            }
            let passing = nearest_to_corner(path, points, (i, k, samples.count()), &style.grid);
            let off = passing.furthest();
            let distance_r = dot(&off, &off).sqrt() / corner_radius(path, i, style);
            // A corner once close stays in, or else it would come and go from round to round.
            let is_close =
                distance_r > CLOSE_R || layout.cutting_planes.of_corner(i).next().is_some();
            (turn > SHARP || is_close).then_some((distance_r, i, Some(passing)))
        })
        .collect();
    corners.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, i, passing) in corners.iter().take(MOST_CORNERS) {
        let (before, after) = (&path.segments[*i], &path.segments[i + 1]);
        let radius = corner_radius(path, *i, style);
        let (k, lambda) = passing
            .as_ref()
            .map_or((k, 0.5), |passing| (passing.sample, passing.lambda));
        let left = |normal: &[f64; D]| {
            let room = passing.as_ref().map_or(0.0, |passing| passing.room(normal));
            radius - room.min(MOST_SAGITTA_R * radius)
        };
        let (first, weights) = style.grid.inner_site(k - 1, lambda, HALF_WAY);
        problem.add_site(first, weights);
        if let Some(site) = problem.sites.last_mut().filter(|_| style.is_centred) {
            site.attraction = style.attraction / (radius * radius);
            site.center = after.start;
        }
        let turn = path.turn(*i, i + 1);
        let inwards = (turn > LEAST_TURN).then(|| Plane {
            normal: core::array::from_fn(|a| (after.tangent[a] - before.tangent[a]) / turn),
            center: after.start,
        });
        for plane in inwards.iter().chain(layout.cutting_planes.of_corner(*i)) {
            let left = left(&plane.normal);
            let normal = plane.normal.map(|n| n / left);
            problem.add_row(normal, &plane.center, [-FAR, 1.0]);
        }
    }
}

/// The part that is used of the tolerance of the corner at the end of piece `i`.
fn corner_radius<const D: usize>(path: &ScaledPath<D>, i: usize, style: &Style) -> f64 {
    path.segments[i].radius.min(path.segments[i + 1].radius) * style.keep_r
}
