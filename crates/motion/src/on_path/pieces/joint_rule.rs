//! The part of a piece's speed limit that joints make, where these are not the axes.

use super::speed_limit::{SpeedLimit, below, constant, curved};
use crate::joints::JointRows;
use crate::scurve::Extremes;
use glidepath_geometry::{AXES, AxisVector, DerivativeBounds, Jet};
use glidepath_program::Limits;

/// Steps along a piece at which joints are asked: so long at most, in mm or degrees of the fastest axis, and
/// so many. What joints change between two of them is added to the bounds.
const STEP: f64 = 2.0;
const FEWEST_STEPS: f64 = 4.0;
const MOST_STEPS: f64 = 128.0;
/// Steps along the curve that replaces a corner, whose derivatives change fast.
const STEPS_OF_TRANSITION: u32 = 24;
/// The same while its length is sought.
const STEPS_OF_CANDIDATE: u32 = 8;
/// By which factor joints are faster at one place of a piece than at another where that is looked into.
const UNEVEN_R: f64 = 1.2;

/// What joints make of the speed limit of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct JointRule {
    /// Of the derivatives of joints by path position, J0 in the place of X and so on.
    bounds: DerivativeBounds,
    /// Of joints likewise.
    limits: Limits,
    /// Whether the speed may change at the top speed.
    is_gentle: bool,
    /// Whether joints are faster at one place of the piece than at another, as where a mechanism comes near a
    /// singularity.
    is_uneven: bool,
}

impl JointRule {
    /// That of a segment or span, from its jets at shares of its length.
    pub(crate) fn of_curve(
        joints: &JointRows,
        length_s: f64,
        jet_at: impl Fn(f64) -> Jet,
    ) -> Option<Self> {
        let fastest = jet_at(0.5).d1.amax();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped"
        )]
        let steps = (length_s * fastest / STEP)
            .ceil()
            .clamp(FEWEST_STEPS, MOST_STEPS) as u32;
        Self::new(joints, (steps, true), jet_at)
    }

    /// That of the curve that replaces a corner.
    pub(crate) fn of_transition(
        joints: &JointRows,
        is_gentle: bool,
        jet_at: impl Fn(f64) -> Jet,
    ) -> Option<Self> {
        Self::new(joints, (STEPS_OF_TRANSITION, is_gentle), jet_at)
    }

    /// The same, about, while the length of that is sought.
    pub(crate) fn of_candidate(
        joints: &JointRows,
        is_gentle: bool,
        jet_at: impl Fn(f64) -> Jet,
    ) -> Option<Self> {
        Self::new(joints, (STEPS_OF_CANDIDATE, is_gentle), jet_at)
    }

    /// That of a straight piece so short that nothing changes along it.
    pub(crate) fn of_place(
        joints: &JointRows,
        position: AxisVector,
        d1: &AxisVector,
    ) -> Option<Self> {
        let here = joints.along(&Jet {
            position,
            d1: *d1,
            d2: AxisVector::zeros(),
            d3: AxisVector::zeros(),
        })?;
        Some(Self {
            bounds: DerivativeBounds {
                d1: here.d1.abs(),
                d2: AxisVector::zeros(),
                d3: AxisVector::zeros(),
            },
            limits: joints.limits,
            is_gentle: true,
            is_uneven: false,
        })
    }

    fn new(
        joints: &JointRows,
        (steps, is_gentle): (u32, bool),
        jet_at: impl Fn(f64) -> Jet,
    ) -> Option<Self> {
        let (bounds, spread_r) = joints.bounds(steps, jet_at)?;
        Some(Self {
            bounds,
            limits: joints.limits,
            is_gentle,
            is_uneven: spread_r > UNEVEN_R,
        })
    }

    /// True if what holds all along the piece may be less than what joints leave at most places of it.
    pub(crate) const fn is_uneven(&self) -> bool {
        self.is_uneven
    }

    /// What of a speed limit joints leave.
    pub(crate) fn within(&self, own: SpeedLimit) -> SpeedLimit {
        let by_joints = if self.is_gentle {
            curved(&self.bounds, own.top_v, &self.limits)
        } else {
            constant(&self.bounds, own.top_v, &self.limits)
        };
        own.weaker(&by_joints)
    }

    /// True if joints can follow with so much speed, acceleration and jerk along the path, all at once.
    pub(crate) fn permits(&self, most: &Extremes) -> bool {
        let Extremes {
            speed_v: v,
            accel_a,
            jerk_j,
        } = *most;
        let DerivativeBounds { d1, d2, d3 } = &self.bounds;
        let limits = &self.limits;
        let (v2, v3, cross) = (v * v, v * v * v, 3.0 * v * accel_a);
        (0..AXES).all(|i| {
            below(d1[i] * v, limits.velocity[i])
                && below(d2[i] * v2 + d1[i] * accel_a, limits.acceleration[i])
                && below(d3[i] * v3 + d2[i] * cross + d1[i] * jerk_j, limits.jerk[i])
        })
    }
}
