//! The junction of two segments: straight on, through a transition, or at rest.
//!
//! A transition takes a length d from both segments. The longer it is, the faster it can be driven
//! and the further it leaves the program, so d is the largest that keeps within
//!
//! * half of each segment (the other half belongs to the junction at its other end, if there is
//!   one),
//! * the tolerance: deviation of the curve plus the chord error of driving it at its top speed,
//! * the travel of every axis: beside an arc a transition may swing out of the corner,
//!
//! and no longer than needed for the programmed rate. Deviation is measured between points of equal
//! path position, so it bounds both ways and in order: curve to program and program to curve.
//!
//! A sharp corner is driven at constant speed: it is a valley of the speed anyway, and all of the
//! limits go into following it. On a gentle one the speed may change, so that a run of short
//! segments can be accelerated through. Where coming to rest at the corner costs less time than
//! the transition, the junction is a stop.

use super::stop_or_pass::{Side, stop_is_faster};
use crate::joints::JointRows;
use crate::on_path::pieces::{CurveRule, JointRule, SpeedLimit, straight_limit};
use glidepath_geometry::{
    AXES, AxisVector, DerivativeBounds, Jet, PairShape, Segment, Transition, Turn, feed_length,
};
use glidepath_program::{Limits, PathMode, Settings, Smoothing, Travel, tolerance_norm};

/// One of the two segments of a junction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JunctionSide<'a> {
    pub segment: &'a Segment,
    pub mode: PathMode,
    pub length_s: f64,
    /// The most of it that the junction may take.
    pub share_s: f64,
    /// Wanted rate, overrides included.
    pub rate_v: f64,
    /// How far the segment is from the program already, mm.
    pub error_mm: f64,
    /// It follows the spindle.
    pub synchronised: bool,
}

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
/// Halvings of each search for d: its relative accuracy is 2⁻¹⁴.
const HALVINGS: u32 = 14;
/// An arc gives at most this angle to a junction, so that the polynomial stays close to it.
const ARC_SHARE_RAD: f64 = 0.6;
/// Points at which the deviation and the speed of a general transition are measured, and the
/// margins for the places between them.
const DEVIATION_POINTS: u32 = 24;
const DEVIATION_MARGIN_R: f64 = 1.02;
const STRETCH_MARGIN_R: f64 = 1.0 + 2e-4;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Family {
    Sextic,
    Pair,
    Hermite,
}

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
    let straight = Straight {
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
            || straight.cut_by_chord_mm(&jet_in.d1, &jet_out.d1) > 0.5 * tolerance_mm,
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

/// What limits straight motion beside a corner.
#[derive(Debug, Clone, Copy)]
struct Straight<'a> {
    corner: AxisVector,
    settings: &'a Settings,
    joints: Option<&'a JointRows>,
}

impl Straight<'_> {
    /// The speed limit in a direction.
    fn limit(&self, tangent: &AxisVector, rate_v: f64) -> SpeedLimit {
        let of_axes = straight_limit(tangent, rate_v, &self.settings.limits);
        let of_place = |joints| JointRule::of_place(joints, self.corner, tangent);
        match self.joints.and_then(of_place) {
            Some(joints) => joints.within(of_axes),
            None => of_axes,
        }
    }

    /// The same as [`continues`] of joints.
    fn joints_continue(&self, jets: [&Jet; 2], rate_v: f64) -> bool {
        let Some(rows) = self.joints else {
            return true;
        };
        let [Some(before), Some(after)] = jets.map(|jet| rows.along(jet)) else {
            return true;
        };
        let top_v = self.limit(&jets[0].d1, rate_v).top_v;
        let steps = [after.d1 - before.d1, after.d2 - before.d2];
        are_rounding(steps, top_v, &rows.limits, self.settings.period_t)
    }

    /// How far from the corner the chord of one period can pass if the machine rests there between two
    /// setpoints: half a period before or after the rest it is at most J·(T/2)³/6 away.
    fn cut_by_chord_mm(&self, t1: &AxisVector, t2: &AxisVector) -> f64 {
        [t1, t2]
            .map(|tangent| {
                let limit = self.limit(tangent, f64::INFINITY);
                let jerk_j = limit.change.jerk_j;
                tolerance_norm(tangent) * jerk_j * self.settings.period_t.powi(3) / 48.0
            })
            .into_iter()
            .fold(0.0, f64::max)
    }
}

