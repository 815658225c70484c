//! What the rotary axes, or the direction that they give the tool, may be off along a programmed move.

use crate::tool_axis::chords;

/// Distance between the directions of a move and their chords, as a part of the tolerance of direction.
const FLATTENING: f64 = 1e-4;

/// What may be off along a chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurnTolerance {
    /// Along it, degrees.
    pub(crate) along_deg: f64,
    /// At its end, degrees.
    pub(crate) end_deg: f64,
    /// It is the direction of the tool that is judged, and not the axes.
    pub(crate) is_way: bool,
    /// What a degree counts for, mm.
    pub(crate) mm_per_deg: f64,
}

impl TurnTolerance {
    /// That of a move at whose start and end so many degrees are allowed, which turns the tool by so many; `slack`: what
    /// counts as kept.
    pub(crate) fn of_move([start_deg, end_deg]: [f64; 2], turn_deg: f64, slack: f64) -> Self {
        let slack = if turn_deg > 0.0 {
            slack + FLATTENING
        } else {
            slack
        };
        Self {
            along_deg: end_deg.max(start_deg) * slack,
            end_deg: end_deg * slack,
            is_way: false,
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
pub(crate) fn turn_chords(turn_deg: f64, allowed_deg: f64) -> u32 {
    let count = chords(turn_deg, FLATTENING * allowed_deg);
    let count = count.ceil().clamp(1.0, 1e9);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped"
    )]
    let count = count as u32;
    count
}
