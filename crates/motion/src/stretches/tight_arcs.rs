//! Tight arcs: those whose chords come near the tolerance, where a window in the tube may find no motion.
//!
//! There is little room beside them, so a long stretch with such arcs is not taken for one that is faster in the tube:
//! it is tried.

use crate::on_path::chord_speed;
use glidepath_geometry::{LINEAR_XYZ, Segment};
use glidepath_program::{Item, ItemKind, Settings};

/// Share of the tolerance from which the height of a chord is near it. On a mill with a tolerance of .02 mm it is .2 at
/// most, and there the tube is the faster way; at .001 and .002 mm circles took 27 % longer in it.
const TIGHT_R: f64 = 0.25;

/// True if one of some moves is an arc with chords near the tolerance, at its feed and the limits of acceleration.
pub(crate) fn has_tight_arcs(items: &[Item], settings: &Settings) -> bool {
    // Across an arc no motion has more; the chord of a period is a·T²/8 high.
    let most_a = settings.limits.acceleration.as_slice()[LINEAR_XYZ].iter();
    let most_a = most_a.copied().fold(0.0, f64::max);
    let most_mm = most_a * settings.period_t * settings.period_t / 8.0;
    items.iter().any(|item| match item.kind {
        ItemKind::Move {
            segment: segment @ Segment::Arc(_),
            rate,
            mode,
        } => {
            let tolerance_mm = mode.tolerance_mm(settings.tolerance_mm);
            let mm_per_deg = settings.direction.mm_per_deg(tolerance_mm);
            let tight_v =
                TIGHT_R.sqrt() * chord_speed(&segment, tolerance_mm, mm_per_deg, settings);
            most_mm > TIGHT_R * tolerance_mm && rate.feed_v().is_some_and(|feed_v| feed_v > tight_v)
        }
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::{Arc, AxisVector, Plane};
    use glidepath_program::{Corners, Effort, Limits, PathMode, ProgramLine, Rate, Smoothing};

    /// A circle in XY by a machine whose rotary axes have no limit.
    fn is_tight(radius_mm: f64, feed_v: f64, tolerance_mm: f64) -> bool {
        let mut limits = Limits::uniform(200.0, 2000.0, 40_000.0);
        for axis in LINEAR_XYZ.end..limits.acceleration.len() {
            limits.acceleration[axis] = f64::INFINITY;
        }
        let settings = Settings {
            limits,
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: Corners::default(),
            period_t: 0.004,
            effort: Effort::Optimal,
        };
        let mut start = AxisVector::zeros();
        start[0] = radius_mm;
        let arc = Arc {
            start,
            end: start,
            plane: Plane::Xy,
            center: [0.0, 0.0],
            sweep_rad: core::f64::consts::TAU,
        };
        let kind = ItemKind::Move {
            segment: Segment::Arc(arc),
            rate: Rate::Feed(feed_v),
            mode: PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            },
        };
        let line = ProgramLine {
            number: 1,
            block: 1,
        };
        has_tight_arcs(&[line.item(kind)], &settings)
    }

    #[test]
    fn an_arc_is_tight_by_its_feed_and_by_what_the_machine_can_do() {
        // v²·T²/(8·R) is a quarter of 1 µm at 35.36 mm/s.
        assert!(!is_tight(10.0, 35.0, 0.001));
        assert!(is_tight(10.0, 36.0, 0.001));
        // 2000 mm/s² make 4 µm, whatever the feed.
        assert!(!is_tight(0.5, 100.0, 0.0161));
        assert!(is_tight(0.5, 100.0, 0.0159));
    }
}
