//! The differences of positions between frames, against the limits of every axis.

use crate::shared::config::SoftLimits;
use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_link::{FrameRefusal, SetpointFrame};
use glidepath_program::{Limits, Travel};

/// Share of a limit that may be exceeded: what an audit allows.
const ALLOWANCE: f64 = 1e-6;
/// Rounding of positions and their differences, mm.
const ROUNDING: f64 = 1e-12;

/// Axis, value found, value allowed.
pub(super) type Found = (Option<Axis>, f64, f64);

/// The first axis whose difference is above its limit.
pub(super) fn above(difference: &AxisVector, scale: f64, limit: &AxisVector) -> Option<Found> {
    Axis::ALL
        .iter()
        .zip(difference.iter().zip(limit))
        .find_map(|(&axis, (&d, &limit))| {
            let allowed = limit * scale * (1.0 + ALLOWANCE) + ROUNDING;
            (d.abs() > allowed).then_some((Some(axis), d / scale, limit))
        })
}

/// The first axis outside its soft limits.
pub(super) fn outside(frame: &SetpointFrame, soft_limits: &SoftLimits) -> Option<Found> {
    let SoftLimits { lowest, highest } = soft_limits;
    Axis::ALL
        .iter()
        .zip(frame.position)
        .zip(lowest.iter().zip(highest))
        .find_map(|((&axis, position), (&low, &high))| {
            let nearest = position.max(low).min(high);
            ((position - nearest).abs() > Travel::ROUNDING).then_some((
                Some(axis),
                position,
                nearest,
            ))
        })
}

/// The first axis whose velocity or acceleration does not belong to its positions: with jerk
/// inside its limit J, Taylor's formula leaves no more than these remainders over a period. Where
/// velocity and position are what the acceleration makes of them, it is the jerk that is too high.
#[allow(clippy::indexing_slicing, reason = "the index runs over the axes")]
pub(super) fn jump(
    [last, frame]: [&SetpointFrame; 2],
    limits: &Limits,
    t: f64,
) -> Option<(FrameRefusal, Found)> {
    (0..AXES).find_map(|i| {
        let (p0, v0, a0) = (last.position[i], last.velocity[i], last.acceleration[i]);
        let (p1, v1, a1) = (frame.position[i], frame.velocity[i], frame.acceleration[i]);
        // The mean of jerk over a period may exceed that of its neighbours' average, which is
        // what the differences limit: hence twice the limit.
        let j = 2.0 * limits.jerk[i] * (1.0 + ALLOWANCE);
        let of_a = (a1 - a0).abs() - j * t;
        let of_v = (v1 - v0 - 0.5 * t * (a0 + a1)).abs() - 0.25 * j * t * t;
        let of_p = (p1 - p0 - 0.5 * t * (v0 + v1) + t * t * (a1 - a0) / 12.0).abs()
            - 0.065 * j * t * t * t;
        let axis = Axis::ALL.get(i).copied();
        if of_v > ROUNDING / t || of_p > ROUNDING {
            Some((FrameRefusal::Discontinuous, (axis, 0.0, 0.0)))
        } else if of_a > ROUNDING / (t * t) {
            let found = (axis, (a1 - a0) / t, limits.jerk[i]);
            Some((FrameRefusal::Jerk, found))
        } else {
            None
        }
    })
}
