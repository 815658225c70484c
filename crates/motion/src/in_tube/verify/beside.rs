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

/// Axes with a tolerance together: two of three linear ones each, and every rotary one.
const GROUPS: usize = 5;

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

impl Beside {
    /// The chord between two places and a point, with the tolerances of a piece.
    pub(crate) fn new(piece: &TubePiece, [a, b]: [&AxisVector; 2], point: &AxisVector) -> Self {
        let (along, offset) = (b - a, point - a);
        let mut beside = Self {
            groups: [AxisGroup::default(); GROUPS],
            count: 0,
        };
        let (linear, rotary) = (piece.tolerance_mm, piece.tolerance_deg);
        beside.add::<3>(linear, LINEAR_XYZ.start, &along, &offset);
        beside.add::<3>(linear, UVW.start, &along, &offset);
        for axis in ROTARY_ABC {
            beside.add::<1>(rotary, axis, &along, &offset);
        }
        beside
    }

    /// Adds a group of `N` axes, if it has an extent.
    #[inline]
    fn add<const N: usize>(
        &mut self,
        tolerance: f64,
        first: usize,
        along: &AxisVector,
        offset: &AxisVector,
    ) {
        let of = |vector: &AxisVector| -> [f64; N] { core::array::from_fn(|i| vector[first + i]) };
        let (along, offset) = (of(along), of(offset));
        if (0..N).all(|i| along[i] == 0.0 && offset[i] == 0.0) {
            return;
        }
        if let Some(next) = self.groups.get_mut(self.count) {
            *next = AxisGroup::new(tolerance, &along, &offset);
            self.count += 1;
        }
    }

    /// The part of the chord within `share_r` tolerances of the point.
    pub(crate) fn within(&self, share_r: f64) -> ParameterRange {
        let mut range = ParameterRange::WHOLE;
        for group in self.groups.iter().take(self.count) {
            let threshold = group.tolerance * share_r;
            let threshold_2 = threshold * threshold;
            // A chord too short to have a direction is a point.
            let has_direction = group.along_2 > 1e-20 * threshold * threshold;
            let room_2 = if has_direction {
                threshold_2 - group.across_2
            } else {
                threshold_2 - group.offset_2
            };
            if room_2.is_nan() || room_2 < 0.0 {
                return ParameterRange::EMPTY;
            }
            if has_direction {
                let half = (room_2 / group.along_2).sqrt();
                range = range.cut(ParameterRange {
                    from: group.foot - half,
                    to: group.foot + half,
                });
            }
        }
        range
    }
}

impl AxisGroup {
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
