//! The pieces whose feed counts where the motion is.
//!
//! ```text
//!     rapid ───────────●          Near a corner the motion may be on several pieces: on all that are
//!        motion ───╮   │ feed     within the tolerance. Those count that are as near as the nearest
//!                   ╲  │          one, give or take FEED_CHANGE_MM: however wide the tolerance is, a
//!                    ╲ ▼          rapid does not go on into the cut.
//! ```

use super::follow::Reachable;
use crate::in_tube::path::{ReferencePath, TubePiece};
use glidepath_geometry::AxisVector;

/// How much further than the nearest piece one may be whose feed still counts, mm (of rotary axes as many
/// tolerances). It is the widest tolerance that needs no look: within it all pieces in reach are as near.
pub(crate) const FEED_CHANGE_MM: f64 = 0.05;

/// The first and the last of the pieces that count at a position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NearPieces {
    first: usize,
    pub(crate) last: usize,
}

impl NearPieces {
    /// Of the pieces that can be reached, those near a position.
    pub(crate) fn of(
        reference_path: &ReferencePath,
        reachable: &Reachable,
        position: &AxisVector,
    ) -> Self {
        let all = Self {
            first: reachable.first,
            last: reachable.last(),
        };
        let mut pieces = (all.first..=all.last).filter_map(|index| reference_path.get(index));
        let Some(first) = pieces.next() else {
            return all;
        };
        let is_narrow = |piece: &TubePiece| piece.tolerance_mm <= FEED_CHANGE_MM;
        #[allow(clippy::float_cmp, reason = "the feed of moves alike is one number")]
        let is_alike = |piece: &TubePiece| piece.top_v == first.top_v;
        if pieces.all(|piece| is_alike(piece) || (is_narrow(piece) && is_narrow(first))) {
            return all;
        }
        let away_mm = |index: usize| reachable.away_mm(reference_path, index, position);
        let nearest_mm = (all.first..=all.last)
            .filter_map(away_mm)
            .fold(f64::INFINITY, f64::min);
        let is_near =
            |index: &usize| away_mm(*index).is_some_and(|mm| mm <= nearest_mm + FEED_CHANGE_MM);
        let first = (all.first..=all.last).find(is_near);
        let last = (all.first..=all.last).rev().find(is_near);
        Self {
            first: first.unwrap_or(all.first),
            last: last.unwrap_or(all.last),
        }
    }

    /// The pieces that count for a period that begins here and ends there: from the first one near its
    /// start to the last one near its end. Rapids, whose speeds are those of their axes, count together.
    pub(super) fn of_period<'a>(
        &self,
        end: &Self,
        reference_path: &'a ReferencePath,
        (from, to): (usize, usize),
    ) -> impl Iterator<Item = &'a TubePiece> + Clone {
        let near = self.first.min(end.last)..=self.first.max(end.last);
        let is_rapid =
            |index: usize| (reference_path.get(index)).is_some_and(|piece| piece.is_rapid);
        let has_rapid = near.clone().any(is_rapid);
        let counts = move |index: &usize| near.contains(index) || (has_rapid && is_rapid(*index));
        (from..=to)
            .filter(counts)
            .filter_map(|index| reference_path.get(index))
    }
}
