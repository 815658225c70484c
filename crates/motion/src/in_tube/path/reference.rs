//! The path as the planner of a stretch is given it.

use crate::programmed_rate::PieceRate;
use glidepath_geometry::AxisVector;

/// The part of a piece that one can lay a ruler to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Straightness {
    /// How far the motion may be beside it there, mm.
    pub(crate) within_mm: f64,
    /// From which share of the piece to which.
    pub(crate) between_u: [f64; 2],
}

impl Straightness {
    /// That of one move: its middle half.
    pub(crate) const fn of_move(within_mm: f64) -> Self {
        Self {
            within_mm,
            between_u: [0.25, 0.75],
        }
    }

    /// What of it is on a part of the piece, from one share of it to another.
    fn on(self, [from_u, to_u]: [f64; 2]) -> Option<Self> {
        let between_u = self
            .between_u
            .map(|u| ((u - from_u) / (to_u - from_u)).clamp(0.0, 1.0));
        (between_u[0] < between_u[1]).then_some(Self { between_u, ..self })
    }
}

/// One straight piece of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reference {
    /// Where it ends; it starts where the piece before it ended.
    pub(crate) end: AxisVector,
    /// Largest path speeds, in mm/s of [`glidepath_geometry::feed_length`], > 0 and finite. For a
    /// rapid: the speed at which some axis is at its limit.
    pub(crate) rate: PieceRate,
    /// How far the motion may be from the path, and each vertex from the motion, in XYZ and in UVW,
    /// mm, > 0. At a vertex the smaller tolerance of both sides holds.
    pub(crate) tolerance_mm: f64,
    /// The same for the rotary axes together, degrees, > 0.
    pub(crate) tolerance_deg: f64,
    /// From the middle of the piece to the program it stands for, which is taken to be a parabola
    /// over it: where the motion is drawn to. Within what the tolerance is smaller by.
    pub(crate) sagitta_vector: AxisVector,
    /// Where it is to be straight; nowhere if the tolerance is for all of it.
    pub(crate) straight: Option<Straightness>,
    /// How far the motion may be beyond a border that it has to stay within, mm or degrees, where a small share of
    /// the tolerance is less.
    pub(crate) beyond_mm: f64,
    /// It has no feed.
    pub(crate) is_rapid: bool,
    /// Given back with each period, and asked for when rates change.
    pub(crate) tag: u64,
}

impl Reference {
    /// Both halves of a piece from a place, which is a line.
    pub(crate) fn halves_from(&self, start: &AxisVector) -> [Self; 2] {
        let half = |end: AxisVector, share_u: [f64; 2]| Self {
            end,
            straight: self.straight.and_then(|straight| straight.on(share_u)),
            ..*self
        };
        let middle = (start + self.end) * 0.5;
        [half(middle, [0.0, 0.5]), half(self.end, [0.5, 1.0])]
    }
}
