//! The speed limit of a piece of path: from the limits of the axes to limits along the path.
//!
//! With position q(s) along the path and s(t) in time, every axis sees
//!
//! ```text
//! q̇ = q′ ṡ        q̈ = q″ ṡ² + q′ s̈        q⃛ = q‴ ṡ³ + 3 q″ ṡ s̈ + q′ s⃛
//! ```
//!
//! On a straight piece only the last term of each is there. On a curved one, part of an axis' limit
//! goes to following the curve at the top speed, and what is left may be used to change speed. The
//! share is fixed here, so that a piece has one top speed, one acceleration and one jerk, all of
//! which may be used at once anywhere on it.

use crate::programmed_rate::ProgrammedRate;
use crate::scurve::{Extremes, PathLimits};
use glidepath_geometry::{AXES, Arc, AxisVector, DerivativeBounds, feed_length, limit_along};
use glidepath_program::{Limits, Override, PathBounds, Rate, tolerance_norm};

/// The limits along a piece of path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpeedLimit {
    /// Top speed, mm/s.
    pub top_v: f64,
    /// Acceleration and jerk along the path.
    pub change: PathLimits,
    /// Above this speed the speed has to be constant; infinite where it never has to.
    pub constant_above_v: f64,
    /// Top speed, acceleration and jerk each where the other two are small: what to try, and then
    /// to check ([`SpeedRule::permits`]).
    pub peak_v: f64,
    pub alone: PathLimits,
}

/// What the speed limit of a piece is computed from, so that it can be computed again when the
/// override changes.
#[derive(Debug, Clone)]
pub(crate) enum SpeedRule {
    /// A line in the direction `d1`.
    Straight {
        d1: AxisVector,
        rate: ProgrammedRate,
    },
    /// An arc, and the speed at which the chords of one period reach its tolerance.
    Arc {
        arc: Arc,
        rate: ProgrammedRate,
        chord_v: f64,
    },
    /// A transition between two segments, or a span of a spline.
    Curve {
        curve: Box<CurveRule>,
        rates: [ProgrammedRate; 2],
    },
}

/// The speed limit of a transition, or of a span of a spline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CurveRule {
    pub bounds: DerivativeBounds,
    /// Whether the speed may change on it.
    pub gentle: bool,
    /// How much faster than its path position the tool moves, at most, ≥ 1.
    pub stretch_r: f64,
    /// The speed at which deviation and chord error reach the tolerance.
    pub chord_v: f64,
    /// What a degree of the rotary axes counts for in that, mm.
    pub mm_per_deg: f64,
}

impl SpeedRule {
    pub(crate) fn limit(&self, wanted: Override, limits: &Limits) -> SpeedLimit {
        let by_axes = self.limit_of_axes(wanted, limits);
        if limits.path.is_none() {
            by_axes
        } else {
            by_axes.within(&limits.path, self.curvature_k())
        }
    }

    fn limit_of_axes(&self, wanted: Override, limits: &Limits) -> SpeedLimit {
        match self {
            Self::Straight { d1, rate } => straight_limit(d1, rate.under(wanted), limits),
            Self::Arc {
                arc: curve,
                rate,
                chord_v,
            } => arc(curve, rate.under(wanted).min(*chord_v), limits),
            Self::Curve { curve, rates } => {
                curve.limit(rates[0].under(wanted).min(rates[1].under(wanted)), limits)
            }
        }
    }
}

impl SpeedLimit {
    /// What both allow.
    pub(crate) fn weaker(&self, other: &Self) -> Self {
        Self {
            top_v: self.top_v.min(other.top_v),
            change: self.change.weaker(other.change),
            constant_above_v: self.constant_above_v.min(other.constant_above_v),
            peak_v: self.peak_v.min(other.peak_v),
            alone: self.alone.weaker(other.alone),
        }
    }

    fn within(mut self, bounds: &PathBounds, curvature_k: f64) -> Self {
        let bounding = PathLimits {
            accel_a: bounds.tangential_a,
            jerk_j: bounds.jerk_j,
        };
        let fastest_v = bounds.speed_v(curvature_k);
        self.top_v = self.top_v.min(fastest_v);
        self.peak_v = self.peak_v.min(fastest_v);
        self.change = self.change.weaker(bounding);
        self.alone = self.alone.weaker(bounding);
        self
    }
}

