//! What every axis does along a piece, and where it began to.
//!
//! ```text
//!   Z   ╲ down           ╱ up     A run is all pieces, one after the other, along which an axis goes
//!        ╲              ╱         one way, or rests. A rest keeps in mind with which sign the axis
//!         ╲____________╱          came to it, a run of moves what it set out from: pieces that have
//!            rest                 been passed are forgotten.
//! ```

use glidepath_geometry::{AXES, AxisVector};

/// A run that goes less far is roughness of a program, not a move to a place, in tolerances.
pub(crate) const WORTH_R: f64 = 0.25;
/// What moves less than this from where it rests is at rest, in tolerances.
const STILL_R: f64 = 1e-3;
/// Cosine of the turn between two pieces beyond which an axis that turns round does so at a corner, 17°;
/// else the path is a curve in chords there, which the motion may pass on its outer side.
const SHARP_COS: f64 = 0.955;

/// Where an axis goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AxisDirection {
    /// Nowhere.
    Rest,
    Up,
    Down,
    /// There and back within a piece that stands for a curve.
    Bent,
}

impl AxisDirection {
    /// 1 upwards, −1 downwards, else 0.
    pub(crate) const fn sign(self) -> f64 {
        match self {
            Self::Up => 1.0,
            Self::Down => -1.0,
            Self::Rest | Self::Bent => 0.0,
        }
    }

    /// True if an axis that goes this way turns round to go the other.
    pub(crate) fn turns_to(self, other: Self) -> bool {
        self.sign() * other.sign() < 0.0
    }
}

/// What an axis has set out from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    /// It was in motion, or that is not known.
    Motion,
    Rest,
    /// A corner at which it turned round.
    Turn,
}

/// What an axis does along a piece.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sense {
    pub(crate) way: AxisDirection,
    /// Coordinate at which the run began, and feed length from the start of the stretch up to there.
    pub(crate) from: f64,
    pub(crate) from_s: f64,
    /// Of a run of moves: what it set out from.
    pub(crate) origin: Origin,
    /// Of a rest: the sign with which the axis came to it; 0 where it did not, or hardly.
    pub(crate) came: f64,
}

impl Sense {
    /// At rest since the start of a stretch.
    pub(crate) const fn at_rest(from: f64) -> Self {
        Self {
            way: AxisDirection::Rest,
            from,
            from_s: 0.0,
            origin: Origin::Rest,
            came: 0.0,
        }
    }
}

/// True if a path turns sharply from one displacement to the next.
pub(crate) fn is_sharp(before: &AxisVector, after: &AxisVector) -> bool {
    before.dot(after) < SHARP_COS * before.norm() * after.norm()
}

/// What is to be known of a piece.
#[derive(Debug)]
pub(super) struct PieceGeometry<'a> {
    pub(super) start: &'a AxisVector,
    pub(super) end: &'a AxisVector,
    /// From its middle to the program.
    pub(super) sagitta_vector: &'a AxisVector,
    /// Feed length from the start of the stretch to its start.
    pub(super) start_s: f64,
    /// By axis.
    pub(super) tolerances: [f64; AXES],
}

impl PieceGeometry<'_> {
    /// What all axes do along it, by what they did along the piece before, whose displacement is given
    /// if there was one.
    pub(super) fn senses(
        &self,
        last: &[Sense; AXES],
        before: Option<&AxisVector>,
    ) -> [Sense; AXES] {
        let is_corner = before.is_some_and(|before| is_sharp(before, &(self.end - self.start)));
        core::array::from_fn(|axis| self.sense(axis, last[axis], is_corner))
    }

    fn sense(&self, axis: usize, last: Sense, is_corner: bool) -> Sense {
        let way = self.way(axis, &last);
        if way == last.way {
            return last;
        }
        let at = self.start[axis];
        let origin = match last.way {
            AxisDirection::Rest => Origin::Rest,
            _ if is_corner && last.way.turns_to(way) => Origin::Turn,
            _ => Origin::Motion,
        };
        let is_worth = (at - last.from).abs() >= WORTH_R * self.tolerances[axis];
        Sense {
            way,
            from: at,
            from_s: self.start_s,
            origin,
            came: if is_worth { last.way.sign() } else { 0.0 },
        }
    }

    fn way(&self, axis: usize, last: &Sense) -> AxisDirection {
        let (start, end) = (self.start[axis], self.end[axis]);
        let least = STILL_R * self.tolerances[axis];
        let rest = if last.way == AxisDirection::Rest {
            last.from
        } else {
            start
        };
        if (end - rest).abs() > least {
            if end > start {
                AxisDirection::Up
            } else {
                AxisDirection::Down
            }
        } else if self.sagitta_vector[axis].abs() > least {
            AxisDirection::Bent
        } else {
            AxisDirection::Rest
        }
    }
}
