//! The straight part of a straight feed move: what a machinist lays a ruler to.
//!
//! A tolerance is for corners and curves. So in the middle half of a move that is long enough to have
//! one, and from the first to the last of these where such moves were drawn together, the tube is narrow,
//! whatever comes before and after. Nothing is refused for it: a motion that stops
//! would be worse on the part than one that is a little beside its line.
//!
//! ```text
//!   ──────────╮                                ╭──────────
//!     radius   ╰──────────────────────────────╯   radius
//!   ●─────────── ─ ─ ─ ─ within_mm ─ ─ ─ ─ ─ ─ ───────────●
//!   ──────────╮                                ╭──────────
//!              ╰──────────────────────────────╯
//!   0         ¼                                ¾          1
//! ```

use super::scaled_path::ScaledSegment;

/// Share of what the motion may be beside the line with which a window is planned: two normals together stay
/// within all of it, and a solution may be a little off.
const PLANNED_R: f64 = 0.6;
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

    /// True if an axis at a coordinate, at a progress, is ahead of the line along the way that it goes, by more than the
    /// line comes up until the piece has to be straight. To turn round is the lesser evil then: a slot that leans a
    /// little would lie beside its line until that has caught up.
    pub(super) fn has_to_come_back(
        &self,
        progress: f64,
        (axis, at): (usize, f64),
        sense: f64,
    ) -> bool {
        self.straight.is_some_and(|straight| {
            let [from, to] = straight.between;
            let line = self.start[axis] + self.tangent[axis] * (progress - self.s);
            let comes_up = self.tangent[axis].abs() * (from - progress).max(0.0);
            progress < to && sense * (at - line) > comes_up + straight.within
        })
    }
}
