//! The length of a helix beside that of its arc: where F is that of the plane, the way along the helix is longer.

use glidepath_geometry::{Arc, Segment};

/// The length of a helix over that of its arc in the plane.
pub(crate) fn share_of_arc(arc: &Arc) -> f64 {
    let length = Segment::Arc(*arc).length();
    let rise = (arc.end - arc.start)[arc.plane.normal().index()];
    let flat = (length * length - rise * rise).max(0.0).sqrt();
    if flat > 0.0 { length / flat } else { 1.0 }
}
