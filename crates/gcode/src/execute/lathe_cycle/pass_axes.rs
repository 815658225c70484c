//! The frame in which passes are made, and the profile in it.
//!
//! ```text
//!   b ▲  stock side: the tool comes from here
//!     │                                  ● start
//!     │  ┌───┐                          ╱
//!     │  │   ╰──╮                     ╱
//!     │  │      │    ┌──╮           ╱
//!     │  end    ╰────┘  ╰─────── first
//!     └──────────────────────────────────────► a
//!        ◄───────────── the profile leads this way
//! ```
//!
//! G71 turns: *a* is Z and *b* is X; G72 faces: *a* is X and *b* is Z. Both are reversed where need
//! be, so that the profile leads to smaller *a* and the stock is on the side of larger *b*. A
//! profile never turns back along *a*: it is a function of *a*, with walls where it jumps.
//! Everything after this file rests on that.

use crate::execute::compensation::element::{Element, Point};

/// How far a profile may turn back, mm: its coordinates are rounded.
pub(crate) const ROUNDING_MM: f64 = 1e-3;

/// Which way *a* and *b* point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PassAxes {
    facing: bool,
    signs: Point,
}

impl PassAxes {
    /// The frame of a profile for a tool that starts at `start`, Z and X.
    pub(super) fn new(facing: bool, profile: &[Element], start: Point) -> Option<Self> {
        let (first, last) = (profile.first()?.start, profile.last()?.end);
        let swap = |point: Point| {
            if facing { [point[1], point[0]] } else { point }
        };
        let (first, last, start) = (swap(first), swap(last), swap(start));
        let sign = |positive: bool| if positive { 1.0 } else { -1.0 };
        // Where the start is level with the first point, the profile leads away from the axis.
        let depth = if (start[1] - first[1]).abs() > ROUNDING_MM {
            start[1] - first[1]
        } else {
            last[1] - first[1]
        };
        Some(Self {
            facing,
            signs: [sign(first[0] >= last[0]), sign(depth >= 0.0)],
        })
    }

    /// *a* and *b* of a point given by Z and X.
    pub(super) const fn inside(&self, point: Point) -> Point {
        let [a, b] = if self.facing {
            [point[1], point[0]]
        } else {
            point
        };
        [a * self.signs[0], b * self.signs[1]]
    }

    /// Z and X of a point given by *a* and *b*.
    pub(super) const fn outside(&self, point: Point) -> Point {
        let [a, b] = [point[0] * self.signs[0], point[1] * self.signs[1]];
        if self.facing { [b, a] } else { [a, b] }
    }

    /// True if what turns left in Z and X turns right in *a* and *b*.
    pub(super) fn mirrors(&self) -> bool {
        self.facing != (self.signs[0] * self.signs[1] < 0.0)
    }
}

/// What a piece of a contour is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PieceShape {
    /// The line through two points.
    Line(Point, Point),
    /// The upper half of a circle about a centre: a hill. Its radius.
    Hill(Point, f64),
    /// The lower half: a valley.
    Valley(Point, f64),
}

impl PieceShape {
    /// *b* at *a*; of a wall, its top.
    pub(super) fn at(&self, a: f64) -> f64 {
        let rise = |center: &Point, radius: f64| {
            (radius * radius - (a - center[0]).powi(2)).max(0.0).sqrt()
        };
        match self {
            Self::Line(p, q) if p[0].total_cmp(&q[0]).is_eq() => p[1].max(q[1]),
            Self::Line(p, q) => p[1] + (a - p[0]) * ((q[1] - p[1]) / (q[0] - p[0])),
            Self::Hill(center, radius) => center[1] + rise(center, *radius),
            Self::Valley(center, radius) => center[1] - rise(center, *radius),
        }
    }

    /// Centre, and whether it turns left in *a* and *b* on the way to smaller *a*.
    pub(super) const fn turn(&self) -> Option<(Point, bool)> {
        match self {
            Self::Line(..) => None,
            Self::Hill(center, _) => Some((*center, true)),
            Self::Valley(center, _) => Some((*center, false)),
        }
    }
}

/// A piece of a contour on the way to smaller *a*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContourPiece {
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) shape: PieceShape,
}

impl ContourPiece {
    pub(super) const fn line(start: Point, end: Point) -> Self {
        Self {
            start,
            end,
            shape: PieceShape::Line(start, end),
        }
    }

    /// True if it leads into the workpiece.
    pub(super) fn falls(&self) -> bool {
        self.end[1] < self.start[1]
    }

    /// Where it is at a level between its ends' ones. It must rise or fall all along.
    pub(super) fn at_level(&self, level: f64) -> f64 {
        let (low, high) = (
            self.start[0].min(self.end[0]),
            self.start[0].max(self.end[0]),
        );
        let a = match self.shape {
            PieceShape::Line(p, q) => p[0] + (level - p[1]) * ((q[0] - p[0]) / (q[1] - p[1])),
            PieceShape::Hill(center, radius) | PieceShape::Valley(center, radius) => {
                let half = (radius * radius - (level - center[1]).powi(2))
                    .max(0.0)
                    .sqrt();
                let middle = 0.5 * (low + high);
                center[0] + half.copysign(middle - center[0])
            }
        };
        // A level line has no place of its own: its end, where the way goes on.
        if a.is_finite() {
            a.clamp(low, high)
        } else {
            self.end[0]
        }
    }
}

/// The pieces of a profile; else the index of the element at which it turns back.
pub(crate) fn pieces(axes: &PassAxes, profile: &[Element]) -> Result<Vec<ContourPiece>, usize> {
    let mut pieces: Vec<ContourPiece> = Vec::with_capacity(profile.len());
    for (index, element) in profile.iter().enumerate() {
        let (mut start, mut end) = (axes.inside(element.start), axes.inside(element.end));
        if end[0] > start[0] + ROUNDING_MM {
            return Err(index);
        }
        if let Some(last) = pieces.last() {
            start = last.end;
        }
        end[0] = end[0].min(start[0]);
        let shape = match element.arc {
            None => PieceShape::Line(start, end),
            Some((center, sweep)) => {
                let left = (sweep > 0.0) != axes.mirrors();
                half_circle(start, end, axes.inside(center), left).ok_or(index)?
            }
        };
        pieces.push(ContourPiece { start, end, shape });
    }
    Ok(pieces)
}

/// The half circle through both ends whose centre is nearest to the given one; `None` if the arc
/// turns back.
fn half_circle(start: Point, end: Point, center: Point, left: bool) -> Option<PieceShape> {
    let chord = [end[0] - start[0], end[1] - start[1]];
    let squared = chord[0] * chord[0] + chord[1] * chord[1];
    let middle = [0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])];
    let across = [-chord[1], chord[0]];
    let off = (center[0] - middle[0]) * across[0] + (center[1] - middle[1]) * across[1];
    let share = off / squared;
    let center = [middle[0] + share * across[0], middle[1] + share * across[1]];
    let radius = (start[0] - center[0]).hypot(start[1] - center[1]);
    let side = if left { 1.0 } else { -1.0 };
    let inside = |point: Point| side * (point[1] - center[1]) >= -ROUNDING_MM;
    let turns_back = start[0] - end[0] < ROUNDING_MM || !inside(start) || !inside(end);
    if turns_back || !radius.is_finite() {
        return None;
    }
    Some(if left {
        PieceShape::Hill(center, radius)
    } else {
        PieceShape::Valley(center, radius)
    })
}