/// True if passing from one derivative to the other at the full rate is no more than rounding: the
/// steps of velocity and acceleration it makes are below what the jerk limit resolves.
fn continues(
    step_d1: &AxisVector,
    step_d2: &AxisVector,
    d1: &AxisVector,
    rate_v: f64,
    settings: &Settings,
) -> bool {
    let Settings {
        limits, period_t, ..
    } = settings;
    let v = straight_limit(d1, rate_v, limits).top_v;
    are_rounding([*step_d1, *step_d2], v, limits, *period_t)
}

/// Whether steps of both derivatives, passed at a speed, are no more than rounding.
fn are_rounding(
    [step_d1, step_d2]: [AxisVector; 2],
    v: f64,
    limits: &Limits,
    period_t: f64,
) -> bool {
    (0..AXES).all(|i| {
        let velocity_step_v = step_d1[i].abs() * v;
        let acceleration_step_a = step_d2[i].abs() * v * v;
        velocity_step_v / (period_t * period_t) + acceleration_step_a / period_t
            <= 1e-7 * limits.jerk[i]
    })
}

/// A corner for which a transition is sought.
struct Corner<'a> {
    from: JunctionSide<'a>,
    to: JunctionSide<'a>,
    t1: AxisVector,
    t2: AxisVector,
    rate_v: f64,
    gentle: bool,
    tolerance_mm: f64,
    family: Family,
    straight: Straight<'a>,
}

/// A transition that takes `d_s` from each side.
#[derive(Clone, Copy)]
struct Candidate {
    d_s: f64,
    transition: Transition,
    curve: CurveRule,
    limit: SpeedLimit,
    /// Deviation and chord error together, mm.
    error_mm: f64,
}

