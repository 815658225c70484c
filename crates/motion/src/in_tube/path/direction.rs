//! Limits of the path in a direction, from those of the axes.

use crate::scurve::PathLimits;
use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::Limits;

/// Limits of the path in a direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) speed_v: f64,
    pub(crate) path: PathLimits,
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
