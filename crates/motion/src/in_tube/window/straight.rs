//! The straight part of a straight feed move: what a machinist lays a ruler to.
//!
//! A tolerance is for corners and curves. So in the middle half of a move that is long enough to have
//! one, the tube is narrow, whatever comes before and behind. Nothing is refused for it: a motion that stops
//! would be worse on the part than one that is a little beside its line.
//!
//! ```text
//!   ──────────╮                                ╭──────────
//!     radius   ╰──────────────────────────────╯   radius
//!   ●─────────── ─ ─ ─ ─ straight_mm ─ ─ ─ ─ ─ ───────────●
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
}
