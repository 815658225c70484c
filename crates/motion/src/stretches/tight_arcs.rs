//! Arcs whose chords come near the tolerance: where a window in the tube may find no motion.
//!
//! On an arc of radius R, driven at v, the chord of a period T is v²·T²/(8·R) high. Where that is a good part of the
//! tolerance there is little room beside it, so a long stretch with such arcs is not taken for one that is faster in
//! the tube: it is tried.

use glidepath_geometry::{Arc, Segment};
use glidepath_program::{Item, ItemKind, Settings};

/// Share of the tolerance from which the height of a chord is a good part of it. On a mill with a tolerance of .02 mm
/// it is .2 at most, and there the tube is the faster way; at .001 and .002 mm circles took 27 % longer in it.
const TIGHT_R: f64 = 0.25;

/// True if one of some moves is an arc with chords near the tolerance, at its feed and the limits of acceleration.
pub(crate) fn has_tight_arcs(items: &[Item], settings: &Settings) -> bool {
    items.iter().any(|item| match item.kind {
        ItemKind::Move {
            segment: Segment::Arc(arc),
            rate,
            mode,
        } => {
            let tolerance_mm = mode.tolerance_mm(settings.tolerance_mm);
            rate.feed_v().is_some_and(|feed_v| {
                chord_height_mm(&arc, feed_v, settings) > TIGHT_R * tolerance_mm
            })
        }
        _ => false,
    })
}

/// How high the chord of a period is on an arc, mm.
fn chord_height_mm(arc: &Arc, feed_v: f64, settings: &Settings) -> f64 {
    let radius_mm = arc.start_radius().max(arc.end_radius());
    let most_a = settings.limits.acceleration.max();
    let across_a = (feed_v * feed_v / radius_mm).min(most_a);
    across_a * settings.period_t * settings.period_t / 8.0
}
