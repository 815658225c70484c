//! The corners of the figure that a window sees, and on which side of them pieces are.
//!
//! ```text
//!                     ○ V          V turns by more than a curve in chords does. Both runs that meet there, up
//!             run   ╱   ╲ run      to where the next corner is nearer, are to be passed on their inner side:
//!                 ╱ inner ╲        every piece of them by its own direction, so that an arc or a line in many
//!               ●           ╲      chords has a side, too.
//!                             ●
//! ```

use super::corner::{CornerSide, RunCorners, Vertex};
use super::scaled_path::ScaledPath;
use super::solver::dot;
use crate::in_tube::path::{ReferencePath, TubePiece};

/// Runs shorter than so many radii are no figure with corners: the motion may leave them out. With
/// less, roughness becomes walls; with more, small figures lose their corners. No measurement of it is kept.
const FIGURE_R: f64 = 8.0;
/// How far outside of a piece that is not next to the corner the border is, in radii. A motion along an arc is
/// beside it by less: with a border on it, some windows at the feed found no motion.
const FAR_BEYOND_R: f64 = 0.01;
/// Cosine beyond which the path comes back on itself, and neither side of it is the outer one.
const REVERSAL_COS: f64 = -0.999;
/// Share of a displacement that is all of it but for rounding.
const ALL_OF_IT: f64 = 0.999;

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
            let scale = self.unit_mm.recip();
            let run_start = segment.s - (piece.start_s - piece.run_from_s) * scale;
            let start = self.vertex_before(piece, (i, scale), run_end);
            let is_first = start.as_ref().is_some_and(|vertex| vertex.s >= segment.s);
            let end_s = segment.s + segment.length;
            let is_last = next.as_ref().is_some_and(|vertex| vertex.s <= end_s);
            let sides = [
                self.side(start.as_ref(), (i, segment.start, is_first), true),
                self.side(next.as_ref(), (i, self.vertex(i), is_last), false),
            ];
            let run = [run_start, run_end];
            if piece.run_from_s >= piece.start_s {
                // What is before it is another run.
                (next, run_end) = (start, segment.s);
            }
            self.segments[i].sides.corners = RunCorners { sides, run };
        }
    }

    /// The side of piece `i` after a corner, or before it, with a point of the piece; whether the piece is next to the
    /// corner.
    fn side(
        &self,
        vertex: Option<&Vertex<D>>,
        (i, at, is_next): (usize, [f64; D], bool),
        is_after: bool,
    ) -> Option<CornerSide<D>> {
        let vertex = vertex?;
        let segment = &self.segments[i];
        let [before, after] = &vertex.along;
        let other = if is_after { before } else { after };
        let beyond = if is_next {
            [0.0; 2]
        } else {
            // Pieces that meet there have the border in common.
            let here_r = vertex.left_r(&segment.tangent, is_after);
            let left_r = |i: usize| {
                let segment = self.segments.get(i);
                segment.map_or(here_r, |segment| vertex.left_r(&segment.tangent, is_after))
            };
            let ends = [i.saturating_sub(1), i + 1].map(|next| 0.5 * (here_r + left_r(next)));
            ends.map(|left_r| left_r.max(FAR_BEYOND_R) * segment.radius)
        };
        Some(CornerSide {
            at,
            inner: vertex.inner(&segment.tangent, is_after)?,
            beyond,
            other: if is_next {
                vertex.inner(other, !is_after)
            } else {
                None
            },
        })
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
        let [before, after] = corner.along.map(|displacement| {
            let along = self.direction(&displacement);
            let size = dot(&along, &along).sqrt();
            // What is beyond the window may have moved axes that rest in it.
            let is_all = size >= ALL_OF_IT * displacement.norm() * scale;
            is_all.then(|| along.map(|value| value / size))
        });
        let along = [before?, after?];
        let is_reversal = dot(&along[0], &along[1]) < REVERSAL_COS;
        (!is_reversal).then_some(Vertex { along, s })
    }
}
