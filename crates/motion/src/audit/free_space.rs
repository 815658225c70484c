//! One cell of the free-space diagram: where a programmed chord and a chord of the motion are near.
//!
//! A programmed chord is parametrised by y and a chord of the motion by x, both over [0, 1]. The
//! distance is the largest over groups: XYZ together, UVW together, each rotary axis by itself. Where
//! it is at most a threshold is a convex set of (x, y), and on an edge of the cell (one end of one
//! chord against the other chord) an interval.

use glidepath_geometry::{AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};

/// An interval [low, high]; empty if low > high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Interval {
    pub(super) const EMPTY: Self = Self {
        low: 1.0,
        high: 0.0,
    };
    pub(super) const FULL: Self = Self {
        low: 0.0,
        high: 1.0,
    };

    pub(super) fn is_empty(self) -> bool {
        self.low > self.high
    }

    pub(super) fn intersect(self, other: Self) -> Self {
        Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }

    /// The part at or above a value.
    pub(super) fn from(self, low: f64) -> Self {
        Self {
            low: self.low.max(low),
            high: self.high,
        }
    }
}

/// The part of the chord from `a` to `b` that is within `threshold` of `point`.
pub(super) fn near(a: &AxisVector, b: &AxisVector, point: &AxisVector, threshold: f64) -> Interval {
    let along = b - a;
    let offset = point - a;
    let mut part = near_group(&along, &offset, LINEAR_XYZ, threshold, Interval::FULL);
    if part.is_empty() {
        return part;
    }
    let moves =
        |axes: core::ops::Range<usize>| axes.clone().any(|i| along[i] != 0.0 || offset[i] != 0.0);
    if moves(UVW) {
        part = near_group(&along, &offset, UVW, threshold, part);
    }
    if moves(ROTARY_ABC) {
        for axis in ROTARY_ABC {
            part = near_group(&along, &offset, axis..axis + 1, threshold, part);
        }
    }
    part
}

fn near_group(
    along: &AxisVector,
    offset: &AxisVector,
    axes: core::ops::Range<usize>,
    threshold: f64,
    part: Interval,
) -> Interval {
    let (mut length_2, mut dot) = (0.0, 0.0);
    for i in axes.clone() {
        length_2 += along[i] * along[i];
        dot += along[i] * offset[i];
    }
    // The foot of the perpendicular, then the perpendicular itself: squaring the offset first would
    // lose half the digits. A chord too short to have a direction is a point.
    let foot = if length_2 > 1e-30 {
        dot / length_2
    } else {
        0.0
    };
    let mut distance_2 = 0.0;
    for i in axes {
        let across = offset[i] - along[i] * foot;
        distance_2 += across * across;
    }
    let room = threshold * threshold - distance_2;
    // Not a number is not near.
    let is_near = room >= 0.0;
    if !is_near {
        return Interval::EMPTY;
    }
    if length_2 <= 1e-30 {
        return part;
    }
    let half = (room / length_2).sqrt();
    part.intersect(Interval {
        low: foot - half,
        high: foot + half,
    })
}

/// Length of a displacement in the sense of the tolerance: the largest over the groups.
pub(super) fn distance(displacement: &AxisVector) -> f64 {
    let norm = |axes: core::ops::Range<usize>| {
        axes.map(|i| displacement[i] * displacement[i])
            .sum::<f64>()
            .sqrt()
    };
    ROTARY_ABC
        .map(|i| displacement[i].abs())
        .fold(norm(LINEAR_XYZ).max(norm(UVW)), f64::max)
}
