//! What the rotary axes, or the direction that they give the tool, may be off along a programmed move.

use crate::flatten::whole;
use crate::tool_axis::Turn;

/// Distance between the directions of a move and their chords, as a part of the tolerance of direction.
const FLATTENING: f64 = 1e-4;
/// Most chords of a move whose directions are all within the tolerance of each other, as by the pole: each of them may be
/// the one that the motion has come to.
const MOST_NEAR: f64 = 1024.0;

/// What may be off along a chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurnTolerance {
    /// Along it, degrees.
    pub(crate) along_deg: f64,
    /// At its end, degrees.
    pub(crate) end_deg: f64,
    /// It is the direction of the tool that is judged, and not the axes.
    pub(crate) is_way: bool,
    /// Beside the direction, they are judged by this part of its tolerance.
    pub(crate) axes_r: Option<f64>,
    /// What a degree counts for, mm.
    pub(crate) mm_per_deg: f64,
}

impl TurnTolerance {
    /// That of a move at whose start and end so many degrees are allowed, and of its directions taken for chords;
    /// `slack`: what counts as kept.
    pub(crate) fn of_move(
        [start_deg, end_deg]: [f64; 2],
        (turn, chords): (Turn, u32),
        slack: f64,
    ) -> Self {
        let flattened_deg = turn.flattened_deg(f64::from(chords));
        Self {
            along_deg: end_deg.max(start_deg) * slack + flattened_deg,
            end_deg: end_deg * slack + flattened_deg,
            is_way: false,
            axes_r: None,
            mm_per_deg: 1.0,
        }
    }

    /// That of one of the chords of a move.
    pub(crate) const fn of_chord(self, is_last: bool) -> Self {
        Self {
            end_deg: if is_last {
                self.end_deg
            } else {
                self.along_deg
            },
            ..self
        }
    }
}

/// How many chords the directions of a move are taken for.
pub(crate) fn turn_chords(turn: Turn, allowed_deg: f64) -> u32 {
    let most = if turn.span_deg() <= allowed_deg {
        MOST_NEAR
    } else {
        1e9
    };
    whole(turn.chords(FLATTENING * allowed_deg), most)
}
