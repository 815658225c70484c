//! The scaled path: what a window sees of the path, the axes that move, measured in tolerances.
//!
//! Dividing every axis by the tolerance of its group makes the tube round the path a round one of
//! radius one (unless tolerances change along the path), and a distance in it no less than in any of
//! the groups: a point within the radius in this space is within tolerance in every group. It also
//! makes millimetres and degrees, and millimetres and micrometres, the same problem.

mod conversion;
mod places;

use super::sides::{Sides, Straight};
use super::solver::dot;
use crate::feed_axes::counted_axes;
use crate::in_tube::path::{ReferencePath, TubePiece, directional};
use crate::in_tube::verify::FEED_CHANGE_MM;
use crate::joints::{Joints, SharedJoints, alone};
use crate::scurve::PathLimits;
use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_program::Limits;

/// A speed that is slower than another, in shares of it.
pub(super) const SLOWER: f64 = 0.999;

/// Length that is left of a unit vector, made perpendicular to some others, from which it is taken for another
/// direction than theirs.
const LEAST_REST: f64 = 1e-3;
/// How many times the feed an axis' own velocity has to be not to bind.
const FEED_KEEPS_R: f64 = 1.05;

/// A piece of the path in the space of the window.
#[derive(Debug, Clone)]
pub(crate) struct ScaledSegment<const D: usize> {
    pub(crate) start: [f64; D],
    /// Unit vector.
    pub(crate) tangent: [f64; D],
    pub(crate) length: f64,
    /// Length from the start of the scaled path to the start of the piece.
    pub(crate) s: f64,
    /// Time that all pieces before it take at their top speeds, s.
    pub(crate) t: f64,
    /// Radius of the tube: 1 where the tolerance is that of the window's first piece.
    pub(crate) radius: f64,
    /// Speed the feed and the axes allow, in tolerances per s.
    pub(crate) top: f64,
    /// Limits along it, in tolerances per s² and s³.
    pub(crate) limits: PathLimits,
    /// Direction in the axes of the feed, such that feed speed over programmed feed is `feed · v`.
    pub(crate) feed: [f64; D],
    /// Per axis, one over the programmed feed where the feed counts the axis, in s per tolerance; else
    /// zero.
    pub(crate) feed_axes: [f64; D],
    /// From its middle to the program it stands for.
    pub(crate) sagitta_vector: [f64; D],
    /// Where it leaves an axis alone: the coordinate.
    pub(crate) level: [Option<f64>; D],
    /// Across: first in the plane of the corner at its end, then whatever completes the base.
    pub(crate) normals: [[f64; D]; D],
    /// On which the motion is to stay.
    pub(crate) sides: Sides<D>,
    /// Where it is to be straight.
    pub(super) straight: Option<Straight>,
    /// How far a motion may be beyond a border of it, at least.
    pub(super) beyond: f64,
    /// It has no feed.
    pub(crate) is_rapid: bool,
}

impl<const D: usize> ScaledSegment<D> {
    /// True if the feed counts every axis that moves along it: not where rotary axes move beside
    /// linear ones.
    pub(crate) fn is_all_counted(&self) -> bool {
        let mut axes = self.tangent.iter().zip(self.feed_axes);
        axes.all(|(tangent, counted)| counted > 0.0 || tangent.abs() <= 0.0)
    }

    /// The direction in which way counts as progress; along the tangent it is one. Where the feed binds and does not
    /// count every axis that moves, it is that of the feed: else a rotary axis that is ahead of the others by all of its
    /// tolerance would count as progress, and would stay there.
    pub(super) fn progress_direction(&self) -> [f64; D] {
        if self.is_all_counted() || !self.is_feed_bound() {
            return self.tangent;
        }
        let along = dot(&self.feed, &self.tangent);
        self.feed.map(|feed| feed / along)
    }

    /// What a way takes at the feed, in the axes that it counts, s.
    pub(super) fn feed_t(&self, way: &[f64; D]) -> f64 {
        let counted: [f64; D] = core::array::from_fn(|a| way[a] * self.feed_axes[a]);
        dot(&counted, &counted).sqrt()
    }

    /// True if the feed sets the top speed, and no limit of an axis.
    pub(super) fn is_feed_bound(&self) -> bool {
        dot(&self.feed, &self.tangent) * self.top >= SLOWER
    }
}