impl SpeedRule {
    /// The largest curvature, or more, 1/mm.
    fn curvature_k(&self) -> f64 {
        match self {
            Self::Straight { .. } => 0.0,
            Self::Arc { arc, .. } => {
                let omega = arc.sweep_rad / arc.length();
                arc.start_radius().max(arc.end_radius()) * omega * omega
            }
            Self::Curve { curve, .. } => feed_length(&curve.bounds.d2),
        }
    }

    /// True if a piece with these limits may be driven with so much speed, acceleration and jerk
    /// along the path, all at once.
    pub(crate) fn permits(&self, own: &SpeedLimit, most: &Extremes, limits: &Limits) -> bool {
        let Extremes {
            speed_v: v,
            accel_a,
            jerk_j,
        } = *most;
        if !below(v, own.peak_v) {
            return false;
        }
        match self {
            Self::Straight { .. } | Self::Arc { .. } => {
                below(accel_a, own.alone.accel_a) && below(jerk_j, own.alone.jerk_j)
            }
            Self::Curve { curve, .. } => {
                let DerivativeBounds { d1, d2, d3 } = &curve.bounds;
                let (v2, v3, cross) = (v * v, v * v * v, 3.0 * v * accel_a);
                let along = below(accel_a, own.alone.accel_a) && below(jerk_j, own.alone.jerk_j);
                along
                    && (0..AXES).all(|i| {
                        below(d2[i] * v2 + d1[i] * accel_a, limits.acceleration[i])
                            && below(d3[i] * v3 + d2[i] * cross + d1[i] * jerk_j, limits.jerk[i])
                    })
            }
        }
    }

    /// The rate, mm/s: the speed is nowhere higher.
    pub(crate) fn rate_v(&self, wanted: Override) -> f64 {
        match self {
            Self::Straight { rate, .. } | Self::Arc { rate, .. } => rate.under(wanted),
            Self::Curve { curve, rates } => {
                rates[0].under(wanted).min(rates[1].under(wanted)) / curve.stretch_r
            }
        }
    }

    /// What bounds the speed whatever the axes can do: the rate, mm/s, the acceleration across the
    /// path at which the chord of one period uses up the tolerance, mm/s², and the speed at which it
    /// does so where the curvature is largest, mm/s.
    pub(crate) fn caps(&self, wanted: Override) -> (f64, f64, f64) {
        match self {
            Self::Straight { .. } => (self.rate_v(wanted), f64::INFINITY, f64::INFINITY),
            Self::Arc { chord_v, .. } => {
                let chord_a = chord_v * chord_v * self.curvature_k();
                (self.rate_v(wanted), chord_a, *chord_v)
            }
            Self::Curve { curve, .. } => {
                let second_k = tolerance_norm(&curve.bounds.d2, curve.mm_per_deg);
                let chord_a = curve.chord_v * curve.chord_v * second_k;
                // On a straight one both factors are without meaning.
                let chord_a = if chord_a.is_nan() {
                    f64::INFINITY
                } else {
                    chord_a
                };
                (self.rate_v(wanted), chord_a, curve.chord_v)
            }
        }
    }

    /// The highest constant speed if axes could be as fast as they liked, mm/s.
    pub(crate) fn following_v(&self, wanted: Override, limits: &Limits) -> f64 {
        let limits = Limits {
            velocity: AxisVector::repeat(f64::INFINITY),
            ..*limits
        };
        let by_axes_v = match self {
            Self::Straight { rate, .. } => rate.under(wanted),
            Self::Arc {
                arc: curve,
                rate,
                chord_v,
            } => ArcBounds::new(curve, &limits)
                .following_v(1.0, 1.0)
                .min(rate.under(wanted))
                .min(*chord_v),
            Self::Curve { curve, rates } => {
                let rate_v = rates[0].under(wanted).min(rates[1].under(wanted));
                let rate_v = (rate_v / curve.stretch_r).min(curve.chord_v);
                constant(&curve.bounds, rate_v, &limits).top_v
            }
        };
        by_axes_v.min(limits.path.speed_v(self.curvature_k()))
    }

    /// True if only rapids touch the piece.
    pub(crate) fn is_rapid(&self) -> bool {
        let is_rapid = |rate: &ProgrammedRate| rate.rate.is_rapid();
        match self {
            Self::Straight { rate, .. } | Self::Arc { rate, .. } => is_rapid(rate),
            Self::Curve { rates, .. } => rates.iter().all(is_rapid),
        }
    }

