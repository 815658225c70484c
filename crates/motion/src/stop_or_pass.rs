//! Whether to rest at a corner or to pass it by a transition.
//!
//! Above some turn angle, which depends on tolerance and jerk, a full stop takes less time than any
//! transition. The two are compared over both segments, with the speeds at their far ends the same:
//! at rest, or as fast as both ways allow. A transition has to win in each case, so that replacing
//! stops by transitions one after the other never makes a path slower.

use crate::scurve::{PathLimits, Profile, reachable_speed};

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
    [[false, false], [true, false], [false, true], [true, true]]
        .into_iter()
        .any(|fast| stop_gain_t(sides, fast, corner_v, transition_s) > 0.0)
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

/// What stopping at the corner gains over passing it at up to `corner_v`, s; with the far end of
/// each side at rest, or fast.
fn stop_gain_t(sides: &[Side; 2], fast: [bool; 2], corner_v: f64, transition_s: f64) -> f64 {
    let far_v = [0, 1].map(|i| {
        let Side {
            length_s,
            left_s,
            top_v,
            change,
        } = sides[i];
        let reach_v = reachable_speed(0.0, length_s, change)
            .min(reachable_speed(corner_v, left_s, change))
            .min(top_v);
        if fast[i] { reach_v } else { 0.0 }
    });
    let corner_v = [0, 1]
        .map(|i| reachable_speed(far_v[i], sides[i].left_s, sides[i].change))
        .into_iter()
        .fold(corner_v, f64::min);
    let passing_t = transition_s / corner_v;
    let mut gain_t = passing_t;
    for (side, far_v) in sides.iter().zip(far_v) {
        let Side {
            length_s,
            left_s,
            top_v,
            change,
        } = *side;
        let stopping = Profile::new(0.0, far_v, length_s, top_v, change);
        let passing = Profile::new(corner_v, far_v, left_s, top_v, change);
        let (Some(stopping), Some(passing)) = (stopping, passing) else {
            return 0.0;
        };
        gain_t += passing.duration_t() - stopping.duration_t();
    }
    gain_t
}
