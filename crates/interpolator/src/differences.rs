//! Limits by finite differences of the published positions: what a drive sees.
//!
//! With positions x one period T apart, every axis obeys |Δx| ≤ V·T, |Δ²x| ≤ A·T², |Δ³x| ≤ J·T³. The
//! differences are averages of the derivatives of any motion through the positions, so a motion
//! inside its limits is inside these.

use glidepath_geometry::{AXES, AxisVector};
use glidepath_motion::Limits;

/// Part of a limit that may be lost to rounding; half of what an audit allows.
const ALLOWANCE: f64 = 5e-7;
/// Rounding of a third difference of positions of up to a metre, mm.
const ROUNDING: f64 = 1e-12;

/// The limits on one, two and three differences, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Allowed([AxisVector; 3]);

impl Allowed {
    pub(crate) fn new(limits: &Limits, period_t: f64) -> Self {
        let t = period_t;
        let raw = [
            limits.velocity * t,
            limits.acceleration * (t * t),
            limits.jerk * (t * t * t),
        ];
        Self(raw.map(|limit| limit * (1.0 + ALLOWANCE) + AxisVector::repeat(ROUNDING)))
    }
}

/// The larger of two numbers, the second if one is none: an instruction, which `f64::max` is not.
fn larger(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

/// The smaller one in the same way.
fn smaller(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The last published position and its differences.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Differences {
    position: AxisVector,
    first: AxisVector,
    second: AxisVector,
}

impl Differences {
    /// At rest for ever.
    pub(crate) fn at_rest(position: AxisVector) -> Self {
        Self {
            position,
            first: AxisVector::zeros(),
            second: AxisVector::zeros(),
        }
    }

    pub(crate) const fn position(&self) -> &AxisVector {
        &self.position
    }

    /// Whether the last three positions are the same.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.first
            .iter()
            .chain(self.second.iter())
            .all(|d| d.abs() <= ROUNDING)
    }

    /// After one more position.
    pub(crate) fn then(&self, position: &AxisVector) -> Self {
        let first = position - self.position;
        Self {
            position: *position,
            first,
            second: first - self.first,
        }
    }

    /// Whether one more position is within the limits.
    pub(crate) fn allow(&self, position: &AxisVector, allowed: &Allowed) -> bool {
        let mut next = *self;
        next.take(position, allowed)
    }

    /// Adds one more position; returns whether it is within the limits. One loop over plain arrays.
    #[allow(clippy::indexing_slicing, reason = "the index runs over the axes")]
    pub(crate) fn take(&mut self, position: &AxisVector, allowed: &Allowed) -> bool {
        let [velocity, acceleration, jerk] = &allowed.0;
        // A number, not a truth value: that can be kept for several axes at once.
        let mut inside = 1_u64;
        for i in 0..AXES {
            let first = position[i] - self.position[i];
            let second = first - self.first[i];
            let third = second - self.second[i];
            inside &= u64::from(first.abs() <= velocity[i]);
            inside &= u64::from(second.abs() <= acceleration[i]);
            inside &= u64::from(third.abs() <= jerk[i]);
            self.position[i] = position[i];
            self.first[i] = first;
            self.second[i] = second;
        }
        inside == 1
    }

    /// From where to where the next position may be moved until a limit is reached, from one along a
    /// velocity, in parts of that. Exact where the motion is straight.
    #[allow(clippy::indexing_slicing, reason = "the index runs over the axes")]
    pub(crate) fn room(
        &self,
        position: &AxisVector,
        velocity: &AxisVector,
        allowed: &Allowed,
    ) -> (f64, f64) {
        let [most_first, most_second, most_third] = &allowed.0;
        let (mut low, mut high) = ([f64::NEG_INFINITY; AXES], [f64::INFINITY; AXES]);
        for i in 0..AXES {
            let first = position[i] - self.position[i];
            let second = first - self.first[i];
            let third = second - self.second[i];
            let scale = velocity[i].abs().recip();
            // What the differences are along the velocity. An axis that stands is not limited by it.
            let along = |difference: f64| difference.copysign(difference * velocity[i]);
            for (difference, most) in [
                (along(first), most_first[i]),
                (along(second), most_second[i]),
                (along(third), most_third[i]),
            ] {
                low[i] = larger((-most - difference) * scale, low[i]);
                high[i] = smaller((most - difference) * scale, high[i]);
            }
        }
        (
            low.into_iter().fold(f64::NEG_INFINITY, larger),
            high.into_iter().fold(f64::INFINITY, smaller),
        )
    }

    /// Largest ratio to a limit one more position would have.
    pub(crate) fn ratio(&self, position: &AxisVector, allowed: &Allowed) -> f64 {
        let [velocity, acceleration, jerk] = &allowed.0;
        let first = position - self.position;
        let second = first - self.first;
        let third = second - self.second;
        [(first, velocity), (second, acceleration), (third, jerk)]
            .iter()
            .map(|(difference, limit)| difference.component_div(limit).amax())
            .fold(0.0, f64::max)
    }
}
