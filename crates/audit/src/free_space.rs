//! One cell of the free-space diagram: where a programmed chord and a chord of the motion are near.
//!
//! A programmed chord is parametrised by y and a chord of the motion by x, both over [0, 1]. The
//! distance is the largest over groups: XYZ together, UVW together, and the rotary axes together, or the direction
//! that they give the tool, as a point of a sphere.
//! Where it is at most a threshold is a convex set of (x, y), and on an edge of the cell (one end
//! of one chord against the other chord) an interval.

use glidepath_geometry::{AXES, AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};
use glidepath_program::tolerance_norm;

use crate::tool_axis::dip_deg;

/// How often the place of a least distance is looked for in two thirds of where it was: 2³⁰ times as narrow.
const THIRDS: u32 = 52;
/// Indices of all axes but X, Y and Z.
const OTHERS: core::ops::Range<usize> = LINEAR_XYZ.end..AXES;

/// An interval [low, high]; empty if low > high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Interval {
    pub(crate) const EMPTY: Self = Self {
        low: 1.0,
        high: 0.0,
    };
    pub(crate) const FULL: Self = Self {
        low: 0.0,
        high: 1.0,
    };

    pub(crate) fn is_empty(self) -> bool {
        self.low > self.high
    }

    pub(crate) fn intersect(self, other: Self) -> Self {
        Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }

    /// The part at or above a value.
    pub(crate) fn from(self, low: f64) -> Self {
        Self {
            low: self.low.max(low),
            high: self.high,
        }
    }
}

/// A place: where the axes are, and which way they point the tool, degrees long; zero where nobody says how they turn
/// it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) axes: &'a AxisVector,
    pub(crate) way: [f64; 3],
}

/// What is near.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Near {
    /// In XYZ, and in UVW, mm.
    pub(crate) mm: f64,
    pub(crate) rotary: NearTurn,
}

/// What is near of the rotary axes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum NearTurn {
    /// They together, degrees.
    Axes(f64),
    /// The direction that they give the tool, and they together where each is a freedom of its own, degrees.
    Way { deg: f64, axes_deg: Option<f64> },
    /// Whatever they do.
    Any,
}

/// A chord, with what is asked of it again and again.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chord {
    pub(crate) from: AxisVector,
    pub(crate) to: AxisVector,
    /// Directions of the tool at its ends.
    pub(crate) ways: [[f64; 3]; 2],
    /// How far the chord of both dips below the sphere of directions, degrees.
    dip_deg: f64,
    /// Its length in XYZ, squared.
    linear_2: f64,
    /// It moves in XYZ alone.
    is_linear: bool,
}

impl Chord {
    /// A chord of a machine of whose tool nobody says how it turns.
    pub(crate) fn new(from: AxisVector, to: AxisVector) -> Self {
        Self::with_ways(from, to, [[0.0; 3]; 2])
    }

    pub(crate) fn with_ways(from: AxisVector, to: AxisVector, ways: [[f64; 3]; 2]) -> Self {
        let along = to - from;
        Self {
            from,
            to,
            ways,
            dip_deg: dip_deg(&ways),
            linear_2: LINEAR_XYZ.map(|i| along[i] * along[i]).sum(),
            is_linear: OTHERS.into_iter().all(|i| along[i] == 0.0),
        }
    }

    /// A part of it.
    pub(crate) fn part(&self, part: Interval) -> Self {
        let along = self.displacement();
        let way = |at: f64| -> [f64; 3] {
            let [from, to] = self.ways;
            core::array::from_fn(|i| from[i] + (to[i] - from[i]) * at)
        };
        let ends = [part.low, part.high];
        let [from, to] = ends.map(|at| self.from + along * at);
        Self::with_ways(from, to, ends.map(way))
    }

