//! The turn of a path at a corner, as sine and cosine of half its angle.
//!
//! Between the unit directions `T1` and `T2` the path turns by θ. With β = θ/2, everything a
//! transition needs is rational in sin β = |T2 − T1|/2 and cos β = |T1 + T2|/2, both accurate for
//! every angle; an arc cosine of T1·T2 would lose half the digits of a slight turn.

use crate::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};
use core::ops::Range;

/// Sine and cosine of half the turn angle at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// sin β: 0 straight on, 1 reversal.
    pub sb: f64,
    /// cos β: 1 straight on, 0 reversal.
    pub cb: f64,
}

impl Turn {
    /// The turn from one tangent to another, each of unit feed length, in the metric of the feed:
    /// the XYZ part if either moves there, else UVW, else ABC.
    ///
    /// Where one tangent moves in that part and the other does not, sb² + cb² < 1; the blends
    /// remain valid.
    #[must_use]
    pub fn between(t1: &AxisVector, t2: &AxisVector) -> Self {
        let group = feed_group(t1, t2);
        Self {
            sb: 0.5 * norm_in(&(t2 - t1), group.clone()),
            cb: 0.5 * norm_in(&(t1 + t2), group),
        }
    }

    /// The turn angle θ in radians, 0 to π.
    #[must_use]
    pub fn theta_rad(&self) -> f64 {
        2.0 * self.sb.atan2(self.cb)
    }

    /// sin θ.
    #[must_use]
    pub fn sin_theta(&self) -> f64 {
        2.0 * self.sb * self.cb
    }
}

/// Half the largest change of direction at a corner in the sense of the path tolerance: of the XYZ
/// part, of the UVW part, and of the rotary axes, a degree of which counts for so many mm. The deviation of a
/// transition is proportional to it, and it is [`Turn::sb`] for a corner of XYZ alone.
#[must_use]
pub fn tolerance_half_turn(t1: &AxisVector, t2: &AxisVector, mm_per_deg: f64) -> f64 {
    0.5 * tolerance_norm(&(t2 - t1), mm_per_deg)
}

/// The distance that a tolerance bounds, mm: the XYZ part, the UVW part, or the rotary axes, whichever is
/// largest. Each is the root of its sum of squares; a degree of the rotary axes counts for `mm_per_deg`.
///
/// Lengths and angles are not added: where a degree counts for a millimetre, a tolerance of 0.02 allows 0.02 mm
/// to the tip of the tool and 0.02° to the rotary axes together.
#[inline]
#[must_use]
pub fn tolerance_norm(difference: &AxisVector, mm_per_deg: f64) -> f64 {
    norm_in(difference, LINEAR_XYZ)
        .max(norm_in(difference, UVW))
        .max(rotary_norm(difference) * mm_per_deg)
}

/// Length of the rotary part, degrees; of one axis alone exactly how far that is.
#[inline]
fn rotary_norm(difference: &AxisVector) -> f64 {
    let largest = ROTARY_ABC.map(|i| difference[i].abs()).fold(0.0, f64::max);
    let turning = ROTARY_ABC.filter(|&i| difference[i] != 0.0).count();
    if turning > 1 {
        norm_in(difference, ROTARY_ABC)
    } else {
        largest
    }
}

/// The largest magnitude along `direction` that keeps every axis within its limit:
/// min over axes of limit / |direction|; infinite for a zero direction.
#[must_use]
pub fn limit_along(direction: &AxisVector, limit: &AxisVector) -> f64 {
    direction
        .iter()
        .zip(limit.iter())
        .filter(|(component, _)| **component != 0.0)
        .map(|(component, limit)| limit / component.abs())
        .fold(f64::INFINITY, f64::min)
}

/// Axes whose norm measures the feed at this corner, for directions of unit feed length: the first
/// group in which one of them has that length. (What little it may have in a group before that is
/// the rounding of coordinates.)
pub(crate) fn feed_group(t1: &AxisVector, t2: &AxisVector) -> Range<usize> {
    [LINEAR_XYZ, UVW]
        .into_iter()
        .find(|group| norm_in(t1, group.clone()).max(norm_in(t2, group.clone())) > 0.5)
        .unwrap_or(ROTARY_ABC)
}

/// Euclidean norm over some of the axes.
#[inline]
pub(crate) fn norm_in(vector: &AxisVector, axes: Range<usize>) -> f64 {
    axes.map(|i| vector[i] * vector[i]).sum::<f64>().sqrt()
}
