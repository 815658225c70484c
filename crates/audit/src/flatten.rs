//! The flattening of segments to chords.
//!
//! A line is one chord, an arc many. Inner points of an arc lie slightly outside it, so that the
//! polygon is as far outside at its corners as it is inside between them: the distance from the arc
//! is half the sagitta.

use glidepath_geometry::{Arc, AxisVector, Prepared, Segment};

/// Distance between an arc and its chords, as a part of the tolerance.
pub(crate) const FLATTENING: f64 = 1e-5;
/// Distance between another curve and its chords, as a part of the tolerance.
pub(crate) const CURVE_FLATTENING: f64 = 1e-3;

/// Number of chords of a segment.
pub(crate) fn chords(of: &Segment, tolerance_mm: f64) -> u32 {
    let count = match of {
        Segment::Line(_) => return 1,
        Segment::Arc(arc) => {
            let radius = arc.start_radius().max(arc.end_radius());
            // A chord over the angle α has sagitta R·α²/8, twice the distance that is allowed.
            let angle = (16.0 * FLATTENING * tolerance_mm / radius).sqrt().min(0.5);
            arc.sweep_rad.abs() / angle
        }
        Segment::Curve(curve) => {
            let max_k = curve.bounds().d2.norm();
            curve.length * (max_k / (8.0 * CURVE_FLATTENING * tolerance_mm)).sqrt()
        }
    };
    whole(count, 1e9)
}

/// So many chords, as a whole number from 1 to `most`, < 2³².
pub(crate) fn whole(count: f64, most: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let count = count.ceil().clamp(1.0, most) as u32;
    count
}

/// Where two of so many chords of a segment meet; on an arc, moved outwards by half the sagitta.
pub(crate) fn inner_point(
    of: &Segment,
    prepared: &Prepared,
    along_mm: f64,
    chords: u32,
) -> AxisVector {
    let mut point = prepared.position(along_mm);
    if let Segment::Arc(arc) = of {
        push_outwards(arc, &mut point, f64::from(chords));
    }
    point
}

fn push_outwards(arc: &Arc, point: &mut AxisVector, count: f64) {
    let (first, second) = arc.plane.axes();
    let angle = arc.sweep_rad / count;
    let factor = 1.0 + angle * angle / 16.0;
    for (axis, center) in [first, second].into_iter().zip(arc.center) {
        let i = axis.index();
        point[i] = center + (point[i] - center) * factor;
    }
}
