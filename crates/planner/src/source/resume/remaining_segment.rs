//! The rest of a segment behind the place where the machine stands.

use std::f64::consts::TAU;

use glidepath_geometry::{Arc, AxisVector, Segment};

/// What is left of a segment after a part of it, from where the machine stands.
pub(super) fn remaining_segment(segment: &Segment, position: &AxisVector, part: f64) -> Segment {
    match segment {
        Segment::Line(line) => Segment::line(*position, line.end),
        Segment::Arc(arc) if part >= 1.0 => Segment::line(*position, arc.end),
        Segment::Arc(arc) => {
            let mut rest = Arc {
                start: *position,
                ..*arc
            };
            // What the angles of both ends say, on the turn that the part says.
            let (first, second) = arc.plane.axes();
            let angle = |p: &AxisVector| {
                (p[second.index()] - arc.center[1]).atan2(p[first.index()] - arc.center[0])
            };
            let turned = angle(&arc.end) - angle(position);
            let about = arc.sweep_rad * (1.0 - part);
            rest.sweep_rad = turned + TAU * ((about - turned) / TAU).round();
            Segment::Arc(rest)
        }
        Segment::Curve(curve) if part >= 1.0 => Segment::line(*position, curve.end),
        Segment::Curve(curve) => Segment::Curve(curve.after(part * curve.length, *position)),
    }
}
