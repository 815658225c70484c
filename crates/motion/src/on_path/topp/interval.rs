//! The path between two knots, and what bounds the speed there.

use glidepath_geometry::{AXES, Jet, feed_length, limit_along};
use glidepath_program::Limits;

/// Share of what a curve allows, for the places between knots. It is twice what is given away there
/// ([`super::between_knots`]), where it is told what of that was measured.
pub(crate) const BETWEEN_R: f64 = 1.0 - 2e-4;

/// What bounds the speed on a piece whatever the axes can do.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Caps {
    /// The programmed rate, or what else bounds the speed all along the piece, mm/s.
    pub(crate) rate_v: f64,
    /// The largest acceleration across the path, mm/s²: that at which the chord of one period uses up
    /// the tolerance.
    pub(crate) chord_a: f64,
}

/// The path between two knots, measured by path position, or by nominal time, s, where knots are at times
/// ([`super::nominal`]): derivatives and speeds are by that, too.
#[derive(Debug)]
pub(crate) struct Interval {
    /// The piece it is on.
    pub(crate) piece: usize,
    /// The phase of the S-curves that it is on, where it is measured by their time; 0 elsewhere.
    pub(crate) phase: usize,
    /// Where it starts, and its length, mm or s.
    pub(crate) from_s: f64,
    pub(crate) length_s: f64,
    /// The axes and their derivatives at its ends. Where pieces or phases meet, those of this one: they jump
    /// there.
    pub(crate) start: Jet,
    pub(crate) end: Jet,
    /// The joints at start and end, where they are not the axes. Apart, because most machines have none, and
    /// slow curves very many intervals.
    pub(crate) joints: Option<Box<[Jet; 2]>>,
    /// The path's own derivatives there, first to third, where it is measured by nominal time.
    pub(crate) along: Option<Box<[[f64; 3]; 2]>>,
    /// Top speeds at its start, in its middle and at its end, mm/s or a rate: axes, joints, the rate and the chord
    /// error, but not what changes of speed take.
    pub(crate) start_v: f64,
    pub(crate) middle_v: f64,
    pub(crate) end_v: f64,
}

impl Interval {
    /// The highest speed where a piece has these derivatives, mm/s.
    pub(crate) fn cap_v(jet: &Jet, own: &Caps, limits: &Limits) -> f64 {
        let curvature_k = feed_length(&jet.d2);
        let by_axes = (0..AXES)
            .map(|i| limits.velocity[i] / jet.d1[i].abs())
            .fold(f64::INFINITY, f64::min);
        let by_chord = (own.chord_a / curvature_k).sqrt();
        let by_curve = by_chord.min(limits.path.speed_v(curvature_k));
        own.rate_v.min(by_axes).min(BETWEEN_R * by_curve)
    }

    /// The highest speed at which joints with these derivatives along the path can follow, mm/s.
    pub(crate) fn joints_v(joints: &Jet, limits: &Limits) -> f64 {
        BETWEEN_R * limit_along(&joints.d1, &limits.velocity)
    }
}