    /// True if the piece follows the spindle.
    pub(crate) fn is_synchronised(&self) -> bool {
        self.any_rate(Rate::is_synchronised)
    }

    /// True if some feed of the piece is one per revolution.
    pub(crate) fn is_per_revolution(&self) -> bool {
        self.any_rate(Rate::is_per_revolution)
    }

    /// The feed that the program asks for, mm/s: the least of its blocks; 0 where any of them is a rapid.
    pub(crate) fn programmed_v(&self) -> f64 {
        let feed_v = |rate: &ProgrammedRate| rate.rate.feed_v().unwrap_or(0.0);
        match self {
            Self::Straight { rate, .. } | Self::Arc { rate, .. } => feed_v(rate),
            Self::Curve { rates, .. } => rates.iter().map(feed_v).fold(f64::INFINITY, f64::min),
        }
    }

    fn any_rate(&self, is_it: fn(Rate) -> bool) -> bool {
        match self {
            Self::Straight { rate, .. } | Self::Arc { rate, .. } => is_it(rate.rate),
            Self::Curve { rates, .. } => rates.iter().any(|rate| is_it(rate.rate)),
        }
    }
}

impl CurveRule {
    pub(crate) fn limit(&self, rate_v: f64, limits: &Limits) -> SpeedLimit {
        let rate_v = (rate_v / self.stretch_r).min(self.chord_v);
        if self.gentle {
            curved(&self.bounds, rate_v, limits)
        } else {
            constant(&self.bounds, rate_v, limits)
        }
    }
}

/// More than a limit by less than this is rounding.
const ROUNDING_R: f64 = 1e-9;

/// Whether a limit is kept.
pub(super) fn below(x: f64, limit: f64) -> bool {
    x <= limit * (1.0 + ROUNDING_R)
}

/// Share of an axis' acceleration and jerk spent on following a curve at its top speed. More is a higher
/// speed and less to change it with. Of jerk .4 and [`CROSS_JERK_R`] leave .3 for changes; where one of
/// these is not needed, limit boosting finds out. No measurement of them is kept.
const FOLLOW_ACCEL_R: f64 = 0.6;
const FOLLOW_JERK_R: f64 = 0.4;
/// The share of acceleration on an arc, where it is at right angles to what changes the speed.
const ARC_FOLLOW_ACCEL_R: f64 = 0.75;
/// Share of acceleration and jerk that following may take where the speed hardly changes.
const PEAK_R: f64 = 0.9;
/// Share of the jerk spent on the product of acceleration along the path and curvature.
const CROSS_JERK_R: f64 = 0.3;
/// The same on an arc, where it is at right angles to the rest, which keeps √(1 − .7²) = .71.
const ARC_CROSS_JERK_R: f64 = 0.7;

/// A straight piece in the direction `d1`, at most at `rate_v`.
pub(crate) fn straight_limit(d1: &AxisVector, rate_v: f64, limits: &Limits) -> SpeedLimit {
    let top_v = rate_v.min(limit_along(d1, &limits.velocity));
    let change = changing_alone(d1, limits);
    SpeedLimit {
        top_v,
        change,
        constant_above_v: f64::INFINITY,
        peak_v: top_v,
        alone: change,
    }
}

/// What the direction alone allows.
fn changing_alone(d1: &AxisVector, limits: &Limits) -> PathLimits {
    PathLimits {
        accel_a: limit_along(d1, &limits.acceleration),
        jerk_j: limit_along(d1, &limits.jerk),
    }
}

/// A curve driven at constant speed: all of every limit goes into following it. At half the top
/// speed and below, enough is left to change speed.
pub(crate) fn constant(bounds: &DerivativeBounds, rate_v: f64, limits: &Limits) -> SpeedLimit {
    let top_v = rate_v
        .min(limit_along(&bounds.d1, &limits.velocity))
        .min(limit_along(&bounds.d2, &limits.acceleration).sqrt())
        .min(limit_along(&bounds.d3, &limits.jerk).cbrt());
    let constant_above_v = 0.5 * top_v;
    let SpeedLimit { change, alone, .. } = curved(bounds, constant_above_v, limits);
    SpeedLimit {
        top_v,
        change,
        constant_above_v,
        peak_v: top_v,
        alone,
    }
}