impl Corner<'_> {
    fn best(&self) -> Option<Candidate> {
        let share_s = self.from.share_s.min(self.to.share_s);
        let longest_s = share_s
            .min(arc_share(self.from.segment))
            .min(arc_share(self.to.segment));
        let mut best = self.candidate(longest_s)?;
        if best.error_mm > self.tolerance_mm {
            let (mut fits_s, mut exceeds_s) = (0.0, longest_s);
            let mut fitting = None;
            for _ in 0..HALVINGS {
                let middle_s = 0.5 * (fits_s + exceeds_s);
                let candidate = self.candidate(middle_s)?;
                if candidate.error_mm <= self.tolerance_mm {
                    fits_s = middle_s;
                    fitting = Some(candidate);
                } else {
                    exceeds_s = middle_s;
                }
            }
            best = fitting?;
        }
        Some(self.no_longer_than_needed(best))
    }

    /// The shortest transition that is as fast as the programmed rate; if there is none, as fast as the fastest.
    fn no_longer_than_needed(&self, longest: Candidate) -> Candidate {
        let rate_v = self.full_speed_v() * (1.0 - 1e-3);
        let fastest = self.fastest(longest, rate_v);
        if fastest.limit.top_v < rate_v {
            return fastest;
        }
        let (mut slow_s, mut found) = (0.0, fastest);
        for _ in 0..HALVINGS {
            let middle_s = 0.5 * (slow_s + found.d_s);
            match self.candidate(middle_s) {
                Some(shorter)
                    if shorter.limit.top_v >= rate_v && shorter.error_mm <= self.tolerance_mm =>
                {
                    found = shorter;
                }
                _ => slow_s = middle_s,
            }
        }
        found
    }

    /// A transition that is as fast as a rate, or else the fastest. A longer one bends less, but the tool has further
    /// to go on it than on the program beside an arc: where bending does not keep it from the rate, a shorter one is
    /// faster.
    fn fastest(&self, longest: Candidate, rate_v: f64) -> Candidate {
        let mut fastest = longest;
        while self.family == Family::Hermite && fastest.limit.top_v < rate_v {
            match self.candidate(0.5 * fastest.d_s) {
                Some(shorter)
                    if shorter.limit.top_v > fastest.limit.top_v
                        && shorter.error_mm <= self.tolerance_mm =>
                {
                    fastest = shorter;
                }
                _ => break,
            }
        }
        fastest
    }

    /// The rate at which the straight parts beside the corner can be driven.
    fn full_speed_v(&self) -> f64 {
        [&self.t1, &self.t2]
            .map(|tangent| self.straight.limit(tangent, self.rate_v).top_v)
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }

    fn candidate(&self, d_s: f64) -> Option<Candidate> {
        let corner = self.to.segment.start();
        let transition = match self.family {
            Family::Sextic => Transition::sextic(corner, self.t1, self.t2, d_s),
            Family::Pair => {
                Transition::bezier_pair(corner, self.t1, self.t2, d_s, PairShape::SMOOTH)
                    .unwrap_or_else(|_| Transition::sextic(corner, self.t1, self.t2, d_s))
            }
            Family::Hermite => Transition::hermite(
                &self.from.segment.jet(self.from.length_s - d_s),
                &self.to.segment.jet(d_s),
                2.0 * d_s,
            ),
        };
        let bounds = transition.bounds();
        let Straight {
            settings, joints, ..
        } = self.straight;
        let travel = &settings.limits.travel;
        let mut curve = CurveRule {
            bounds,
            gentle: self.gentle,
            stretch_r: match self.family {
                Family::Hermite => greatest_stretch(&transition),
                _ => 1.0,
            },
            chord_v: f64::INFINITY,
        };
        let jet_at = |part: f64| transition.jet(part * transition.length());
        let mut limit = curve.limit(self.rate_v, &settings.limits);
        if let Some(joints) = joints {
            limit = JointRule::of_candidate(joints, self.gentle, jet_at)?.within(limit);
        }
        let deviation_mm = match self.family {
            Family::Hermite => self.measured_deviation_mm(&transition, d_s),
            // Both families are symmetric: they are farthest from the program at the corner.
            _ => tolerance_norm(&(transition.jet(0.5 * transition.length()).position - corner)),
        };
        let period_t = settings.period_t;
        let error_mm = if transition.is_within(&travel.lowest, &travel.highest, Travel::ROUNDING) {
            deviation_mm + chord_error_mm(&bounds, limit.top_v, period_t)
        } else {
            // Whatever the tolerance is, it is too much: a shorter one may stay inside.
            f64::MAX
        };
        let left_mm = (self.tolerance_mm - deviation_mm).max(0.0);
        curve.chord_v = (left_mm / chord_error_mm(&bounds, 1.0, period_t)).sqrt();
        (limit.top_v > 0.0 && error_mm.is_finite()).then_some(Candidate {
            d_s,
            transition,
            curve,
            limit,
            error_mm,
        })
    }

    /// Largest distance between points of equal path position of transition and program.
    fn measured_deviation_mm(&self, transition: &Transition, d_s: f64) -> f64 {
        (1..DEVIATION_POINTS)
            .map(|i| {
                let s = 2.0 * d_s * f64::from(i) / f64::from(DEVIATION_POINTS);
                let program = if s < d_s {
                    self.from.segment.jet(self.from.length_s - d_s + s)
                } else {
                    self.to.segment.jet(s - d_s)
                };
                tolerance_norm(&(transition.jet(s).position - program.position))
            })
            .fold(0.0, f64::max)
            * DEVIATION_MARGIN_R
    }

    /// Whether resting at the corner costs less time than the transition.
    fn stop_is_faster(&self, found: &Candidate) -> bool {
        let side = |leg: JunctionSide<'_>, tangent: &AxisVector| {
            let SpeedLimit { top_v, change, .. } = self.straight.limit(tangent, leg.rate_v);
            Side {
                length_s: leg.length_s,
                left_s: leg.length_s - found.d_s,
                top_v,
                change,
            }
        };
        let sides = [side(self.from, &self.t1), side(self.to, &self.t2)];
        stop_is_faster(&sides, found.limit.top_v, found.transition.length())
    }
}

/// How much faster than its path position the tool moves on a general transition, at most, ≥ 1.
fn greatest_stretch(transition: &Transition) -> f64 {
    let length_s = transition.length();
    (1..DEVIATION_POINTS)
        .map(|i| length_s * f64::from(i) / f64::from(DEVIATION_POINTS))
        .map(|s| feed_length(&transition.jet(s).d1) * STRETCH_MARGIN_R)
        .fold(1.0, f64::max)
}

/// The most an arc may give to a junction.
fn arc_share(segment: &Segment) -> f64 {
    match segment {
        Segment::Line(_) | Segment::Curve(_) => f64::INFINITY,
        Segment::Arc(arc) => ARC_SHARE_RAD / arc.sweep_rad.abs() * arc.length(),
    }
}

/// Largest distance between a curve and the chord of one period at a speed: |q″|·(v·T)²/8.
pub(crate) fn chord_error_mm(bounds: &DerivativeBounds, top_v: f64, period_t: f64) -> f64 {
    let step_s = top_v * period_t;
    tolerance_norm(&bounds.d2) * step_s * step_s / 8.0
}