    /// Where it ends.
    pub(crate) const fn end(&self) -> Place<'_> {
        Place {
            axes: &self.to,
            way: self.ways[1],
        }
    }

    /// How far a direction is from the nearest on it, degrees.
    pub(crate) fn off_way_deg(&self, way: &[f64; 3]) -> f64 {
        let [from, to] = &self.ways;
        let (mut dot, mut square) = (0.0, 0.0);
        for i in 0..3 {
            dot += (to[i] - from[i]) * (way[i] - from[i]);
            square += (to[i] - from[i]).powi(2);
        }
        let part = if square > 1e-30 {
            (dot / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let off = |i: usize| way[i] - from[i] - (to[i] - from[i]) * part;
        let off_2: f64 = (0..3).map(|i| off(i).powi(2)).sum();
        let dip_deg = 4.0 * part * (1.0 - part) * self.dip_deg;
        (off_2 - dip_deg * dip_deg).max(0.0).sqrt()
    }

    pub(crate) fn displacement(&self) -> AxisVector {
        self.to - self.from
    }

    /// Its length over all axes.
    pub(crate) fn travel_mm(&self) -> f64 {
        if self.is_linear {
            self.linear_2.sqrt()
        } else {
            self.displacement().norm()
        }
    }

    /// How far a point is from its nearest part, mm; a degree of the rotary axes counts for so many.
    pub(crate) fn distance_mm(&self, point: &AxisVector, mm_per_deg: f64) -> f64 {
        let along = self.displacement();
        let at_mm = |part: f64| tolerance_norm(&(point - self.from - along * part), mm_per_deg);
        if self.is_linear {
            let dot: f64 = (LINEAR_XYZ.map(|i| along[i] * (point[i] - self.from[i]))).sum();
            let foot = if self.linear_2 > 1e-30 {
                dot / self.linear_2
            } else {
                0.0
            };
            return at_mm(foot.clamp(0.0, 1.0));
        }
        // Each group of axes has a nearest part of its own; the largest distance of them all has no valley but one.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..THIRDS {
            let third = (high - low) / 3.0;
            if at_mm(low + third) <= at_mm(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        at_mm(0.5 * (low + high))
    }

    /// True only if no part is within `threshold` of `point`, told by X, Y and Z one by one:
    /// mostly the answer, and without a division.
    #[inline]
    pub(crate) fn is_far(&self, point: &AxisVector, threshold: f64) -> bool {
        let room = threshold * (1.0 + 1e-9) + 1e-9;
        LINEAR_XYZ.into_iter().any(|i| {
            let (a, b, x) = (self.from[i], self.to[i], point[i]);
            (x > a + room && x > b + room) || (x < a - room && x < b - room)
        })
    }

    /// The part that is near a place.
    #[inline]
    pub(crate) fn near(&self, place: &Place<'_>, within: &Near) -> Interval {
        let point = place.axes;
        let offset = LINEAR_XYZ.map(|i| point[i] - self.from[i]);
        let along = LINEAR_XYZ.map(|i| self.to[i] - self.from[i]);
        let part = near_group(along.zip(offset), self.linear_2, within.mm, Interval::FULL);
        let is_all = self.is_linear && OTHERS.into_iter().all(|i| point[i] - self.from[i] == 0.0);
        if part.is_empty() || is_all {
            return part;
        }
        self.near_others(place, within, part)
    }

    fn near_others(&self, place: &Place<'_>, within: &Near, mut part: Interval) -> Interval {
        let offset = place.axes - self.from;
        let along = self.displacement();
        let group = |axes: core::ops::Range<usize>, threshold, part| {
            let length_2 = axes.clone().map(|i| along[i] * along[i]).sum();
            let pairs = axes.map(|i| (along[i], offset[i]));
            near_group(pairs, length_2, threshold, part)
        };
        let moves = |axes: core::ops::Range<usize>| {
            axes.into_iter()
                .any(|i| along[i] != 0.0 || offset[i] != 0.0)
        };
        if moves(UVW) {
            part = group(UVW, within.mm, part);
        }
        match within.rotary {
            NearTurn::Axes(deg) if moves(ROTARY_ABC) => group(ROTARY_ABC, deg, part),
            NearTurn::Way { deg, axes_deg } if moves(ROTARY_ABC) => {
                if let Some(axes_deg) = axes_deg {
                    part = group(ROTARY_ABC, axes_deg, part);
                }
                let [from, to] = &self.ways;
                let pairs = (0..3).map(|i| (to[i] - from[i], place.way[i] - from[i]));
                let length_2 = pairs.clone().map(|(along, _)| along * along).sum();
                // The place is on the sphere; what the chord is below it is across every difference of directions.
                near_group(pairs, length_2, deg.hypot(self.dip_deg), part)
            }
            NearTurn::Axes(_) | NearTurn::Way { .. } | NearTurn::Any => part,
        }
    }
}

/// The part of `part` that is near in a group of axes: of each the chord along it, and the offset
/// of the point from its start.
#[inline]
fn near_group(
    axes: impl Iterator<Item = (f64, f64)> + Clone,
    length_2: f64,
    threshold: f64,
    part: Interval,
) -> Interval {
    let mut dot = 0.0;
    for (along, offset) in axes.clone() {
        dot += along * offset;
    }
    // The foot of the perpendicular, then the perpendicular itself: squaring the offset first would
    // lose half the digits. A chord too short to have a direction is a point.
    let foot = if length_2 > 1e-30 {
        dot / length_2
    } else {
        0.0
    };
    let mut distance_2 = 0.0;
    for (along, offset) in axes {
        let across = offset - along * foot;
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