/// A curve on which the speed may change.
pub(crate) fn curved(bounds: &DerivativeBounds, rate_v: f64, limits: &Limits) -> SpeedLimit {
    let normal_a = limit_along(&bounds.d2, &limits.acceleration);
    let normal_j = limit_along(&bounds.d3, &limits.jerk);
    let straight_v = rate_v.min(limit_along(&bounds.d1, &limits.velocity));
    let following_v = |accel_r: f64, jerk_r: f64| {
        straight_v
            .min((accel_r * normal_a).sqrt())
            .min((jerk_r * normal_j).cbrt())
    };
    let top_v = following_v(FOLLOW_ACCEL_R, FOLLOW_JERK_R);
    let left_a = limits.acceleration - bounds.d2 * (top_v * top_v);
    let cross = bounds.d2 * (3.0 * top_v);
    let accel_a =
        limit_along(&bounds.d1, &left_a).min(CROSS_JERK_R * limit_along(&cross, &limits.jerk));
    let left_j = limits.jerk - bounds.d3 * top_v.powi(3) - cross * accel_a;
    let jerk_j = limit_along(&bounds.d1, &left_j);
    SpeedLimit {
        top_v,
        change: PathLimits { accel_a, jerk_j },
        constant_above_v: f64::INFINITY,
        peak_v: following_v(PEAK_R, PEAK_R),
        alone: changing_alone(&bounds.d1, limits),
    }
}

/// Bounds of the derivatives of an arc, in its plane and across it, and the limits in its plane.
struct ArcBounds {
    straight_d1: AxisVector,
    d1: f64,
    d2: f64,
    d3: f64,
    plane_v: f64,
    plane_a: f64,
    plane_j: f64,
}

impl ArcBounds {
    fn new(arc: &Arc, limits: &Limits) -> Self {
        let length_s = arc.length();
        let (first, second) = arc.plane.axes();
        let (first, second) = (first.index(), second.index());
        let in_plane = |limit: &AxisVector| limit[first].min(limit[second]);
        let mut straight_d1 = (arc.end - arc.start) / length_s;
        straight_d1[first] = 0.0;
        straight_d1[second] = 0.0;

        let radius_mm = arc.start_radius().max(arc.end_radius());
        let drift = (arc.end_radius() - arc.start_radius()).abs() / length_s;
        let omega = arc.sweep_rad.abs() / length_s;
        // `drift` is the rounding of programs, practically zero.
        Self {
            straight_d1,
            d1: radius_mm * omega + drift,
            d2: radius_mm * omega * omega + 2.0 * drift * omega,
            d3: (radius_mm * omega + 3.0 * drift) * omega * omega,
            plane_v: in_plane(&limits.velocity),
            plane_a: in_plane(&limits.acceleration),
            plane_j: in_plane(&limits.jerk),
        }
    }

    /// The speed at which following the arc takes these shares of acceleration and jerk.
    fn following_v(&self, accel_r: f64, jerk_r: f64) -> f64 {
        (self.plane_v / self.d1)
            .min((accel_r * self.plane_a / self.d2).sqrt())
            .min((jerk_r * self.plane_j / self.d3).cbrt())
    }
}

/// An arc. Its normal and tangential parts are at right angles, so in the plane of the arc they add
/// as squares whatever the direction of motion is.
pub(crate) fn arc(arc: &Arc, rate_v: f64, limits: &Limits) -> SpeedLimit {
    let bounds = ArcBounds::new(arc, limits);
    let ArcBounds {
        d1,
        d2,
        d3,
        plane_a,
        plane_j,
        ..
    } = bounds;
    let along = straight_limit(&bounds.straight_d1, rate_v, limits);
    let top_v = along
        .top_v
        .min(bounds.following_v(ARC_FOLLOW_ACCEL_R, FOLLOW_JERK_R));
    let normal_a = d2 * top_v * top_v;
    let cross_j = ARC_CROSS_JERK_R * plane_j;
    let accel_a =
        ((plane_a * plane_a - normal_a * normal_a).sqrt() / d1).min(cross_j / (3.0 * d2 * top_v));
    let used_j = 3.0 * d2 * top_v * accel_a;
    let jerk_j = ((plane_j * plane_j - used_j * used_j).sqrt() - d3 * top_v.powi(3)) / d1;
    let change = PathLimits {
        accel_a: accel_a.min(along.change.accel_a),
        jerk_j: jerk_j.min(along.change.jerk_j),
    };
    SpeedLimit {
        top_v,
        change,
        constant_above_v: f64::INFINITY,
        peak_v: top_v,
        alone: change,
    }
}