/// The path of a window, measured in tolerances.
#[derive(Debug, Clone)]
pub(crate) struct ScaledPath<const D: usize> {
    /// Number of the first piece.
    pub(crate) first: usize,
    pub(crate) segments: Vec<ScaledSegment<D>>,
    /// The path ends with the last piece.
    pub(crate) is_final: bool,
    /// The moving axes, and how many they are: the rest of the `D` stays at zero.
    pub(super) axes: [usize; D],
    pub(super) moving: usize,
    /// The tolerance of the linear axes, mm.
    pub(super) unit_mm: f64,
    /// The tolerance of each, mm or degrees, and where the window begins, which is its zero.
    pub(super) unit: [f64; D],
    pub(super) origin: AxisVector,
    /// Coordinates at which pieces leave an axis alone, in the space of the window and as programmed,
    /// by rising order.
    levels: [Vec<(f64, f64)>; D],
    /// Limits of the moving axes, in tolerances per s, s² and s³.
    pub(crate) velocity: [f64; D],
    pub(crate) acceleration: [f64; D],
    pub(crate) jerk: [f64; D],
    /// What acceleration and jerk of each axis alone may be about here, where joints are not the axes; else its
    /// limits.
    pub(super) usual: [[f64; D]; 2],
    /// Ends of travel, lowest and highest, in the space of the window; infinite where there is none.
    pub(crate) walls: [[f64; 2]; D],
    /// How far a rate may go on beyond where another one begins, in tolerances of the linear axes.
    pub(super) rate_change: f64,
    joints: SharedJoints,
}

/// Axes on which something differs from `from`.
pub(crate) fn moving_axes<'a>(
    from: &AxisVector,
    points: impl Iterator<Item = &'a AxisVector>,
) -> [bool; AXES] {
    let mut moves = [false; AXES];
    for point in points {
        for (is_moving, (a, b)) in moves.iter_mut().zip(point.iter().zip(from.iter())) {
            *is_moving |= (a - b).abs() > 0.0;
        }
    }
    moves
}

impl<const D: usize> ScaledPath<D> {
    /// The pieces `range` as seen from `origin`, in memory of an earlier path; `moves` has at most `D`
    /// axes.
    pub(crate) fn new(
        limits: &Limits,
        reference_path: &ReferencePath,
        range: core::ops::Range<usize>,
        (origin, moves): (AxisVector, [bool; AXES]),
        mut segments: Vec<ScaledSegment<D>>,
    ) -> Self {
        segments.clear();
        segments.reserve(range.len());
        let tolerances = reference_path
            .get(range.start)
            .map_or([1.0; 2], |piece| [piece.tolerance_mm, piece.tolerance_deg]);
        let mut path = Self {
            first: range.start,
            segments,
            is_final: range.end > 0 && reference_path.is_last(range.end - 1),
            axes: [0; D],
            moving: 0,
            unit_mm: tolerances[0],
            unit: [1.0; D],
            origin,
            levels: core::array::from_fn(|_| Vec::new()),
            velocity: [1.0; D],
            acceleration: [1.0; D],
            jerk: [1.0; D],
            usual: [[1.0; D]; 2],
            walls: [[f64::NEG_INFINITY, f64::INFINITY]; D],
            rate_change: FEED_CHANGE_MM / tolerances[0],
            joints: None,
        };
        for axis in Axis::ALL
            .into_iter()
            .filter(|axis| moves[axis.index()])
            .take(D)
        {
            let (k, i) = (path.moving, axis.index());
            let unit = tolerances[usize::from(axis.is_rotary())];
            path.axes[k] = i;
            path.unit[k] = unit;
            path.velocity[k] = limits.velocity[i] / unit;
            path.acceleration[k] = limits.acceleration[i] / unit;
            path.jerk[k] = limits.jerk[i] / unit;
            path.usual = [path.acceleration, path.jerk];
            let ends = [limits.travel.lowest[i], limits.travel.highest[i]];
            path.walls[k] = ends.map(|end| (end - origin[i]) / unit);
            path.moving += 1;
        }
        for piece in range.filter_map(|index| reference_path.get(index)) {
            path.add(limits, piece, tolerances);
        }
        path.add_normals();
        for levels in &mut path.levels {
            levels.sort_by(|a, b| a.0.total_cmp(&b.0));
            levels.dedup_by(|a, b| a.0.total_cmp(&b.0).is_eq());
        }
        path
    }

    /// The same path for joints that are not the axes.
    pub(crate) fn with_joints(mut self, joints: &SharedJoints) -> Self {
        self.joints.clone_from(joints);
        if let Some([accelerations, jerks]) = self.joints().and_then(|j| alone(j, &self.origin)) {
            for k in 0..self.moving {
                let (i, unit) = (self.axes[k], self.unit[k]);
                let [acceleration, jerk] = &mut self.usual;
                acceleration[k] = acceleration[k].min(accelerations[i] / unit);
                jerk[k] = jerk[k].min(jerks[i] / unit);
            }
        }
        self
    }

