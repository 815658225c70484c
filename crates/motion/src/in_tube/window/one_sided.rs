//! The side of the program on which a motion may be.
//!
//! Within the tube the fastest motion swings out before a corner and beyond an end, as a car takes a
//! bend. What is left on the inner side can be taken away by a finishing cut; what is gone on the outer
//! side cannot. So, if the motion is to stay on the inner side ([`Corners::Inner`]), the tube is one-sided
//! where that is the question:
//!
//! ```text
//!        V ────────▶        An axis that comes to a rest, or sets out from one, stays on the side
//!        │ ╲                that it comes from or goes to: no plunge goes below its depth.
//!        │   motion         At a corner V the motion stays between the two sides, in the wedge that
//!        │                  they make, each side for its half that is nearer to the corner.
//! ```
//!
//! All of that are half-spaces by place: where on which piece a sample is. Most are a side of the tube
//! already, which only moves; the others become rows near their borders. And where an axis is not to
//! turn round, its control points rise or fall with the program ([`super::sense_rows`]): else the motion would
//! dip into the inner side after each corner, and come back.

use super::scaled_path::ScaledPath;
use super::sides::{AxisSides, HalfSpace, Stop};
use super::solver::{Problem, dot};
use crate::in_tube::path::{AxisDirection, Origin, ReferencePath, SHARP, TubePiece, WORTH_R};
use glidepath_geometry::AxisVector;
use glidepath_program::Corners;

/// How near to a border the path is where a row is needed, in radii. The tube keeps the motion within one
/// of the path; along a piece samples may come out a little further on than they were given for.
const NEAR_R: f64 = 3.0;
/// Share of a piece by which the place of a motion on it may be taken to be another.
const SHIFT: f64 = 0.02;
/// What a motion may be beyond a border at least, in radii.
const BEYOND_R: f64 = 0.01;

impl<const D: usize> ScaledPath<D> {
    /// The same path with the sides on which the motion is to stay; the pieces are those it was made of.
    pub(crate) fn with_sides(mut self, reference_path: &ReferencePath, corners: Corners) -> Self {
        if corners == Corners::Either {
            return self;
        }
        for i in (0..self.segments.len()).rev() {
            let Some(piece) = reference_path.get(self.first + i) else {
                continue;
            };
            for k in 0..self.moving {
                self.segments[i].sides.axes[k] = self.axis_sides(piece, (i, k));
            }
        }
        self.add_corners(reference_path);
        self
    }

    fn axis_sides(&self, piece: &TubePiece, (i, k): (usize, usize)) -> AxisSides {
        let segment = &self.segments[i];
        let sense = &piece.senses[self.axes[k]];
        let from = (sense.from - self.origin[self.axes[k]]) / self.unit[k];
        let before = Stop {
            sign: match (sense.way, sense.origin) {
                (AxisDirection::Rest, _) => sense.came,
                (AxisDirection::Bent, _) | (_, Origin::Motion) => 0.0,
                _ => sense.way.sign(),
            },
            at: from,
            s: segment.s - (piece.start_s - sense.from_s) / self.unit[k],
            is_turn: sense.origin == Origin::Turn,
        };
        let next = self.segments.get(i + 1).map(|next| next.sides.axes[k]);
        let mut sides = AxisSides {
            way: sense.way.sign(),
            is_rest: sense.way == AxisDirection::Rest,
            from,
            to: self.vertex(i)[k],
            before,
            after: Stop::default(),
        };
        if let Some(next) = next.filter(|next| sides.goes_on_as(next)) {
            sides.to = next.to;
        }
        let is_worth =
            |sides: &AxisSides| (sides.to - sides.from).abs() >= WORTH_R * segment.radius;
        sides.after = self.stop_after((i, k), &sides, is_worth);
        if !sides.is_rest && !is_worth(&sides) {
            (sides.before, sides.after) = (Stop::default(), Stop::default());
        }
        sides
    }

    /// Where axis `k` stops next after piece `i`.
    fn stop_after(
        &self,
        (i, k): (usize, usize),
        sides: &AxisSides,
        is_worth: impl Fn(&AxisSides) -> bool,
    ) -> Stop {
        let stop = Stop {
            sign: sides.way,
            at: sides.to,
            s: self.segments[i].s + self.segments[i].length,
            is_turn: false,
        };
        let Some(next) = self.segments.get(i + 1).map(|next| &next.sides.axes[k]) else {
            return if self.is_final { stop } else { Stop::default() };
        };
        if sides.goes_on_as(next) {
            return next.after;
        }
        if sides.is_rest {
            // What follows sets out from here.
            let sign = if is_worth(next) { next.way } else { 0.0 };
            return Stop { sign, ..stop };
        }
        let is_turn = next.way * sides.way < 0.0 && self.turn(i, i + 1) > SHARP;
        if next.is_rest || is_turn {
            Stop { is_turn, ..stop }
        } else {
            Stop::default()
        }
    }

    /// A displacement in the space of the window.
    pub(super) fn direction(&self, displacement: &AxisVector) -> [f64; D] {
        let mut along = [0.0; D];
        for k in 0..self.moving {
            along[k] = displacement[self.axes[k]] / self.unit[k];
        }
        along
    }

