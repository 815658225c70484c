//! The removal of displacements that are rounding of coordinates, and no motion.

use glidepath_geometry::{AXES, Axis, AxisVector};

/// Displacements of an axis up to this, mm or degrees, are rounding of coordinates, and no motion.
///
/// Without this, a rotary move whose X differs by 1e-14 mm would count as a move of 1e-14 mm.
pub(crate) const MIN_MOVE: f64 = 1e-9;

/// `target` with every axis that would not really move put back on `start`; the axes in `keep`
/// are left alone.
#[inline]
pub(crate) fn settled(
    start: AxisVector,
    mut target: AxisVector,
    keep: [Option<Axis>; 2],
) -> AxisVector {
    let programmed = target;
    for i in 0..AXES {
        let moves = (target[i] - start[i]).abs() > MIN_MOVE;
        target[i] = if moves { target[i] } else { start[i] };
    }
    for axis in keep.into_iter().flatten() {
        target[axis.index()] = programmed[axis.index()];
    }
    target
}
