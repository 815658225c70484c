//! A programmed move as the rules of tremor see it: which axes it leaves alone, and how round it
//! is.

use glidepath_geometry::{AXES, AxisVector, Plane, Segment};

/// A programmed move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    /// Which of the moves of the program it is.
    pub(crate) number: u64,
    /// Axes whose coordinate is the same, bit for bit, all along it.
    pub(crate) still: [bool; AXES],
    pub(crate) shape: Shape,
}

/// What a move looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Line,
    /// A circle or a helix.
    Arc {
        plane: Plane,
        /// Coordinates of the centre on the first and second axis of the plane, mm.
        center: [f64; 2],
    },
    Other,
}

impl Piece {
    pub(crate) fn new(number: u64, segment: &Segment) -> Self {
        Self {
            number,
            still: still(segment),
            shape: shape(segment),
        }
    }
}

fn still(segment: &Segment) -> [bool; AXES] {
    let (start, end) = (segment.start(), segment.end());
    let mut still = same(&start, &end);
    match segment {
        Segment::Line(_) => {}
        Segment::Arc(arc) => {
            let (first, second) = arc.plane.axes();
            still[first.index()] = false;
            still[second.index()] = false;
        }
        Segment::Curve(_) => {
            // A polynomial of fifth degree that has a value six times is constant.
            let length = segment.length();
            for place in [0.2, 0.4, 0.6, 0.8] {
                let inner = same(&start, &segment.jet(place * length).position);
                for (still, inner) in still.iter_mut().zip(inner) {
                    *still &= inner;
                }
            }
        }
    }
    still
}

fn same(a: &AxisVector, b: &AxisVector) -> [bool; AXES] {
    #[allow(
        clippy::float_cmp,
        reason = "a coordinate that is left alone is copied"
    )]
    core::array::from_fn(|axis| a[axis] == b[axis])
}

fn shape(segment: &Segment) -> Shape {
    match segment {
        Segment::Line(_) => Shape::Line,
        Segment::Arc(arc) => Shape::Arc {
            plane: arc.plane,
            center: arc.center,
        },
        Segment::Curve(_) => Shape::Other,
    }
}
