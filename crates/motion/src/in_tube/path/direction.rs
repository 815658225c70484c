//! Limits of the path in a direction, from those of the axes and of joints.

use crate::joints::JointRows;
use crate::on_path::{JointRule, SpeedLimit};
use crate::scurve::PathLimits;
use glidepath_geometry::{AXES, AxisVector, Jet};
use glidepath_program::Limits;

/// Limits of the path in a direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) speed_v: f64,
    pub(crate) path: PathLimits,
}

impl Bounds {
    /// What both allow.
    pub(crate) fn weaker(self, other: Self) -> Self {
        Self {
            speed_v: self.speed_v.min(other.speed_v),
            path: self.path.weaker(other.path),
        }
    }

    /// The same by a length that is so much of the one these are by.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            speed_v: self.speed_v * factor,
            path: PathLimits {
                accel_a: self.path.accel_a * factor,
                jerk_j: self.path.jerk_j * factor,
            },
        }
    }

    /// What joints leave of these along a straight way, all at once, at speeds up to this one: `along` is the change
    /// of every axis per unit of path. All of these if the mechanism cannot be there.
    pub(crate) fn within_joints(
        self,
        joints: &JointRows,
        way: (&AxisVector, &AxisVector),
        length_s: f64,
    ) -> Self {
        self.of_joints(joints, way, length_s)
            .map_or(self, |(limit, _)| Self {
                speed_v: limit.top_v,
                path: limit.change,
            })
    }

    /// The same of each where the others are small: for what is checked by itself afterwards. With it whether joints
    /// leave less at one place of the way than at another.
    pub(crate) fn within_joints_each(
        self,
        joints: &JointRows,
        way: (&AxisVector, &AxisVector),
        length_s: f64,
    ) -> (Self, bool) {
        self.of_joints(joints, way, length_s)
            .map_or((self, false), |(limit, is_uneven)| {
                let bounds = Self {
                    speed_v: limit.peak_v,
                    path: limit.alone,
                };
                (bounds, is_uneven)
            })
    }

    fn of_joints(
        self,
        joints: &JointRows,
        (from, along): (&AxisVector, &AxisVector),
        length_s: f64,
    ) -> Option<(SpeedLimit, bool)> {
        let jet_at = |share: f64| Jet {
            position: from + along * (share * length_s),
            d1: *along,
            d2: AxisVector::zeros(),
            d3: AxisVector::zeros(),
        };
        let own = SpeedLimit {
            top_v: self.speed_v,
            change: self.path,
            constant_above_v: f64::INFINITY,
            peak_v: self.speed_v,
            alone: self.path,
        };
        JointRule::of_curve(joints, length_s, jet_at)
            .map(|rule| (rule.within(own), rule.is_uneven()))
    }
}

/// The largest path speed, acceleration and jerk at which no axis exceeds its own; `along` is the
/// change of every axis per unit of path.
pub(crate) fn directional(limits: &Limits, along: &AxisVector) -> Bounds {
    let least = |of: &AxisVector| {
        (0..AXES)
            .filter(|&i| along[i] != 0.0)
            .map(|i| of[i] / along[i].abs())
            .fold(Limits::UNLIMITED, f64::min)
    };
    Bounds {
        speed_v: least(&limits.velocity),
        path: PathLimits {
            accel_a: least(&limits.acceleration),
            jerk_j: least(&limits.jerk),
        },
    }
}
