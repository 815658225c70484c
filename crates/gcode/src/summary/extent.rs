//! The extent of moves: their smallest and largest coordinates.

use glidepath_geometry::{AXES, AxisVector, Segment};

/// Takes a segment into the box between two corners.
#[inline]
pub(crate) fn enclose(segment: &Segment, low: &mut AxisVector, high: &mut AxisVector) {
    let Segment::Line(line) = segment else {
        let (least, most) = segment.bounding_box();
        (*low, *high) = (low.inf(&least), high.sup(&most));
        return;
    };
    // In place, and without a branch.
    for end in [&line.start, &line.end] {
        for i in 0..AXES {
            low[i] = if end[i] < low[i] { end[i] } else { low[i] };
            high[i] = if end[i] > high[i] { end[i] } else { high[i] };
        }
    }
}
