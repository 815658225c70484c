//! The plan that always works: straight to a vertex of the path, at rest at both ends.
//!
//! From a place within tolerance of a point of a piece, the straight line to the end of the piece
//! stays within tolerance of the piece, because distances between two straight motions are convex.
//! So whatever else fails, a leg brings the motion to the next vertex. Its seven-phase profile
//! keeps the limits of every axis, and of every joint, at every instant, hence all differences over a period.
//!
//! From a rest beside a cut that is to be [straight](crate::in_tube::window), two legs lead to its end: to the
//! nearest point of the piece, and along it. One alone would be askew all the way: beside the line by what the
//! tolerance allowed at the corner before, in the middle of the move.

use crate::in_tube::path::{Bounds, TubePiece, directional, top_v};
use crate::in_tube::period::Period;
use crate::joints::JointRows;
use crate::scurve::Profile;
use glidepath_geometry::{AxisVector, feed_length};
use glidepath_program::Limits;

/// A cruise that takes less than this share of a leg is none: rounding may leave a trace of one.
const TRACE_R: f64 = 1e-9;

/// Up to here a piece is to be straight: after its middle half the tolerance is for the next corner.
const STRAIGHT_UNTIL: f64 = 0.75;

/// A straight motion from rest to rest.
#[derive(Debug, Clone)]
pub(crate) struct StopLeg {
    from: AxisVector,
    pub(crate) to: AxisVector,
    /// The piece at whose end it ends, or which it only comes to.
    pub(crate) piece: usize,
    /// How long the leg takes that is left to the end of the piece, if it only comes to the piece.
    rest_t: Option<f64>,
    /// Change of every axis per unit of path.
    along: AxisVector,
    profile: Profile,
}

impl StopLeg {
    /// From a position near a piece to the end of that piece; `None` if the motion is there.
    pub(crate) fn new(
        (limits, joints): (&Limits, Option<&JointRows>),
        from: AxisVector,
        index: usize,
        piece: &TubePiece,
    ) -> Option<Self> {
        if let Some(to) = nearest_if_beside(piece, &from)
            && let Some(there) = Self::between((limits, joints), (from, to), index, piece)
            && let Some(on) = Self::between((limits, joints), (to, piece.end), index, piece)
        {
            return Some(Self {
                rest_t: Some(on.duration_t()),
                ..there
            });
        }
        Self::between((limits, joints), (from, piece.end), index, piece)
    }

    /// From one place to another near a piece.
    fn between(
        (limits, joints): (&Limits, Option<&JointRows>),
        (from, to): (AxisVector, AxisVector),
        index: usize,
        piece: &TubePiece,
    ) -> Option<Self> {
        let displacement = to - from;
        let length_s = feed_length(&displacement);
        if length_s <= 0.0 || !length_s.is_finite() {
            return None;
        }
        let along = displacement / length_s;
        let of_axes = directional(limits, &along);
        let own = Bounds {
            speed_v: of_axes.speed_v.min(top_v(piece, &displacement, length_s)),
            ..of_axes
        };
        let bounds = joints.map_or(own, |joints| {
            own.within_joints(joints, (&from, &along), length_s)
        });
        let profile = Profile::new(0.0, 0.0, length_s, bounds.speed_v, bounds.path)?;
        Some(Self {
            from,
            to,
            piece: index,
            rest_t: None,
            along,
            profile,
        })
    }

    pub(crate) const fn duration_t(&self) -> f64 {
        self.profile.duration_t()
    }

    /// From its start until the end of the piece, with the leg that may be left after it.
    pub(crate) fn arrival_t(&self) -> f64 {
        self.duration_t() + self.rest_t.unwrap_or(0.0)
    }

    /// The piece from which on the next leg leads.
    pub(crate) const fn next_piece(&self) -> usize {
        match self.rest_t {
            Some(_) => self.piece,
            None => self.piece + 1,
        }
    }

    /// Whether it ends at the end of its piece.
    pub(crate) const fn ends_piece(&self) -> bool {
        self.rest_t.is_none()
    }

    /// When it begins to slow down for its end, s after its start: at once if it has not the length
    /// for its top speed.
    pub(crate) fn eager_t(&self) -> f64 {
        let cruise_t = self.profile.cruise_t();
        if cruise_t.end - cruise_t.start <= TRACE_R * self.duration_t() {
            0.0
        } else {
            cruise_t.end
        }
    }

    /// When it has come to its top speed, s after its start: at once if it does not.
    pub(crate) fn cruise_from_t(&self) -> f64 {
        if self.eager_t() > 0.0 {
            self.profile.cruise_t().start
        } else {
            0.0
        }
    }

    /// Where it is `t` ≥ 0 seconds after the start; at its end from then on.
    pub(crate) fn position(&self, t: f64) -> AxisVector {
        if t >= self.duration_t() {
            self.to
        } else {
            self.at(t).position
        }
    }

    /// The state `t` seconds after the start, 0 ≤ t < duration; where on the path that is, is not
    /// known here.
    pub(crate) fn at(&self, t: f64) -> Period {
        let state = self.profile.at(t);
        Period {
            position: self.from + self.along * state.position_s,
            velocity: self.along * state.speed_v,
            acceleration: self.along * state.accel_a,
            path_v: state.speed_v,
            path_s: 0.0,
            tag: 0,
            rest_at_end: false,
        }
    }
}

/// The point of a straight piece next to a place that is beside it by more than is allowed in its middle, if that is
/// not beyond it.
fn nearest_if_beside(piece: &TubePiece, from: &AxisVector) -> Option<AxisVector> {
    let allowed_mm = piece.straight?.within_mm;
    let along = piece.end - piece.start;
    let share = (from - piece.start).dot(&along) / along.norm_squared();
    if share >= STRAIGHT_UNTIL {
        return None;
    }
    let across = from - (piece.start + along * share);
    (across.norm() > allowed_mm).then(|| piece.start + along * share.max(0.0))
}
