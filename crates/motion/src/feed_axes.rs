//! The axes that measure the feed: XYZ if they move, else UVW, else the rotary axes; see
//! [`glidepath_geometry::feed_length`].

use core::ops::Range;
use glidepath_geometry::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW, feed_length};

/// The axes that measure the feed of a displacement; what is below the resolution of programs does
/// not count as motion.
pub(crate) fn feed_axes(displacement: &AxisVector) -> Range<usize> {
    [LINEAR_XYZ, UVW]
        .into_iter()
        .find(|axes| axes.clone().any(|i| displacement[i].abs() > 1e-7))
        .unwrap_or(ROTARY_ABC)
}

/// The axes that [`feed_length`] counts in a displacement, however short it is.
pub(crate) fn counted_axes(displacement: &AxisVector) -> Range<usize> {
    let length = feed_length(displacement);
    let counts = |axes: &Range<usize>| {
        let square: f64 = axes
            .clone()
            .map(|i| displacement[i] * displacement[i])
            .sum();
        square.sqrt() >= length && square > 0.0
    };
    [LINEAR_XYZ, UVW]
        .into_iter()
        .find(counts)
        .unwrap_or(ROTARY_ABC)
}
