//! The stops of axes at vertices, where they come to a rest, set out from one or turn round, and
//! the distance of a motion beyond them.

use super::corner::turn_cos;
use crate::follow::Move;
use glidepath_geometry::{AXES, AxisVector, Segment};

/// Cosine of the least turn of a vertex with stops, 20°: what turns less may be a curve in chords.
const LEAST_TURN_COS: f64 = 0.939_692_620_785_908_4;
/// Moves shorter than so many tolerances are no figure: the motion may leave them out.
const MOVE_TOLERANCES: f64 = 8.0;
/// An axis moves from so many tolerances on.
const WAY_TOLERANCES: f64 = 1.0;

/// What an axis does along a move.
#[derive(Clone, Copy, PartialEq)]
enum AxisMotion {
    Rests,
    /// The sign of its motion.
    Moves(f64),
    /// It moves less, or both ways.
    Other,
}

impl AxisMotion {
    fn along(of: &Move, axis: usize) -> Self {
        let (start, end) = (of.programmed.start()[axis], of.programmed.end()[axis]);
        let is_straight = match &of.programmed {
            Segment::Line(_) => true,
            Segment::Arc(arc) => {
                let (first, second) = arc.plane.axes();
                axis != first.index() && axis != second.index()
            }
            Segment::Curve(_) => false,
        };
        if !is_straight {
            Self::Other
        } else if (end - start).abs() >= WAY_TOLERANCES * of.tolerance_mm {
            Self::Moves((end - start).signum())
        } else if (end - start).abs() <= 0.0 {
            Self::Rests
        } else {
            Self::Other
        }
    }
}

/// The stops of axes at a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stops {
    vertex: AxisVector,
    /// By axis: 1 if it is to stay above the vertex, −1 if below, 0 if it does not stop there.
    signs: [f64; AXES],
}

impl Stops {
    /// Between two moves one after the other; none where nothing stops.
    pub(super) fn between(before: &Move, behind: &Move) -> Option<Self> {
        let least_mm = MOVE_TOLERANCES * before.tolerance_mm.max(behind.tolerance_mm);
        let cos = turn_cos(before, behind)?;
        if before.length_s < least_mm || behind.length_s < least_mm || cos > LEAST_TURN_COS {
            return None;
        }
        let signs = core::array::from_fn(|axis| {
            match [before, behind].map(|side| AxisMotion::along(side, axis)) {
                [AxisMotion::Moves(way), AxisMotion::Rests] => -way,
                [AxisMotion::Rests, AxisMotion::Moves(way)] => way,
                [AxisMotion::Moves(way), AxisMotion::Moves(then)] if way * then < 0.0 => then,
                _ => 0.0,
            }
        });
        let vertex = behind.programmed.start();
        signs
            .iter()
            .any(|sign| sign.abs() > 0.0)
            .then_some(Self { vertex, signs })
    }

    /// How far a coordinate is beyond its stop, mm or degrees; 0 where it is not.
    pub(super) fn beyond_mm(&self, position: &AxisVector, axis: usize) -> f64 {
        (self.signs[axis] * (self.vertex[axis] - position[axis])).max(0.0)
    }
}
