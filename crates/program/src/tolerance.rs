//! What a tolerance measures.

use glidepath_geometry::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};

/// The distance that a tolerance bounds: the XYZ part, the UVW part, or a rotary axis, whichever is
/// largest.
///
/// Lengths and angles are not added: a tolerance of 0.02 allows 0.02 mm to the tool centre and
/// 0.02° to each rotary axis.
#[inline]
#[must_use]
pub fn tolerance_norm(difference: &AxisVector) -> f64 {
    let norm = |axes: core::ops::Range<usize>| {
        axes.map(|i| difference[i] * difference[i])
            .sum::<f64>()
            .sqrt()
    };
    let rotary = ROTARY_ABC.map(|i| difference[i].abs()).fold(0.0, f64::max);
    norm(LINEAR_XYZ).max(norm(UVW)).max(rotary)
}
