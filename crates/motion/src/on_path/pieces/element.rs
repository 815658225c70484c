//! The elements of a path: pieces, and the rests between them.

use super::piece::Piece;
use crate::rest::Rest;

/// An element of the path, as the path front makes it.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "nearly every element is a piece")]
pub(crate) enum Element {
    Piece(Piece),
    /// A rest of which the program knows nothing, inside a stretch.
    InnerRest(Rest),
    /// The stretch that the next rest ends can also be driven like this, at rest after each piece.
    Stops {
        pieces: Vec<Piece>,
        /// Whether each rest needs a setpoint exactly there.
        exact: bool,
    },
    Rest(Rest),
}
