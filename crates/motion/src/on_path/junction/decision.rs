//! The junction of two segments: straight on, through a transition, or at rest.
//!
//! A sharp corner is driven at constant speed: it is a valley of the speed anyway, and all of the
//! limits go into following it. On a gentle one the speed may change, so that a run of short
//! segments can be accelerated through. Where coming to rest at the corner costs less time than
//! the transition ([`super::corner`]), the junction is a stop.

use super::beside_corner::{BesideCorner, continues};
use super::corner::{Corner, Family};
use super::side::JunctionSide;
use crate::joints::JointRows;
use crate::on_path::pieces::CurveRule;
use glidepath_geometry::{Segment, Transition, Turn};
use glidepath_program::{PathMode, Settings, Smoothing};

/// How the path passes from one segment to the next.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "short-lived, one per corner, never stored in bulk"
)]
pub(crate) enum Junction {
    /// The segments continue each other.
    Straight,
    /// The machine rests at the corner; if `exact`, with a setpoint exactly there.
    Stop { exact: bool },
    /// A curve replaces `trim_s` of both segments.
    Blend {
        transition: Transition,
        trim_s: f64,
        curve: CurveRule,
    },
}

/// sin of half the turn up to which a corner counts as gentle: 30° of turn.
const GENTLE_SB: f64 = 0.2588;
/// A turn sharper than this is a reversal: 176°.
const REVERSAL_CB: f64 = 0.035;

/// Decides how `from` is joined to `to`: in the path mode of `from`.
pub(crate) fn join(
    from: JunctionSide<'_>,
    to: JunctionSide<'_>,
    settings: &Settings,
    joints: Option<&JointRows>,
) -> Junction {
    let rate_v = from.rate_v.min(to.rate_v);
    let jet_in = from.segment.jet(from.length_s);
    let jet_out = to.segment.jet(0.0);
    let tolerance_mm = from.mode.tolerance_mm(settings.tolerance_mm);
    let mm_per_deg = settings.direction.mm_per_deg(tolerance_mm);
    let stop_wanted = match from.mode {
        PathMode::ExactStop => return Junction::Stop { exact: true },
        // A chord from a loose stretch must not reach into a tight one.
        PathMode::Continuous { .. }
            if tolerance_mm
                .total_cmp(&to.mode.tolerance_mm(settings.tolerance_mm))
                .is_ne() =>
        {
            return Junction::Stop { exact: true };
        }
        PathMode::ExactPath => true,
        PathMode::Continuous { .. } => settings.smoothing == Smoothing::ExactStop,
    };
    let step_d1 = jet_out.d1 - jet_in.d1;
    let step_d2 = jet_out.d2 - jet_in.d2;
    let straight = BesideCorner {
        corner: jet_out.position,
        settings,
        joints,
    };
    if continues(&step_d1, &step_d2, &jet_in.d1, rate_v, settings)
        && straight.joints_continue([&jet_in, &jet_out], rate_v)
    {
        return Junction::Straight;
    }
    let turn = Turn::between(&jet_in.d1, &jet_out.d1);
    let stop = Junction::Stop {
        exact: from.mode == PathMode::ExactPath
            || straight.cut_by_chord_mm([&jet_in.d1, &jet_out.d1], mm_per_deg) > 0.5 * tolerance_mm,
    };
    if stop_wanted || turn.cb < REVERSAL_CB {
        return stop;
    }
    let family = match (from.segment, to.segment) {
        (Segment::Line(_), Segment::Line(_)) if settings.smoothing == Smoothing::BezierPair => {
            Family::Pair
        }
        (Segment::Line(_), Segment::Line(_)) => Family::Sextic,
        _ => Family::Hermite,
    };
    let corner = Corner {
        from,
        to,
        t1: jet_in.d1,
        t2: jet_out.d1,
        rate_v,
        gentle: turn.sb <= GENTLE_SB && turn.cb > 0.0,
        tolerance_mm: tolerance_mm - from.error_mm.max(to.error_mm),
        mm_per_deg,
        family,
        straight,
    };
    match corner.best() {
        // What follows the spindle does not wait for it at a corner.
        Some(found) if from.synchronised || !corner.stop_is_faster(&found) => Junction::Blend {
            transition: found.transition,
            trim_s: found.d_s,
            curve: found.curve,
        },
        _ => stop,
    }
}

/// True if a path that is to be passed exactly comes to rest between two segments.
pub(crate) fn is_exact_corner(
    from: &Segment,
    to: &Segment,
    rate_v: f64,
    settings: &Settings,
) -> bool {
    let jet_in = from.jet(from.length());
    let jet_out = to.jet(0.0);
    let step_d1 = jet_out.d1 - jet_in.d1;
    let step_d2 = jet_out.d2 - jet_in.d2;
    !continues(&step_d1, &step_d2, &jet_in.d1, rate_v, settings)
}
