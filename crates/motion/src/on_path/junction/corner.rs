//! A corner, and the transition through it.
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

use super::beside_corner::BesideCorner;
use super::side::JunctionSide;
use super::stop_or_pass::{Side, stop_is_faster};
use crate::on_path::pieces::{CurveRule, JointRule, SpeedLimit};
use glidepath_geometry::{
    AxisVector, DerivativeBounds, PairShape, Segment, Transition, feed_length,
};
use glidepath_program::{Travel, tolerance_norm};

/// Halvings of each search for d: its relative accuracy is 2⁻¹⁴.
const HALVINGS: u32 = 14;
/// An arc gives at most this angle to a junction, so that the polynomial stays close to it.
const ARC_SHARE_RAD: f64 = 0.6;
/// Points at which the deviation and the speed of a general transition are measured, and the
/// margins for the places between them.
const DEVIATION_POINTS: u32 = 24;
const DEVIATION_MARGIN_R: f64 = 1.02;
const STRETCH_MARGIN_R: f64 = 1.0 + 2e-4;

/// The families of transitions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Family {
    Sextic,
    Pair,
    Hermite,
}

/// A corner for which a transition is sought.
pub(super) struct Corner<'a> {
    pub(super) from: JunctionSide<'a>,
    pub(super) to: JunctionSide<'a>,
    pub(super) t1: AxisVector,
    pub(super) t2: AxisVector,
    pub(super) rate_v: f64,
    pub(super) gentle: bool,
    pub(super) tolerance_mm: f64,
    /// What a degree of the rotary axes counts for, mm.
    pub(super) mm_per_deg: f64,
    pub(super) family: Family,
    pub(super) straight: BesideCorner<'a>,
}

/// A transition that takes `d_s` from each side.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    pub(super) d_s: f64,
    pub(super) transition: Transition,
    pub(super) curve: CurveRule,
    limit: SpeedLimit,
    /// Deviation and chord error together, mm.
    error_mm: f64,
}

impl Corner<'_> {
    pub(super) fn best(&self) -> Option<Candidate> {
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
        let BesideCorner {
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
            mm_per_deg: self.mm_per_deg,
        };
        let jet_at = |part: f64| transition.jet(part * transition.length());
        let mut limit = curve.limit(self.rate_v, &settings.limits);
        if let Some(joints) = joints {
            limit = JointRule::of_candidate(joints, self.gentle, jet_at)?.within(limit);
        }
        let deviation_mm = match self.family {
            Family::Hermite => self.measured_deviation_mm(&transition, d_s),
            // Both families are symmetric: they are farthest from the program at the corner.
            _ => {
                let middle = transition.jet(0.5 * transition.length()).position;
                tolerance_norm(&(middle - corner), self.mm_per_deg)
            }
        };
        let chord_mm = |v| chord_error_mm(&bounds, v, settings.period_t, self.mm_per_deg);
        let error_mm = if transition.is_within(&travel.lowest, &travel.highest, Travel::ROUNDING) {
            deviation_mm + chord_mm(limit.top_v)
        } else {
            // Whatever the tolerance is, it is too much: a shorter one may stay inside.
            f64::MAX
        };
        let left_mm = (self.tolerance_mm - deviation_mm).max(0.0);
        curve.chord_v = (left_mm / chord_mm(1.0)).sqrt();
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
                let off = transition.jet(s).position - program.position;
                tolerance_norm(&off, self.mm_per_deg)
            })
            .fold(0.0, f64::max)
            * DEVIATION_MARGIN_R
    }

    /// Whether resting at the corner costs less time than the transition.
    pub(super) fn stop_is_faster(&self, found: &Candidate) -> bool {
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

/// Largest distance between a curve and the chord of one period at a speed: |q″|·(v·T)²/8. A degree of the rotary
/// axes counts for `mm_per_deg`.
pub(crate) fn chord_error_mm(
    bounds: &DerivativeBounds,
    top_v: f64,
    period_t: f64,
    mm_per_deg: f64,
) -> f64 {
    let step_s = top_v * period_t;
    tolerance_norm(&bounds.d2, mm_per_deg) * step_s * step_s / 8.0
}