    /// The joints, where these are not the axes.
    pub(super) fn joints(&self) -> Option<&dyn Joints> {
        self.joints.as_deref()
    }

    fn add(&mut self, limits: &Limits, piece: &TubePiece, [unit_mm, unit_deg]: [f64; 2]) {
        let displacement = piece.end - piece.start;
        let start = self.inside(&piece.start);
        let mut along = [0.0; D];
        for k in 0..self.moving {
            along[k] = displacement[self.axes[k]] / self.unit[k];
        }
        let mut level = [None; D];
        let mut sagitta_vector = [0.0; D];
        for k in 0..self.moving {
            let i = self.axes[k];
            sagitta_vector[k] = piece.sagitta_vector[i] / self.unit[k];
            if piece.start[i].total_cmp(&piece.end[i]).is_eq() && sagitta_vector[k].abs() <= 0.0 {
                level[k] = Some(start[k]);
                self.levels[k].push((start[k], piece.start[i]));
            }
        }
        let length = dot(&along, &along).sqrt();
        let tangent = along.map(|value| value / length);
        let bounds = directional(limits, &(displacement / length));
        let bounds = piece.within_joints(bounds, length / piece.length_s);
        let mut feed = [0.0; D];
        let mut feed_axes = [0.0; D];
        let counted = counted_axes(&displacement);
        for k in 0..self.moving {
            if counted.contains(&self.axes[k]) {
                feed[k] =
                    displacement[self.axes[k]] / piece.length_s * self.unit[k] / piece.counted_v;
                feed_axes[k] = self.unit[k] / piece.counted_v;
            }
        }
        let s = self
            .segments
            .last()
            .map_or(0.0, |last| last.s + last.length);
        let t = self
            .segments
            .last()
            .map_or(0.0, |last| last.t + last.length / last.top);
        self.segments.push(ScaledSegment {
            start,
            tangent,
            length,
            s,
            t,
            radius: (piece.tolerance_mm / unit_mm).min(piece.tolerance_deg / unit_deg),
            top: (piece.top_v * length / piece.length_s).min(bounds.speed_v),
            limits: bounds.path,
            feed,
            feed_axes,
            sagitta_vector,
            level,
            normals: [[0.0; D]; D],
            sides: Sides::none(),
            straight: Straight::of(piece, (s, length), unit_mm),
            beyond: piece.beyond_mm / unit_mm,
            is_rapid: piece.is_rapid,
        });
    }

    /// Completes each tangent to a base whose first normal lies in the plane of the next corner (of
    /// the corner before, where the path goes straight on).
    fn add_normals(&mut self) {
        for i in 0..self.segments.len() {
            let tangent = self.segments[i].tangent;
            let mut candidates: Vec<[f64; D]> = Vec::with_capacity(D + 2);
            for other in [Some(i + 1), i.checked_sub(1)].into_iter().flatten() {
                candidates.extend(self.segments.get(other).map(|segment| segment.tangent));
            }
            candidates
                .extend((0..D).map(|k| core::array::from_fn(|a| f64::from(u8::from(a == k)))));
            let mut normals = [[0.0; D]; D];
            let mut found = 0;
            for candidate in candidates {
                if found + 1 >= D {
                    break;
                }
                let mut rest = candidate;
                for other in core::iter::once(&tangent).chain(&normals[..found]) {
                    let part = dot(&rest, other);
                    for k in 0..D {
                        rest[k] -= part * other[k];
                    }
                }
                let size = dot(&rest, &rest).sqrt();
                if size > LEAST_REST {
                    normals[found] = rest.map(|value| value / size);
                    found += 1;
                }
            }
            self.segments[i].normals = normals;
        }
    }

    /// Length of the whole path of the scaled path.
    pub(crate) fn length(&self) -> f64 {
        self.segments
            .last()
            .map_or(0.0, |last| last.s + last.length)
    }

    /// Limits of the axes whose own velocity may bind before the feed does; infinite for those that the feed
    /// keeps well below theirs on every piece. Rows that cannot bind are work.
    pub(crate) fn velocity_bounds(&self) -> [f64; D] {
        core::array::from_fn(|k| {
            let is_bounded_by_feed =
                |segment: &ScaledSegment<D>| segment.feed_axes[k] * self.velocity[k] > FEED_KEEPS_R;
            if self.segments.iter().all(is_bounded_by_feed) || k >= self.moving {
                f64::INFINITY
            } else {
                self.velocity[k]
            }
        })
    }
}
