//! The distance between places, and the rounding allowed on top of a tolerance.

use glidepath_geometry::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};

/// How far from the program a machine that stands on it may be on top of the tolerance: rounding.
pub(crate) const ROUNDING_MM: f64 = 1e-6;

/// Distance in the groups that a tolerance is for.
pub(crate) fn distance(difference: &AxisVector) -> f64 {
    let norm = |axes: core::ops::Range<usize>| {
        difference.as_slice()[axes]
            .iter()
            .map(|x| x * x)
            .sum::<f64>()
            .sqrt()
    };
    let rotary = ROTARY_ABC.map(|i| difference[i].abs()).fold(0.0, f64::max);
    norm(LINEAR_XYZ).max(norm(UVW)).max(rotary)
}
