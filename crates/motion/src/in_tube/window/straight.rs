//! The straight part of a straight feed move: what a machinist lays a ruler to.
//!
//! A tolerance is for corners and curves. So in the middle half of a move that is long enough to have
//! one, the tube is narrow, whatever comes before and behind:
//!
//! ```text
//!   ──────────╮                                ╭──────────
//!     radius   ╰──────────────────────────────╯   radius
//!   ●─────────── ─ ─ ─ ─ straight_mm ─ ─ ─ ─ ─ ───────────●
//!   ──────────╮                                ╭──────────
//!              ╰──────────────────────────────╯
//!   0         ¼                                ¾          1
//! ```

use super::scaled_path::{ScaledPath, ScaledSegment};
use super::solver::dot;
use glidepath_geometry::AxisVector;

/// Share of what the motion may be beside the line with which a window is planned: two normals together stay
/// within all of it, and a solution may be a little off.
const PLANNED_R: f64 = 0.6;
impl<const D: usize> ScaledPath<D> {
    /// True if the end of a period is on the line of its piece as far as it is to be, at a parameter of the piece, by
    /// its number on the whole path.
    pub(crate) fn is_straight(&self, (index, u): (usize, f64), at: &AxisVector) -> bool {
        let Some(segment) = self.segments.get(index - self.first) else {
            return true;
        };
        let Some(straight) = segment.straight else {
            return true;
        };
        let progress = segment.s + u * segment.length;
        let [from, to] = straight.between;
        if !(from..=to).contains(&progress) {
            return true;
        }
        let place = self.inside(at);
        let off: [f64; D] = core::array::from_fn(|k| place[k] - segment.start[k]);
        let along = dot(&off, &segment.tangent);
        let beside: [f64; D] = core::array::from_fn(|k| off[k] - along * segment.tangent[k]);
        dot(&beside, &beside) <= straight.within * straight.within
    }
}

impl<const D: usize> ScaledSegment<D> {
    /// How far a sample may be beside the line of the piece, at a progress that may come out another by
    /// `shift`.
    pub(super) fn beside(&self, progress: f64, shift: f64, radius: f64) -> f64 {
        let straight = self.straight.filter(|straight| {
            let [from, to] = straight.between;
            (from - shift..=to + shift).contains(&progress)
        });
        straight.map_or(radius, |straight| (PLANNED_R * straight.within).min(radius))
    }
}