    /// Gives every half-space in which a sample on piece `i` is to be, at a progress.
    pub(crate) fn half_spaces(&self, i: usize, progress: f64, mut give: impl FnMut(HalfSpace<D>)) {
        let segment = &self.segments[i];
        for (k, axis) in segment.sides.axes.iter().enumerate() {
            for (sign, at) in axis.borders(progress).into_iter().flatten() {
                let mut normal = [0.0; D];
                normal[k] = sign;
                give(HalfSpace {
                    normal,
                    least: sign * at,
                    axis: Some(k),
                });
            }
        }
        // What a piece stands for is beside it by so much there.
        let u = (progress - segment.s) / segment.length;
        let height = (4.0 * u * (1.0 - u)).max(0.0);
        segment.sides.corners.inner_sides(progress, |side, normal| {
            let at = dot(normal, &side.at) + height * dot(normal, &segment.sagitta_vector);
            let [from, to] = side.beyond;
            give(HalfSpace {
                normal: *normal,
                least: at - (from + u.clamp(0.0, 1.0) * (to - from)),
                axis: None,
            });
        });
    }

    /// How far a motion on piece `i` may be outside of a border.
    fn allowed_beyond(&self, i: usize) -> f64 {
        let segment = &self.segments[i];
        (BEYOND_R * segment.radius).max(segment.beyond)
    }

    /// True if the end of a period is on the sides on which the motion is to stay at a parameter of a
    /// piece, by its number on the whole path; give or take the way of the period, or a little of the piece. As far
    /// as a window that begins with an offset is still going over after some periods, it may be beside them.
    pub(crate) fn is_on_its_sides(
        &self,
        (index, u): (usize, f64),
        [from, to]: [&AxisVector; 2],
        (periods, start): (usize, &StartOffset<D>),
    ) -> bool {
        let i = index - self.first;
        let Some(segment) = self.segments.get(i) else {
            return true;
        };
        let (place, progress) = (self.inside(to), segment.s + u * segment.length);
        let step = self.direction(&(to - from));
        let way = dot(&step, &step).sqrt().min(SHIFT * segment.length);
        let allowed = self.allowed_beyond(i);
        let ends = [segment.s, segment.s + segment.length];
        [0.0, -way, way].into_iter().any(|shift| {
            // Where on the piece the period belongs is only known to within its way: one place is enough.
            let mut is_inside = true;
            let at = (progress + shift).max(ends[0]).min(ends[1]);
            let here = self.position(i, at);
            self.half_spaces(i, at, |side| {
                let room = start.room(periods, &side, &here, allowed);
                is_inside &= dot(&side.normal, &place) >= side.least - allowed.max(room);
            });
            is_inside
        })
    }
}

/// The offset of a window's start from the path, where that is outside of a border.
///
/// Where a corner comes into sight after the middle of its run, the motion that is given may be on the inner side of
/// the corner before, and that is the outer one of this. Asked to be on the other side at once, it would swing
/// over within two periods, and swing out by several times as much; judged at once, it would have to stop. So it goes
/// over while it settles. Borders that were known before have to be kept as they are: there it may only go over from
/// what the judge allows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StartOffset<const D: usize> {
    offset: [f64; D],
    /// It is further beyond a border of its own place than the judge allows.
    is_beyond: bool,
    settling_periods: usize,
}

impl<const D: usize> StartOffset<D> {
    /// That of a window whose first sample is on piece `i` at a progress.
    pub(crate) fn new(
        path: &ScaledPath<D>,
        (i, progress): (usize, f64),
        start: &[f64; D],
        settling_periods: usize,
    ) -> Self {
        let here = path.position(i, progress);
        let least = -path.allowed_beyond(i);
        let mut is_beyond = false;
        path.half_spaces(i, progress, |side| {
            is_beyond |= side.axis.is_none() && dot(&side.normal, start) - side.least < least;
        });
        // Across the path alone: where along it the start belongs is known to within a period, and on the border of
        // another piece that would count as an offset.
        let tangent = &path.segments[i].tangent;
        let off: [f64; D] = core::array::from_fn(|k| start[k] - here[k]);
        let along = dot(&off, tangent);
        Self {
            offset: core::array::from_fn(|k| off[k] - along * tangent[k]),
            is_beyond,
            settling_periods,
        }
    }

    /// How far the end of period `k` may be outside of the border of a side, where the path is `here`: less and less
    /// from period to period. The end of an axis' way stays where it is: no plunge goes
    /// below its depth, whatever comes into sight.
    fn room(&self, k: usize, side: &HalfSpace<D>, here: &[f64; D], allowed: f64) -> f64 {
        let inside = dot(&side.normal, here) - side.least;
        let outside = -inside - dot(&side.normal, &self.offset);
        if side.axis.is_some() || k >= self.settling_periods || outside <= 0.0 {
            return 0.0;
        }
        #[expect(clippy::cast_precision_loss, reason = "a few periods")]
        let left_r = 1.0 - k as f64 / self.settling_periods as f64;
        let most = if self.is_beyond {
            outside.max(allowed)
        } else {
            allowed
        };
        most * left_r
    }
}

/// Keeps the last site, which belongs to sample `k` on piece `i` at a progress, on its sides.
pub(super) fn keep<const D: usize>(
    problem: &mut Problem<D>,
    path: &ScaledPath<D>,
    (k, i, progress): (usize, usize, f64),
    (radius, start): (f64, &StartOffset<D>),
) {
    let Some(site) = problem.sites.last() else {
        return;
    };
    let (first, weights) = (site.first, site.weights);
    let here = path.position(i, progress);
    let allowed = path.allowed_beyond(i);
    path.half_spaces(i, progress, |side| {
        let is_given = side
            .axis
            .is_some_and(|axis| problem.is_given((first, &weights), axis));
        let inside = dot(&side.normal, &here) - side.least;
        if is_given || inside >= NEAR_R * radius {
            return;
        }
        let room = start.room(k, &side, &here, allowed);
        problem.keep_beyond(&side.normal, side.least - room, radius);
    });
}
