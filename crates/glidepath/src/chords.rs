//! The chords of the programmed path: straight pieces that look like it.

use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

/// Turn of a chord of an arc, radians: off by a thousandth of the radius.
const CHORD_RAD: f64 = 0.09;
/// Chords of another curve.
const CURVE_CHORDS: f64 = 8.0;

/// The points of an item, each with whether the way to it is a rapid; with its start if
/// `from_start`.
pub(crate) fn chords(item: &Item, from_start: bool, mut point: impl FnMut(&AxisVector, bool)) {
    let ItemKind::Move { segment, rate, .. } = &item.kind else {
        return;
    };
    let rapid = rate.is_rapid();
    if from_start {
        point(&segment.start(), rapid);
    }
    let chords = match segment {
        Segment::Line(_) => 1.0,
        Segment::Arc(arc) => (arc.sweep_rad.abs() / CHORD_RAD).ceil().clamp(1.0, 1e4),
        Segment::Curve(_) => CURVE_CHORDS,
    };
    let length = segment.length();
    let mut chord = 1.0;
    while chord < chords {
        point(&segment.jet(length * chord / chords).position, rapid);
        chord += 1.0;
    }
    point(&segment.end(), rapid);
}
