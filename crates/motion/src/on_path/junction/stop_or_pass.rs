//! The choice between a stop at a corner and a transition.
//!
//! Above some turn angle, which depends on tolerance and jerk, a full stop takes less time than any
//! transition. The two are compared over both segments, with the speeds at their far ends the same:
//! at rest, or as fast as both ways allow. A transition has to win in each case, so that replacing
//! stops by transitions one after the other never makes a path slower.

use crate::scurve::{Outline, PathLimits, reachable_speed};

/// True if a stop is faster in some case. The transition can be driven at up to `corner_v` and is
/// `transition_s` long.
pub(crate) fn stop_is_faster(sides: &[Side; 2], corner_v: f64, transition_s: f64) -> bool {
    let corner_v = corner_v.min(sides[0].top_v).min(sides[1].top_v);
    // From a stop neither segment lets one reach the speed of the corner: nothing to compare.
    if sides
        .iter()
        .all(|side| corner_v >= reachable_speed(0.0, side.length_s, side.change))
    {
        return false;
    }
    let [rest, next_rest] = sides.map(|side| TimedSide::new(side, 0.0, corner_v));
    if stop_gain_t([&rest, &next_rest], transition_s) > 0.0 {
        return true;
    }
    let [fast, next_fast] = sides.map(|side| TimedSide::new(side, side.fast_v(corner_v), corner_v));
    [
        [&fast, &next_rest],
        [&rest, &next_fast],
        [&fast, &next_fast],
    ]
    .into_iter()
    .any(|both| stop_gain_t(both, transition_s) > 0.0)
}

/// A segment beside a corner.
#[derive(Clone, Copy)]
pub(crate) struct Side {
    pub length_s: f64,
    /// What a transition leaves of it.
    pub left_s: f64,
    pub top_v: f64,
    pub change: PathLimits,
}

impl Side {
    /// The speed its far end can be passed at, from a stop and from the corner.
    fn fast_v(&self, corner_v: f64) -> f64 {
        reachable_speed(0.0, self.length_s, self.change)
            .min(reachable_speed(corner_v, self.left_s, self.change))
            .min(self.top_v)
    }

    /// How long so much of it takes, s.
    fn duration_t(&self, corner_v: f64, far_v: f64, length_s: f64) -> Option<f64> {
        let outline = Outline::new(corner_v, far_v, length_s, self.top_v, self.change);
        outline.map(|outline| outline.duration_t())
    }
}

/// A side with a speed at its far end.
struct TimedSide {
    side: Side,
    far_v: f64,
    /// What the far end leaves of the speed of the corner.
    corner_v: f64,
    stopping_t: Option<f64>,
    /// With that speed at the corner.
    passing_t: Option<f64>,
}

impl TimedSide {
    fn new(side: Side, far_v: f64, corner_v: f64) -> Self {
        let corner_v = corner_v.min(reachable_speed(far_v, side.left_s, side.change));
        Self {
            side,
            far_v,
            corner_v,
            stopping_t: side.duration_t(0.0, far_v, side.length_s),
            passing_t: side.duration_t(corner_v, far_v, side.left_s),
        }
    }

    /// What passing the corner takes longer than stopping there, s.
    fn loss_t(&self, corner_v: f64) -> Option<f64> {
        let passing_t = if corner_v < self.corner_v {
            self.side.duration_t(corner_v, self.far_v, self.side.left_s)
        } else {
            self.passing_t
        };
        Some(passing_t? - self.stopping_t?)
    }
}

/// What stopping at the corner gains over passing it by a transition of that length, s.
fn stop_gain_t(both: [&TimedSide; 2], transition_s: f64) -> f64 {
    let corner_v = both[0].corner_v.min(both[1].corner_v);
    match both.map(|side| side.loss_t(corner_v)) {
        [Some(first), Some(second)] => transition_s / corner_v + first + second,
        _ => 0.0,
    }
}
