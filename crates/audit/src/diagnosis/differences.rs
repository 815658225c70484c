//! The share of each axis limit that a period uses, by finite differences of the positions.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Limits;
use glidepath_program::tolerance_norm;

/// Below this an axis is not moving, mm or degrees a period: rounding.
const STILL_MM: f64 = 1e-12;

/// Follows the positions.
#[derive(Debug)]
pub(super) struct Differences {
    /// Largest differences of first, second and third order.
    most: [AxisVector; 3],
    position: AxisVector,
    first: AxisVector,
    second: AxisVector,
    third: AxisVector,
}

impl Differences {
    pub(super) fn new(limits: &Limits, period_t: f64) -> Self {
        let zero = AxisVector::zeros();
        Self {
            most: [
                limits.velocity * period_t,
                limits.acceleration * period_t.powi(2),
                limits.jerk * period_t.powi(3),
            ],
            position: zero,
            first: zero,
            second: zero,
            third: zero,
        }
    }

    /// The next position; before the first the machine is at rest there.
    pub(super) fn next(&mut self, position: &AxisVector, is_first: bool) {
        if is_first {
            self.position = *position;
        }
        let first = position - self.position;
        let second = first - self.first;
        self.third = second - self.second;
        self.position = *position;
        self.first = first;
        self.second = second;
    }

    /// True if the period does not move any axis.
    pub(super) fn is_at_rest(&self) -> bool {
        self.first
            .iter()
            .all(|difference| difference.abs() <= STILL_MM)
    }

    /// The axis that uses most of its velocity, acceleration and jerk in the period, and what
    /// share.
    pub(super) fn ratios(&self) -> [Option<(Axis, f64)>; 3] {
        let [velocity, acceleration, jerk] = &self.most;
        [
            largest(&self.first, velocity),
            largest(&self.second, acceleration),
            largest(&self.third, jerk),
        ]
    }

    /// How far the straight line of the period is from a curve with its acceleration across, mm.
    pub(super) fn chord_mm(&self) -> f64 {
        let (first, second) = (self.first, self.second);
        let length_2 = first.norm_squared();
        let across = if length_2 > 0.0 {
            second - first * (second.dot(&first) / length_2)
        } else {
            second
        };
        tolerance_norm(&across, 1.0) / 8.0
    }
}

/// The axis that uses the largest share of its limit.
fn largest(difference: &AxisVector, most: &AxisVector) -> Option<(Axis, f64)> {
    Axis::ALL
        .into_iter()
        .map(|axis| (axis, difference[axis.index()].abs() / most[axis.index()]))
        .reduce(|a, b| if b.1 > a.1 { b } else { a })
}
