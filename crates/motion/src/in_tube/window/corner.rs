//! The corners of the figure that a window sees, and on which side of them pieces are.
//!
//! ```text
//!                     ○ V          V turns by more than a curve in chords does. Both runs that meet there, up
//!             run   ╱   ╲ run      to where the next corner is nearer, are to be passed on their inner side:
//!                 ╱ inner ╲        every piece of them by its own direction, so that an arc or a line in many
//!               ●           ╲      chords has a side, too.
//!                             ●
//! ```

use super::scaled_path::ScaledPath;
use super::solver::dot;
use crate::in_tube::path::{ReferencePath, TubePiece};

/// Runs shorter than so many radii are no figure with corners: the motion may leave them out. With
/// less, roughness becomes walls; with more, small figures lose their corners. No measurement of it is kept.
const FIGURE_R: f64 = 8.0;
/// Cosine of how much a run may have turned from its corner, 60°: further on the inner side of the corner is not
/// that of the run.
const STILL_OF_CORNER_COS: f64 = 0.5;
/// How far outside of a piece that is not at the corner itself the border is, in radii. A motion along an arc is
/// beside it by less: with a border on it, some windows at the feed found no motion.
const FAR_BEYOND_R: f64 = 0.01;
/// Cosine beyond which the path comes back on itself, and neither side of it is the outer one.
const REVERSAL_COS: f64 = -0.999;
/// Share of a run on both sides of its middle in which neither end is the nearer one: where the sides of both
/// ends are opposite ones, the motion goes over there.
const MIDDLE: f64 = 0.08;

/// The side of a piece that a corner asks for.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerSide<const D: usize> {
    /// A point of the piece, and the direction to the inner side.
    pub(super) at: [f64; D],
    inner: [f64; D],
    /// How far outside of the piece the border is.
    pub(super) beyond: f64,
    /// The same of the other run, at the corner itself.
    other: Option<[f64; D]>,
}

/// The corners at both ends of the run that a piece is of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RunCorners<const D: usize> {
    sides: [Option<CornerSide<D>>; 2],
    /// Where the run begins and ends, as far as it is seen: progress.
    run: [f64; 2],
}

/// A corner: unit vectors along the path before and behind it, and its progress.
#[derive(Debug, Clone, Copy)]
struct Vertex<const D: usize> {
    along: [[f64; D]; 2],
    s: f64,
}

/// True if a progress is about the middle of a way.
pub(super) fn is_middle(progress: f64, [from, to]: [f64; 2]) -> bool {
    (progress - 0.5 * (from + to)).abs() < MIDDLE * (to - from)
}

impl<const D: usize> RunCorners<D> {
    pub(super) const NONE: Self = Self {
        sides: [None; 2],
        run: [0.0; 2],
    };

    /// Gives the sides on which the motion is to be at a progress, each with a direction to the inner side: those of the nearer corner; none where the motion goes over from the side of one to that of
    /// the other.
    pub(super) fn inner_sides(
        &self,
        progress: f64,
        mut give: impl FnMut(&CornerSide<D>, &[f64; D]),
    ) {
        if let [Some(start), Some(end)] = &self.sides
            && is_middle(progress, self.run)
            && dot(&start.inner, &end.inner) < 0.0
        {
            return;
        }
        let is_late = progress - self.run[0] > self.run[1] - progress;
        if let Some(side) = &self.sides[usize::from(is_late)] {
            give(side, &side.inner);
            if let Some(other) = &side.other {
                give(side, other);
            }
        }
    }
}

impl<const D: usize> Vertex<D> {
    /// The direction to the inner side of a piece along a unit vector, before or behind it; none where it has
    /// turned too far.
    fn inner(&self, along: &[f64; D], is_behind: bool) -> Option<[f64; D]> {
        let [before, behind] = &self.along;
        let at_corner = if is_behind { behind } else { before };
        if dot(along, at_corner) < STILL_OF_CORNER_COS {
            return None;
        }
        let across = |vector: &[f64; D], along: &[f64; D]| -> [f64; D] {
            let part = dot(vector, along);
            core::array::from_fn(|k| vector[k] - part * along[k])
        };
        // First the inner side at the corner: what the path turns by there is across a run that has turned as
        // much again to the other side.
        let turned: [f64; D] = core::array::from_fn(|k| behind[k] - before[k]);
        let across = across(&across(&turned, at_corner), along);
        let size = dot(&across, &across).sqrt();
        Some(across.map(|value| value / size))
    }
}

impl<const D: usize> ScaledPath<D> {
    /// Gives every piece the corners at the ends of its run, from the last piece to the first.
    pub(super) fn add_corners(&mut self, reference_path: &ReferencePath) {
        let mut next: Option<Vertex<D>> = None;
        // Where a run goes on beyond what is seen, its end is nowhere near.
        let mut run_end = if self.is_final {
            self.length()
        } else {
            f64::INFINITY
        };
        for i in (0..self.segments.len()).rev() {
            let Some(piece) = reference_path.get(self.first + i) else {
                continue;
            };
            let segment = &self.segments[i];
            // Lengths of the path by the unit of the window.
            let scale = segment.radius / piece.tolerance_mm;
            let run_start = segment.s - (piece.start_s - piece.run_from_s) * scale;
            let start = self.vertex_before(piece, (i, scale), run_end);
            let mut sides = [None; 2];
            if let Some(vertex) = &start {
                let is_here = vertex.s >= segment.s;
                sides[0] = vertex
                    .inner(&segment.tangent, true)
                    .map(|inner| CornerSide {
                        at: segment.start,
                        inner,
                        beyond: if is_here {
                            0.0
                        } else {
                            FAR_BEYOND_R * segment.radius
                        },
                        other: is_here
                            .then(|| vertex.inner(&vertex.along[0], false))
                            .flatten(),
                    });
            }
            if let Some(vertex) = &next {
                let is_here = i + 1 == self.segments.len() || vertex.s <= self.segments[i + 1].s;
                sides[1] = vertex
                    .inner(&segment.tangent, false)
                    .map(|inner| CornerSide {
                        at: self.vertex(i),
                        inner,
                        beyond: if is_here {
                            0.0
                        } else {
                            FAR_BEYOND_R * segment.radius
                        },
                        other: is_here
                            .then(|| vertex.inner(&vertex.along[1], true))
                            .flatten(),
                    });
            }
            let run = [run_start, run_end];
            if piece.run_from_s >= piece.start_s {
                // What is before it is another run.
                (next, run_end) = (start, segment.s);
            }
            self.segments[i].sides.corners = RunCorners { sides, run };
        }
    }

    /// The corner at which the run of piece `i` begins, if it is one of a figure.
    fn vertex_before(
        &self,
        piece: &TubePiece,
        (i, scale): (usize, f64),
        run_end: f64,
    ) -> Option<Vertex<D>> {
        let corner = piece.corner_before?;
        let segment = &self.segments[i];
        let s = segment.s - (piece.start_s - corner.at_s) * scale;
        let least = FIGURE_R * segment.radius;
        if corner.run_s * scale < least || run_end - s < least {
            return None;
        }
        let along = corner.along.map(|displacement| {
            let along = self.direction(&displacement);
            let size = dot(&along, &along).sqrt();
            along.map(|value| value / size)
        });
        let is_reversal = dot(&along[0], &along[1]) < REVERSAL_COS;
        (!is_reversal).then_some(Vertex { along, s })
    }
}
