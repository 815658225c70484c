//! Segments: the pieces a program is made of, each a curve over all nine axes.
//!
//! A segment is parametrised by *path position* `s`, from 0 to [`Segment::length`]. Its length is
//! the feed length of RS274/NGC: the XYZ length if any of X, Y, Z moves, else the UVW length if
//! any of those moves, else the length of the rotary motion in degrees. The feedrate is the rate
//! of `s`, so a rotary axis that turns along with a linear move does not slow the tool.

use crate::{Arc, AxisVector, Jet, LINEAR_XYZ, Quintic, ROTARY_ABC, UVW};

/// A straight move over any of the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where it starts.
    pub start: AxisVector,
    /// Where it ends.
    pub end: AxisVector,
}

/// A programmed piece of path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Straight.
    Line(Line),
    /// Circular, helical, or slightly spiral.
    Arc(Arc),
    /// A piece of another smooth curve.
    Curve(Quintic),
}

/// A displacement below this in a group of axes is rounding of coordinates, not a move: 0.1 nm (or
/// 1e-7 degrees).
pub(crate) const ROUNDING_MM: f64 = 1e-7;

/// Feed length of a displacement: XYZ if it has any, else UVW, else degrees of rotation.
///
/// A group whose motion is only rounding (below 1e-7) counts as not moving, unless no group moves
/// more: then the longest decides, so the result is zero only for a zero displacement.
#[must_use]
#[inline]
pub fn feed_length(displacement: &AxisVector) -> f64 {
    let length = |group: core::ops::Range<usize>| {
        let squares = group.map(|i| displacement[i] * displacement[i]);
        squares.sum::<f64>().sqrt()
    };
    let linear = length(LINEAR_XYZ);
    // Nearly every move is one of XYZ.
    if linear > ROUNDING_MM {
        return linear;
    }
    let lengths = [linear, length(UVW), length(ROTARY_ABC)];
    let longest = lengths.into_iter().fold(0.0, f64::max);
    lengths
        .into_iter()
        .find(|&length| length > ROUNDING_MM)
        .unwrap_or(longest)
}

impl Line {
    /// End minus start.
    #[must_use]
    pub fn displacement(&self) -> AxisVector {
        self.end - self.start
    }
}

impl Segment {
    /// A straight segment.
    #[must_use]
    pub const fn line(start: AxisVector, end: AxisVector) -> Self {
        Self::Line(Line { start, end })
    }

    /// First point.
    #[must_use]
    pub const fn start(&self) -> AxisVector {
        match self {
            Self::Line(line) => line.start,
            Self::Arc(arc) => arc.start,
            Self::Curve(curve) => curve.start,
        }
    }

    /// Last point.
    #[must_use]
    pub const fn end(&self) -> AxisVector {
        match self {
            Self::Line(line) => line.end,
            Self::Arc(arc) => arc.end,
            Self::Curve(curve) => curve.end,
        }
    }

    /// Feed length, ≥ 0; see the module text.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => feed_length(&line.displacement()),
            Self::Arc(arc) => arc.length(),
            Self::Curve(curve) => curve.length,
        }
    }

    /// Position and derivatives at path position `s`, which is clamped to the segment only by the
    /// caller. A segment of zero length has zero derivatives.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        match self {
            Self::Line(line) => line.prepared().jet(s),
            Self::Arc(arc) => arc.jet(s),
            Self::Curve(curve) => curve.jet(s),
        }
    }

    /// The largest distance from what was programmed, mm.
    #[must_use]
    pub const fn error_mm(&self) -> f64 {
        match self {
            Self::Line(_) | Self::Arc(_) => 0.0,
            Self::Curve(curve) => curve.error_mm,
        }
    }

    /// Smallest and largest coordinate on every axis.
    #[must_use]
    pub fn bounding_box(&self) -> (AxisVector, AxisVector) {
        match self {
            Self::Line(line) => (line.start.inf(&line.end), line.start.sup(&line.end)),
            Self::Arc(arc) => arc.bounding_box(),
            Self::Curve(curve) => curve.bounding_box(),
        }
    }
}
