//! The plan that always works: straight to a vertex of the path, at rest at both ends.
//!
//! From a place within tolerance of a point of a piece, the straight line to the end of the piece
//! stays within tolerance of the piece, because distances between two straight motions are convex.
//! So whatever else fails, a leg brings the motion to the next vertex. Its seven-phase profile
//! keeps the limits of every axis, and of every joint, at every instant, hence all differences over a period.

use crate::in_tube::path::{Bounds, TubePiece, directional, top_v};
use crate::in_tube::period::Period;
use crate::joints::JointRows;
use crate::scurve::Profile;
use glidepath_geometry::{AxisVector, feed_length};
use glidepath_program::Limits;

/// A straight motion from rest to rest.
#[derive(Debug, Clone)]
pub(crate) struct StopLeg {
    from: AxisVector,
    pub(crate) to: AxisVector,
    /// The piece at whose end it ends.
    pub(crate) piece: usize,
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
        let displacement = piece.end - from;
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
            to: piece.end,
            piece: index,
            along,
            profile,
        })
    }

    pub(crate) const fn duration_t(&self) -> f64 {
        self.profile.duration_t()
    }

    /// When it begins to slow down for its end, s after its start: at once if it has not the length
    /// for its top speed.
    pub(crate) fn eager_t(&self) -> f64 {
        let cruise_t = self.profile.cruise_t();
        // Where there is none, rounding may leave a trace of one.
        if cruise_t.end - cruise_t.start <= 1e-9 * self.duration_t() {
            0.0
        } else {
            cruise_t.end
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
