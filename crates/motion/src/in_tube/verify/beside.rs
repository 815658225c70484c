//! Which part of a chord is near a point.
//!
//! ```text
//!                 point
//!                   │ across
//!     a ──────┼─────┴─────┼───── b      of the chord, what is within the tolerance
//!               half  half               half² = (tolerance² − across²) / |b − a|²
//! ```
//!
//! Each group of axes has a tolerance of its own, and what is near in all of them is.

use glidepath_geometry::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};

use super::parameter_range::ParameterRange;
use crate::in_tube::path::TubePiece;

/// Axes with a tolerance together: two of three linear ones each, and the rotary ones.
const GROUPS: usize = 3;

/// A chord and a point beside it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside {
    groups: [AxisGroup; GROUPS],
    /// Of them, how many have an extent.
    count: usize,
}

/// The same in a group of axes.
#[derive(Debug, Clone, Copy, Default)]
struct AxisGroup {
    tolerance: f64,
    /// Squares of lengths: of the chord, from it to the point, and from its start to the point.
    along_2: f64,
    across_2: f64,
    offset_2: f64,
    /// Part of the chord next to the point.
    foot: f64,
}

/// The part of the chord between two places that is within the tolerances of a piece of a point.
#[inline]
pub(crate) fn near(
    piece: &TubePiece,
    ends: [&AxisVector; 2],
    point: &AxisVector,
) -> ParameterRange {
    let mut range = Some(ParameterRange::WHOLE);
    for_each_group(piece, ends, point, |group| {
        range = range.and_then(|range| group.cut(range, 1.0));
    });
    range.unwrap_or(ParameterRange::EMPTY)
}

/// Goes through the groups of axes that have an extent.
#[inline]
fn for_each_group(
    piece: &TubePiece,
    [a, b]: [&AxisVector; 2],
    point: &AxisVector,
    mut take: impl FnMut(AxisGroup),
) {
    let (along, offset) = (b - a, point - a);
    let (linear, rotary) = (piece.tolerance_mm, piece.tolerance_deg);
    let vectors = (&along, &offset);
    AxisGroup::of::<3>(linear, LINEAR_XYZ.start, vectors).map(&mut take);
    AxisGroup::of::<3>(linear, UVW.start, vectors).map(&mut take);
    AxisGroup::of::<3>(rotary, ROTARY_ABC.start, vectors).map(&mut take);
}

impl Beside {
    /// The chord between two places and a point, with the tolerances of a piece.
    pub(crate) fn new(piece: &TubePiece, ends: [&AxisVector; 2], point: &AxisVector) -> Self {
        let mut beside = Self {
            groups: [AxisGroup::default(); GROUPS],
            count: 0,
        };
        for_each_group(piece, ends, point, |group| {
            if let Some(next) = beside.groups.get_mut(beside.count) {
                *next = group;
                beside.count += 1;
            }
        });
        beside
    }

    /// The part of the chord within `share_r` tolerances of the point.
    pub(crate) fn within(&self, share_r: f64) -> ParameterRange {
        let mut groups = self.groups.iter().take(self.count);
        let range = groups.try_fold(ParameterRange::WHOLE, |range, group| {
            group.cut(range, share_r)
        });
        range.unwrap_or(ParameterRange::EMPTY)
    }
}

impl AxisGroup {
    /// `N` axes, if they have an extent.
    #[inline]
    fn of<const N: usize>(
        tolerance: f64,
        first: usize,
        (along, offset): (&AxisVector, &AxisVector),
    ) -> Option<Self> {
        let of = |vector: &AxisVector| -> [f64; N] { core::array::from_fn(|i| vector[first + i]) };
        let (along, offset) = (of(along), of(offset));
        let has_extent = (0..N).any(|i| along[i] != 0.0 || offset[i] != 0.0);
        has_extent.then(|| Self::new(tolerance, &along, &offset))
    }

    /// Of a part of the chord, what is within `share_r` tolerances of the point.
    #[inline]
    fn cut(&self, range: ParameterRange, share_r: f64) -> Option<ParameterRange> {
        let threshold = self.tolerance * share_r;
        let threshold_2 = threshold * threshold;
        // A chord too short to have a direction is a point.
        let has_direction = self.along_2 > 1e-20 * threshold * threshold;
        let room_2 = if has_direction {
            threshold_2 - self.across_2
        } else {
            threshold_2 - self.offset_2
        };
        if room_2.is_nan() || room_2 < 0.0 {
            return None;
        }
        if !has_direction {
            return Some(range);
        }
        let half = (room_2 / self.along_2).sqrt();
        Some(range.cut(ParameterRange {
            from: self.foot - half,
            to: self.foot + half,
        }))
    }

    #[inline]
    fn new<const N: usize>(tolerance: f64, along: &[f64; N], offset: &[f64; N]) -> Self {
        let (mut along_2, mut dot, mut offset_2) = (0.0, 0.0, 0.0);
        for i in 0..N {
            along_2 += along[i] * along[i];
            dot += along[i] * offset[i];
            // Not a number if the chord is none: then nothing is near.
            let offset = offset[i] - along[i] * 0.0;
            offset_2 += offset * offset;
        }
        let foot = if along_2 > 0.0 { dot / along_2 } else { 0.0 };
        let mut across_2 = 0.0;
        for i in 0..N {
            let across = offset[i] - along[i] * foot;
            across_2 += across * across;
        }
        Self {
            tolerance,
            along_2,
            across_2,
            offset_2,
            foot,
        }
    }
}
