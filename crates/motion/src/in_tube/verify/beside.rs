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

use core::ops::Range;

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
        let axes = [LINEAR_XYZ, UVW].map(|axes| (axes, piece.tolerance_mm));
        let rotary = ROTARY_ABC.map(|axis| (axis..axis + 1, piece.tolerance_deg));
        for (axes, tolerance) in axes.into_iter().chain(rotary) {
            if axes.clone().all(|i| along[i] == 0.0 && offset[i] == 0.0) {
                continue;
            }
            if let Some(next) = beside.groups.get_mut(beside.count) {
                *next = AxisGroup::new(tolerance, axes, &along, &offset);
                beside.count += 1;
            }
        }
        beside
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
    fn new(tolerance: f64, axes: Range<usize>, along: &AxisVector, offset: &AxisVector) -> Self {
        let (mut along_2, mut dot, mut offset_2) = (0.0, 0.0, 0.0);
        for i in axes.clone() {
            along_2 += along[i] * along[i];
            dot += along[i] * offset[i];
            // Not a number if the chord is none: then nothing is near.
            let offset = offset[i] - along[i] * 0.0;
            offset_2 += offset * offset;
        }
        let foot = if along_2 > 0.0 { dot / along_2 } else { 0.0 };
        let mut across_2 = 0.0;
        for i in axes {
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
