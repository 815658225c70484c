//! A curve as chords.

use glidepath_geometry::{AxisVector, Nurbs, feed_length};

/// Halvings of a knot span, at most.
const MAX_HALVINGS: u32 = 20;

/// The ends of chords that leave the curve by no more than the tolerance, in mm and degrees, without
/// the start of the curve and with its end.
///
/// A chord is compared with the curve in three places between. Both are smooth between knots, and a
/// span begins as two chords at least, so that no bend hides between the places.
pub(super) fn flatten(curve: &Nurbs, tolerance_mm: f64) -> Vec<AxisVector> {
    let mut points = Vec::new();
    for span in curve.spans() {
        let (from_u, to_u) = (span.from_u(), span.to_u());
        let middle_u = 0.5 * (from_u + to_u);
        let at = |u: f64| span.jet(u).position;
        let [from, middle, to] = [from_u, middle_u, to_u].map(at);
        halve(
            &at,
            (from_u, from),
            (middle_u, middle),
            tolerance_mm,
            MAX_HALVINGS,
            &mut points,
        );
        halve(
            &at,
            (middle_u, middle),
            (to_u, to),
            tolerance_mm,
            MAX_HALVINGS,
            &mut points,
        );
    }
    points
}

fn halve(
    at: &impl Fn(f64) -> AxisVector,
    from: (f64, AxisVector),
    to: (f64, AxisVector),
    tolerance_mm: f64,
    halvings: u32,
    points: &mut Vec<AxisVector>,
) {
    let u = |share: f64| from.0 + (to.0 - from.0) * share;
    let middle = at(u(0.5));
    let beside = [at(u(0.25)), middle, at(u(0.75))];
    let near = beside
        .iter()
        .all(|point| distance(point, &from.1, &to.1) <= tolerance_mm);
    if near || halvings == 0 {
        points.push(to.1);
        return;
    }
    halve(
        at,
        from,
        (u(0.5), middle),
        tolerance_mm,
        halvings - 1,
        points,
    );
    halve(at, (u(0.5), middle), to, tolerance_mm, halvings - 1, points);
}

/// Distance of a point from a chord, in the feed length of what is left when the part along the chord
/// is taken away.
fn distance(point: &AxisVector, from: &AxisVector, to: &AxisVector) -> f64 {
    let (chord, offset) = (to - from, point - from);
    let square = chord.norm_squared();
    let share = if square > 0.0 {
        (offset.dot(&chord) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let beside = offset - chord * share;
    // Rotary axes count too, where linear ones move: the larger of the two.
    feed_length(&beside).max(beside.amax())
}
